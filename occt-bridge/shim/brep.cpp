#include "occt-bridge/shim/brep.hpp"

#include "occt-bridge/src/ffi.rs.h"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>

#include <fstream>
#include <sstream>

namespace clinothem::occt {

namespace {

rust::Vec<std::uint8_t> bytes_of(const TopoDS_Shape& shape) {
  std::ostringstream stream(std::ios::binary);
  BinTools::Write(shape, stream);
  if (!stream) throw Refused("the shape could not be written to memory");
  const std::string text = stream.str();
  rust::Vec<std::uint8_t> out;
  out.reserve(text.size());
  for (char c : text) out.push_back(static_cast<std::uint8_t>(c));
  return out;
}

TopoDS_Shape shape_of(rust::Slice<const std::uint8_t> bytes) {
  std::istringstream stream(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), std::ios::binary);
  TopoDS_Shape shape;
  BinTools::Read(shape, stream);
  if (shape.IsNull()) throw BadInput("the bytes hold no shape");
  return shape;
}

}  // namespace

void write_brep_file(const ShapeHandle& shape, rust::Str path) {
  const std::string name(path);
  std::ofstream file(name, std::ios::binary | std::ios::trunc);
  if (!file) throw NoFile("cannot create " + name);
  BRepTools::Write(shape.shape, file);
  file.close();
  if (!file) throw NoFile("cannot write " + name);
}

std::unique_ptr<ShapeHandle> read_brep_file(rust::Str path) {
  const std::string name(path);
  std::ifstream file(name, std::ios::binary);
  if (!file) throw NoFile("cannot open " + name);
  BRep_Builder builder;
  TopoDS_Shape shape;
  BRepTools::Read(shape, file, builder);
  if (shape.IsNull()) throw NoFile(name + " holds no shape");
  return handle(shape);
}

rust::Vec<std::uint8_t> shape_to_bytes(const ShapeHandle& shape) { return bytes_of(shape.shape); }

std::unique_ptr<ShapeHandle> shape_from_bytes(rust::Slice<const std::uint8_t> bytes) { return handle(shape_of(bytes)); }

// A compound of two: the faces in order, and the solids in order.
rust::Vec<std::uint8_t> solids_to_bytes(const SolidsHandle& solids) {
  BRep_Builder builder;
  TopoDS_Compound faces;
  builder.MakeCompound(faces);
  for (const TopoDS_Face& face : solids.faces) builder.Add(faces, face);
  TopoDS_Compound all;
  builder.MakeCompound(all);
  builder.Add(all, faces);
  builder.Add(all, solids.compound);
  return bytes_of(all);
}

std::unique_ptr<SolidsHandle> solids_from_bytes(rust::Slice<const std::uint8_t> bytes) {
  const TopoDS_Shape all = shape_of(bytes);
  auto out = std::make_unique<SolidsHandle>();
  std::vector<TopoDS_Shape> parts;
  for (TopoDS_Iterator it(all); it.More(); it.Next()) parts.push_back(it.Value());
  if (parts.size() != 2 || parts[0].ShapeType() != TopAbs_COMPOUND || parts[1].ShapeType() != TopAbs_COMPOUND)
    throw BadInput("the bytes do not hold a set of solids");
  for (TopoDS_Iterator it(parts[0]); it.More(); it.Next()) out->faces.push_back(TopoDS::Face(it.Value()));
  out->compound = TopoDS::Compound(parts[1]);
  for (TopoDS_Iterator it(parts[1]); it.More(); it.Next()) out->solids.push_back(TopoDS::Solid(it.Value()));
  return out;
}

}  // namespace clinothem::occt
