// Solids from finished tables: every vertex, edge and face is made once and shared by handle.
#pragma once

#include "occt-bridge/shim/shape.hpp"

namespace clinothem::occt {

struct AssembledData;
struct MergeData;
struct SolidsHandle;

// Shells and solids of faces that are there.
std::unique_ptr<SolidsHandle> solids_of(const std::vector<TopoDS_Face>& faces, const MergeData& data);
// The tables are checked in Rust; what only the kernel can refuse is named by its entry.
std::unique_ptr<SolidsHandle> build_assembled(const AssembledData& data);

}  // namespace clinothem::occt
