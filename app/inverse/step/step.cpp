// SPDX-License-Identifier: Apache-2.0
#include "inverse/step/step.h"

#include "base/files.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <dlfcn.h>
#include <filesystem>
#include <unistd.h>

namespace nephroid::inverse {
namespace {

namespace fs = std::filesystem;

constexpr const char* step_remedy = "install the package nephroid-workshop, or build with OpenCascade";

const StepModule* load_step() {
  const fs::path file = library_file(step_module_name);
  void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) throw failed(file.string(), fmt::format("cannot be loaded: {}", ::dlerror()), {}, step_remedy);
  return reinterpret_cast<const StepModule* (*)()>(::dlsym(library, step_module_symbol))();
}

/// Loaded at the first call and kept.
const StepModule& step_module() {
  static const StepModule* const loaded = load_step();
  return *loaded;
}

/// OpenCascade 7.6 writes files by their names alone.
class StepScratch {
public:
  StepScratch() {
    std::error_code error;
    path_ = (fs::temp_directory_path(error) / "nephroid-step-XXXXXX").string();
    const int descriptor = ::mkstemp(path_.data());
    if (descriptor < 0)
      throw failed(path_, "cannot be made", "OpenCascade writes there first", "choose another folder by TMPDIR");
    ::close(descriptor);
  }
  ~StepScratch() {
    std::error_code error;
    fs::remove(path_, error);
  }
  StepScratch(const StepScratch&) = delete;
  StepScratch& operator=(const StepScratch&) = delete;
  const std::string& path() const { return path_; }

private:
  std::string path_;
};

StepSolid spline_of(const Layout& layout, const Surface& surface) {
  StepSolid solid;
  const Grid& bells = surface.bells();
  solid.spline = {.size = layout.size,
                  .columns = static_cast<int>(bells.cols()) - 3,
                  .rows = static_cast<int>(bells.rows()) - 3,
                  .heights = {bells.data(), bells.data() + bells.size()},
                  .round = layout.round,
                  .front = layout.thickness};
  return solid;
}

/// The integral of the thickness over a round lens, whose mesh has a polygon's outline: by the middles of rings and of
/// parts of a turn.
double round_volume(const Layout& layout, const Surface& surface) {
  const int rings = 4 * std::max(layout.facets.x, layout.facets.y), parts = 4 * rings;
  double sum = 0;
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < parts; ++k) {
      const double r = (i + 0.5) / rings, angle = 2 * glm::pi<double>() * (k + 0.5) / parts;
      const glm::dvec2 p = r * layout.size / 2.0 * glm::dvec2(std::cos(angle), std::sin(angle));
      sum += r * (layout.thickness - surface.at(p).z);
    }
  return sum * glm::pi<double>() / 2 * layout.size.x * layout.size.y / rings / parts;
}

double volume_of_solid(const Layout& layout, const Solid& solid) {
  if (layout.round) return round_volume(layout, *solid.surface);
  return scene::signed_volume(solid.mesh, 0, static_cast<std::uint32_t>(solid.mesh.triangles.size()));
}

} // namespace

void require_step(const Location& where) {
  try {
    step_module();
  } catch (const Error& error) {
    throw bad_input(where,
                    fmt::format("asks for a STEP file, and the module that writes it is not there: {}", error.what()),
                    "expected none", step_remedy);
  }
}

StepFile step_file(const Layout& layout, const Solid& solid, const std::string& name) {
  StepSolid of = solid.surface ? spline_of(layout, *solid.surface) : step_faces(layout, solid);
  of.name = name;
  const StepScratch scratch;
  try {
    step_module().write(of, scratch.path());
    const auto [faces, volume] = step_module().read(scratch.path());
    const double wanted = volume_of_solid(layout, solid);
    if (!(std::abs(volume / wanted - 1) <= step_volume_error))
      throw failed("object.step", fmt::format("has a volume of {:.9g} mm3 as OpenCascade reads it back", volume),
                   fmt::format("expected that of the object, {:.9g} mm3", wanted),
                   "take the STL, and report this with the preset");
    return {read_file(scratch.path()), faces, volume};
  } catch (const StepRefused& refused) {
    throw failed("object.step", "OpenCascade: " + refused.reason, {}, "take \"step\" away, or choose fewer facets");
  }
}

} // namespace nephroid::inverse
