// STEP in metres. Everything here works on process-wide state: the caller holds a lock.
#pragma once

#include "occt-bridge/shim/shape.hpp"

namespace clinothem::occt {

struct StepNodeData;
struct StepHeader;
struct ReadPartData;
struct ReadParts {
  std::vector<TopoDS_Shape> shapes;
  std::unique_ptr<ShapeHandle> shape(std::size_t index) const;
};

void write_assembly(rust::Str path, const StepHeader& header, const rust::Vec<StepNodeData>& nodes, const ShapeList& shapes);
void write_shared(rust::Str path, const StepHeader& header, const ShapeHandle& shape, const rust::Vec<rust::String>& names);
std::unique_ptr<ReadParts> read_parts(rust::Str path, rust::Vec<ReadPartData>& tables);

}  // namespace clinothem::occt
