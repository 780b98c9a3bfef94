// What shapes consist of, as flat tables.
#pragma once

#include "occt-bridge/shim/shape.hpp"

namespace clinothem::occt {

struct BoundaryRows;

// Fills the rows; returns the numbers they count: knots, poles and weights of the curves, then of the pcurves, then of the surfaces.
std::unique_ptr<std::vector<double>> boundary_of(const ShapeList& list, BoundaryRows& rows);

}  // namespace clinothem::occt
