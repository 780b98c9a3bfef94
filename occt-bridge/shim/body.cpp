#include "occt-bridge/shim/body.hpp"

#include "occt-bridge/shim/check.hpp"
#include "occt-bridge/src/ffi.rs.h"

#include <BRepBuilderAPI_Transform.hxx>
#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <IFSelect_ReturnStatus.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Reader.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Iterator.hxx>
#include <gp_Trsf.hxx>

#include <algorithm>
#include <sstream>

namespace clinothem::occt {

namespace {

// How exactly a volume is integrated, as a share of it.
constexpr double kExact = 1e-9;

// What the reader says while it reads.
class Words : public Message_Printer {
 public:
  std::string said() const {
    std::string all;
    for (const std::string& line : lines_) all += (all.empty() ? "" : "; ") + line;
    return all;
  }

 protected:
  void send(const TCollection_AsciiString& text, const Message_Gravity gravity) const override {
    constexpr std::size_t kMost = 4;
    if (gravity < Message_Warning || lines_.size() == kMost) return;
    std::string line;
    for (const char c : std::string(text.ToCString())) line += (c == '\n' || c == '\t') ? ' ' : c;
    const auto is_idle = [](char c) { return c == ' ' || c == '*' || c == '\r'; };
    const auto first = std::find_if_not(line.begin(), line.end(), is_idle);
    const auto last = std::find_if_not(line.rbegin(), std::make_reverse_iterator(first), is_idle).base();
    line = std::string(first, last);
    if (!line.empty() && std::find(lines_.begin(), lines_.end(), line) == lines_.end()) lines_.push_back(line);
  }

 private:
  mutable std::vector<std::string> lines_;
};

std::string text(const gp_Pnt& p) {
  std::ostringstream out;
  out.precision(6);
  out << "(" << p.X() << ", " << p.Y() << ", " << p.Z() << ")";
  return out.str();
}

std::string number(std::size_t count, const char* one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

std::size_t count(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, kind, map);
  return static_cast<std::size_t>(map.Extent());
}

TopoDS_Shape step_shape(std::istream& stream, BodyRead& told) {
  const Handle(Message_Messenger) messenger = Message::DefaultMessenger();
  messenger->ChangePrinters().Clear();  // it would write to standard output
  const Handle(Words) words = new Words;
  messenger->AddPrinter(words);
  struct Quiet {
    Handle(Message_Messenger) messenger;
    ~Quiet() { messenger->ChangePrinters().Clear(); }
  } quiet{messenger};
  STEPControl_Controller::Init();
  if (!Interface_Static::SetCVal("xstep.cascade.unit", "M")) throw Refused("the reader of STEP does not count in metres");
  STEPControl_Reader reader;
  const std::string why = [&] {
    if (reader.ReadStream("body", stream) == IFSelect_RetDone) return std::string();
    const std::string said = words->said();
    return said.empty() ? std::string("its first lines are not those of STEP") : said;
  }();
  if (!why.empty()) throw BadInput("unreadable:this is no STEP file that can be read: " + why);
  TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
  reader.FileUnits(lengths, angles, solid_angles);
  if (!lengths.IsEmpty()) told.unit = std::string(lengths.First().ToCString());
  reader.TransferRoots();
  const TopoDS_Shape shape = reader.OneShape();
  if (shape.IsNull()) {
    const std::string said = words->said();
    throw BadInput("empty:it holds no shape" + (said.empty() ? "" : ": " + said));
  }
  return shape;
}

TopoDS_Shape brep_shape(std::istream& stream) {
  BRep_Builder builder;
  TopoDS_Shape shape;
  try {
    BRepTools::Read(shape, stream, builder);
  } catch (const Standard_Failure& failure) {
    throw BadInput("unreadable:this is no BREP file that can be read: " + describe(failure));
  }
  if (shape.IsNull()) throw BadInput("unreadable:this is no BREP file that can be read, or it holds no shape");
  return shape;
}

// Where faces do not close: in a closed body every edge is run along twice, once each way.
void refuse_open(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape edges;
  std::vector<int> uses;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next())
    for (TopExp_Explorer it(faces.Current(), TopAbs_EDGE); it.More(); it.Next()) {
      const TopoDS_Edge& edge = TopoDS::Edge(it.Current());
      if (BRep_Tool::Degenerated(edge) || edge.Orientation() == TopAbs_INTERNAL) continue;
      const auto at = static_cast<std::size_t>(edges.Add(edge)) - 1;
      if (at == uses.size()) uses.push_back(0);
      ++uses[at];
    }
  std::size_t open = 0, shared = 0, first = 0;
  for (std::size_t i = uses.size(); i-- > 0;) {
    if (uses[i] == 2) continue;
    ++(uses[i] < 2 ? open : shared);
    first = i;
  }
  if (open + shared == 0) return;
  double from = 0.0, to = 0.0;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(edges(static_cast<int>(first) + 1)), from, to);
  const std::string where = curve.IsNull() ? "" : ", one near " + text(curve->Value(0.5 * (from + to)));
  if (open > 0) throw BadInput("open:it is not closed: " + number(open, "edge") + (open == 1 ? " has" : " have") + " a face on one side only" + where);
  throw BadInput("open:it is not one body: more than two faces meet in " + number(shared, "edge") + where);
}

// The one solid of a shape; a shell that closes is one, too.
TopoDS_Solid only_solid(const TopoDS_Shape& shape) {
  const std::size_t solids = count(shape, TopAbs_SOLID), faces = count(shape, TopAbs_FACE);
  if (faces == 0) throw BadInput("empty:it holds no face");
  if (solids > 1) throw BadInput("several:it holds " + number(solids, "solid"));
  BRep_Builder builder;
  TopoDS_Solid made;
  if (solids == 1) {
    const TopoDS_Solid solid = TopoDS::Solid(TopExp_Explorer(shape, TopAbs_SOLID).Current());
    const std::size_t beside = faces - count(solid, TopAbs_FACE);
    if (beside > 0) throw BadInput("several:beside its solid it holds " + number(beside, "face"));
    made = solid;
  } else {
    refuse_open(shape);
    const std::size_t shells = count(shape, TopAbs_SHELL);
    if (shells != 1) throw BadInput("several:it holds no solid but " + number(shells, "shell") + " of " + number(faces, "face"));
    builder.MakeSolid(made);
    builder.Add(made, TopExp_Explorer(shape, TopAbs_SHELL).Current());
  }
  refuse_open(made);
  return made;
}

double volume_of(const TopoDS_Shape& shape) {
  GProp_GProps props;
  BRepGProp::VolumeProperties(shape, props, kExact, Standard_False, Standard_False);
  return props.Mass();
}

double largest_tolerance(const TopoDS_Shape& shape) {
  double most = 0.0;
  for (TopExp_Explorer it(shape, TopAbs_EDGE); it.More(); it.Next()) most = std::max(most, BRep_Tool::Tolerance(TopoDS::Edge(it.Current())));
  for (TopExp_Explorer it(shape, TopAbs_VERTEX); it.More(); it.Next()) most = std::max(most, BRep_Tool::Tolerance(TopoDS::Vertex(it.Current())));
  return most;
}

TopoDS_Shape transformed(const TopoDS_Shape& shape, double scale, double turn, const gp_Vec& move) {
  gp_Trsf by, turned, moved;
  by.SetScale(gp::Origin(), scale);
  turned.SetRotation(gp::OZ(), turn);
  moved.SetTranslation(move);
  BRepBuilderAPI_Transform made(shape, moved * turned * by, Standard_True);
  if (!made.IsDone()) throw Refused("the shape could not be placed");
  return made.Shape();
}

}  // namespace

std::unique_ptr<ShapeHandle> read_body(rust::Slice<const std::uint8_t> bytes, bool step, double unit, BodyRead& told) {
  std::istringstream stream(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), std::ios::binary);
  const TopoDS_Shape read = step ? step_shape(stream, told) : brep_shape(stream);
  TopoDS_Solid solid = only_solid(read);
  // In any case: parts of assemblies have a place of their own, which is to be in their numbers.
  solid = TopoDS::Solid(transformed(solid, unit > 0.0 ? unit : 1.0, 0.0, gp_Vec()));
  const std::string defect = first_defect(solid);
  if (!defect.empty()) throw BadInput("invalid:it is not valid: " + defect);
  told.volume = volume_of(solid);
  if (told.volume < 0.0) {
    // Inside out: all of its shells look the other way.
    TopoDS_Solid turned;
    BRep_Builder builder;
    builder.MakeSolid(turned);
    for (TopoDS_Iterator it(solid); it.More(); it.Next()) builder.Add(turned, it.Value().Reversed());
    solid = turned;
    told.volume = -told.volume;
  }
  if (!(told.volume > 0.0)) throw BadInput("empty:it encloses no volume");
  told.faces = count(solid, TopAbs_FACE);
  told.tolerance = largest_tolerance(solid);
  return handle(solid);
}

std::unique_ptr<ShapeHandle> placed_shape(const ShapeHandle& shape, double scale, double turn, std::array<double, 3> at) {
  if (!(scale > 0.0)) throw BadInput("a shape is made " + std::to_string(scale) + " times as large; that must be above 0");
  return handle(transformed(shape.shape, scale, turn, gp_Vec(at[0], at[1], at[2])));
}

}  // namespace clinothem::occt
