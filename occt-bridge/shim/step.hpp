// Reading STEP. Everything here works on process-wide state: the caller holds a lock.
#pragma once

#include "occt-bridge/shim/shape.hpp"

namespace clinothem::occt {

struct ReadPartData;
struct ReadParts {
  std::vector<TopoDS_Shape> shapes;
  std::unique_ptr<ShapeHandle> shape(std::size_t index) const;
};

std::unique_ptr<ReadParts> read_parts(rust::Str path, rust::Str unit, rust::Vec<ReadPartData>& tables);

}  // namespace clinothem::occt
