// One general fuse of several solids: cells, their faces, and where each face comes from.
#pragma once

#include "occt-bridge/shim/shape.hpp"

#include <array>

namespace clinothem::occt {

struct Monitor;
struct PartitionTables;
struct MergeData;

struct PartitionHandle {
  std::vector<TopoDS_Shape> cells;
  std::vector<TopoDS_Face> faces;  // all FORWARD
  std::unique_ptr<PartitionTables> tables;
  ~PartitionHandle();
};

// Solids that share their common faces, in one compound.
struct SolidsHandle {
  TopoDS_Compound compound;
  std::vector<TopoDS_Solid> solids;
  std::vector<TopoDS_Face> faces;  // all FORWARD
};

std::unique_ptr<PartitionHandle> run_partition(const ShapeList& arguments, bool parallel, double fuzzy, const Monitor& monitor);
// The arguments as they are, nothing intersected: each is a cell, and faces are shared only where they already were.
std::unique_ptr<PartitionHandle> adopt(const ShapeList& arguments);
PartitionTables tables_of(const PartitionHandle& partition);

std::unique_ptr<SolidsHandle> build_solids(const PartitionHandle& partition, const MergeData& data);
std::unique_ptr<ShapeHandle> solid_of(const SolidsHandle& solids, std::size_t index);
std::unique_ptr<ShapeHandle> face_of(const SolidsHandle& solids, std::size_t index);
std::unique_ptr<ShapeHandle> compound_of_solids(const SolidsHandle& solids);
std::size_t edges_of(const SolidsHandle& solids);

}  // namespace clinothem::occt
