// Solids from finished tables: every vertex, edge and face is made once and shared by handle.
#pragma once

#include "occt-bridge/shim/shape.hpp"

namespace clinothem::occt {

struct AssembledData;
struct SolidsHandle;

// The tables are checked in Rust; what only the kernel can refuse is named by its entry.
std::unique_ptr<SolidsHandle> build_assembled(const AssembledData& data);

}  // namespace clinothem::occt
