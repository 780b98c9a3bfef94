#include "occt-bridge/shim/assembled.hpp"

#include "occt-bridge/shim/geometry.hpp"
#include "occt-bridge/shim/partition.hpp"
#include "occt-bridge/src/ffi.rs.h"

#include <BRep_Builder.hxx>
#include <Geom_Line.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>

#include <algorithm>
#include <limits>

namespace clinothem::occt {

namespace {

// The kernel's own checks (weights that vanish, knots that rounding cannot tell apart) name no entry.
template <typename Make>
auto named(const char* what, std::size_t index, const Make& make) {
  try {
    return make();
  } catch (const Standard_Failure& failure) {
    throw BadInput(std::string(what) + " " + std::to_string(index) + ": OpenCASCADE refuses it: " + describe(failure));
  }
}

// The numbers of all curves and surfaces, taken from the front.
class Pool {
 public:
  explicit Pool(Reals numbers) : numbers_(numbers) {}

  CurveNumbers curve(const CurveRow& row, std::size_t dimension) {
    const Reals knots = take(row.degree == 0 ? 0 : row.poles + row.degree + 1);
    const Reals poles = take(dimension * row.poles);
    return {row.degree, knots, poles, take(row.rational ? row.poles : 0)};
  }

  SurfaceNumbers surface(const SurfaceRow& row) {
    const bool plane = row.degree_u == 0;
    const std::size_t poles = plane ? 3 : std::size_t{row.poles_u} * row.poles_v;
    const Reals u = take(plane ? 0 : row.poles_u + row.degree_u + 1);
    const Reals v = take(plane ? 0 : row.poles_v + row.degree_v + 1);
    const Reals points = take(3 * poles);
    return {row.degree_u, row.degree_v, u, v, points, take(row.rational ? poles : 0)};
  }

 private:
  Reals take(std::size_t count) {
    if (count > numbers_.size() - at_) throw BadInput("the numbers end before the curves and surfaces do");
    const Reals taken(numbers_.data() + at_, count);
    at_ += count;
    return taken;
  }

  Reals numbers_;
  std::size_t at_ = 0;
};

struct CurveOf {
  Handle(Geom_Curve) curve;
  double scale = 1.0;  // the caller's parameter times this is the kernel's
};

class Assembler {
 public:
  explicit Assembler(const AssembledData& data) : data_(data) {
    make_geometry();
    make_vertices();
    make_edges();
    make_faces();
  }

  const std::vector<TopoDS_Face>& faces() const { return faces_; }

 private:
  struct Span {
    double first = std::numeric_limits<double>::infinity();
    double last = -std::numeric_limits<double>::infinity();
    void add(double a, double b) {
      first = std::min(first, a);
      last = std::max(last, b);
    }
  };

  void make_geometry() {
    // A straight edge that lies on planes only is a line; beside a B-spline surface it keeps that surface's parameter. A line in
    // the parameters of a surface may become a B-spline too: over the ranges of all edges that share it.
    std::vector<bool> on_spline(data_.curves.size(), false);
    std::vector<Span> spans(data_.pcurves.size());
    std::size_t next = 0;
    for (const EdgeRow& edge : data_.edges)
      for (std::uint32_t k = 0; k < edge.on; ++k, ++next) {
        const OnRow& on = data_.on[next];
        if (!edge.degenerate) on_spline[edge.curve] = true;
        spans[on.forward].add(edge.first, edge.last);
        if (on.seam) spans[on.reversed].add(edge.first, edge.last);
      }
    Pool pool(reals(data_.numbers));
    for (std::size_t i = 0; i < data_.curves.size(); ++i) {
      const CurveNumbers numbers = pool.curve(data_.curves[i], 3);
      curves_.push_back(named("curve", i, [&] { return curve_of(numbers, on_spline[i]); }));
    }
    for (std::size_t i = 0; i < data_.surfaces.size(); ++i) {
      const SurfaceNumbers numbers = pool.surface(data_.surfaces[i]);
      surfaces_.push_back(named("surface", i, [&] { return surface_of(numbers); }));
    }
    for (std::size_t i = 0; i < data_.pcurves.size(); ++i) {
      const CurveNumbers numbers = pool.curve(data_.pcurves[i], 2);
      Handle(Geom2d_Curve) made;  // none if no edge runs along it
      if (spans[i].first < spans[i].last)
        made = named("pcurve", i, [&] { return plane_curve(numbers, spans[i].first, spans[i].last); });
      pcurves_.push_back(made);
    }
  }

  static CurveOf curve_of(const CurveNumbers& numbers, bool on_spline) {
    if (numbers.degree > 0 || on_spline) return {bspline_curve(numbers), 1.0};
    const gp_Pnt a = point3(numbers.poles, 0);
    const gp_Pnt b = point3(numbers.poles, 1);
    return {new Geom_Line(a, gp_Dir(gp_Vec(a, b))), a.Distance(b)};
  }

  void make_vertices() {
    for (const VertexRow& row : data_.vertices) {
      TopoDS_Vertex made;
      builder_.MakeVertex(made, gp_Pnt(row.point[0], row.point[1], row.point[2]), row.tolerance);
      vertices_.push_back(made);
    }
  }

  void make_edges() {
    const TopLoc_Location here;
    std::size_t next = 0;
    for (const EdgeRow& row : data_.edges) {
      TopoDS_Edge made;
      double scale = 1.0;
      if (row.degenerate) {
        builder_.MakeEdge(made);
        builder_.Degenerated(made, Standard_True);
        builder_.UpdateEdge(made, row.tolerance);
      } else {
        builder_.MakeEdge(made, curves_[row.curve].curve, row.tolerance);
        scale = curves_[row.curve].scale;
      }
      builder_.Add(made, vertices_[row.start].Oriented(TopAbs_FORWARD));
      builder_.Add(made, vertices_[row.end].Oriented(TopAbs_REVERSED));
      for (std::uint32_t k = 0; k < row.on; ++k, ++next) {
        const OnRow& on = data_.on[next];
        const Handle(Geom_Surface)& surface = surfaces_[on.surface];
        if (on.seam)
          builder_.UpdateEdge(made, pcurves_[on.forward], pcurves_[on.reversed], surface, here, row.tolerance);
        else
          builder_.UpdateEdge(made, pcurves_[on.forward], surface, here, row.tolerance);
      }
      builder_.Range(made, row.first * scale, row.last * scale);
      edges_.push_back(made);
    }
  }

  void make_faces() {
    std::size_t next_loop = 0;
    std::size_t next_use = 0;
    for (const FaceRow& row : data_.faces) {
      TopoDS_Face made;
      builder_.MakeFace(made, surfaces_[row.surface], row.tolerance);
      for (std::uint32_t l = 0; l < row.loops; ++l, ++next_loop) {
        TopoDS_Wire wire;
        builder_.MakeWire(wire);
        for (std::uint32_t k = 0; k < data_.loops[next_loop]; ++k, ++next_use) {
          const std::uint32_t use = data_.uses[next_use];
          builder_.Add(wire, edges_[use / 2].Oriented(use % 2 == 1 ? TopAbs_REVERSED : TopAbs_FORWARD));
        }
        wire.Closed(Standard_True);
        builder_.Add(made, wire);
      }
      faces_.push_back(made);
    }
  }

  const AssembledData& data_;
  BRep_Builder builder_;
  std::vector<Handle(Geom_Surface)> surfaces_;
  std::vector<CurveOf> curves_;
  std::vector<Handle(Geom2d_Curve)> pcurves_;
  std::vector<TopoDS_Vertex> vertices_;
  std::vector<TopoDS_Edge> edges_;
  std::vector<TopoDS_Face> faces_;
};

}  // namespace

std::unique_ptr<SolidsHandle> solids_of(const std::vector<TopoDS_Face>& faces, const MergeData& data) {
  auto out = std::make_unique<SolidsHandle>();
  BRep_Builder builder;
  builder.MakeCompound(out->compound);
  std::size_t shell_index = 0;
  std::size_t use_index = 0;
  for (std::uint32_t shells : data.shells_of_solids) {
    TopoDS_Solid solid;
    builder.MakeSolid(solid);
    for (std::uint32_t s = 0; s < shells; ++s, ++shell_index) {
      TopoDS_Shell shell;
      builder.MakeShell(shell);
      for (std::uint32_t k = 0; k < data.faces_of_shells[shell_index]; ++k, ++use_index) {
        const std::uint32_t use = data.uses[use_index];
        const TopoDS_Face& face = faces.at(use / 2);
        builder.Add(shell, face.Oriented(use % 2 == 1 ? TopAbs_REVERSED : TopAbs_FORWARD));
      }
      shell.Closed(Standard_True);
      builder.Add(solid, shell);
    }
    builder.Add(out->compound, solid);
    out->solids.push_back(solid);
  }
  for (std::uint32_t face : data.faces) out->faces.push_back(faces.at(face));
  return out;
}

std::unique_ptr<SolidsHandle> build_assembled(const AssembledData& data) { return solids_of(Assembler(data).faces(), data.solids); }

}  // namespace clinothem::occt
