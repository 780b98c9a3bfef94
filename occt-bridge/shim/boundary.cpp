#include "occt-bridge/shim/boundary.hpp"

#include "occt-bridge/shim/spline.hpp"
#include "occt-bridge/src/ffi.rs.h"

#include <BRepClass3d.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dConvert.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_BezierCurve.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <GeomConvert.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Precision.hxx>
#include <ShapeExtend_WireData.hxx>
#include <ShapeFix_Wire.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>

#include <algorithm>
#include <unordered_map>

namespace clinothem::occt {

namespace {

using Numbers = std::vector<double>;

// What the templates below need to know of curves in space and of curves on surfaces.
struct InSpace {
  using Curve = Geom_Curve;
  using Line = Geom_Line;
  using Trimmed = Geom_TrimmedCurve;
  using Bezier = Geom_BezierCurve;
  using BSpline = Geom_BSplineCurve;
  static gp_XYZ coordinates(const gp_Pnt& p) { return p.XYZ(); }
  static gp_XYZ coordinates(const gp_Dir& d) { return d.XYZ(); }
  static Handle(BSpline) convert(const Handle(Curve) & curve) { return GeomConvert::CurveToBSplineCurve(curve); }
};

struct OnSurface {
  using Curve = Geom2d_Curve;
  using Line = Geom2d_Line;
  using Trimmed = Geom2d_TrimmedCurve;
  using Bezier = Geom2d_BezierCurve;
  using BSpline = Geom2d_BSplineCurve;
  static gp_XY coordinates(const gp_Pnt2d& p) { return p.XY(); }
  static gp_XY coordinates(const gp_Dir2d& d) { return d.XY(); }
  static Handle(BSpline) convert(const Handle(Curve) & curve) { return Geom2dConvert::CurveToBSplineCurve(curve); }
};

void put(Numbers& to, const gp_XYZ& p) { to.insert(to.end(), {p.X(), p.Y(), p.Z()}); }

void put(Numbers& to, const gp_XY& p) { to.insert(to.end(), {p.X(), p.Y()}); }

void put(Numbers& to, const TColStd_Array1OfReal& flat) {
  for (int i = flat.Lower(); i <= flat.Upper(); ++i) to.push_back(flat(i));
}

// Geometry by identity: each piece is there once, in the order of its first use.
template <typename Geometry>
class Identities {
 public:
  // With the parameters that are used of it: what is no spline becomes one over these.
  std::uint32_t index(const opencascade::handle<Geometry>& one, const Range& u, const Range& v = {0.0, 0.0}) {
    const auto found = places_.emplace(one.get(), static_cast<std::uint32_t>(all_.size()));
    if (found.second) {
      all_.push_back(one);
      used_.push_back({u, v});
    }
    std::array<Range, 2>& used = used_[found.first->second];
    for (std::size_t k = 0; k < 2; ++k) {
      const Range& more = k == 0 ? u : v;
      used[k] = {std::min(used[k][0], more[0]), std::max(used[k][1], more[1])};
    }
    return found.first->second;
  }
  const std::vector<opencascade::handle<Geometry>>& all() const { return all_; }
  const std::array<Range, 2>& used(std::size_t index) const { return used_[index]; }

 private:
  std::unordered_map<const Geometry*, std::uint32_t> places_;
  std::vector<opencascade::handle<Geometry>> all_;  // so that no address is used again
  std::vector<std::array<Range, 2>> used_;
};

template <typename Kind>
CurveRow curve_row(opencascade::handle<typename Kind::Curve> curve, const Range& used, Numbers& to) {
  for (auto trimmed = opencascade::handle<typename Kind::Trimmed>::DownCast(curve); !trimmed.IsNull();
       trimmed = opencascade::handle<typename Kind::Trimmed>::DownCast(curve))
    curve = trimmed->BasisCurve();
  const auto line = opencascade::handle<typename Kind::Line>::DownCast(curve);
  if (!line.IsNull()) {
    put(to, Kind::coordinates(line->Position().Location()));
    put(to, Kind::coordinates(line->Position().Direction()));
    return {0, 2, false};
  }
  auto spline = opencascade::handle<typename Kind::BSpline>::DownCast(curve);
  if (spline.IsNull() && !opencascade::handle<typename Kind::Bezier>::DownCast(curve).IsNull()) spline = Kind::convert(curve);
  if (spline.IsNull()) spline = as_spline(curve, used);  // circles, ellipses and what else CAD programs have
  const int last = spline->NbKnots();
  if (spline->IsPeriodic() || std::min(spline->Multiplicity(1), spline->Multiplicity(last)) <= spline->Degree()) {
    spline = opencascade::handle<typename Kind::BSpline>::DownCast(spline->Copy());
    // What was periodic has knots beyond its ends; a segment of it is clamped.
    if (spline->IsPeriodic()) spline->SetNotPeriodic();
    spline->Segment(spline->FirstParameter(), spline->LastParameter());
  }
  put(to, spline->KnotSequence());
  for (int i = 1; i <= spline->NbPoles(); ++i) put(to, Kind::coordinates(spline->Pole(i)));
  if (spline->IsRational())
    for (int i = 1; i <= spline->NbPoles(); ++i) to.push_back(spline->Weight(i));
  return {static_cast<std::uint32_t>(spline->Degree()), static_cast<std::uint32_t>(spline->NbPoles()), spline->IsRational() == Standard_True};
}

SurfaceRow surface_row(const Handle(Geom_Surface) & surface, const std::array<Range, 2>& used, Numbers& to) {
  const auto plane = Handle(Geom_Plane)::DownCast(surface);
  if (!plane.IsNull()) {
    const gp_Ax3& axes = plane->Position();
    put(to, axes.Location().XYZ());
    put(to, (axes.Direct() ? axes.Direction() : axes.Direction().Reversed()).XYZ());  // du × dv, also of left-handed axes
    put(to, axes.XDirection().XYZ());
    return {0, 0, 0, 0, false};
  }
  auto spline = Handle(Geom_BSplineSurface)::DownCast(surface);
  if (spline.IsNull() && surface->IsKind(STANDARD_TYPE(Geom_BezierSurface))) spline = GeomConvert::SurfaceToBSplineSurface(surface);
  if (spline.IsNull()) spline = as_spline(surface, used[0], used[1]);  // cylinders, spheres and what else CAD programs have
  const int least_u = std::min(spline->UMultiplicity(1), spline->UMultiplicity(spline->NbUKnots()));
  const int least_v = std::min(spline->VMultiplicity(1), spline->VMultiplicity(spline->NbVKnots()));
  if (spline->IsUPeriodic() || spline->IsVPeriodic() || least_u <= spline->UDegree() || least_v <= spline->VDegree()) {
    spline = Handle(Geom_BSplineSurface)::DownCast(spline->Copy());
    spline->SetUNotPeriodic();
    spline->SetVNotPeriodic();
    double u0, u1, v0, v1;
    spline->Bounds(u0, u1, v0, v1);
    spline->Segment(u0, u1, v0, v1);
  }
  const int nu = spline->NbUPoles();
  const int nv = spline->NbVPoles();
  const bool rational = spline->IsURational() || spline->IsVRational();
  put(to, spline->UKnotSequence());
  put(to, spline->VKnotSequence());
  for (int i = 1; i <= nu; ++i)
    for (int j = 1; j <= nv; ++j) put(to, spline->Pole(i, j).XYZ());
  for (int i = 1; rational && i <= nu; ++i)
    for (int j = 1; j <= nv; ++j) to.push_back(spline->Weight(i, j));
  return {static_cast<std::uint32_t>(spline->UDegree()), static_cast<std::uint32_t>(spline->VDegree()), static_cast<std::uint32_t>(nu),
          static_cast<std::uint32_t>(nv), rational};
}

class Taker {
 public:
  explicit Taker(BoundaryRows& rows) : rows_(rows) {}

  void take(const TopoDS_Shape& shape) {
    std::uint32_t shells = 0;
    if (shape.ShapeType() == TopAbs_SOLID) {
      const TopoDS_Solid& solid = TopoDS::Solid(shape);
      const TopoDS_Shape outer = BRepClass3d::OuterShell(solid);
      if (outer.IsNull()) throw BadInput("a solid has no outer shell");
      take_shell(outer);
      for (TopoDS_Iterator it(solid); it.More(); it.Next(), ++shells)
        if (!it.Value().IsSame(outer)) take_shell(it.Value());
    } else {
      take_shell(shape);
    }
    rows_.shells_of_shapes.push_back(shells);
  }

  std::unique_ptr<Numbers> finish() {
    for (int i = 1; i <= vertices_.Extent(); ++i) {
      const gp_Pnt p = BRep_Tool::Pnt(TopoDS::Vertex(vertices_(i)));
      rows_.vertices.push_back(p.X());
      rows_.vertices.push_back(p.Y());
      rows_.vertices.push_back(p.Z());
    }
    auto numbers = std::make_unique<Numbers>();
    for (std::size_t i = 0; i < curves_.all().size(); ++i)
      rows_.curves.push_back(curve_row<InSpace>(curves_.all()[i], curves_.used(i)[0], *numbers));
    for (std::size_t i = 0; i < pcurves_.all().size(); ++i)
      rows_.pcurves.push_back(curve_row<OnSurface>(pcurves_.all()[i], pcurves_.used(i)[0], *numbers));
    for (std::size_t i = 0; i < surfaces_.all().size(); ++i)
      rows_.surfaces.push_back(surface_row(surfaces_.all()[i], surfaces_.used(i), *numbers));
    return numbers;
  }

 private:
  // Faces of a shell, or of whatever else holds faces.
  void take_shell(const TopoDS_Shape& shell) {
    std::uint32_t count = 0;
    for (TopExp_Explorer it(shell, TopAbs_FACE); it.More(); it.Next(), ++count) {
      const auto before = static_cast<std::size_t>(faces_.Extent());
      const auto face = static_cast<std::size_t>(faces_.Add(it.Current())) - 1;
      if (face == before) take_face(TopoDS::Face(it.Current().Oriented(TopAbs_FORWARD)));
      rows_.uses_of_faces.push_back(2 * static_cast<std::uint32_t>(face) + (it.Current().Orientation() == TopAbs_REVERSED ? 1 : 0));
    }
    if (count == 0) throw BadInput("a shape has no face");
    rows_.faces_of_shells.push_back(count);
  }

  void take_face(const TopoDS_Face& face) {
    Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
    for (auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface); !trimmed.IsNull();
         trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface))
      surface = trimmed->BasisSurface();
    const bool plane = surface->IsKind(STANDARD_TYPE(Geom_Plane));
    Range u = {0.0, 0.0}, v = {0.0, 0.0};
    if (!plane && !surface->IsKind(STANDARD_TYPE(Geom_BSplineSurface))) BRepTools::UVBounds(face, u[0], u[1], v[0], v[1]);
    BoundaryFaceRow row{surfaces_.index(surface, u, v), 0};
    for (TopoDS_Iterator it(face); it.More(); it.Next()) {
      // A general fuse leaves vertices in faces where other bodies only touch them: they bound nothing.
      if (it.Value().ShapeType() == TopAbs_VERTEX) continue;
      ++row.loops;
      const std::vector<TopoDS_Edge> edges = loop(TopoDS::Wire(it.Value()), face);
      for (const TopoDS_Edge& edge : edges) take_use(edge, face, plane);
      rows_.loops.push_back(static_cast<std::uint32_t>(edges.size()));
    }
    if (row.loops == 0) throw BadInput("a face has no loop");
    rows_.faces.push_back(row);
  }

  // The edges of a wire from end to end; the kernel's need not be in order.
  static std::vector<TopoDS_Edge> loop(const TopoDS_Wire& wire, const TopoDS_Face& face) {
    const bool reversed = wire.Orientation() == TopAbs_REVERSED;
    const TopoDS_Wire forward = TopoDS::Wire(wire.Oriented(TopAbs_FORWARD));
    std::vector<TopoDS_Edge> edges;
    for (TopoDS_Iterator it(forward); it.More(); it.Next()) edges.push_back(TopoDS::Edge(it.Value()));
    if (!closes(edges)) {
      ShapeFix_Wire fix(forward, face, Precision::Confusion());
      fix.FixReorder();
      const Handle(ShapeExtend_WireData) ordered = fix.WireData();
      edges.clear();
      for (int i = 1; i <= ordered->NbEdges(); ++i) edges.push_back(ordered->Edge(i));
      if (!closes(edges)) throw Refused("the edges of a loop do not follow each other");
    }
    if (reversed) {
      std::reverse(edges.begin(), edges.end());
      for (TopoDS_Edge& edge : edges) edge.Reverse();
    }
    return edges;
  }

  static bool closes(const std::vector<TopoDS_Edge>& edges) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const TopoDS_Edge& next = edges[(i + 1) % edges.size()];
      if (!TopExp::LastVertex(edges[i], Standard_True).IsSame(TopExp::FirstVertex(next, Standard_True))) return false;
    }
    return !edges.empty();
  }

  void take_use(const TopoDS_Edge& edge, const TopoDS_Face& face, bool plane) {
    const auto before = static_cast<std::size_t>(edges_.Extent());
    const auto index = static_cast<std::size_t>(edges_.Add(edge)) - 1;
    if (index == before) take_edge(TopoDS::Edge(edge.Oriented(TopAbs_FORWARD)));
    BoundaryUseRow row{2 * static_cast<std::uint32_t>(index) + (edge.Orientation() == TopAbs_REVERSED ? 1 : 0), false, 0};
    if (!plane && !BRep_Tool::Degenerated(edge)) {
      double first;
      double last;
      const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(edge, face, first, last);
      if (pcurve.IsNull()) throw Refused("an edge has no curve on the surface of its face");
      row.has_pcurve = true;
      row.pcurve = pcurves_.index(pcurve, {first, last});
    }
    rows_.uses.push_back(row);
  }

  void take_edge(const TopoDS_Edge& edge) {
    const TopoDS_Vertex first = TopExp::FirstVertex(edge);
    const TopoDS_Vertex last = TopExp::LastVertex(edge);
    if (first.IsNull() || last.IsNull()) throw Refused("an edge has no ends");
    BoundaryEdgeRow row{BRep_Tool::Degenerated(edge) == Standard_True, 0, 0.0, 0.0, static_cast<std::uint32_t>(vertices_.Add(first)) - 1,
                        static_cast<std::uint32_t>(vertices_.Add(last)) - 1};
    if (!row.degenerate) {
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, row.from, row.to);
      if (curve.IsNull()) throw Refused("an edge has no curve");
      row.curve = curves_.index(curve, {row.from, row.to});
    }
    rows_.edges.push_back(row);
  }

  BoundaryRows& rows_;
  TopTools_IndexedMapOfShape vertices_;
  TopTools_IndexedMapOfShape edges_;
  TopTools_IndexedMapOfShape faces_;
  Identities<Geom_Curve> curves_;
  Identities<Geom2d_Curve> pcurves_;
  Identities<Geom_Surface> surfaces_;
};

}  // namespace

std::unique_ptr<Numbers> boundary_of(const ShapeList& list, BoundaryRows& rows) {
  Taker taker(rows);
  for (const TopoDS_Shape& shape : list.shapes) taker.take(shape);
  return taker.finish();
}

}  // namespace clinothem::occt
