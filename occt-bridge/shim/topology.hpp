// Shapes from plain tables of vertices, curves, surfaces, edges and faces.
#pragma once

#include "occt-bridge/shim/shape.hpp"

namespace clinothem::occt {

struct TopologyData;

// One closed shell as a solid whose faces point outwards.
std::unique_ptr<ShapeHandle> build_solid(const TopologyData& data);
// Every face by itself, in a compound.
std::unique_ptr<ShapeHandle> build_faces(const TopologyData& data);

}  // namespace clinothem::occt
