#include "occt-bridge/shim/geometry.hpp"

#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Plane.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <gp_Ax3.hxx>

#include <cmath>

namespace clinothem::occt {

namespace {

// OpenCASCADE wants distinct knots and their multiplicities.
struct Knots {
  TColStd_Array1OfReal values;
  TColStd_Array1OfInteger multiplicities;

  explicit Knots(Reals flat) : Knots(flat, distinct(flat)) {}

 private:
  Knots(Reals flat, int count) : values(1, count), multiplicities(1, count) {
    int at = 0;
    for (std::size_t i = 0; i < flat.size(); ++i) {
      if (i == 0 || flat[i] != flat[i - 1]) {
        values(++at) = flat[i];
        multiplicities(at) = 0;
      }
      ++multiplicities(at);
    }
  }

  static int distinct(Reals flat) {
    int n = 0;
    for (std::size_t i = 0; i < flat.size(); ++i)
      if (i == 0 || flat[i] != flat[i - 1]) ++n;
    return n;
  }
};

TColStd_Array1OfReal weights_of(Reals flat) {
  TColStd_Array1OfReal w(1, static_cast<int>(flat.size()));
  for (std::size_t i = 0; i < flat.size(); ++i) w(static_cast<int>(i) + 1) = flat[i];
  return w;
}

Handle(Geom2d_Curve) plane_line(Reals poles, double first, double last) {
  const gp_Pnt2d origin(poles[0], poles[1]);
  const gp_Vec2d direction(poles[2], poles[3]);
  if (std::abs(direction.Magnitude() - 1.0) < 1e-15) return new Geom2d_Line(origin, gp_Dir2d(direction));
  TColgp_Array1OfPnt2d p(1, 2);
  p(1) = origin.Translated(first * direction);
  p(2) = origin.Translated(last * direction);
  TColStd_Array1OfReal k(1, 2);
  k(1) = first;
  k(2) = last;
  TColStd_Array1OfInteger m(1, 2);
  m.Init(2);
  return new Geom2d_BSplineCurve(p, k, m, 1);
}

}  // namespace

gp_Pnt point3(Reals values, std::size_t i) { return gp_Pnt(values[3 * i], values[3 * i + 1], values[3 * i + 2]); }

Handle(Geom_BSplineCurve) bspline_curve(const CurveNumbers& numbers) {
  static const double unit[] = {0.0, 0.0, 1.0, 1.0};
  const bool line = numbers.degree == 0;
  const Knots k(line ? Reals(unit, 4) : numbers.knots);
  const int degree = line ? 1 : static_cast<int>(numbers.degree);
  const int n = static_cast<int>(numbers.poles.size() / 3);
  TColgp_Array1OfPnt p(1, n);
  for (int i = 0; i < n; ++i) p(i + 1) = point3(numbers.poles, static_cast<std::size_t>(i));
  if (numbers.weights.empty()) return new Geom_BSplineCurve(p, k.values, k.multiplicities, degree);
  return new Geom_BSplineCurve(p, weights_of(numbers.weights), k.values, k.multiplicities, degree);
}

Handle(Geom2d_Curve) plane_curve(const CurveNumbers& numbers, double first, double last) {
  if (numbers.degree == 0) return plane_line(numbers.poles, first, last);
  const Knots k(numbers.knots);
  const int n = static_cast<int>(numbers.poles.size() / 2);
  TColgp_Array1OfPnt2d p(1, n);
  for (int i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(2 * i);
    p(i + 1) = gp_Pnt2d(numbers.poles[at], numbers.poles[at + 1]);
  }
  const int degree = static_cast<int>(numbers.degree);
  if (numbers.weights.empty()) return new Geom2d_BSplineCurve(p, k.values, k.multiplicities, degree);
  return new Geom2d_BSplineCurve(p, weights_of(numbers.weights), k.values, k.multiplicities, degree);
}

Handle(Geom_Surface) surface_of(const SurfaceNumbers& numbers) {
  if (numbers.degree_u == 0) {
    const gp_Vec normal(point3(numbers.poles, 1).XYZ());
    const gp_Vec x(point3(numbers.poles, 2).XYZ());
    return new Geom_Plane(gp_Ax3(point3(numbers.poles, 0), gp_Dir(normal), gp_Dir(x)));
  }
  const Knots u(numbers.knots_u);
  const Knots v(numbers.knots_v);
  const int nu = static_cast<int>(numbers.knots_u.size() - numbers.degree_u - 1);
  const int nv = static_cast<int>(numbers.knots_v.size() - numbers.degree_v - 1);
  TColgp_Array2OfPnt p(1, nu, 1, nv);
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) p(i + 1, j + 1) = point3(numbers.poles, static_cast<std::size_t>(i * nv + j));
  const int du = static_cast<int>(numbers.degree_u);
  const int dv = static_cast<int>(numbers.degree_v);
  if (numbers.weights.empty())
    return new Geom_BSplineSurface(p, u.values, v.values, u.multiplicities, v.multiplicities, du, dv);
  TColStd_Array2OfReal w(1, nu, 1, nv);
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) w(i + 1, j + 1) = numbers.weights[static_cast<std::size_t>(i * nv + j)];
  return new Geom_BSplineSurface(p, w, u.values, v.values, u.multiplicities, v.multiplicities, du, dv);
}

}  // namespace clinothem::occt
