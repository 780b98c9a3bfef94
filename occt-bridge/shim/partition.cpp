#include "occt-bridge/shim/partition.hpp"

#include "occt-bridge/shim/assembled.hpp"
#include "occt-bridge/src/ffi.rs.h"

#include <BOPAlgo_Builder.hxx>
#include <BOPAlgo_PaveFiller.hxx>
#include <BOPDS_DS.hxx>
#include <BOPTools_AlgoTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <IntTools_Context.hxx>
#include <Message_Alert.hxx>
#include <Message_ProgressIndicator.hxx>
#include <Message_ProgressScope.hxx>
#include <Message_Report.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeListOfShape.hxx>
#include <TopTools_DataMapOfShapeShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_AlertWithShape.hxx>
#include <TopoDS_Iterator.hxx>

#include <algorithm>
#include <map>
#include <set>

namespace clinothem::occt {

PartitionHandle::~PartitionHandle() = default;

namespace {

// Passes progress to Rust and a request to stop to the kernel. Called from worker threads.
class Watcher : public Message_ProgressIndicator {
 public:
  explicit Watcher(const Monitor& monitor) : monitor_(monitor) {}
  DEFINE_STANDARD_RTTI_INLINE(Watcher, Message_ProgressIndicator)

 protected:
  Standard_Boolean UserBreak() override { return monitor_.is_cancelled(); }
  void Show(const Message_ProgressScope&, const Standard_Boolean) override { monitor_.report(GetPosition()); }

 private:
  const Monitor& monitor_;
};

// Which arguments a sub-shape, given or produced, belongs to.
class Owners {
 public:
  explicit Owners(const std::vector<TopoDS_Shape>& arguments) {
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      TopTools_IndexedMapOfShape subs;
      TopExp::MapShapes(arguments[i], subs);
      for (int k = 1; k <= subs.Extent(); ++k) add(subs(k), i);
    }
  }

  void add_origins(const TopTools_DataMapOfShapeListOfShape& origins) {
    for (TopTools_DataMapOfShapeListOfShape::Iterator it(origins); it.More(); it.Next())
      for (const TopoDS_Shape& origin : it.Value()) {
        const int at = index_.FindIndex(origin);
        if (at == 0) continue;
        const std::set<std::size_t> of = owners_[static_cast<std::size_t>(at - 1)];
        for (std::size_t owner : of) add(it.Key(), owner);
      }
  }

  std::set<std::size_t> of(const TopoDS_Shape& shape) const {
    std::set<std::size_t> found;
    TopTools_IndexedMapOfShape subs;
    TopExp::MapShapes(shape, subs);
    for (TopAbs_ShapeEnum kind : {TopAbs_SOLID, TopAbs_FACE, TopAbs_EDGE, TopAbs_VERTEX}) {
      for (int k = 1; k <= subs.Extent(); ++k) {
        if (subs(k).ShapeType() != kind) continue;
        const int at = index_.FindIndex(subs(k));
        if (at > 0) found.insert(owners_[static_cast<std::size_t>(at - 1)].begin(), owners_[static_cast<std::size_t>(at - 1)].end());
      }
      if (!found.empty()) break;  // the largest sub-shapes say it best
    }
    return found;
  }

 private:
  void add(const TopoDS_Shape& shape, std::size_t owner) {
    const auto at = static_cast<std::size_t>(index_.Add(shape));
    if (owners_.size() < at) owners_.resize(at);
    owners_[at - 1].insert(owner);
  }

  TopTools_IndexedMapOfShape index_;
  std::vector<std::set<std::size_t>> owners_;
};

struct Noted {
  int count = 0;
  std::set<std::size_t> arguments;
};

void note_alerts(const Handle(Message_Report)& report, Message_Gravity gravity, const Owners& owners, std::map<std::string, Noted>& out) {
  if (report.IsNull()) return;
  std::map<std::string, Noted> found;
  for (Message_ListOfAlert::Iterator it(report->GetAlerts(gravity)); it.More(); it.Next()) {
    Noted& noted = found[it.Value()->DynamicType()->Name()];
    ++noted.count;
    const Handle(TopoDS_AlertWithShape) with = Handle(TopoDS_AlertWithShape)::DownCast(it.Value());
    if (with.IsNull() || with->GetShape().IsNull()) continue;
    const std::set<std::size_t> of = owners.of(with->GetShape());
    noted.arguments.insert(of.begin(), of.end());
  }
  // The builder's report may or may not repeat the intersector's.
  for (const auto& entry : found) {
    Noted& noted = out[entry.first];
    noted.count = std::max(noted.count, entry.second.count);
    noted.arguments.insert(entry.second.arguments.begin(), entry.second.arguments.end());
  }
}

std::vector<std::string> alert_lines(const std::map<std::string, Noted>& noted) {
  std::vector<std::string> lines;
  for (const auto& entry : noted) {
    std::string line = entry.first + " x" + std::to_string(entry.second.count);
    if (!entry.second.arguments.empty()) {
      line += " (arguments";
      for (std::size_t argument : entry.second.arguments) line += " " + std::to_string(argument);
      line += ")";
    }
    lines.push_back(line);
  }
  return lines;
}

void stop_at_errors(const BOPAlgo_Options& algorithm, const Owners& owners, const Monitor& monitor) {
  if (monitor.is_cancelled()) throw Cancelled();
  if (!algorithm.HasErrors()) return;
  std::map<std::string, Noted> noted;
  note_alerts(algorithm.GetReport(), Message_Fail, owners, noted);
  note_alerts(algorithm.GetReport(), Message_Alarm, owners, noted);
  std::string text;
  for (const std::string& line : alert_lines(noted)) text += line + "\n";
  throw Alerts(text.empty() ? "an error without an alert\n" : text);
}

void check_arguments(const ShapeList& arguments) {
  if (arguments.shapes.empty()) throw BadInput("no argument was given");
  TopTools_IndexedMapOfShape seen;
  for (std::size_t i = 0; i < arguments.shapes.size(); ++i) {
    const TopoDS_Shape& shape = arguments.shapes[i];
    if (shape.ShapeType() != TopAbs_SOLID) throw BadInput("argument " + std::to_string(i) + " is not a solid");
    const int before = seen.Extent();
    seen.Add(shape);
    if (seen.Extent() == before) throw BadInput("argument " + std::to_string(i) + " was given before");
  }
}

// Fills everything that follows from the cells and the faces of the arguments.
class Tabulator {
 public:
  Tabulator(PartitionHandle& partition, const std::vector<TopoDS_Shape>& arguments)
      : partition_(partition), tables_(*partition.tables), arguments_(arguments) {}

  // images(argument) and faces_of(face of an argument) give what became of each.
  template <typename Images>
  void run(const Images& images) {
    TopTools_IndexedMapOfShape cells;
    std::vector<std::vector<std::uint32_t>> inside;
    for (std::size_t i = 0; i < arguments_.size(); ++i)
      for (const TopoDS_Shape& image : images(arguments_[i])) {
        if (image.ShapeType() != TopAbs_SOLID) continue;
        const auto at = static_cast<std::size_t>(cells.Add(image));
        if (inside.size() < at) inside.resize(at);
        inside[at - 1].push_back(static_cast<std::uint32_t>(i));
      }
    for (int c = 1; c <= cells.Extent(); ++c) {
      partition_.cells.push_back(cells(c));
      add_cell(cells(c));
      start(tables_.inside_starts, tables_.inside);
      for (std::uint32_t argument : inside[static_cast<std::size_t>(c - 1)]) tables_.inside.push_back(argument);
    }
    start(tables_.cell_starts, tables_.cell_faces);
    start(tables_.inside_starts, tables_.inside);
    for (int f = 1; f <= faces_.Extent(); ++f) {
      partition_.faces.push_back(TopoDS::Face(faces_(f)));
      add_edges(faces_(f));
    }
    start(tables_.face_starts, tables_.face_edges);
    add_origins(images);
  }

 private:
  template <typename Starts, typename Values>
  static void start(Starts& starts, const Values& values) {
    starts.push_back(static_cast<std::uint32_t>(values.size()));
  }

  void add_cell(const TopoDS_Shape& cell) {
    start(tables_.cell_starts, tables_.cell_faces);
    for (TopExp_Explorer it(cell, TopAbs_FACE); it.More(); it.Next()) {
      const TopAbs_Orientation orientation = it.Current().Orientation();
      if (orientation != TopAbs_FORWARD && orientation != TopAbs_REVERSED) {
        ++tables_.internal_faces;
        continue;
      }
      const int at = faces_.Add(it.Current().Oriented(TopAbs_FORWARD)) - 1;
      tables_.cell_faces.push_back(static_cast<std::uint32_t>(2 * at + (orientation == TopAbs_REVERSED ? 1 : 0)));
    }
  }

  void add_edges(const TopoDS_Shape& face) {
    start(tables_.face_starts, tables_.face_edges);
    for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
      const TopAbs_Orientation orientation = it.Current().Orientation();
      if (orientation != TopAbs_FORWARD && orientation != TopAbs_REVERSED) continue;
      if (BRep_Tool::Degenerated(TopoDS::Edge(it.Current()))) continue;
      const int at = edges_.Add(it.Current().Oriented(TopAbs_FORWARD)) - 1;
      tables_.face_edges.push_back(static_cast<std::uint32_t>(2 * at + (orientation == TopAbs_REVERSED ? 1 : 0)));
    }
  }

  template <typename Images>
  void add_origins(const Images& images) {
    const Handle(IntTools_Context) context = new IntTools_Context;
    struct Origin {
      std::uint32_t argument;
      std::uint32_t face;
      std::uint32_t state;
    };
    std::vector<std::vector<Origin>> origins(static_cast<std::size_t>(faces_.Extent()));
    for (std::size_t i = 0; i < arguments_.size(); ++i) {
      std::uint32_t index = 0;
      for (TopExp_Explorer it(arguments_[i], TopAbs_FACE); it.More(); it.Next(), ++index) {
        const TopoDS_Face given = TopoDS::Face(it.Current());
        for (const TopoDS_Shape& image : images(given)) {
          const int at = faces_.FindIndex(image);
          if (at == 0) continue;
          int error = 0;
          const bool reversed = BOPTools_AlgoTools::IsSplitToReverse(TopoDS::Face(faces_(at)), given, context, &error);
          if (error != 0) ++tables_.unoriented_faces;
          origins[static_cast<std::size_t>(at - 1)].push_back({static_cast<std::uint32_t>(i), index, reversed ? 0U : 1U});
        }
      }
    }
    for (const auto& of_face : origins) {
      start(tables_.origin_starts, tables_.origins);
      for (const Origin& origin : of_face)
        for (std::uint32_t value : {origin.argument, origin.face, origin.state}) tables_.origins.push_back(value);
    }
    start(tables_.origin_starts, tables_.origins);
  }

  PartitionHandle& partition_;
  PartitionTables& tables_;
  const std::vector<TopoDS_Shape>& arguments_;
  TopTools_IndexedMapOfShape faces_;
  TopTools_IndexedMapOfShape edges_;
};

// Pairs of faces with a section edge between them, and the arguments they belong to.
void add_crossings(BOPDS_DS& ds, PartitionTables& tables) {
  std::set<std::pair<int, int>> pairs;
  BOPDS_VectorOfInterfFF& found = ds.InterfFF();
  for (int i = 0; i < found.Length(); ++i) {
    BOPDS_InterfFF& interference = found(i);
    BOPDS_VectorOfCurve& curves = interference.ChangeCurves();
    bool crosses = false;
    for (int k = 0; k < curves.Length() && !crosses; ++k) crosses = !curves(k).PaveBlocks().IsEmpty();
    if (!crosses) continue;
    ++tables.crossing_faces;
    const int a = ds.Rank(interference.Index1());
    const int b = ds.Rank(interference.Index2());
    if (a >= 0 && b >= 0 && a != b) pairs.insert({std::min(a, b), std::max(a, b)});
  }
  for (const auto& pair : pairs) {
    tables.crossing_arguments.push_back(static_cast<std::uint32_t>(pair.first));
    tables.crossing_arguments.push_back(static_cast<std::uint32_t>(pair.second));
  }
}

}  // namespace

std::unique_ptr<PartitionHandle> adopt(const ShapeList& arguments) {
  check_arguments(arguments);
  auto partition = std::make_unique<PartitionHandle>();
  partition->tables = std::make_unique<PartitionTables>();
  Tabulator(*partition, arguments.shapes).run([](const TopoDS_Shape& shape) { return std::vector<TopoDS_Shape>{shape}; });
  return partition;
}

std::unique_ptr<PartitionHandle> run_partition(const ShapeList& list, bool parallel, double fuzzy, const Monitor& monitor) {
  check_arguments(list);
  if (monitor.is_cancelled()) throw Cancelled();
  if (!(fuzzy >= 0.0)) throw BadInput("the fuzzy value is " + std::to_string(fuzzy) + "; it must not be negative");
  if (list.shapes.size() == 1) return adopt(list);  // the kernel refuses to fuse one argument

  // The operation writes tolerances and curves into its arguments: it gets a copy of their topology, made at once so that
  // what they share stays shared.
  BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& shape : list.shapes) builder.Add(all, shape);
  std::vector<TopoDS_Shape> arguments;
  TopTools_ListOfShape kernel_arguments;
  const TopoDS_Shape copy = topology_copy(all);  // an iterator does not keep its shape alive
  for (TopoDS_Iterator it(copy); it.More(); it.Next()) {
    arguments.push_back(it.Value());
    kernel_arguments.Append(it.Value());
  }
  if (arguments.size() != list.shapes.size()) throw Refused("copying the arguments changed their number");
  Owners owners(arguments);

  const Handle(Watcher) watcher = new Watcher(monitor);
  Message_ProgressScope scope(watcher->Start(), "partition", 10);

  BOPAlgo_PaveFiller filler;
  filler.SetArguments(kernel_arguments);
  filler.SetRunParallel(parallel);
  filler.SetNonDestructive(Standard_False);
  if (fuzzy > 0.0) filler.SetFuzzyValue(fuzzy);
  filler.Perform(scope.Next(8));
  stop_at_errors(filler, owners, monitor);

  BOPAlgo_Builder fuse;
  fuse.SetArguments(kernel_arguments);
  fuse.SetRunParallel(parallel);
  fuse.SetNonDestructive(Standard_False);
  if (fuzzy > 0.0) fuse.SetFuzzyValue(fuzzy);
  fuse.PerformWithFiller(filler, scope.Next(2));
  stop_at_errors(fuse, owners, monitor);
  if (fuse.Shape().IsNull()) throw Refused("the general fuse returned no shape");

  auto partition = std::make_unique<PartitionHandle>();
  partition->tables = std::make_unique<PartitionTables>();
  auto images = [&fuse](const TopoDS_Shape& shape) {
    std::vector<TopoDS_Shape> out;
    auto add = [&](const TopoDS_Shape& image) {
      const TopoDS_Shape* same = fuse.ShapesSD().Seek(image);
      out.push_back(same != nullptr ? *same : image);
    };
    if (const TopTools_ListOfShape* found = fuse.Images().Seek(shape)) {
      for (const TopoDS_Shape& image : *found) add(image);
    } else {
      add(shape);
    }
    return out;
  };
  Tabulator(*partition, arguments).run(images);
  add_crossings(*filler.PDS(), *partition->tables);

  owners.add_origins(fuse.Origins());
  std::map<std::string, Noted> noted;
  note_alerts(filler.GetReport(), Message_Warning, owners, noted);
  note_alerts(fuse.GetReport(), Message_Warning, owners, noted);
  for (const std::string& line : alert_lines(noted)) partition->tables->alerts.push_back(line);
  if (monitor.is_cancelled()) throw Cancelled();
  return partition;
}

PartitionTables tables_of(const PartitionHandle& partition) { return *partition.tables; }

std::unique_ptr<SolidsHandle> build_solids(const PartitionHandle& partition, const MergeData& data) {
  return solids_of(partition.faces, data);
}

std::unique_ptr<ShapeHandle> solid_of(const SolidsHandle& solids, std::size_t index) {
  if (index >= solids.solids.size()) throw BadInput("there is no solid " + std::to_string(index));
  return handle(solids.solids[index]);
}

std::unique_ptr<ShapeHandle> face_of(const SolidsHandle& solids, std::size_t index) {
  if (index >= solids.faces.size()) throw BadInput("there is no face " + std::to_string(index));
  return handle(solids.faces[index]);
}

std::unique_ptr<ShapeHandle> compound_of_solids(const SolidsHandle& solids) { return handle(solids.compound); }

std::size_t edges_of(const SolidsHandle& solids) {
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(solids.compound, TopAbs_EDGE, edges);
  return static_cast<std::size_t>(edges.Extent());
}

}  // namespace clinothem::occt
