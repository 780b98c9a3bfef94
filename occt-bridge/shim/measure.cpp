#include "occt-bridge/shim/measure.hpp"

#include "occt-bridge/shim/partition.hpp"
#include "occt-bridge/src/ffi.rs.h"

#include <BOPTools_AlgoTools3D.hxx>
#include <BRepBndLib.hxx>
#include <BRepGProp_Domain.hxx>
#include <BRepGProp_Face.hxx>
#include <BRepGProp_Sinert.hxx>
#include <BRepGProp_Vinert.hxx>
#include <BRepGProp_VinertGK.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <ElSLib.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <GeomConvert_BSplineSurfaceToBezierSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_Surface.hxx>
#include <IntCurveSurface_HInter.hxx>
#include <IntCurveSurface_IntersectionPoint.hxx>
#include <IntTools_Context.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace clinothem::occt {

namespace {

void check_eps(double eps) {
  if (!(eps > 0.0 && eps < 0.1)) throw BadInput("eps is " + std::to_string(eps) + "; it must be above 0 and below 0.1");
}

gp_Pnt bounds_middle(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::Add(shape, box, Standard_False);
  if (box.IsVoid()) throw BadInput("the shape has no faces");
  const gp_Pnt a = box.CornerMin();
  const gp_Pnt b = box.CornerMax();
  return gp_Pnt(0.5 * (a.XYZ() + b.XYZ()));
}

double largest_tolerance(const TopoDS_Face& face) {
  double tolerance = BRep_Tool::Tolerance(face);
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next())
    tolerance = std::max(tolerance, BRep_Tool::Tolerance(TopoDS::Edge(it.Current())));
  for (TopExp_Explorer it(face, TopAbs_VERTEX); it.More(); it.Next())
    tolerance = std::max(tolerance, BRep_Tool::Tolerance(TopoDS::Vertex(it.Current())));
  return tolerance;
}

double radical_inverse(std::size_t i, std::size_t base) {
  double value = 0.0;
  double scale = 1.0 / static_cast<double>(base);
  for (; i > 0; i /= base, scale /= static_cast<double>(base)) value += static_cast<double>(i % base) * scale;
  return value;
}

// Appends the point of the surface at (u, v) if the normal there is defined.
bool append_sample(const Handle(Geom_Surface)& surface, std::size_t face, double u, double v, std::vector<FaceSampleData>& out) {
  gp_Pnt p;
  gp_Vec du;
  gp_Vec dv;
  surface->D1(u, v, p, du, dv);
  gp_Vec normal = du.Crossed(dv);
  const double shorter = std::min(du.Magnitude(), dv.Magnitude());
  const double longer = std::max(du.Magnitude(), dv.Magnitude());
  if (!(shorter > 1e-7 * longer && normal.Magnitude() > 1e-9 * shorter * longer)) return false;
  normal.Normalize();
  out.push_back(FaceSampleData{face, {p.X(), p.Y(), p.Z()}, {normal.X(), normal.Y(), normal.Z()}});
  return true;
}

// The same as face_flux by Gauss-Kronrod, span by span. It converges where face_flux stops too soon, wrong by up to 1e-3; but
// at 1e-9 it takes minutes for channels of many spans for which face_flux takes none.
Integral kronrod_flux(const TopoDS_Face& face, const gp_Pnt& reference, double eps) {
  BRepGProp_Face surface(Standard_True);
  surface.Load(face);
  BRepGProp_Domain domain(face);
  BRepGProp_VinertGK volume;
  volume.SetLocation(reference);
  const double error = volume.Perform(surface, domain, eps);
  if (!(error >= 0.0) || !std::isfinite(volume.Mass())) throw Refused("the volume under a face could not be integrated");
  return {volume.Mass(), error};
}

// The integrand of a plane's area along a curve on it, by Green's theorem: half of (p - origin) x dp.
class Swept {
 public:
  Swept(const Handle(Geom2d_Curve)& curve, const gp_Pnt2d& origin) : curve_(curve), origin_(origin) {}

  // Exact for polynomial curves of degree 9 and less.
  double over(double from, double to) const {
    constexpr std::array<double, 5> nodes{0.1488743389816312, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845,
                                          0.9739065285171717};
    constexpr std::array<double, 5> weights{0.2955242247147529, 0.2692667193099963, 0.2190863625159820, 0.1494513491505806,
                                            0.0666713443086881};
    const double middle = 0.5 * (from + to);
    const double half = 0.5 * (to - from);
    double sum = 0.0;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      sum += weights[k] * (at(middle - half * nodes[k]) + at(middle + half * nodes[k]));
    return half * sum;
  }

  // Halved until both halves agree with the whole.
  Integral refined(double from, double to, double whole, double allowed, int depth) const {
    const double middle = 0.5 * (from + to);
    const double left = over(from, middle);
    const double right = over(middle, to);
    const double off = std::abs(left + right - whole);
    if (off <= allowed || depth == 0) return {left + right, off};
    const Integral one = refined(from, middle, left, 0.5 * allowed, depth - 1);
    const Integral other = refined(middle, to, right, 0.5 * allowed, depth - 1);
    return {one.value + other.value, one.error + other.error};
  }

 private:
  double at(double t) const {
    gp_Pnt2d p;
    gp_Vec2d d;
    curve_->D1(t, p, d);
    return 0.5 * gp_Vec2d(origin_, p).Crossed(d);
  }

  Handle(Geom2d_Curve) curve_;
  gp_Pnt2d origin_;
};

// The kernel's own integrals over planes within spline edges stop too soon, whatever is asked for: the eps form is wrong by 5e-4, the
// Gauss-Kronrod form by 1e-5 where an edge is a long spline of few spans. Along the edges the integrand is polynomial from knot to
// knot. Edges begin and end at their vertices, so that loops close, and what two faces of a plane share cancels.
Integral planar_area(const TopoDS_Face& face, const Handle(Geom_Plane)& plane, double eps) {
  struct Piece {
    Swept swept;
    double from;
    double to;
    double whole;
    double sign;
  };
  constexpr int deepest = 12;
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  const auto on_plane = [&](const TopoDS_Vertex& vertex) {
    double u = 0.0;
    double v = 0.0;
    ElSLib::Parameters(plane->Pln(), BRep_Tool::Pnt(vertex), u, v);
    return gp_Pnt2d(u, v);
  };
  std::vector<Piece> pieces;
  std::optional<gp_Pnt2d> origin;
  double straight = 0.0;
  double extent = 0.0;
  for (TopExp_Explorer it(forward, TopAbs_EDGE); it.More(); it.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(it.Current());
    if (edge.Orientation() != TopAbs_FORWARD && edge.Orientation() != TopAbs_REVERSED) continue;
    const double sign = edge.Orientation() == TopAbs_FORWARD ? 1.0 : -1.0;
    double first = 0.0;
    double last = 0.0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, forward, first, last);
    const TopoDS_Vertex start = TopExp::FirstVertex(edge);
    const TopoDS_Vertex end = TopExp::LastVertex(edge);
    if (curve.IsNull() || start.IsNull() || end.IsNull()) throw Refused("an edge of a plane has no curve on it, or no vertices");
    if (!origin) origin = on_plane(start);
    const auto chord = [&](const gp_Pnt2d& a, const gp_Pnt2d& b) {
      extent = std::max(extent, origin->Distance(b));
      return 0.5 * gp_Vec2d(*origin, a).Crossed(gp_Vec2d(*origin, b));
    };
    straight += sign * (chord(on_plane(start), curve->Value(first)) + chord(curve->Value(last), on_plane(end)));
    const Geom2dAdaptor_Curve adaptor(curve, first, last);
    TColStd_Array1OfReal breaks(1, adaptor.NbIntervals(GeomAbs_CN) + 1);
    adaptor.Intervals(breaks, GeomAbs_CN);
    const Swept swept(curve, *origin);
    for (int i = breaks.Lower(); i < breaks.Upper(); ++i)
      pieces.push_back({swept, breaks(i), breaks(i + 1), swept.over(breaks(i), breaks(i + 1)), sign});
  }
  double rough = straight;
  for (const Piece& piece : pieces) rough += piece.sign * piece.whole;
  // Below what rounding leaves of places so far away nothing can be told.
  const double share = std::max(eps * std::abs(rough) / static_cast<double>(pieces.size() + 1), 1e-15 * extent * extent);
  Integral area{straight, 0.0};
  for (const Piece& piece : pieces) {
    const Integral one = piece.swept.refined(piece.from, piece.to, piece.whole, share, deepest);
    area.value += piece.sign * one.value;
    area.error += one.error;
  }
  if (!std::isfinite(area.value)) throw Refused("the area of a plane could not be integrated");
  return {std::abs(area.value), area.error};
}

}  // namespace

Integral face_flux(const TopoDS_Face& face, const gp_Pnt& reference, double eps) {
  BRepGProp_Face surface(face);
  BRepGProp_Domain domain(face);
  BRepGProp_Vinert volume;
  volume.SetLocation(reference);
  const double error = volume.Perform(surface, domain, eps);
  return {volume.Mass(), std::abs(error * volume.Mass())};
}

Integral face_area(const TopoDS_Face& face, double eps) {
  const Handle(Geom_Plane) plane = Handle(Geom_Plane)::DownCast(BRep_Tool::Surface(face));
  if (!plane.IsNull()) return planar_area(face, plane, eps);
  BRepGProp_Face surface(face);
  BRepGProp_Domain domain(face);
  BRepGProp_Sinert area;
  area.SetLocation(gp_Pnt(0, 0, 0));
  const double error = area.Perform(surface, domain, eps);
  return {std::abs(area.Mass()), std::abs(error * area.Mass())};
}

double shape_volume(const ShapeHandle& shape, double eps) {
  check_eps(eps);
  const gp_Pnt reference = bounds_middle(shape.shape);
  if (!TopExp_Explorer(shape.shape, TopAbs_SOLID).More()) throw BadInput("the shape has no solid, so no volume");
  double volume = 0.0;
  for (TopExp_Explorer solid(shape.shape, TopAbs_SOLID); solid.More(); solid.Next())
    for (TopExp_Explorer it(solid.Current(), TopAbs_FACE); it.More(); it.Next()) {
      const TopoDS_Face& face = TopoDS::Face(it.Current());
      if (face.Orientation() == TopAbs_FORWARD || face.Orientation() == TopAbs_REVERSED)
        volume += face_flux(face, reference, eps).value;
    }
  return volume;
}

double shape_area(const ShapeHandle& shape, double eps) {
  check_eps(eps);
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape.shape, TopAbs_FACE, faces);
  if (faces.IsEmpty()) throw BadInput("the shape has no face, so no area");
  double area = 0.0;
  for (int i = 1; i <= faces.Extent(); ++i) area += face_area(TopoDS::Face(faces(i)), eps).value;
  return area;
}

std::array<double, 6> shape_bounds(const ShapeHandle& shape) {
  Bnd_Box box;
  BRepBndLib::AddOptimal(shape.shape, box, Standard_False, Standard_False);
  if (box.IsVoid()) throw BadInput("the shape is empty, so it has no bounds");
  box.SetGap(0.0);
  std::array<double, 6> b{};
  box.Get(b[0], b[1], b[2], b[3], b[4], b[5]);
  return b;
}

rust::Vec<BoxData> solid_boxes(const SolidsHandle& solids, bool parallel) {
  // A box per face first: two solids share it, and a face's box from its poles costs next to nothing.
  TopTools_IndexedMapOfShape index;
  for (const TopoDS_Face& face : solids.faces) index.Add(face);
  std::vector<Bnd_Box> boxes(solids.faces.size());
  for_each_index(solids.faces.size(), parallel, [&](std::size_t i) {
    BRepBndLib::Add(solids.faces[i], boxes[i], Standard_False);
    boxes[i].SetGap(0.0);
  });
  rust::Vec<BoxData> out;
  for (const TopoDS_Solid& solid : solids.solids) {
    Bnd_Box box;
    for (TopExp_Explorer it(solid, TopAbs_FACE); it.More(); it.Next()) {
      const int at = index.FindIndex(it.Current().Oriented(TopAbs_FORWARD));
      if (at == 0) throw Refused("a solid has a face that is not in the table of faces");
      box.Add(boxes[static_cast<std::size_t>(at - 1)]);
    }
    if (box.IsVoid()) throw Refused("a solid has no faces");
    BoxData data{};
    box.Get(data.min[0], data.min[1], data.min[2], data.max[0], data.max[1], data.max[2]);
    out.push_back(data);
  }
  return out;
}

rust::Vec<FaceIntegralData> integrate_faces(const SolidsHandle& solids, double eps, std::array<double, 3> reference, bool parallel) {
  check_eps(eps);
  const gp_Pnt at(reference[0], reference[1], reference[2]);
  std::vector<FaceIntegralData> results(solids.faces.size());
  for_each_index(solids.faces.size(), parallel, [&](std::size_t i) {
    const TopoDS_Face face = TopoDS::Face(solids.faces[i].Oriented(TopAbs_FORWARD));
    const Integral area = face_area(face, eps);
    const Handle(Geom_Plane) plane = Handle(Geom_Plane)::DownCast(BRep_Tool::Surface(face));
    Integral flux{0.0, 0.0};
    if (plane.IsNull()) {
      flux = kronrod_flux(face, at, eps);
    } else {
      // A pyramid: no second integral.
      const gp_Dir normal = plane->Position().XDirection().Crossed(plane->Position().YDirection());
      const double height = gp_Vec(at, plane->Location()).Dot(gp_Vec(normal));
      flux = {area.value * height / 3.0, area.error * std::abs(height) / 3.0};
    }
    results[i] = FaceIntegralData{area.value, flux.value, area.error, flux.error, largest_tolerance(face)};
  });
  rust::Vec<FaceIntegralData> out;
  for (const FaceIntegralData& result : results) out.push_back(result);
  return out;
}

rust::Vec<FaceSampleData> sample_faces(const SolidsHandle& solids, std::size_t per_face, bool parallel) {
  std::vector<std::vector<FaceSampleData>> results(solids.faces.size());
  for_each_index(solids.faces.size(), parallel, [&](std::size_t i) {
    if (per_face == 0) return;
    const TopoDS_Face face = TopoDS::Face(solids.faces[i].Oriented(TopAbs_FORWARD));
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
    const Handle(IntTools_Context) context = new IntTools_Context;
    std::vector<FaceSampleData>& out = results[i];
    gp_Pnt p;
    gp_Pnt2d uv;
    // The first is the middle of the widest stretch of a hatch line: the safest point of a narrow face.
    if (BOPTools_AlgoTools3D::PointInFace(face, p, uv, context) == 0) append_sample(surface, i, uv.X(), uv.Y(), out);
    double u0 = 0.0;
    double u1 = 0.0;
    double v0 = 0.0;
    double v1 = 0.0;
    BRepTools::UVBounds(face, u0, u1, v0, v1);
    const std::size_t tries = 64 * per_face;
    for (std::size_t k = 1; k <= tries && out.size() < per_face; ++k) {
      uv = gp_Pnt2d(u0 + (u1 - u0) * radical_inverse(k, 2), v0 + (v1 - v0) * radical_inverse(k, 3));
      if (context->IsPointInFace(face, uv)) append_sample(surface, i, uv.X(), uv.Y(), out);
    }
  });
  rust::Vec<FaceSampleData> out;
  for (const auto& face : results)
    for (const FaceSampleData& sample : face) out.push_back(sample);
  return out;
}

std::unique_ptr<ClassifierHandle> new_classifier(const ShapeHandle& shape) {
  if (!TopExp_Explorer(shape.shape, TopAbs_SOLID).More()) throw BadInput("the shape has no solid, so no inside");
  return std::make_unique<ClassifierHandle>(shape.shape);
}

namespace {

// The kernel's own intersection of lines and faces looks at a polyhedron of some samples of the whole face, and misses most crossings of
// a long, meandering one: of 23 lines from a point 15 cm inside a channel's lag, 900 m long, it missed 15 of 23 passages. So each face
// is cut into its Bezier patches, of which the polyhedron is a good likeness.
void add_patches(const TopoDS_Face& face, std::vector<ClassifierHandle::Patch>& patches) {
  Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  const Handle(Geom_RectangularTrimmedSurface) trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface);
  if (!trimmed.IsNull()) surface = trimmed->BasisSurface();
  ClassifierHandle::Patch patch;
  patch.face = face;
  const Handle(Geom_BSplineSurface) spline = Handle(Geom_BSplineSurface)::DownCast(surface);
  if (spline.IsNull()) {
    double u0 = 0.0;
    double u1 = 0.0;
    double v0 = 0.0;
    double v1 = 0.0;
    BRepTools::UVBounds(face, u0, u1, v0, v1);
    // A plane goes on beyond the face: what passes beside that is seen, and left to the face's border.
    const double margin = Handle(Geom_Plane)::DownCast(surface).IsNull() ? 0.0 : u1 - u0 + v1 - v0;
    patch.surface = new GeomAdaptor_Surface(surface, u0 - margin, u1 + margin, v0 - margin, v1 + margin);
    BRepBndLib::Add(face, patch.box, Standard_False);
    patch.is_part = false;
    patches.push_back(patch);
    return;
  }
  GeomConvert_BSplineSurfaceToBezierSurface pieces(spline);
  TColStd_Array1OfReal u(1, pieces.NbUPatches() + 1);
  TColStd_Array1OfReal v(1, pieces.NbVPatches() + 1);
  pieces.UKnots(u);
  pieces.VKnots(v);
  for (int i = 1; i <= pieces.NbUPatches(); ++i) {
    for (int j = 1; j <= pieces.NbVPatches(); ++j) {
      const Handle(Geom_BezierSurface) piece = pieces.Patch(i, j);
      patch.surface = new GeomAdaptor_Surface(piece);
      patch.box = Bnd_Box();
      for (int a = 1; a <= piece->NbUPoles(); ++a)
        for (int b = 1; b <= piece->NbVPoles(); ++b) patch.box.Add(piece->Pole(a, b));
      patch.from = gp_XY(u(i), v(j));
      patch.to = gp_XY(u(i + 1), v(j + 1));
      patch.is_part = true;
      patches.push_back(patch);
    }
  }
}

}  // namespace

ClassifierHandle::ClassifierHandle(const TopoDS_Shape& solid) : context(new IntTools_Context) {
  Bnd_Box whole;
  for (TopExp_Explorer it(solid, TopAbs_FACE); it.More(); it.Next()) {
    const TopoDS_Face& face = TopoDS::Face(it.Current());
    Bnd_Box box;
    BRepBndLib::Add(face, box, Standard_False);
    whole.Add(box);
    faces.emplace_back(face, box);
    add_patches(face, patches);
  }
  reach = 2.0 * std::sqrt(whole.SquareExtent());
}

int ClassifierHandle::crossings(const gp_Lin& line) const {
  const double near_border = 1e-9;
  const Handle(GeomAdaptor_Curve) ray = new GeomAdaptor_Curve(new Geom_Line(line), 0.0, reach);
  int count = 0;
  for (const Patch& patch : patches) {
    Bnd_Box box = patch.box;
    box.Enlarge(Precision::Confusion());
    if (box.IsOut(line)) continue;
    IntCurveSurface_HInter found;
    found.Perform(ray, patch.surface);
    if (!found.IsDone()) return -1;
    for (int i = 1; i <= found.NbPoints(); ++i) {
      const IntCurveSurface_IntersectionPoint& point = found.Point(i);
      gp_XY at(point.U(), point.V());
      bool is_clear = point.Transition() != IntCurveSurface_Tangent;
      if (patch.is_part) {
        // Between two patches a passage is found in one of them, in both or in none.
        const gp_XY one(1.0, 1.0);
        for (const gp_XY& off : {at, one - at}) is_clear = is_clear && off.X() > near_border && off.Y() > near_border;
        at = patch.from + gp_XY(at.X() * (patch.to - patch.from).X(), at.Y() * (patch.to - patch.from).Y());
      }
      const bool is_inside = context->IsPointInFace(patch.face, gp_Pnt2d(at));
      const bool is_on = !is_inside && context->IsPointInOnFace(patch.face, gp_Pnt2d(at));
      if (is_on || (is_inside && !is_clear)) return -1;
      count += is_inside ? 1 : 0;
    }
  }
  return count;
}

std::uint8_t ClassifierHandle::classify(std::array<double, 3> point, double tolerance) {
  const gp_Pnt p(point[0], point[1], point[2]);
  for (const auto& face : faces) {
    Bnd_Box box = face.second;
    box.Enlarge(tolerance);
    if (!box.IsOut(p) && context->IsValidPointForFace(p, face.first, tolerance)) return 2;
  }
  // Rays vote, askew so that they meet edges only by accident; one that does, or grazes a face, has no vote.
  const gp_Dir directions[] = {gp_Dir(0.0137, 0.0291, 1.0),   gp_Dir(1.0, 0.3719, 0.1173),    gp_Dir(-0.4127, 1.0, -0.2311),
                               gp_Dir(0.0533, -0.0217, -1.0), gp_Dir(0.3301, 0.2203, 0.9178), gp_Dir(-0.7193, -0.5147, 0.4667),
                               gp_Dir(0.1931, -1.0, 0.4211),  gp_Dir(-1.0, 0.1789, -0.0631),  gp_Dir(0.6173, -0.5701, -0.5423)};
  int votes[2] = {0, 0};
  for (const gp_Dir& direction : directions) {
    const int count = crossings(gp_Lin(p, direction));
    if (count < 0) continue;
    if (++votes[count % 2] == 2) break;
  }
  if (votes[0] == votes[1]) throw Refused("the point could not be classified");
  return votes[1] > votes[0] ? 0 : 1;
}

}  // namespace clinothem::occt
