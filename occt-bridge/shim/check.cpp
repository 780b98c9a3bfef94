#include "occt-bridge/shim/check.hpp"

#include "occt-bridge/shim/partition.hpp"
#include "occt-bridge/src/ffi.rs.h"

#include <BRepCheck.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepCheck_ListOfStatus.hxx>
#include <BRepCheck_Result.hxx>
#include <BRepCheck_Status.hxx>
#include <TopAbs.hxx>
#include <TopExp.hxx>
#include <TopoDS.hxx>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace clinothem::occt {

namespace {

std::string status_name(BRepCheck_Status status) {
  std::ostringstream out;
  BRepCheck::Print(status, out);
  std::string name = out.str();
  while (!name.empty() && (name.back() == '\n' || name.back() == ' ')) name.pop_back();
  return name;
}

// Everything wrong with one kind of sub-shape, by itself and within the shapes that contain it.
void collect(const BRepCheck_Analyzer& analyzer, const TopoDS_Shape& shape, TopAbs_ShapeEnum kind, std::vector<std::string>& out) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, kind, map);
  for (int i = 1; i <= map.Extent(); ++i) {
    const Handle(BRepCheck_Result)& result = analyzer.Result(map(i));
    if (result.IsNull()) continue;
    auto note = [&](const BRepCheck_ListOfStatus& list, const char* where) {
      for (BRepCheck_ListOfStatus::Iterator it(list); it.More(); it.Next()) {
        if (it.Value() == BRepCheck_NoError) continue;
        std::ostringstream text;
        text << TopAbs::ShapeTypeToString(kind) << " " << i - 1 << " of " << map.Extent() << where << ": " << status_name(it.Value());
        std::string line = text.str();
        for (char& c : line) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        if (std::find(out.begin(), out.end(), line) == out.end()) out.push_back(line);
      }
    };
    note(result->Status(), "");
    for (result->InitContextIterator(); result->MoreShapeInContext(); result->NextShapeInContext()) {
      const std::string where =
          std::string(" within a ") + TopAbs::ShapeTypeToString(result->ContextualShape().ShapeType());
      note(result->StatusOnShape(), where.c_str());
    }
  }
}

std::string words(const BRepCheck_Analyzer& analyzer, const TopoDS_Shape& shape) {
  std::vector<std::string> all;
  for (TopAbs_ShapeEnum kind : {TopAbs_SOLID, TopAbs_SHELL, TopAbs_FACE, TopAbs_WIRE, TopAbs_EDGE, TopAbs_VERTEX})
    collect(analyzer, shape, kind, all);
  if (all.empty()) return "invalid for a reason that BRepCheck does not name";
  std::string text;
  const std::size_t shown = std::min<std::size_t>(all.size(), 5);
  for (std::size_t i = 0; i < shown; ++i) text += (i > 0 ? "; " : "") + all[i];
  if (all.size() > shown) text += "; and " + std::to_string(all.size() - shown) + " more";
  return text;
}

}  // namespace

std::string first_defect(const TopoDS_Shape& shape) {
  const BRepCheck_Analyzer analyzer(shape, Standard_True);
  return analyzer.IsValid() ? std::string() : words(analyzer, shape);
}

namespace {

// The kernel's own parallel check has reported a valid face as unorientable, about once in a hundred runs on a loaded machine. So
// each face is checked by itself, on a copy that no other thread sees, and how faces make shells and solids on this thread.
bool seems_valid(const SolidsHandle& solids, bool parallel) {
  std::vector<TopoDS_Shape> faces;
  for (const TopoDS_Face& face : solids.faces) faces.push_back(topology_copy(face));
  std::vector<char> valid(faces.size(), 0);
  for_each_index(faces.size(), parallel, [&](std::size_t i) {
    const BRepCheck_Analyzer analyzer(faces[i], Standard_True);
    valid[i] = analyzer.IsValid() ? 1 : 0;
  });
  if (std::find(valid.begin(), valid.end(), 0) != valid.end()) return false;
  return BRepCheck_Analyzer(solids.compound, Standard_False).IsValid();
}

}  // namespace

rust::Vec<DefectData> find_defects(const SolidsHandle& solids, bool parallel) {
  rust::Vec<DefectData> out;
  if (seems_valid(solids, parallel)) return out;
  // One analyzer for all, on one thread, has the last word and the words.
  const BRepCheck_Analyzer analyzer(solids.compound, Standard_True);
  if (analyzer.IsValid()) return out;
  for (std::size_t i = 0; i < solids.solids.size(); ++i)
    if (!analyzer.IsValid(solids.solids[i])) out.push_back(DefectData{i, words(analyzer, solids.solids[i])});
  if (out.empty()) out.push_back(DefectData{solids.solids.size(), words(analyzer, solids.compound)});
  return out;
}

}  // namespace clinothem::occt
