#include "occt-bridge/shim/spline.hpp"

#include <Geom2dAdaptor_Curve.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace clinothem::occt {

namespace {

constexpr int kDegree = 7;
constexpr int kSide = 4;  // a point and three derivatives
// Inner knots are there so often: three derivatives agree.
constexpr int kMultiplicity = kDegree + 1 - kSide;
// How far the spline may be from what it stands for, as a share of its size.
constexpr double kNear = 1e-11;
constexpr int kMostSpans = 512;

using Row = std::array<gp_XYZ, 2 * kSide>;

// The Bezier points of the polynomial of degree 7 with these derivatives (0 to 3) at both ends of an interval.
Row bezier(const std::array<gp_XYZ, kSide>& left, const std::array<gp_XYZ, kSide>& right, double length) {
  static const double binomial[kSide][kSide] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 2, 1, 0}, {1, 3, 3, 1}};
  // (7 − j)! / 7!
  static const double falling[kSide] = {1.0, 1.0 / 7.0, 1.0 / 42.0, 1.0 / 210.0};
  Row points;
  for (int k = 0; k < kSide; ++k) {
    gp_XYZ low(0, 0, 0), high(0, 0, 0);
    double power = 1.0;
    for (int j = 0; j <= k; ++j, power *= length) {
      const double factor = binomial[k][j] * falling[j] * power;
      low += factor * left[static_cast<std::size_t>(j)];
      high += (j % 2 == 0 ? factor : -factor) * right[static_cast<std::size_t>(j)];
    }
    points[static_cast<std::size_t>(k)] = low;
    points[static_cast<std::size_t>(kDegree - k)] = high;
  }
  return points;
}

// The blossom of a Bezier piece over an interval.
gp_XYZ blossom(Row points, Range range, const double* arguments) {
  for (int round = 0; round < kDegree; ++round) {
    const double part = (arguments[round] - range[0]) / (range[1] - range[0]);
    for (int k = 0; k < kDegree - round; ++k) {
      const auto at = static_cast<std::size_t>(k);
      points[at] = points[at] * (1.0 - part) + points[at + 1] * part;
    }
  }
  return points[0];
}

std::vector<double> flat(const std::vector<double>& knots) {
  std::vector<double> all(kDegree + 1, knots.front());
  for (std::size_t i = 1; i + 1 < knots.size(); ++i) all.insert(all.end(), kMultiplicity, knots[i]);
  all.insert(all.end(), kDegree + 1, knots.back());
  return all;
}

// The control points of the spline whose pieces these are.
std::vector<gp_XYZ> poles(const std::vector<Row>& pieces, const std::vector<double>& knots) {
  const std::vector<double> all = flat(knots);
  std::vector<gp_XYZ> out;
  for (std::size_t i = 0; i + kDegree + 1 < all.size(); ++i) {
    // The piece around the middle of its arguments.
    const double middle = 0.5 * (all[i + 1] + all[i + kDegree]);
    auto after = std::upper_bound(knots.begin() + 1, knots.end() - 1, middle);
    const auto piece = static_cast<std::size_t>(after - knots.begin()) - 1;
    out.push_back(blossom(pieces[piece], {knots[piece], knots[piece + 1]}, &all[i + 1]));
  }
  return out;
}

void multiplicities(const std::vector<double>& knots, TColStd_Array1OfReal& values, TColStd_Array1OfInteger& counts) {
  const int n = static_cast<int>(knots.size());
  for (int i = 1; i <= n; ++i) {
    values(i) = knots[static_cast<std::size_t>(i) - 1];
    counts(i) = i == 1 || i == n ? kDegree + 1 : kMultiplicity;
  }
}

std::vector<double> halved(const std::vector<double>& knots) {
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    out.push_back(knots[i]);
    out.push_back(0.5 * (knots[i] + knots[i + 1]));
  }
  out.push_back(knots.back());
  return out;
}

// Places in which the smooth parts of something end, within a range.
std::vector<double> within(const TColStd_Array1OfReal& breaks, Range range) {
  std::vector<double> knots = {range[0]};
  const double least = 1e-9 * (range[1] - range[0]);
  for (int i = breaks.Lower(); i <= breaks.Upper(); ++i)
    if (breaks(i) > knots.back() + least && breaks(i) < range[1] - least) knots.push_back(breaks(i));
  knots.push_back(range[1]);
  return knots;
}

std::string refusal(const Handle(Standard_Transient) & geometry) {
  return std::string("a ") + geometry->DynamicType()->Name() + " is not smooth enough to become a B-spline";
}

gp_XYZ space(const gp_Vec& d) { return d.XYZ(); }
gp_XYZ space(const gp_Vec2d& d) { return gp_XYZ(d.X(), d.Y(), 0.0); }
gp_XYZ space(const gp_Pnt& p) { return p.XYZ(); }
gp_XYZ space(const gp_Pnt2d& p) { return gp_XYZ(p.X(), p.Y(), 0.0); }

// A partial derivative. Those of low order not by DN: that of cones along their rulings is wrong (7.6).
gp_XYZ derivative(const Handle(Geom_Surface) & surface, double u, double v, int in_u, int in_v) {
  if (in_u + in_v > 3) return surface->DN(u, v, in_u, in_v).XYZ();
  gp_Pnt p;
  gp_Vec of[kSide][kSide];
  surface->D3(u, v, p, of[1][0], of[0][1], of[2][0], of[0][2], of[1][1], of[3][0], of[0][3], of[2][1], of[1][2]);
  return in_u + in_v == 0 ? p.XYZ() : of[in_u][in_v].XYZ();
}

// Curves in space and in the plane.
template <typename Curve, typename Adaptor, typename Spline, typename Points>
opencascade::handle<Spline> curve_as_spline(const opencascade::handle<Curve>& curve, Range range) {
  const Adaptor adaptor(curve, range[0], range[1]);
  TColStd_Array1OfReal breaks(1, adaptor.NbIntervals(GeomAbs_C3) + 1);
  adaptor.Intervals(breaks, GeomAbs_C3);
  for (std::vector<double> knots = within(breaks, range); knots.size() <= kMostSpans + 1; knots = halved(knots)) {
    std::vector<Row> pieces;
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
      const double length = knots[i + 1] - knots[i];
      // A break is looked at from within the piece.
      const double inside = 1e-13 * length;
      std::array<gp_XYZ, kSide> ends[2];
      for (int side = 0; side < 2; ++side) {
        const double t = side == 0 ? knots[i] + inside : knots[i + 1] - inside;
        ends[side][0] = space(curve->Value(side == 0 ? knots[i] : knots[i + 1]));
        for (int k = 1; k < kSide; ++k) ends[side][static_cast<std::size_t>(k)] = space(curve->DN(t, k));
      }
      pieces.push_back(bezier(ends[0], ends[1], length));
    }
    const std::vector<gp_XYZ> all = poles(pieces, knots);
    Points points(1, static_cast<int>(all.size()));
    gp_XYZ low = all[0], high = all[0];
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (int axis = 1; axis <= 3; ++axis) {
        low.SetCoord(axis, std::min(low.Coord(axis), all[i].Coord(axis)));
        high.SetCoord(axis, std::max(high.Coord(axis), all[i].Coord(axis)));
      }
      auto& point = points(static_cast<int>(i) + 1);
      point.SetX(all[i].X());
      point.SetY(all[i].Y());
      if constexpr (std::is_same_v<Points, TColgp_Array1OfPnt>) point.SetZ(all[i].Z());
    }
    const int n = static_cast<int>(knots.size());
    TColStd_Array1OfReal values(1, n);
    TColStd_Array1OfInteger counts(1, n);
    multiplicities(knots, values, counts);
    const opencascade::handle<Spline> spline = new Spline(points, values, counts, kDegree);
    double worst = 0.0;
    for (std::size_t i = 0; i + 1 < knots.size(); ++i)
      for (int k = 1; k < 8; ++k) {
        const double t = knots[i] + (knots[i + 1] - knots[i]) * k / 8.0;
        worst = std::max(worst, (space(spline->Value(t)) - space(curve->Value(t))).Modulus());
      }
    if (worst <= kNear * (high - low).Modulus()) return spline;
  }
  throw Refused(refusal(curve));
}

}  // namespace

Handle(Geom_BSplineCurve) as_spline(const Handle(Geom_Curve) & curve, Range range) {
  return curve_as_spline<Geom_Curve, GeomAdaptor_Curve, Geom_BSplineCurve, TColgp_Array1OfPnt>(curve, range);
}

Handle(Geom2d_BSplineCurve) as_spline(const Handle(Geom2d_Curve) & curve, Range range) {
  return curve_as_spline<Geom2d_Curve, Geom2dAdaptor_Curve, Geom2d_BSplineCurve, TColgp_Array1OfPnt2d>(curve, range);
}

Handle(Geom_BSplineSurface) as_spline(const Handle(Geom_Surface) & surface, Range u, Range v) {
  const GeomAdaptor_Surface adaptor(surface, u[0], u[1], v[0], v[1]);
  TColStd_Array1OfReal breaks_u(1, adaptor.NbUIntervals(GeomAbs_C3) + 1), breaks_v(1, adaptor.NbVIntervals(GeomAbs_C3) + 1);
  adaptor.UIntervals(breaks_u, GeomAbs_C3);
  adaptor.VIntervals(breaks_v, GeomAbs_C3);
  std::vector<double> knots_u = within(breaks_u, u), knots_v = within(breaks_v, v);
  while (knots_u.size() <= kMostSpans + 1 && knots_v.size() <= kMostSpans + 1) {
    // Along v first: for each knot in u its point and derivatives in u, each as control points along v.
    std::vector<std::vector<Row>> pieces_u;
    std::size_t across = 0;
    for (std::size_t i = 0; i + 1 < knots_u.size(); ++i) {
      const double length_u = knots_u[i + 1] - knots_u[i];
      std::array<std::vector<gp_XYZ>, kSide> ends[2];
      for (int side = 0; side < 2; ++side) {
        const double at_u = side == 0 ? knots_u[i] : knots_u[i + 1];
        const double in_u = at_u + (side == 0 ? 1e-13 : -1e-13) * length_u;
        for (int du = 0; du < kSide; ++du) {
          std::vector<Row> pieces_v;
          for (std::size_t j = 0; j + 1 < knots_v.size(); ++j) {
            const double length_v = knots_v[j + 1] - knots_v[j];
            std::array<gp_XYZ, kSide> low, high;
            for (int dv = 0; dv < kSide; ++dv) {
              const auto k = static_cast<std::size_t>(dv);
              const double inside = dv == 0 ? 0.0 : 1e-13 * length_v;
              const double a = knots_v[j] + inside, b = knots_v[j + 1] - inside;
              low[k] = derivative(surface, du == 0 ? at_u : in_u, a, du, dv);
              high[k] = derivative(surface, du == 0 ? at_u : in_u, b, du, dv);
            }
            pieces_v.push_back(bezier(low, high, length_v));
          }
          ends[side][static_cast<std::size_t>(du)] = poles(pieces_v, knots_v);
        }
      }
      across = ends[0][0].size();
      std::vector<Row> row(across);
      for (std::size_t j = 0; j < across; ++j) {
        std::array<gp_XYZ, kSide> low, high;
        for (std::size_t du = 0; du < kSide; ++du) {
          low[du] = ends[0][du][j];
          high[du] = ends[1][du][j];
        }
        row[j] = bezier(low, high, length_u);
      }
      pieces_u.push_back(row);
    }
    std::vector<std::vector<gp_XYZ>> columns;
    for (std::size_t j = 0; j < across; ++j) {
      std::vector<Row> along;
      for (const std::vector<Row>& row : pieces_u) along.push_back(row[j]);
      columns.push_back(poles(along, knots_u));
    }
    const int nu = static_cast<int>(columns[0].size()), nv = static_cast<int>(across);
    TColgp_Array2OfPnt points(1, nu, 1, nv);
    gp_XYZ low = columns[0][0], high = low;
    for (int i = 1; i <= nu; ++i)
      for (int j = 1; j <= nv; ++j) {
        const gp_XYZ& p = columns[static_cast<std::size_t>(j) - 1][static_cast<std::size_t>(i) - 1];
        points(i, j) = gp_Pnt(p);
        for (int axis = 1; axis <= 3; ++axis) {
          low.SetCoord(axis, std::min(low.Coord(axis), p.Coord(axis)));
          high.SetCoord(axis, std::max(high.Coord(axis), p.Coord(axis)));
        }
      }
    TColStd_Array1OfReal values_u(1, static_cast<int>(knots_u.size())), values_v(1, static_cast<int>(knots_v.size()));
    TColStd_Array1OfInteger counts_u(1, values_u.Upper()), counts_v(1, values_v.Upper());
    multiplicities(knots_u, values_u, counts_u);
    multiplicities(knots_v, values_v, counts_v);
    const Handle(Geom_BSplineSurface) spline = new Geom_BSplineSurface(points, values_u, values_v, counts_u, counts_v, kDegree, kDegree);
    // Which of the two parameters wants more spans: on lines of knots of one the other's error is alone.
    double worst = 0.0, worst_u = 0.0, worst_v = 0.0;
    const auto off = [&](double s, double t) { return spline->Value(s, t).Distance(surface->Value(s, t)); };
    for (std::size_t i = 0; i + 1 < knots_u.size(); ++i)
      for (std::size_t j = 0; j + 1 < knots_v.size(); ++j) {
        const double length_u = knots_u[i + 1] - knots_u[i], length_v = knots_v[j + 1] - knots_v[j];
        for (int k = 1; k < 8; ++k) {
          worst_u = std::max(worst_u, off(knots_u[i] + length_u * k / 8.0, knots_v[j]));
          worst_v = std::max(worst_v, off(knots_u[i], knots_v[j] + length_v * k / 8.0));
          worst = std::max(worst, off(knots_u[i] + length_u * k / 8.0, knots_v[j] + length_v * 0.5));
        }
      }
    const double near = kNear * (high - low).Modulus();
    if (std::max({worst, worst_u, worst_v}) <= near) return spline;
    const bool more_u = worst_u > near, more_v = worst_v > near;
    if (more_u || !more_v) knots_u = halved(knots_u);
    if (more_v || !more_u) knots_v = halved(knots_v);
  }
  throw Refused(refusal(surface));
}

}  // namespace clinothem::occt
