// Curves and surfaces from flat numbers.
#pragma once

#include "occt-bridge/shim/failure.hpp"
#include "rust/cxx.h"

#include <Geom2d_Curve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_Surface.hxx>
#include <gp_Pnt.hxx>

#include <cstdint>

namespace clinothem::occt {

// Numbers that someone else owns. (Every access to a rust::Slice is a call into Rust.)
class Reals {
 public:
  Reals(const double* first, std::size_t count) : first_(first), count_(count) {}
  const double* data() const { return first_; }
  std::size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  double operator[](std::size_t i) const { return first_[i]; }

 private:
  const double* first_;
  std::size_t count_;
};

inline Reals reals(const rust::Vec<double>& values) { return Reals(values.data(), values.size()); }

// Knots are flat; weights are empty or one per pole.
struct CurveNumbers {
  std::uint32_t degree;
  Reals knots;
  Reals poles;
  Reals weights;
};

struct SurfaceNumbers {
  std::uint32_t degree_u;
  std::uint32_t degree_v;
  Reals knots_u;
  Reals knots_v;
  Reals poles;
  Reals weights;
};

gp_Pnt point3(Reals values, std::size_t i);

// Degree 0 is the line from the first to the second pole: of degree 1 over 0 to 1.
Handle(Geom_BSplineCurve) bspline_curve(const CurveNumbers& numbers);
// Degree 0 is a line by origin and direction. Unless the direction is of unit length it is a B-spline, from `first` to `last`.
Handle(Geom2d_Curve) plane_curve(const CurveNumbers& numbers, double first, double last);
// Degree 0 is a plane by origin, normal and x axis.
Handle(Geom_Surface) surface_of(const SurfaceNumbers& numbers);

}  // namespace clinothem::occt
