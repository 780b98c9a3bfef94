#include "occt-bridge/shim/mesh.hpp"

#include "occt-bridge/src/ffi.rs.h"

#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom_Surface.hxx>
#include <IMeshTools_Parameters.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>

namespace clinothem::occt {

namespace {

// The surface's normal; beside the point, towards the middle of the face, where the surface is degenerate; else the triangles'.
gp_Vec normal_at(const Handle(Geom_Surface)& surface, const gp_Pnt2d& uv, const gp_Pnt2d& middle, const gp_Vec& otherwise) {
  for (const double step : {0.0, 1e-4}) {
    gp_Pnt p;
    gp_Vec du;
    gp_Vec dv;
    surface->D1(uv.X() + step * (middle.X() - uv.X()), uv.Y() + step * (middle.Y() - uv.Y()), p, du, dv);
    const gp_Vec normal = du.Crossed(dv);
    const double shorter = std::min(du.Magnitude(), dv.Magnitude());
    const double longer = std::max(du.Magnitude(), dv.Magnitude());
    if (shorter > 1e-7 * longer && normal.Magnitude() > 1e-9 * shorter * longer) return normal.Normalized();
  }
  return otherwise;
}

MeshData mesh_of(const TopoDS_Face& face) {
  MeshData out;
  TopLoc_Location location;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
  if (mesh.IsNull()) throw Refused("a face could not be triangulated");
  const bool reversed = face.Orientation() == TopAbs_REVERSED;
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(TopoDS::Face(face.Oriented(TopAbs_FORWARD)));
  std::vector<gp_Pnt> points;
  for (int i = 1; i <= mesh->NbNodes(); ++i) points.push_back(mesh->Node(i).Transformed(location.Transformation()));
  std::vector<gp_Vec> sums(points.size(), gp_Vec(0, 0, 0));
  for (int i = 1; i <= mesh->NbTriangles(); ++i) {
    int n[3];
    mesh->Triangle(i).Get(n[0], n[1], n[2]);
    const gp_Vec area = gp_Vec(points[n[0] - 1], points[n[1] - 1]).Crossed(gp_Vec(points[n[0] - 1], points[n[2] - 1]));
    for (int k : n) sums[static_cast<std::size_t>(k - 1)] += area;
    if (reversed) std::swap(n[1], n[2]);
    for (int k : n) out.triangles.push_back(static_cast<std::uint32_t>(k - 1));
  }
  gp_XY middle(0.0, 0.0);
  if (mesh->HasUVNodes())
    for (int i = 1; i <= mesh->NbNodes(); ++i) middle += mesh->UVNode(i).XY() / mesh->NbNodes();
  for (std::size_t i = 0; i < points.size(); ++i) {
    gp_Vec normal = sums[i].Magnitude() > 0.0 ? sums[i].Normalized() : gp_Vec(0, 0, 1);
    if (mesh->HasUVNodes()) normal = normal_at(surface, mesh->UVNode(static_cast<int>(i) + 1), middle, normal);
    if (reversed) normal.Reverse();
    for (double value : {points[i].X(), points[i].Y(), points[i].Z()}) out.vertices.push_back(value);
    for (double value : {normal.X(), normal.Y(), normal.Z()}) out.normals.push_back(value);
  }
  return out;
}

void triangulate(const TopoDS_Shape& shape, double deflection, double angle, bool parallel) {
  if (!(deflection > 0.0)) throw BadInput("the deflection is " + std::to_string(deflection) + "; it must be above 0");
  if (!(angle > 0.0)) throw BadInput("the angle is " + std::to_string(angle) + "; it must be above 0");
  IMeshTools_Parameters parameters;
  parameters.Deflection = deflection;
  parameters.Angle = angle;
  parameters.Relative = Standard_False;
  parameters.InParallel = parallel;
  BRepMesh_IncrementalMesh mesher(shape, parameters);
}

rust::Vec<MeshData> meshes_of(const std::vector<TopoDS_Face>& faces) {
  rust::Vec<MeshData> out;
  for (const TopoDS_Face& face : faces) out.push_back(mesh_of(face));
  return out;
}

}  // namespace

rust::Vec<MeshData> mesh_shape(const ShapeHandle& shape, double deflection, double angle, bool parallel) {
  const TopoDS_Shape copy = topology_copy(shape.shape);
  triangulate(copy, deflection, angle, parallel);
  std::vector<TopoDS_Face> faces;
  for (TopExp_Explorer it(copy, TopAbs_FACE); it.More(); it.Next()) faces.push_back(TopoDS::Face(it.Current()));
  return meshes_of(faces);
}

rust::Vec<MeshData> mesh_solids(const SolidsHandle& solids, double deflection, double angle, bool parallel) {
  if (solids.faces.empty()) return {};
  BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  for (const TopoDS_Face& face : solids.faces) builder.Add(all, face);
  const TopoDS_Shape copy = topology_copy(all);
  triangulate(copy, deflection, angle, parallel);
  std::vector<TopoDS_Face> faces;
  for (TopoDS_Iterator it(copy); it.More(); it.Next()) faces.push_back(TopoDS::Face(it.Value()));
  if (faces.size() != solids.faces.size()) throw Refused("copying the faces changed their number");
  return meshes_of(faces);
}

}  // namespace clinothem::occt
