// Validity by BRepCheck, in words.
#pragma once

#include "occt-bridge/shim/shape.hpp"

namespace clinothem::occt {

struct DefectData;
struct SolidsHandle;

// The first thing wrong with a shape, or an empty text.
std::string first_defect(const TopoDS_Shape& shape);
rust::Vec<DefectData> find_defects(const SolidsHandle& solids, bool parallel);

}  // namespace clinothem::occt
