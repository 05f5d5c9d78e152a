// SPDX-License-Identifier: Apache-2.0
// The only file that includes OpenCascade (7.6 and later): a solid as a STEP file, and the file read back.
#include "inverse/step/seam.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Geom2d_Ellipse.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <ShapeFix_Face.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <gp_Pln.hxx>

#include <algorithm>
#include <cmath>
#include <new>
#include <unordered_map>

namespace nephroid::inverse {
namespace {

constexpr double least_tolerance = 1e-7; // mm

gp_Pnt point(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

/// Vertices and edges are made once, so that nothing is left to sew. A vertex that is off the plane of a face has that
/// as its tolerance, and so have its edges.
TopoDS_Shape planar_solid(const StepSolid& of) {
  const BRep_Builder builder;
  std::vector<double> off(of.vertices.size(), least_tolerance);
  for (const StepFace& face : of.faces)
    for (const std::uint32_t id : face.ring)
      off[id] = std::max(off[id], 1.01 * std::abs(glm::dot(of.vertices[id] - face.at, face.normal)));
  std::vector<TopoDS_Vertex> vertices(of.vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) builder.MakeVertex(vertices[i], point(of.vertices[i]), off[i]);

  std::unordered_map<std::uint64_t, TopoDS_Edge> edges;
  const auto edge_from = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t low = std::min(a, b), high = std::max(a, b);
    const auto [known, is_new] = edges.try_emplace(std::uint64_t{low} << 32 | high);
    TopoDS_Edge& edge = known->second;
    if (is_new) {
      const glm::dvec3 way = of.vertices[high] - of.vertices[low];
      const double length = glm::length(way);
      builder.MakeEdge(edge, new Geom_Line(point(of.vertices[low]), gp_Dir(way.x, way.y, way.z)),
                       std::max(off[low], off[high]));
      builder.Add(edge, vertices[low].Oriented(TopAbs_FORWARD));
      builder.Add(edge, vertices[high].Oriented(TopAbs_REVERSED));
      builder.Range(edge, 0, length);
    }
    return edge.Oriented(a < b ? TopAbs_FORWARD : TopAbs_REVERSED);
  };

  TopoDS_Shell shell;
  builder.MakeShell(shell);
  for (const StepFace& from : of.faces) {
    TopoDS_Wire wire;
    builder.MakeWire(wire);
    for (std::size_t i = 0; i < from.ring.size(); ++i)
      builder.Add(wire, edge_from(from.ring[i], from.ring[(i + 1) % from.ring.size()]));
    wire.Closed(true);
    TopoDS_Face face;
    builder.MakeFace(face, new Geom_Plane(point(from.at), gp_Dir(from.normal.x, from.normal.y, from.normal.z)),
                     least_tolerance);
    builder.Add(face, wire);
    builder.Add(shell, face);
  }
  shell.Closed(true);
  TopoDS_Solid solid;
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  return solid;
}

/// One step of the spline is 1 in its parameters, which are 0 at the left and at the top. It looks down.
Handle(Geom_BSplineSurface) surface_of(const StepSpline& of) {
  constexpr int degree = 3;
  TColgp_Array2OfPnt poles(1, of.columns + degree, 1, of.rows + degree);
  const glm::dvec2 step = of.size / glm::dvec2(of.columns, of.rows);
  for (int row = 0; row < of.rows + degree; ++row)
    for (int column = 0; column < of.columns + degree; ++column)
      poles(column + 1, row + 1) =
          gp_Pnt((column - 1) * step.x - of.size.x / 2, of.size.y / 2 - (row - 1) * step.y,
                 of.heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(of.columns + degree) +
                            static_cast<std::size_t>(column)]);
  const auto knots = [](int steps) {
    TColStd_Array1OfReal all(1, steps + 2 * degree + 1);
    for (int i = 0; i < all.Length(); ++i) all(i + 1) = i - degree;
    return all;
  };
  const auto once = [](int steps) {
    TColStd_Array1OfInteger all(1, steps + 2 * degree + 1);
    all.Init(1);
    return all;
  };
  Handle(Geom_BSplineSurface) surface = new Geom_BSplineSurface(poles, knots(of.columns), knots(of.rows),
                                                                once(of.columns), once(of.rows), degree, degree);
  surface->Segment(0, of.columns, 0, of.rows); // its ends are clamped, as many readers want them
  return surface;
}

TopoDS_Edge straight(const gp_Pnt& a, const gp_Pnt& b) { return BRepBuilderAPI_MakeEdge(a, b); }

/// The front, a side for each edge of the relief, and the relief.
std::vector<TopoDS_Face> rectangle(const StepSpline& of, const Handle(Geom_BSplineSurface) & surface) {
  std::vector<TopoDS_Face> faces{BRepBuilderAPI_MakeFace(surface, 0, of.columns, 0, of.rows, least_tolerance)};
  for (TopExp_Explorer edge(faces.front(), TopAbs_EDGE); edge.More(); edge.Next()) {
    const TopoDS_Edge below = TopoDS::Edge(edge.Current());
    double first = 0, last = 0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(below, first, last);
    const gp_Pnt a = curve->Value(first), b = curve->Value(last), a_up(a.X(), a.Y(), of.front),
                 b_up(b.X(), b.Y(), of.front);
    BRepBuilderAPI_MakeWire wire(below, straight(b, b_up), straight(b_up, a_up), straight(a_up, a));
    const gp_Vec along(a_up, b_up);
    faces.push_back(BRepBuilderAPI_MakeFace(gp_Pln(a, gp_Dir(along.Crossed(gp_Vec(0, 0, 1)))), wire.Wire()));
  }
  BRepBuilderAPI_MakeWire wire;
  const double x = of.size.x / 2, y = of.size.y / 2, z = of.front;
  const gp_Pnt corners[] = {{-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z}};
  for (int i = 0; i < 4; ++i) wire.Add(straight(corners[i], corners[(i + 1) % 4]));
  faces.push_back(BRepBuilderAPI_MakeFace(gp_Pln(corners[0], gp_Dir(0, 0, 1)), wire.Wire()));
  return faces;
}

/// The ellipse is a line of the relief's parameters; its place in space is found within the tolerance that
/// OpenCascade has for that, 1e-5 mm.
std::vector<TopoDS_Face> ellipse(const StepSpline& of, const Handle(Geom_BSplineSurface) & surface) {
  const auto wire_of = [](const TopoDS_Edge& edge) { return BRepBuilderAPI_MakeWire(edge).Wire(); };
  const double u = of.columns / 2.0, v = of.rows / 2.0;
  const gp_Dir2d major = u >= v ? gp_Dir2d(1, 0) : gp_Dir2d(0, 1);
  const TopoDS_Edge below = BRepBuilderAPI_MakeEdge(
      new Geom2d_Ellipse(gp_Ax2d(gp_Pnt2d(u, v), major), std::max(u, v), std::min(u, v)), surface);
  BRepLib::BuildCurves3d(below);
  const double x = of.size.x / 2, y = of.size.y / 2;
  const gp_Ax2 axes(gp_Pnt(0, 0, of.front), gp_Dir(0, 0, 1), x >= y ? gp_Dir(1, 0, 0) : gp_Dir(0, 1, 0));
  const Handle(Geom_Ellipse) outline = new Geom_Ellipse(axes, std::max(x, y), std::min(x, y));
  const TopoDS_Edge above = BRepBuilderAPI_MakeEdge(outline);
  const TopoDS_Face relief = BRepBuilderAPI_MakeFace(surface, wire_of(below)),
                    front = BRepBuilderAPI_MakeFace(gp_Pln(axes.Location(), axes.Direction()), wire_of(above));
  // Between two closed edges, whose places on it and whose seam are found for it.
  BRepBuilderAPI_MakeFace side(new Geom_SurfaceOfLinearExtrusion(outline, gp_Dir(0, 0, -1)), wire_of(above));
  side.Add(TopoDS::Wire(wire_of(below).Reversed()));
  ShapeFix_Face whole(side.Face());
  whole.Perform();
  return {relief, front, whole.Face()};
}

TopoDS_Shape spline_solid(const StepSpline& of) {
  const Handle(Geom_BSplineSurface) surface = surface_of(of);
  BRepBuilderAPI_Sewing sewing(1e-4);
  for (const TopoDS_Face& face : of.round ? ellipse(of, surface) : rectangle(of, surface)) sewing.Add(face);
  sewing.Perform();
  TopExp_Explorer shell(sewing.SewedShape(), TopAbs_SHELL);
  if (!shell.More() || sewing.NbFreeEdges() > 0) throw StepRefused{"the lens's faces do not close"};
  TopoDS_Solid solid;
  const BRep_Builder builder;
  builder.MakeSolid(solid);
  builder.Add(solid, TopoDS::Shell(shell.Current()));
  BRepLib::OrientClosedSolid(solid);
  return solid;
}

void be_silent() { Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream)); }

/// Whatever OpenCascade throws, as the seam says it.
template <class F>
auto refusing(const F& work) {
  try {
    be_silent();
    return work();
  } catch (const Standard_Failure& failure) {
    throw StepRefused{std::string(failure.DynamicType()->Name()) + " " + failure.GetMessageString()};
  } catch (const std::bad_alloc&) {
    throw StepRefused{"there is not enough memory"};
  }
}

void write(const StepSolid& solid, const std::string& file) {
  refusing([&] {
    STEPControl_Writer writer;
    Interface_Static::SetCVal("write.step.schema", "AP214IS");
    Interface_Static::SetCVal("write.step.unit", "MM");
    Interface_Static::SetCVal("write.step.product.name", solid.name.c_str());
    Interface_Static::SetIVal("write.precision.mode", 1);    // the greatest tolerance
    Interface_Static::SetIVal("write.surfacecurve.mode", 0); // lines on planes say nothing
    const TopoDS_Shape shape = solid.faces.empty() ? spline_solid(solid.spline) : planar_solid(solid);
    if (writer.Transfer(shape, STEPControl_ManifoldSolidBrep) != IFSelect_RetDone)
      throw StepRefused{"the solid does not become STEP"};
    if (writer.Write(file.c_str()) != IFSelect_RetDone) throw StepRefused{"the file cannot be written"};
  });
}

StepRead read(const std::string& file) {
  return refusing([&] {
    STEPControl_Reader reader;
    if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) throw StepRefused{"it cannot be read back"};
    reader.TransferRoots();
    const TopoDS_Shape shape = reader.OneShape();
    std::size_t solids = 0;
    StepRead result;
    for (TopExp_Explorer solid(shape, TopAbs_SOLID); solid.More(); solid.Next()) ++solids;
    for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next()) ++result.faces;
    if (solids != 1) throw StepRefused{"it is read back as " + std::to_string(solids) + " solids"};
    GProp_GProps of;
    BRepGProp::VolumeProperties(shape, of, 1e-6, Standard_True);
    result.volume = of.Mass();
    return result;
  });
}

} // namespace
} // namespace nephroid::inverse

extern "C" __attribute__((visibility("default"))) const nephroid::inverse::StepModule* nephroid_step_module() {
  static const nephroid::inverse::StepModule module{nephroid::inverse::write, nephroid::inverse::read};
  return &module;
}
