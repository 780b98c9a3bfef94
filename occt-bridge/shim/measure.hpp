// Areas, volumes, bounds, and whether a point is inside: by adaptive integration with a stated relative error.
#pragma once

#include "occt-bridge/shim/shape.hpp"

#include <Bnd_Box.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <IntTools_Context.hxx>
#include <gp_Lin.hxx>
#include <gp_Pnt.hxx>
#include <gp_XY.hxx>

#include <array>

namespace clinothem::occt {

struct BoxData;
struct FaceIntegralData;
struct FaceSampleData;
struct SolidsHandle;

struct Integral {
  double value;
  double error;  // as the integrator estimates it, in units of the value
};

// Volume of the cone from a point over a face, positive where the face, as oriented, looks away from the point.
Integral face_flux(const TopoDS_Face& face, const gp_Pnt& reference, double eps);
Integral face_area(const TopoDS_Face& face, double eps);

double shape_volume(const ShapeHandle& shape, double eps);
double shape_area(const ShapeHandle& shape, double eps);
std::array<double, 6> shape_bounds(const ShapeHandle& shape);
// A box around every solid, from control points.
rust::Vec<BoxData> solid_boxes(const SolidsHandle& solids, bool parallel);
rust::Vec<FaceIntegralData> integrate_faces(const SolidsHandle& solids, double eps, std::array<double, 3> reference, bool parallel);
rust::Vec<FaceSampleData> sample_faces(const SolidsHandle& solids, std::size_t per_face, bool parallel);

struct ClassifierHandle {
  explicit ClassifierHandle(const TopoDS_Shape& solid);
  // A Bezier patch of a face's surface, or another surface as far as the face needs it.
  struct Patch {
    TopoDS_Face face;
    Handle(GeomAdaptor_Surface) surface;
    Bnd_Box box;
    // Of a patch: where its parameters from 0 to 1 are in those of the surface.
    bool is_part = false;
    gp_XY from;
    gp_XY to;
  };
  std::vector<Patch> patches;
  // How long rays are.
  double reach = 0.0;
  // How often a ray passes through the faces; -1 if it meets an edge or grazes a face.
  int crossings(const gp_Lin& line) const;
  std::vector<std::pair<TopoDS_Face, Bnd_Box>> faces;
  Handle(IntTools_Context) context;
  // 0 in, 1 out, 2 on
  std::uint8_t classify(std::array<double, 3> point, double tolerance);
};
std::unique_ptr<ClassifierHandle> new_classifier(const ShapeHandle& shape);

}  // namespace clinothem::occt
