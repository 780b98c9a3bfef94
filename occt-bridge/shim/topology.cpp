#include "occt-bridge/shim/topology.hpp"

#include "occt-bridge/shim/check.hpp"
#include "occt-bridge/shim/geometry.hpp"
#include "occt-bridge/shim/measure.hpp"
#include "occt-bridge/src/ffi.rs.h"

#include <BRep_Builder.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace clinothem::occt {

namespace {

std::string text(const gp_Pnt& p) {
  std::ostringstream out;
  out.precision(10);
  out << "(" << p.X() << ", " << p.Y() << ", " << p.Z() << ")";
  return out.str();
}

CurveNumbers numbers(const CurveData& d) { return {d.degree, reals(d.knots), reals(d.poles), reals(d.weights)}; }

CurveNumbers numbers(const PcurveData& d) { return {d.degree, reals(d.knots), reals(d.poles), reals(d.weights)}; }

SurfaceNumbers numbers(const SurfaceData& d) {
  return {d.degree_u, d.degree_v, reals(d.knots_u), reals(d.knots_v), reals(d.poles), reals(d.weights)};
}

class Maker {
 public:
  explicit Maker(const TopologyData& data) : data_(data) {
    make_geometry();
    make_edges();
    add_curves_on_surfaces();
    make_faces();
  }

  const std::vector<TopoDS_Face>& faces() const { return faces_; }

 private:
  // The curves of an edge on one surface: by the direction in which faces run along it.
  struct OnSurface {
    Handle(Geom2d_Curve) forward;
    Handle(Geom2d_Curve) reversed;
    const PcurveData* forward_data = nullptr;
    const PcurveData* reversed_data = nullptr;
  };

  void make_geometry() {
    for (const SurfaceData& s : data_.surfaces) surfaces_.push_back(surface_of(numbers(s)));
    for (std::size_t i = 0; i * 3 < data_.vertices.size(); ++i) {
      TopoDS_Vertex vertex;
      builder_.MakeVertex(vertex, vertex_point(i), data_.tolerance);
      vertices_.push_back(vertex);
    }
    // A straight edge that lies on planes only is a line; beside a B-spline surface it keeps that surface's parameter.
    std::vector<bool> on_spline(data_.curves.size(), false);
    for (const FaceData& face : data_.faces)
      for (const EdgeUseData& use : face.uses)
        if (use.pcurve.has) on_spline[data_.edges[use.edge].curve] = true;
    for (std::size_t i = 0; i < data_.curves.size(); ++i) curves_.push_back(curve_of(data_.curves[i], on_spline[i]));
  }

  struct CurveOf {
    Handle(Geom_Curve) curve;  // null when all poles coincide: the edge is degenerate
    double scale = 1.0;        // the caller's parameter times this is the kernel's
  };

  CurveOf curve_of(const CurveData& data, bool on_spline) const {
    const Reals poles = reals(data.poles);
    const gp_Pnt a = point3(poles, 0);
    double extent = 0.0;
    for (std::size_t i = 1; i < poles.size() / 3; ++i) extent = std::max(extent, a.Distance(point3(poles, i)));
    if (extent <= data_.tolerance) return {};
    if (data.degree > 0 || on_spline) return {bspline_curve(numbers(data)), 1.0};
    const gp_Pnt b = point3(poles, 1);
    return {new Geom_Line(a, gp_Dir(gp_Vec(a, b))), a.Distance(b)};
  }

  gp_Pnt vertex_point(std::size_t i) const { return point3(reals(data_.vertices), i); }

  void make_edges() {
    for (std::size_t i = 0; i < data_.edges.size(); ++i) {
      const EdgeData& edge = data_.edges[i];
      const CurveOf& curve = curves_[edge.curve];
      TopoDS_Edge made;
      if (curve.curve.IsNull()) {
        builder_.MakeEdge(made);
        builder_.Degenerated(made, Standard_True);
        builder_.UpdateEdge(made, data_.tolerance);
      } else {
        builder_.MakeEdge(made, curve.curve, data_.tolerance);
        check_end(i, edge.start, curve.curve->Value(edge.first * curve.scale));
        check_end(i, edge.end, curve.curve->Value(edge.last * curve.scale));
      }
      builder_.Add(made, vertices_[edge.start].Oriented(TopAbs_FORWARD));
      builder_.Add(made, vertices_[edge.end].Oriented(TopAbs_REVERSED));
      if (!curve.curve.IsNull()) builder_.Range(made, edge.first * curve.scale, edge.last * curve.scale);
      edges_.push_back(made);
    }
  }

  void check_end(std::size_t edge, std::size_t vertex, const gp_Pnt& on_curve) const {
    const gp_Pnt p = vertex_point(vertex);
    const double gap = p.Distance(on_curve);
    if (gap <= data_.tolerance) return;
    std::ostringstream out;
    out << "edge " << edge << " ends at " << text(on_curve) << ", " << gap << " from its vertex " << vertex << " at " << text(p)
        << " (tolerance " << data_.tolerance << ")";
    throw BadInput(out.str());
  }

  static bool same(const PcurveData& a, const PcurveData& b) {
    auto equal = [](const rust::Vec<double>& x, const rust::Vec<double>& y) { return std::equal(x.begin(), x.end(), y.begin(), y.end()); };
    return a.degree == b.degree && equal(a.knots, b.knots) && equal(a.poles, b.poles) && equal(a.weights, b.weights);
  }

  void add_curves_on_surfaces() {
    std::map<std::pair<std::size_t, std::size_t>, OnSurface> found;  // by edge and surface
    for (std::size_t f = 0; f < data_.faces.size(); ++f) {
      const FaceData& face = data_.faces[f];
      for (const EdgeUseData& use : face.uses) {
        if (!use.pcurve.has) continue;
        OnSurface& on = found[{use.edge, face.surface}];
        const PcurveData*& data = use.reversed ? on.reversed_data : on.forward_data;
        if (data != nullptr && !same(*data, use.pcurve)) {
          std::ostringstream out;
          out << "face " << f << " gives edge " << use.edge << " another curve on surface " << face.surface
              << " than an earlier face that runs along it in the same direction";
          throw BadInput(out.str());
        }
        data = &use.pcurve;
      }
    }
    const TopLoc_Location here;
    for (const auto& entry : found) {
      const std::size_t e = entry.first.first;
      const EdgeData& edge = data_.edges[e];
      const Handle(Geom_Surface)& surface = surfaces_[entry.first.second];
      const PcurveData* forward = entry.second.forward_data;
      const PcurveData* reversed = entry.second.reversed_data;
      const PcurveData* first = forward != nullptr ? forward : reversed;
      const Handle(Geom2d_Curve) one = plane_curve(numbers(*first), edge.first, edge.last);
      check_curve(e, entry.first.second, one);
      if (forward != nullptr && reversed != nullptr && !same(*forward, *reversed)) {
        const Handle(Geom2d_Curve) two = plane_curve(numbers(*reversed), edge.first, edge.last);
        check_curve(e, entry.first.second, two);
        builder_.UpdateEdge(edges_[e], one, two, surface, here, data_.tolerance);
      } else {
        builder_.UpdateEdge(edges_[e], one, surface, here, data_.tolerance);
      }
      builder_.Range(edges_[e], surface, here, edge.first, edge.last);
    }
  }

  // The curve on the surface must run where the edge's curve runs, at equal parameters.
  void check_curve(std::size_t e, std::size_t s, const Handle(Geom2d_Curve)& curve) const {
    const EdgeData& edge = data_.edges[e];
    const int samples = 12;
    for (int i = 0; i <= samples; ++i) {
      const double t = edge.first + (edge.last - edge.first) * i / samples;
      const gp_Pnt2d uv = curve->Value(t);
      const gp_Pnt on_surface = surfaces_[s]->Value(uv.X(), uv.Y());
      const gp_Pnt on_curve = curves_[edge.curve].curve.IsNull() ? vertex_point(edge.start)
                                                                 : curves_[edge.curve].curve->Value(t);
      const double gap = on_surface.Distance(on_curve);
      if (gap <= data_.tolerance) continue;
      std::ostringstream out;
      out << "the curve of edge " << e << " on surface " << s << " is " << gap << " away from the edge at parameter " << t << " near "
          << text(on_curve) << " (tolerance " << data_.tolerance << ")";
      throw BadInput(out.str());
    }
  }

  void check_plane(std::size_t f, std::size_t e, const Handle(Geom_Plane)& plane) const {
    const EdgeData& edge = data_.edges[e];
    const CurveOf& curve = curves_[edge.curve];
    if (curve.curve.IsNull()) return;
    for (int i = 0; i <= 8; ++i) {
      const gp_Pnt p = curve.curve->Value(curve.scale * (edge.first + (edge.last - edge.first) * i / 8));
      const double gap = plane->Pln().Distance(p);
      if (gap <= data_.tolerance) continue;
      std::ostringstream out;
      out << "edge " << e << " is " << gap << " off the plane of face " << f << " near " << text(p) << " (tolerance "
          << data_.tolerance << ")";
      throw BadInput(out.str());
    }
  }

  void make_faces() {
    for (std::size_t f = 0; f < data_.faces.size(); ++f) {
      const FaceData& face = data_.faces[f];
      const Handle(Geom_Plane) plane = Handle(Geom_Plane)::DownCast(surfaces_[face.surface]);
      TopoDS_Face made;
      builder_.MakeFace(made, surfaces_[face.surface], data_.tolerance);
      std::size_t next = 0;
      for (std::uint32_t length : face.loops) {
        TopoDS_Wire wire;
        builder_.MakeWire(wire);
        for (std::uint32_t i = 0; i < length; ++i, ++next) {
          const EdgeUseData& use = face.uses[next];
          if (!plane.IsNull()) check_plane(f, use.edge, plane);
          builder_.Add(wire, edges_[use.edge].Oriented(use.reversed ? TopAbs_REVERSED : TopAbs_FORWARD));
        }
        wire.Closed(Standard_True);
        builder_.Add(made, wire);
      }
      if (face.reversed) made.Reverse();
      faces_.push_back(made);
    }
  }

  const TopologyData& data_;
  BRep_Builder builder_;
  std::vector<Handle(Geom_Surface)> surfaces_;
  std::vector<CurveOf> curves_;
  std::vector<TopoDS_Vertex> vertices_;
  std::vector<TopoDS_Edge> edges_;
  std::vector<TopoDS_Face> faces_;
};

void refuse_invalid(const TopoDS_Shape& shape) {
  const std::string what = first_defect(shape);
  if (!what.empty()) throw BadInput("the shape is not valid: " + what);
}

}  // namespace

std::unique_ptr<ShapeHandle> build_solid(const TopologyData& data) {
  const Maker maker(data);
  const gp_Pnt reference = point3(reals(data.vertices), 0);
  double volume = 0.0;
  for (const TopoDS_Face& face : maker.faces()) volume += face_flux(face, reference, 1e-4).value;  // its sign is wanted
  if (!(std::abs(volume) > 0.0)) throw BadInput("the faces enclose no volume");

  BRep_Builder builder;
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  for (const TopoDS_Face& face : maker.faces()) builder.Add(shell, volume > 0.0 ? TopoDS_Shape(face) : face.Reversed());
  shell.Closed(Standard_True);
  TopoDS_Solid solid;
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  refuse_invalid(solid);
  return handle(solid);
}

std::unique_ptr<ShapeHandle> build_faces(const TopologyData& data) {
  const Maker maker(data);
  BRep_Builder builder;
  TopoDS_Compound compound;
  builder.MakeCompound(compound);
  for (const TopoDS_Face& face : maker.faces()) builder.Add(compound, face);
  refuse_invalid(compound);
  return handle(compound);
}

}  // namespace clinothem::occt
