// Handles that Rust holds: a shape, a list of shapes, and the faces of a set of solids.
#pragma once

#include "occt-bridge/shim/failure.hpp"
#include "rust/cxx.h"

#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <TopoDS_Solid.hxx>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace clinothem::occt {

struct ShapeHandle {
  explicit ShapeHandle(const TopoDS_Shape& s) : shape(s) {}
  TopoDS_Shape shape;
};

struct ShapeList {
  std::vector<TopoDS_Shape> shapes;
  void push(const ShapeHandle& shape) { shapes.push_back(shape.shape); }
};

std::unique_ptr<ShapeHandle> handle(const TopoDS_Shape& shape);
std::unique_ptr<ShapeList> new_list();
std::unique_ptr<ShapeHandle> compound_of(const ShapeList& list);
rust::String kind_of(const ShapeHandle& shape);
std::size_t count_of(const ShapeHandle& shape, std::uint8_t kind);
rust::String kernel_version();
void use_threads(std::size_t count);

// A copy of the topology on the same geometry, so that what an operation writes into it (tolerances, curves on surfaces,
// triangles) does not reach the argument. Faces are visited in the same order.
TopoDS_Shape topology_copy(const TopoDS_Shape& shape);

// Calls body(i) for 0 <= i < count, on several threads if asked. The first failure by index is thrown after all have ended.
void for_each_index(std::size_t count, bool parallel, const std::function<void(std::size_t)>& body);

}  // namespace clinothem::occt
