// SPDX-License-Identifier: Apache-2.0
// `nephroid plate`: objects of several runs of engine 3 on one plate.
#include "inverse/facets/plate.h"
#include "base/files.h"
#include "cli/verb.h"
#include "inverse/facets/files.h"
#include "inverse/facets/smooth_solid.h"
#include "inverse/print_page.h"

#include <fmt/format.h>

#include <limits>

namespace nephroid::cli {
namespace fs = std::filesystem;
namespace {

struct PlateOptions {
  std::vector<fs::path> runs;
  std::array<double, 2> size{300, 200};
  double gap = 6;
  fs::path output;
};

/// The plate's width and height are those of its mesh.
inverse::PlatePart body_of(const fs::path& run, const scene::Mesh& mesh) {
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const glm::vec3& p : mesh.positions) {
    low = glm::min(low, glm::dvec2(p));
    high = glm::max(high, glm::dvec2(p));
  }
  return {run.generic_string(), high - low, {}};
}

void make_plate(const PlateOptions& options) {
  const bool obj = options.output.extension() == ".obj";
  if (!obj && options.output.extension() != ".stl")
    throw bad_input(options.output.string(), "has no ending that says how to write it", "expected a file .stl or .obj");
  std::vector<scene::Mesh> meshes;
  std::vector<inverse::PlatePart> bodies;
  std::uint64_t triangles = 0;
  double area = 0;
  for (const fs::path& run : options.runs) {
    const fs::path file = fs::is_directory(run) ? run / "object.ply" : run; // as exact as the STL file, and read faster
    if (!is_there(file))
      throw bad_input(file.string(), "is not there",
                      "expected the folder of a finished run of the engine 'inverse', or a mesh");
    const fs::path output = fs::weakly_canonical(fs::absolute(options.output)),
                   taken = fs::weakly_canonical(fs::absolute(run));
    if (output == taken || output.parent_path() == taken)
      throw bad_input(options.output.string(), "would overwrite what goes onto the plate",
                      "expected a file beside its runs and meshes");
    meshes.push_back(scene::load_mesh(file));
    for (glm::vec3& p : meshes.back().positions) p.z += static_cast<float>(meshes.back().middle.z); // x, y: by its row
    bodies.push_back(body_of(run, meshes.back()));
    triangles += meshes.back().triangles.size();
    area += bodies.back().size.x * bodies.back().size.y;
  }
  const glm::dvec2 plate(options.size[0], options.size[1]);
  if (const auto left_over = inverse::put_on_shelves(plate, options.gap, bodies)) {
    const inverse::PlatePart& body = bodies[*left_over];
    throw bad_input(body.name,
                    fmt::format("number {} of {}, {:.6g} x {:.6g} mm, finds no place on a plate of {:.6g} x {:.6g} mm "
                                "with gaps of {:.6g} mm",
                                *left_over + 1, bodies.size(), body.size.x, body.size.y, plate.x, plate.y, options.gap),
                    {}, "choose a larger --size, a smaller --gap or fewer objects");
  }
  if (!obj && inverse::stl_bytes(triangles) > inverse::most_stl_bytes)
    throw bad_input(options.output.string(),
                    fmt::format("would have {:.3g} GB", static_cast<double>(inverse::stl_bytes(triangles)) / 1e9),
                    fmt::format("expected at most {:.3g} GB", static_cast<double>(inverse::most_stl_bytes) / 1e9),
                    "choose fewer objects");
  const scene::Mesh mesh = inverse::plate_mesh(meshes, bodies);
  write_file_whole(options.output, [&](ByteSink& to) { (obj ? inverse::write_obj : inverse::write_stl)(mesh, to); });
  const fs::path page = fs::path(options.output).replace_extension(".svg");
  write_file_whole(page, inverse::plate_page(plate, bodies));
  for (const inverse::PlatePart& body : bodies)
    fmt::print("{}: {:.6g} x {:.6g} mm, its middle at ({:.6g}, {:.6g}) mm\n", body.name, body.size.x, body.size.y,
               body.middle.x, body.middle.y);
  fmt::print("{:.0f} % of the plate; {} and {}\n", 100 * area / (plate.x * plate.y), options.output.string(),
             page.string());
}

} // namespace

void add_plate(CLI::App& program, Session&) {
  const auto options = std::make_shared<PlateOptions>();
  Verb verb(program, "plate", "Objects of several runs of the engine 'inverse' on one plate",
            {{"nephroid run inverse/shapes -o out/shapes", ""},
             {"nephroid plate out/shapes out/shapes --size 300x200 -o plate.stl",
              "a mesh of both, and plate.svg, a page to print in real size"}},
            "Objects stand in rows, the highest first; none is turned. A run that is named twice stands there twice. "
            "The fronts are all at\n"
            "z = 0, and places are counted from the middle of the plate.");
  verb.option("RUN", options->runs, {.says = "Folders of finished runs, or meshes in mm", .required = true});
  verb.option("--size", options->size,
              {.type = "WxH",
               .says = "Width and height of the plate in mm: 300x200, the default",
               .separator = 'x',
               .from = 1,
               .to = 1e5});
  verb.option("--gap", options->gap,
              {.type = "MM", .says = "Between objects and at the rim, for the tool; default: 6", .from = 0, .to = 1e4});
  verb.option("-o,--output", options->output, {.type = "FILE", .says = "The mesh: .stl or .obj", .required = true});
  verb.work([options] { make_plate(*options); });
}

} // namespace nephroid::cli
