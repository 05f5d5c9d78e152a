// SPDX-License-Identifier: Apache-2.0
#include "inverse/facets/files.h"

#include "base/zip.h"
#include "inverse/facets/tool.h"
#include "inverse/light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace nephroid::inverse {
namespace {

void write_text(std::string_view text, ByteSink& to) { to.write(std::as_bytes(std::span(text))); }

/// The pixels of a height map: square but for what divides the object's shorter side evenly, four or more across any
/// facet, whole facets along the longer side, and some 1024 across the object.
glm::ivec2 pixels_of(const Layout& layout) {
  constexpr int across = 1024, least_a_facet = 4, most = 8192;
  const int axis = layout.size.x >= layout.size.y ? 0 : 1;
  const double facet = layout.facet()[axis], narrower = std::min(layout.facet().x, layout.facet().y);
  const int least = static_cast<int>(std::ceil(least_a_facet * facet / narrower)),
            fitting = std::max(1, most / layout.facets[axis]);
  const double pixel = facet / std::min(fitting, std::max(least, across / layout.facets[axis]));
  return glm::max(glm::ivec2(glm::round(layout.size / pixel)), 1);
}

std::string scale_of(const Layout& layout) {
  const glm::dvec2 pixel = layout.size / glm::dvec2(pixels_of(layout));
  return fmt::format("a pixel is {:.6g} x {:.6g} mm; seen from the facets' side, +x is at the left{}{}", pixel.x,
                     pixel.y, layout.round ? "; 0 beside the object" : "",
                     layout.draft > 0 ? "; facets reach as far as if walls stood upright: the mesh has the draft" : "");
}

double step_mm(const Solid& solid) { return solid.relief() / std::numeric_limits<std::uint16_t>::max(); }

std::string png_scale(const Layout& layout, const Solid& solid) {
  return fmt::format("thickness in mm = {:.9g} + {:.9g} * value (0..65535); {}", layout.thickness - solid.highest,
                     step_mm(solid), scale_of(layout));
}

std::string wall_angle(const Solid& solid) {
  return solid.steepest_wall_deg < 90 ? fmt::format("{:.4g} degrees from the front", solid.steepest_wall_deg)
                                      : "90 degrees, as all of them";
}

/// What a ball end mill leaves.
std::string reach_of(const Layout& layout, const Solid& solid, double radius) {
  if (!solid.surface)
    return fmt::format("cannot touch {:.3g} % of the facets, whose light its fillets send elsewhere",
                       100 * unreached_part(layout, solid, radius));
  const Valley valley = tightest_valley(layout, *solid.surface);
  if (valley.radius == std::numeric_limits<double>::infinity()) return "reaches everything: there is no valley";
  return fmt::format("{}: the tightest valley has a radius of {:.4g} mm, at ({:.4g}, {:.4g}) mm from the middle",
                     valley.radius >= radius ? "reaches everything" : "is too large", valley.radius, valley.at.x,
                     valley.at.y);
}

std::string layers_of(const Solid& solid, double layer) {
  return fmt::format(
      "{:.0f} in the relief. A layer's top is flat and bends no light: polish or coat the steps away, or "
      "print with the front upright",
      std::ceil(solid.relief() / layer));
}

} // namespace

void write_obj(const scene::Mesh& mesh, ByteSink& to) {
  write_text("# millimetres\n", to);
  for (const glm::vec3& p : mesh.positions) write_text(fmt::format("v {} {} {}\n", p.x, p.y, p.z), to);
  for (const glm::uvec3& t : mesh.triangles) write_text(fmt::format("f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1), to);
}

// 80 bytes of title, the number of triangles, then for each its normal, its corners and two empty bytes; little-endian.
void write_stl(const scene::Mesh& mesh, ByteSink& to) {
  std::string title = mesh_title;
  title.resize(80, ' ');
  write_text(title, to);
  to.value(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    const glm::vec3 numbers[] = {glm::vec3(glm::normalize(glm::cross(b - a, c - a))), glm::vec3(a), glm::vec3(b),
                                 glm::vec3(c)};
    to.write(std::as_bytes(std::span(numbers)));
    to.value(std::uint16_t{0});
  }
}

void write_3mf(const scene::Mesh& mesh, ByteSink& to) {
  const auto text = [](const char* words) { return [words](ByteSink& part) { write_text(words, part); }; };
  const auto model = [&](ByteSink& part) {
    write_text("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
               "<model unit=\"millimeter\" xml:lang=\"en-US\" "
               "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n"
               "<metadata name=\"Application\">Nephroid</metadata>\n"
               "<resources><object id=\"1\" type=\"model\" name=\"object\"><mesh>\n<vertices>\n",
               part);
    for (const glm::vec3& p : mesh.positions)
      write_text(fmt::format("<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>\n", p.x, p.y, p.z), part);
    write_text("</vertices>\n<triangles>\n", part);
    for (const glm::uvec3& t : mesh.triangles)
      write_text(fmt::format("<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>\n", t.x, t.y, t.z), part);
    write_text("</triangles>\n</mesh></object></resources>\n<build><item objectid=\"1\"/></build>\n</model>\n", part);
  };
  const ZipEntry entries[] = {
      {"[Content_Types].xml",
       text("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
            "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
            "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>"
            "</Types>\n")},
      {"_rels/.rels",
       text("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
            "<Relationship Id=\"rel0\" Target=\"/3D/3dmodel.model\" "
            "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n")},
      {"3D/3dmodel.model", model}};
  write_zip(entries, to);
}

std::string workshop_page(const Layout& layout, const Solid& solid, const std::string& material,
                          const Manufacturing& making) {
  std::string page = "# For the workshop\n\n| what | figure |\n|---|---|\n";
  const auto row = [&](const char* what, const std::string& figure) {
    fmt::format_to(std::back_inserter(page), "| {} | {} |\n", what, figure);
  };
  const auto mm = [](double length) { return fmt::format("{:.4g} mm", length); };
  row("width x height", fmt::format("{:.6g} x {:.6g} mm", layout.size.x, layout.size.y));
  if (layout.round) row("outline", layout.size.x == layout.size.y ? "a disc" : "an ellipse");
  row("greatest thickness, of the sheet that holds it", mm(layout.thickness - solid.lowest));
  row("smallest thickness", mm(layout.thickness - solid.highest));
  row("depth of the relief", mm(solid.relief()));
  row("volume",
      fmt::format("{:.6g} cm3",
                  scene::signed_volume(solid.mesh, 0, static_cast<std::uint32_t>(solid.mesh.triangles.size())) / 1000));
  row("material", material);
  row("facets", fmt::format("{} x {}", layout.facets.x, layout.facets.y));
  row("smallest facet", fmt::format("{:.4g} x {:.4g} mm, as all of them{}", layout.facet().x, layout.facet().y,
                                    layout.draft > 0 ? ", less what leaning walls take" : ""));
  const char* const flat = layout.is_mirror() ? "back" : "front";
  row("steepest facet", fmt::format("{:.4g} degrees from the {}", solid.steepest_deg, flat));
  row("steepest wall", solid.wall_area > 0 ? wall_angle(solid) : "none");
  row("highest wall", mm(solid.highest_wall));
  row("area of the walls between facets", fmt::format("{:.4g} mm2", solid.wall_area));
  if (making.tool_radius)
    row(fmt::format("a ball of {:.4g} mm radius", *making.tool_radius).c_str(),
        reach_of(layout, solid, *making.tool_radius));
  if (making.layer)
    row(fmt::format("layers of {:.4g} mm along the {}", *making.layer, flat).c_str(), layers_of(solid, *making.layer));
  page += fmt::format("\n{}. {} on the other side{}.\n\n",
                      layout.is_mirror() ? "The back is flat" : "The front is flat and the light's way in",
                      solid.wall_area > 0 ? (solid.steepest_wall_deg < 90
                                                 ? "The facets, with walls between them that lean, are"
                                                 : "The facets, with walls between them that stand straight up, are")
                                          : "The relief is",
                      layout.is_mirror() ? ", which is the mirror" : "");
  fmt::format_to(std::back_inserter(page),
                 "- `object.stl`, `object.3mf`, `object.obj`, `object.ply`: the closed solid in millimetres, the {} at "
                 "the top (+z).\n"
                 "- `facets.json`: a line a facet",
                 flat);
  page += layout.draft > 0 ? ", as if walls stood upright.\n" : ".\n";
  fmt::format_to(std::back_inserter(page), "- `heights.exr`: thickness in mm; {}.\n- `heights.png`: {}.\n",
                 scale_of(layout), png_scale(layout, solid));
  return page;
}

void write_facets(const Layout& layout, const Solid& solid, ByteSink& to) {
  const glm::dvec2 facet = layout.facet();
  write_text(
      fmt::format("{{\"columns\": {}, \"rows\": {}, \"facet_mm\": [{}, {}],\n"
                  " \"order\": \"row by row from the top, from -x to +x\",\n"
                  " \"normal\": \"(dz_dx, dz_dy, -1), not of unit length: out of the object\",\n"
                  " \"numbers\": [\"slope_x\", \"slope_y\", \"dz_dx\", \"dz_dy\", \"middle_z_mm\"],\n \"facets\": [",
                  layout.facets.x, layout.facets.y, facet.x, facet.y),
      to);
  for (const Facet& f : solid.facets)
    write_text(fmt::format("{}[{:.7g},{:.7g},{:.7g},{:.7g},{:.7g}]", &f == solid.facets.data() ? "\n" : ",\n",
                           f.slope.x, f.slope.y, f.gradient.x, f.gradient.y, f.height),
               to);
  write_text("\n ]}\n", to);
}

image::Image height_map(const Layout& layout, const Solid& solid) {
  const glm::ivec2 pixels = pixels_of(layout);
  image::Image map{pixels.x, pixels.y, {"Y"}, {}, {}, false};
  map.data.reserve(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
  for (int y = 0; y < map.height; ++y)
    for (int x = map.width - 1; x >= 0; --x) {
      const glm::dvec2 p = Layout::middle_of(index_at(x, y, map.width), pixels, layout.size);
      if (layout.is_beside(p)) {
        map.data.push_back(0);
        continue;
      }
      const std::size_t facet = facet_at(layout, p);
      const Facet& f = solid.facets[facet];
      const double z =
          solid.surface ? solid.surface->at(p).z : f.height + glm::dot(f.gradient, p - layout.middle(facet));
      map.data.push_back(static_cast<float>(layout.thickness - z));
    }
  map.attributes["ImageDescription"] = "thickness in mm; " + scale_of(layout);
  return map;
}

void write_height_exr(const Layout& layout, const Solid& solid, ByteSink& to) {
  image::write_exr(to, height_map(layout, solid));
}

void write_height_png(const Layout& layout, const Solid& solid, ByteSink& to) {
  const image::Image map = height_map(layout, solid);
  const double deepest = layout.thickness - solid.highest, step = step_mm(solid);
  std::vector<std::uint16_t> grey;
  grey.reserve(map.data.size());
  for (const float thickness : map.data)
    grey.push_back(
        static_cast<std::uint16_t>(step > 0 ? std::clamp(std::round((thickness - deepest) / step), 0.0, 65535.0) : 0));
  image::write_png16(to, map.width, map.height, grey, png_scale(layout, solid));
}

} // namespace nephroid::inverse
