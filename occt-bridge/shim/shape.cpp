#include "occt-bridge/shim/shape.hpp"

#include <BRepBuilderAPI_Copy.hxx>
#include <BRep_Builder.hxx>
#include <OSD_Parallel.hxx>
#include <OSD_ThreadPool.hxx>
#include <Standard_Version.hxx>
#include <TopAbs.hxx>
#include <TopExp.hxx>

namespace clinothem::occt {

std::unique_ptr<ShapeHandle> handle(const TopoDS_Shape& shape) {
  if (shape.IsNull()) throw Refused("the operation returned no shape");
  return std::make_unique<ShapeHandle>(shape);
}

std::unique_ptr<ShapeList> new_list() { return std::make_unique<ShapeList>(); }

std::unique_ptr<ShapeHandle> compound_of(const ShapeList& list) {
  BRep_Builder builder;
  TopoDS_Compound compound;
  builder.MakeCompound(compound);
  for (const TopoDS_Shape& shape : list.shapes) builder.Add(compound, shape);
  return handle(compound);
}

rust::String kind_of(const ShapeHandle& shape) {
  switch (shape.shape.ShapeType()) {
    case TopAbs_COMPOUND: return "compound";
    case TopAbs_COMPSOLID: return "compsolid";
    case TopAbs_SOLID: return "solid";
    case TopAbs_SHELL: return "shell";
    case TopAbs_FACE: return "face";
    case TopAbs_WIRE: return "wire";
    case TopAbs_EDGE: return "edge";
    case TopAbs_VERTEX: return "vertex";
    default: return "shape";
  }
}

std::size_t count_of(const ShapeHandle& shape, std::uint8_t kind) {
  static const TopAbs_ShapeEnum kinds[] = {TopAbs_SOLID, TopAbs_SHELL, TopAbs_FACE, TopAbs_EDGE, TopAbs_VERTEX};
  if (kind >= 5) throw BadInput("no such kind of shape");
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape.shape, kinds[kind], map);
  return static_cast<std::size_t>(map.Extent());
}

rust::String kernel_version() { return OCC_VERSION_COMPLETE; }

void use_threads(std::size_t count) {
  if (count == 0 || count > 1024) throw BadInput("the number of threads must be between 1 and 1024");
  OSD_Parallel::SetUseOcctThreads(Standard_True);
  OSD_ThreadPool::DefaultPool()->Init(static_cast<int>(count));
}

TopoDS_Shape topology_copy(const TopoDS_Shape& shape) {
  BRepBuilderAPI_Copy copy(shape, Standard_False, Standard_False);
  if (!copy.IsDone()) throw Refused("the topology could not be copied");
  return copy.Shape();
}

void for_each_index(std::size_t count, bool parallel, const std::function<void(std::size_t)>& body) {
  std::vector<std::string> failures(count);
  auto guarded = [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    rust::behavior::trycatch([&] { body(index); }, [&](const std::string& what) { failures[index] = what; });
  };
  OSD_Parallel::For(0, static_cast<int>(count), guarded, parallel ? Standard_False : Standard_True);
  for (const std::string& what : failures)
    if (!what.empty()) throw std::runtime_error(what);
}

}  // namespace clinothem::occt
