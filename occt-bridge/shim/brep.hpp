// OpenCASCADE's own files and bytes: exact, and faces that are shared stay shared.
#pragma once

#include "occt-bridge/shim/partition.hpp"

namespace clinothem::occt {

void write_brep_file(const ShapeHandle& shape, rust::Str path);
std::unique_ptr<ShapeHandle> read_brep_file(rust::Str path);
rust::Vec<std::uint8_t> solids_to_bytes(const SolidsHandle& solids);
std::unique_ptr<SolidsHandle> solids_from_bytes(rust::Slice<const std::uint8_t> bytes);
rust::Vec<std::uint8_t> shape_to_bytes(const ShapeHandle& shape);
std::unique_ptr<ShapeHandle> shape_from_bytes(rust::Slice<const std::uint8_t> bytes);

}  // namespace clinothem::occt
