// Triangles for pictures.
#pragma once

#include "occt-bridge/shim/partition.hpp"

namespace clinothem::occt {

struct MeshData;

// One mesh per face of the shape, wound so that triangles face the way the face is oriented.
rust::Vec<MeshData> mesh_shape(const ShapeHandle& shape, double deflection, double angle, bool parallel);
// One mesh per face of the table, wound for the FORWARD face.
rust::Vec<MeshData> mesh_solids(const SolidsHandle& solids, double deflection, double angle, bool parallel);

}  // namespace clinothem::occt
