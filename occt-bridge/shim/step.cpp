#include "occt-bridge/shim/step.hpp"

#include "occt-bridge/src/ffi.rs.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <IFSelect_ReturnStatus.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <STEPControl_Controller.hxx>
#include <TCollection_ExtendedString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

#include <cmath>
#include <fstream>

namespace clinothem::occt {

namespace {

void set(const char* name, const char* value) {
  if (!Interface_Static::SetCVal(name, value)) throw Refused(std::string("the parameter ") + name + " does not take " + value);
}

void set(const char* name, int value) {
  if (!Interface_Static::SetIVal(name, value)) throw Refused(std::string("the parameter ") + name + " does not take " + std::to_string(value));
}

// Before a reader is made: it reads these when it is.
void prepare(const std::string& unit) {
  Message::DefaultMessenger()->ChangePrinters().Clear();  // it would write to standard output
  STEPControl_Controller::Init();
  set("xstep.cascade.unit", unit.c_str());
  set("read.step.nonmanifold", 1);
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
    for (const XCAFDoc_ColorType type : {XCAFDoc_ColorSurf, XCAFDoc_ColorGen, XCAFDoc_ColorCurv}) {
      if (tool->GetColor(label, type, color)) return true;
      if (!occurrence.IsNull() && tool->GetColor(occurrence, type, color)) return true;
    }
    // Several solids of one product carry their colours themselves.
    TDF_LabelSequence subs;
    XCAFDoc_ShapeTool::GetSubShapes(label, subs);
    for (TDF_LabelSequence::Iterator it(subs); it.More(); it.Next())
      for (const XCAFDoc_ColorType type : {XCAFDoc_ColorSurf, XCAFDoc_ColorGen, XCAFDoc_ColorCurv})
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

std::unique_ptr<ReadParts> read_parts(rust::Str path, rust::Str unit, rust::Vec<ReadPartData>& tables) {
  const std::string name(path);
  if (!std::ifstream(name, std::ios::binary)) throw NoFile("cannot open " + name);
  prepare(std::string(unit));
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
