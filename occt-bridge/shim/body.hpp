// One closed body from a file of another program.
#pragma once

#include "occt-bridge/shim/shape.hpp"

#include <array>

namespace clinothem::occt {

struct BodyRead;

// Reads the one solid that a file holds, in metres; a unit of 0 is the file's own. STEP works
// on process-wide state: the caller holds a lock.
std::unique_ptr<ShapeHandle> read_body(rust::Slice<const std::uint8_t> bytes, bool step, double unit, BodyRead& told);
// The shape made so many times as large, turned about the z axis by an angle (anticlockwise, radians), and moved.
std::unique_ptr<ShapeHandle> placed_shape(const ShapeHandle& shape, double scale, double turn, std::array<double, 3> at);

}  // namespace clinothem::occt
