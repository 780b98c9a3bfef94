#include "occt-bridge/shim/step.hpp"

#include "occt-bridge/src/ffi.rs.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <IFSelect_ReturnStatus.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_Protocol.hxx>
#include <Interface_ShareTool.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Version.hxx>
#include <StepBasic_Product.hxx>
#include <StepBasic_ProductDefinition.hxx>
#include <StepBasic_ProductDefinitionFormation.hxx>
#include <StepData_StepModel.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepRepr_CharacterizedDefinition.hxx>
#include <StepRepr_NextAssemblyUsageOccurrence.hxx>
#include <StepRepr_PropertyDefinition.hxx>
#include <StepRepr_RepresentationContext.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <StepRepr_RepresentedDefinition.hxx>
#include <StepShape_ShapeDefinitionRepresentation.hxx>
#include <StepShape_ShellBasedSurfaceModel.hxx>
#include <StepShape_VertexPoint.hxx>
#include <StepVisual_MechanicalDesignGeometricPresentationRepresentation.hxx>
#include <TCollection_ExtendedString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>
#include <TransferBRep.hxx>
#include <TransferBRep_ShapeMapper.hxx>
#include <Transfer_FinderProcess.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_TransferWriter.hxx>
#include <XSControl_WorkSession.hxx>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>

namespace clinothem::occt {

namespace {

TCollection_AsciiString ascii(const rust::String& text) { return TCollection_AsciiString(std::string(text).c_str()); }

Handle(TCollection_HAsciiString) shared(const rust::String& text) { return new TCollection_HAsciiString(ascii(text)); }

void set(const char* name, const char* value) {
  if (!Interface_Static::SetCVal(name, value)) throw Refused(std::string("the parameter ") + name + " does not take " + value);
}

void set(const char* name, int value) {
  if (!Interface_Static::SetIVal(name, value)) throw Refused(std::string("the parameter ") + name + " does not take " + std::to_string(value));
}

// Before a reader or writer is made: they read these when they are.
void prepare(bool ap242, bool shared_faces, const rust::String& product) {
  Message::DefaultMessenger()->ChangePrinters().Clear();  // it would write to standard output
  STEPControl_Controller::Init();
  set("xstep.cascade.unit", "M");
  set("write.step.unit", "M");
  set("write.step.schema", ap242 ? 5 : 4);
  set("write.step.nonmanifold", shared_faces ? 1 : 0);
  set("read.step.nonmanifold", 1);
  set("write.surfacecurve.mode", 1);
  set("write.step.product.name", std::string(product).c_str());
}

// Since 7.8 the model scales by its own unit, whatever the process-wide parameter says (millimetres for a metre).
void declare_metres([[maybe_unused]] const Handle(StepData_StepModel)& model) {
#if OCC_VERSION_HEX >= 0x070800
  model->SetWriteLengthUnit(1000.0);
#endif
}

class Document {
 public:
  Document() {
    application_ = XCAFApp_Application::GetApplication();
    application_->NewDocument("MDTV-XCAF", document_);
  }
  ~Document() {
    try {
      application_->Close(document_);
    } catch (const Standard_Failure&) {
      // Nothing more can be released.
    }
  }
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  Handle(TDocStd_Document)& get() { return document_; }
  Handle(XCAFDoc_ShapeTool) shapes() const { return XCAFDoc_DocumentTool::ShapeTool(document_->Main()); }
  Handle(XCAFDoc_ColorTool) colors() const { return XCAFDoc_DocumentTool::ColorTool(document_->Main()); }
  Handle(XCAFDoc_LayerTool) layers() const { return XCAFDoc_DocumentTool::LayerTool(document_->Main()); }

 private:
  Handle(XCAFApp_Application) application_;
  Handle(TDocStd_Document) document_;
};

// No clock and no user: the same model gives the same bytes.
void write_header(const Handle(StepData_StepModel)& model, const StepHeader& data) {
  APIHeaderSection_MakeHeader header(model);
  header.SetName(shared(data.name));
  header.SetTimeStamp(new TCollection_HAsciiString("1970-01-01T00:00:00"));
  header.SetAuthorValue(1, new TCollection_HAsciiString(""));
  header.SetOrganizationValue(1, new TCollection_HAsciiString(""));
  header.SetOriginatingSystem(shared(data.system));
  header.SetPreprocessorVersion(new TCollection_HAsciiString((std::string("OpenCASCADE ") + std::string(kernel_version())).c_str()));
  header.SetAuthorisation(new TCollection_HAsciiString(""));
  header.SetDescriptionValue(1, shared(data.description));
}

// Occurrences are numbered by a counter that lives as long as the process.
void renumber_occurrences(const Handle(StepData_StepModel)& model) {
  int next = 0;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(StepRepr_NextAssemblyUsageOccurrence) use =
        Handle(StepRepr_NextAssemblyUsageOccurrence)::DownCast(model->Value(i));
    if (!use.IsNull()) use->SetId(new TCollection_HAsciiString(++next));
  }
}

// Colours are written product by product, in the order of a hash of addresses. This puts them in the order of the products.
void order_styles(const Handle(XSControl_WorkSession)& session, const Handle(StepData_StepModel)& model) {
  using Entity = Handle(Standard_Transient);
  const Interface_ShareTool share(model, session->Protocol());
  std::vector<bool> placed(static_cast<std::size_t>(model->NbEntities()) + 1, false);
  const std::function<void(const Entity&, std::vector<Entity>*)> place = [&](const Entity& entity, std::vector<Entity>* out) {
    const auto number = static_cast<std::size_t>(model->Number(entity));
    if (number == 0 || placed[number]) return;
    placed[number] = true;
    if (out != nullptr) out->push_back(entity);
    for (Interface_EntityIterator it = share.Shareds(entity); it.More(); it.Next()) place(it.Value(), out);
  };
  // What the products need keeps its order; what only colours need follows.
  std::vector<std::pair<int, Entity>> styles;
  for (Interface_EntityIterator it = share.RootEntities(); it.More(); it.Next()) {
    const auto style = Handle(StepVisual_MechanicalDesignGeometricPresentationRepresentation)::DownCast(it.Value());
    if (style.IsNull())
      place(it.Value(), nullptr);
    else
      styles.emplace_back(model->Number(style->ContextOfItems()), it.Value());
  }
  if (styles.empty()) return;
  std::vector<Entity> ordered;
  for (int i = 1; i <= model->NbEntities(); ++i)
    if (placed[static_cast<std::size_t>(i)]) ordered.push_back(model->Value(i));
  std::sort(styles.begin(), styles.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& style : styles) place(style.second, &ordered);
  if (static_cast<int>(ordered.size()) != model->NbEntities()) throw Refused("ordering the entities of the file lost some");
  model->ClearEntities();
  for (const Entity& entity : ordered) model->AddEntity(entity);
  session->ComputeGraph(Standard_True);
}

// The PRODUCT that was written for a shape.
Handle(StepBasic_Product) product_of(const Handle(Transfer_FinderProcess)& process, const TopoDS_Shape& shape) {
  const Handle(TransferBRep_ShapeMapper) mapper = TransferBRep::ShapeMapper(process, shape);
  Handle(StepShape_ShapeDefinitionRepresentation) found;
  if (!process->FindTypedTransient(mapper, STANDARD_TYPE(StepShape_ShapeDefinitionRepresentation), found)) return {};
  const Handle(StepRepr_PropertyDefinition) property = found->Definition().PropertyDefinition();
  if (property.IsNull()) return {};
  const Handle(StepBasic_ProductDefinition) definition = property->Definition().ProductDefinition();
  if (definition.IsNull()) return {};
  return definition->Formation()->OfProduct();
}

// The numbers in the file must be those of the model: how the kernel scales depends on its version and on process-wide state.
void check_scale(const Handle(StepData_StepModel)& model, const std::vector<TopoDS_Shape>& shapes) {
  double given = 0.0;
  for (const TopoDS_Shape& shape : shapes)
    for (TopExp_Explorer it(shape, TopAbs_VERTEX); it.More(); it.Next()) {
      const gp_Pnt p = BRep_Tool::Pnt(TopoDS::Vertex(it.Current()));
      for (double x : {p.X(), p.Y(), p.Z()}) given = std::max(given, std::abs(x));
    }
  double written = 0.0;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto vertex = Handle(StepShape_VertexPoint)::DownCast(model->Value(i));
    if (vertex.IsNull()) continue;
    const auto point = Handle(StepGeom_CartesianPoint)::DownCast(vertex->VertexGeometry());
    if (point.IsNull()) continue;
    for (int k = 1; k <= point->NbCoordinates(); ++k) written = std::max(written, std::abs(point->CoordinatesValue(k)));
  }
  if (std::abs(given - written) > 1e-9 * given)
    throw Refused("the largest coordinate is " + std::to_string(given) + " m, but " + std::to_string(written) + " would be written");
}

void write_file(STEPControl_Writer& writer, const std::string& path) {
  {
    const std::ofstream probe(path, std::ios::binary | std::ios::app);
    if (!probe) throw NoFile("cannot create " + path);
  }
  if (writer.Write(path.c_str()) != IFSelect_RetDone) throw NoFile("cannot write " + path);
}

// The shape of a leaf: its only piece, or a compound of its pieces.
TopoDS_Shape leaf_shape(const StepNodeData& node, const ShapeList& shapes, TopTools_IndexedMapOfShape& seen) {
  if (node.first_shape + node.shapes > shapes.shapes.size()) throw BadInput("a node names shapes that do not exist");
  for (std::size_t i = 0; i < node.shapes; ++i) {
    const int before = seen.Extent();
    seen.Add(shapes.shapes[node.first_shape + i]);
    if (seen.Extent() == before) throw BadInput("a shape of \"" + std::string(node.name) + "\" is used twice in the document");
  }
  if (node.shapes == 1) return shapes.shapes[node.first_shape];
  BRep_Builder builder;
  TopoDS_Compound compound;
  builder.MakeCompound(compound);
  for (std::size_t i = 0; i < node.shapes; ++i) builder.Add(compound, shapes.shapes[node.first_shape + i]);
  return compound;
}

}  // namespace

void write_assembly(rust::Str path, const StepHeader& header, const rust::Vec<StepNodeData>& nodes, const ShapeList& shapes) {
  prepare(header.ap242, false, header.name);
  Document document;
  const Handle(XCAFDoc_ShapeTool) tool = document.shapes();
  XCAFDoc_ShapeTool::SetAutoNaming(Standard_False);
  std::vector<TDF_Label> labels;
  TopTools_IndexedMapOfShape seen;
  for (const StepNodeData& node : nodes) {
    const TDF_Label label = node.shapes == 0 ? tool->NewShape() : tool->AddShape(leaf_shape(node, shapes, seen), Standard_False);
    const TCollection_ExtendedString name(std::string(node.name).c_str());
    TDataStd_Name::Set(label, name);
    if (node.parent >= 0) {
      const TDF_Label use = tool->AddComponent(labels.at(static_cast<std::size_t>(node.parent)), label, TopLoc_Location());
      TDataStd_Name::Set(use, name);
    }
    if (node.has_color)
      document.colors()->SetColor(
          label, Quantity_Color(node.color[0] / 255.0, node.color[1] / 255.0, node.color[2] / 255.0, Quantity_TOC_sRGB), XCAFDoc_ColorGen);
    if (!node.layer.empty()) document.layers()->SetLayer(label, TCollection_ExtendedString(std::string(node.layer).c_str()));
    labels.push_back(label);
  }
  tool->UpdateAssemblies();

  STEPCAFControl_Writer writer;
  writer.SetColorMode(Standard_True);
  writer.SetNameMode(Standard_True);
  writer.SetLayerMode(Standard_True);
  writer.SetPropsMode(Standard_False);
  declare_metres(writer.ChangeWriter().Model());
  if (!writer.Transfer(document.get(), STEPControl_AsIs)) throw Refused("the document could not be translated to STEP");

  const Handle(XSControl_WorkSession) session = writer.ChangeWriter().WS();
  const Handle(Transfer_FinderProcess) process = session->TransferWriter()->FinderProcess();
  std::map<std::string, int> ids;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Handle(StepBasic_Product) product = product_of(process, XCAFDoc_ShapeTool::GetShape(labels[i]));
    if (product.IsNull()) throw Refused("no PRODUCT was written for \"" + std::string(nodes[i].name) + "\"");
    const std::string name(nodes[i].name);
    const int count = ++ids[name];
    product->SetName(shared(nodes[i].name));
    product->SetId(new TCollection_HAsciiString((count == 1 ? name : name + " #" + std::to_string(count)).c_str()));
    product->SetDescription(shared(nodes[i].description));
  }
  const Handle(StepData_StepModel) model = writer.ChangeWriter().Model();
  order_styles(session, model);
  check_scale(model, shapes.shapes);
  renumber_occurrences(model);
  write_header(model, header);
  write_file(writer.ChangeWriter(), std::string(path));
}

void write_shared(rust::Str path, const StepHeader& header, const ShapeHandle& shape, const rust::Vec<rust::String>& names) {
  TopTools_IndexedMapOfShape solids;
  TopExp::MapShapes(shape.shape, TopAbs_SOLID, solids);
  if (solids.IsEmpty()) throw BadInput("the shape has no solid");
  if (!names.empty() && names.size() != static_cast<std::size_t>(solids.Extent()))
    throw BadInput("there are " + std::to_string(names.size()) + " names for " + std::to_string(solids.Extent()) + " solids");
  for (int i = 1; i <= solids.Extent(); ++i) {
    int shells = 0;
    for (TopoDS_Iterator it(solids(i)); it.More(); it.Next()) ++shells;
    if (shells != 1)
      throw BadInput("solid " + std::to_string(i - 1) + " has " + std::to_string(shells) +
                     " shells: this flavour cannot tell a void from a body, BREP can");
  }
  prepare(header.ap242, true, header.name);
  STEPControl_Writer writer;
  declare_metres(writer.Model());
  if (writer.Transfer(shape.shape, STEPControl_AsIs) != IFSelect_RetDone) throw Refused("the shape could not be translated to STEP");
  const Handle(StepData_StepModel) model = writer.Model();
  // The kernel numbers its products by a counter that lives as long as the process.
  int products = 0;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto product = Handle(StepBasic_Product)::DownCast(model->Value(i));
    if (product.IsNull()) continue;
    const std::string name(header.name);
    product->SetName(shared(header.name));
    product->SetId(new TCollection_HAsciiString((++products == 1 ? name : name + " #" + std::to_string(products)).c_str()));
  }
  // The kernel writes each solid as its closed shell.
  std::vector<Handle(StepShape_ShellBasedSurfaceModel)> items;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto item = Handle(StepShape_ShellBasedSurfaceModel)::DownCast(model->Value(i));
    if (!item.IsNull()) items.push_back(item);
  }
  if (items.size() != static_cast<std::size_t>(solids.Extent()))
    throw Refused(std::to_string(solids.Extent()) + " solids became " + std::to_string(items.size()) + " closed shells");
  for (std::size_t i = 0; i < names.size(); ++i) items[i]->SetName(shared(names[i]));
  renumber_occurrences(model);
  check_scale(model, {shape.shape});
  write_header(model, header);
  write_file(writer, std::string(path));
}

namespace {

std::string label_name(const TDF_Label& label) {
  Handle(TDataStd_Name) name;
  if (!label.FindAttribute(TDataStd_Name::GetID(), name)) return {};
  const TCollection_ExtendedString& text = name->Get();
  std::vector<char> buffer(static_cast<std::size_t>(text.LengthOfCString()) + 1, '\0');
  Standard_PCharacter target = buffer.data();
  text.ToUTF8CString(target);
  return std::string(buffer.data());
}

// The shared flavour holds closed shells: each is the boundary of a solid.
TopoDS_Shape with_solids(const TopoDS_Shape& shape) {
  if (TopExp_Explorer(shape, TopAbs_SOLID).More()) return shape;
  std::vector<TopoDS_Shape> solids;
  BRep_Builder builder;
  for (TopExp_Explorer it(shape, TopAbs_SHELL); it.More(); it.Next()) {
    if (!BRep_Tool::IsClosed(it.Current())) return shape;
    TopoDS_Solid solid;
    builder.MakeSolid(solid);
    builder.Add(solid, it.Current());
    solids.push_back(solid);
  }
  if (solids.empty()) return shape;
  if (solids.size() == 1) return solids[0];
  TopoDS_Compound compound;
  builder.MakeCompound(compound);
  for (const TopoDS_Shape& solid : solids) builder.Add(compound, solid);
  return compound;
}

class PartCollector {
 public:
  PartCollector(const Document& document, ReadParts& parts, rust::Vec<ReadPartData>& tables)
      : document_(document), parts_(parts), tables_(tables) {}

  void visit(const TDF_Label& label, const TopLoc_Location& location, const std::string& path, const TDF_Label& occurrence) {
    TDF_Label referred = label;
    const bool is_use = XCAFDoc_ShapeTool::GetReferredShape(label, referred);
    const TopLoc_Location here = is_use ? location * XCAFDoc_ShapeTool::GetLocation(label) : location;
    std::string name = label_name(referred);
    if (name.empty()) name = label_name(label);
    const std::string full = path.empty() ? name : path + "/" + name;
    if (XCAFDoc_ShapeTool::IsAssembly(referred)) {
      TDF_LabelSequence components;
      XCAFDoc_ShapeTool::GetComponents(referred, components);
      for (TDF_LabelSequence::Iterator it(components); it.More(); it.Next()) visit(it.Value(), here, full, it.Value());
      return;
    }
    ReadPartData part;
    part.name = name;
    part.path = full;
    part.has_color = false;
    part.color = {0, 0, 0};
    Quantity_Color color;
    if (find_color(referred, occurrence, color)) {
      double rgb[3];
      color.Values(rgb[0], rgb[1], rgb[2], Quantity_TOC_sRGB);
      part.has_color = true;
      for (std::size_t i = 0; i < 3; ++i) part.color[i] = static_cast<std::uint8_t>(std::lround(255.0 * rgb[i]));
    }
    part.layer = find_layer(referred, occurrence);
    parts_.shapes.push_back(with_solids(XCAFDoc_ShapeTool::GetShape(referred)).Located(here));
    tables_.push_back(part);
  }

 private:
  std::string find_layer(const TDF_Label& label, const TDF_Label& occurrence) const {
    TDF_LabelSequence candidates;
    XCAFDoc_ShapeTool::GetSubShapes(label, candidates);  // several solids of one product carry their layer themselves
    if (!occurrence.IsNull()) candidates.Prepend(occurrence);
    candidates.Prepend(label);
    for (TDF_LabelSequence::Iterator it(candidates); it.More(); it.Next()) {
      const Handle(TColStd_HSequenceOfExtendedString) layers = document_.layers()->GetLayers(it.Value());
      if (!layers.IsNull() && !layers->IsEmpty()) return TCollection_AsciiString(layers->Value(1)).ToCString();
    }
    return {};
  }

  bool find_color(const TDF_Label& label, const TDF_Label& occurrence, Quantity_Color& color) const {
    const Handle(XCAFDoc_ColorTool) tool = document_.colors();
    for (const XCAFDoc_ColorType type : {XCAFDoc_ColorSurf, XCAFDoc_ColorGen}) {
      if (tool->GetColor(label, type, color)) return true;
      if (!occurrence.IsNull() && tool->GetColor(occurrence, type, color)) return true;
    }
    // Several solids of one product carry their colours themselves.
    TDF_LabelSequence subs;
    XCAFDoc_ShapeTool::GetSubShapes(label, subs);
    for (TDF_LabelSequence::Iterator it(subs); it.More(); it.Next())
      for (const XCAFDoc_ColorType type : {XCAFDoc_ColorSurf, XCAFDoc_ColorGen})
        if (tool->GetColor(it.Value(), type, color)) return true;
    return false;
  }

  const Document& document_;
  ReadParts& parts_;
  rust::Vec<ReadPartData>& tables_;
};

}  // namespace

std::unique_ptr<ShapeHandle> ReadParts::shape(std::size_t index) const {
  if (index >= shapes.size()) throw BadInput("there is no part " + std::to_string(index));
  return handle(shapes[index]);
}

std::unique_ptr<ReadParts> read_parts(rust::Str path, rust::Vec<ReadPartData>& tables) {
  const std::string name(path);
  if (!std::ifstream(name, std::ios::binary)) throw NoFile("cannot open " + name);
  prepare(false, false, "");
  Document document;
  STEPCAFControl_Reader reader;
  reader.SetColorMode(Standard_True);
  reader.SetNameMode(Standard_True);
  reader.SetLayerMode(Standard_True);
  if (reader.ReadFile(name.c_str()) != IFSelect_RetDone) throw NoFile(name + " is not a STEP file");
  if (!reader.Transfer(document.get())) throw NoFile(name + " holds no shape");
  auto parts = std::make_unique<ReadParts>();
  TDF_LabelSequence free;
  document.shapes()->GetFreeShapes(free);
  PartCollector collector(document, *parts, tables);
  for (TDF_LabelSequence::Iterator it(free); it.More(); it.Next()) collector.visit(it.Value(), TopLoc_Location(), "", TDF_Label());
  if (parts->shapes.empty()) throw NoFile(name + " holds no shape");
  return parts;
}

}  // namespace clinothem::occt
