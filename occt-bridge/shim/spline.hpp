// Any smooth curve or surface as a B-spline with the same parameters: piecewise Hermite interpolation of degree 7, three derivatives at
// every knot, halved until it is as near as rounding. So what lies on it, and refers to it by parameters, stays as it is.
#pragma once

#include "occt-bridge/shim/failure.hpp"

#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>

#include <array>

namespace clinothem::occt {

using Range = std::array<double, 2>;

Handle(Geom_BSplineCurve) as_spline(const Handle(Geom_Curve) & curve, Range range);
Handle(Geom2d_BSplineCurve) as_spline(const Handle(Geom2d_Curve) & curve, Range range);
Handle(Geom_BSplineSurface) as_spline(const Handle(Geom_Surface) & surface, Range u, Range v);

}  // namespace clinothem::occt
