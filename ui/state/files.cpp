// SPDX-License-Identifier: Apache-2.0
#include "ui/state/files.h"

#include "base/error.h"
#include "base/files.h"
#include "base/foreign_kind.h"
#include "base/lower_case.h"
#include "engine/engine.h"
#include "image/image.h"
#include "preset/differences.h"
#include "preset/read.h"
#include "run/write_run.h"
#include "scene/mesh.h"
#include "ui/state/additions.h"
#include "ui/state/tone.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

namespace nephroid::ui {
namespace fs = std::filesystem;
namespace {

struct KnownKind {
  FileKind kind;
  std::string_view endings; ///< lower case, each followed by a space
  const char* what;
  const char* remedy; ///< {} stands for the file's name, {1} for the engines that use pictures
};

constexpr std::array kinds{
    KnownKind{FileKind::dispersion, ".yml .yaml .agf ", "is dispersion data",
              "drop it on the window once a preset with glass is open, or print it with `nephroid dispersion {}`"},
    KnownKind{FileKind::scene, ".gltf .glb .xml .pbrt .asc ", "is a scene",
              "drop it on the window, which makes a preset of it, or run `nephroid import {} -o PRESET.json`"},
    KnownKind{FileKind::mesh, ".obj .ply .stl .3ds ", "is a mesh",
              "drop it on the window once a preset with a scene is open, or name it in one as an object's \"mesh\""},
    KnownKind{FileKind::map, ".exr .hdr ", "is a picture",
              "drop it on the window once a preset is open, whose environment it becomes; a run's pictures lie beside "
              "its preset.json"},
    KnownKind{FileKind::picture, ".pfm .png .jpg .jpeg .tif .tiff ", "is a picture",
              "drop it on the window once a preset of the engine {1} is open, which takes it; a run's pictures lie "
              "beside its preset.json: open "
              "that; an environment is a .hdr or .exr"},
    KnownKind{FileKind::kernel, ".cl ", "is a kernel source", "start with --kernels and its folder"},
};

/// The engines that use pictures: "inverse".
std::string engines_for_pictures() {
  std::string names;
  for (const engine::Engine* engine : engine::engines())
    if (engine->take_picture) names += (names.empty() ? "" : " or ") + std::string(name_of(*engine));
  return names;
}

/// Returns a remark about the PNG, or nothing.
std::string write_shown(const fs::path& file, const PictureToSave& shown) {
  if (!shown.why_not.empty())
    throw failed(file.string(), "nothing to save: " + shown.why_not, "", "show the picture, then save it");
  const measure::Pixels& pixels = shown.picture.pixels;
  if (shown.map) {
    image::write_png_bytes(file, pixels.width, pixels.height, shown.map->rgba);
    return fmt::format(", a difference whose colours end at {:.3g}", shown.map->scale);
  }
  const Tone tone = tone_of(shown.view_settings, shown.display, shown.white, pixels.rgb);
  if (!tone.false_colour) {
    image::write_png(file, pixels.width, pixels.height, {pixels.rgb.begin(), pixels.rgb.end()}, tone.showing);
    return {};
  }
  std::vector<unsigned char> rgba(pixels.rgb.size() / 3 * 4);
  toned_pixels(pixels.rgb, tone, rgba);
  image::write_png_bytes(file, pixels.width, pixels.height, rgba);
  return fmt::format(", false colour of {:.3g} to {:.3g} W/m2/sr", tone.false_colour->low, tone.false_colour->high);
}

/// The kind with this ending; null: only a preset can have it.
const KnownKind* known_kind(const std::string& ending) {
  if (ending.empty()) return nullptr;
  const auto found = std::ranges::find_if(
      kinds, [&](const KnownKind& kind) { return kind.endings.find(ending + ' ') != std::string_view::npos; });
  return found == kinds.end() ? nullptr : &*found;
}

std::string beginning_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes(256, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

/// Whether the first character other than white space opens a JSON object. An empty file passes: the reader reports it.
bool may_be_object(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  char first = '{';
  in >> first;
  return first == '{';
}

constexpr double part_of_view = 0.4; ///< the new object's longest edge, as a part of what the camera sees at its target

std::string material_for(preset::Scene& scene) {
  preset::Preset of;
  of.scene = scene;
  if (std::string glass = shown_dielectric(of, {}); !glass.empty()) return glass;
  return scene.materials.empty() ? glass_of(scene) : scene.materials.begin()->first;
}

} // namespace

FileKind kind_of(const fs::path& file) {
  const KnownKind* kind = known_kind(lower_case(file.extension().string()));
  return kind ? kind->kind : FileKind::other;
}

void refuse_other_kinds(const std::string& name) {
  std::error_code ignored;
  if (!fs::is_regular_file(name, ignored)) return;
  constexpr const char* expected = "the window opens presets";
  const std::string ending = lower_case(fs::path(name).extension().string());
  if (const KnownKind* kind = known_kind(ending))
    throw bad_input(name, kind->what, expected, fmt::format(fmt::runtime(kind->remedy), name, engines_for_pictures()));
  if (ending == ".json" || may_be_object(name)) return;
  if (const ForeignKind* kind = foreign_kind(name, beginning_of(name)))
    throw bad_input(name, fmt::format("is {}, which is not read", kind->what), expected, std::string(kind->remedy));
  throw bad_input(name, "is no preset and of no kind that Nephroid knows",
                  std::string(expected) + " and scenes of other programs",
                  "see `nephroid presets` for those that are shipped");
}

fs::path save_target(const preset::Preset* preset) {
  if (!preset || preset->source.empty()) return {};
  const fs::path source = preset->source;
  std::error_code ignored;
  if (!fs::is_regular_file(source, ignored) || !preset::shipped_name(source).empty()) return {};
  return source;
}

std::string parent_to_keep(const preset::Preset& preset) {
  const std::string own = preset::own_parent(preset.source);
  return own.empty() ? preset::shipped_name(preset.source) : own;
}

std::string proposed_name(const preset::Preset* preset, const std::string& ending) {
  return (!preset || preset->source.empty() ? "untitled" : preset::stem_of(preset->source)) + ending;
}

fs::path free_name(const fs::path& path) {
  fs::path free = path;
  std::error_code ignored;
  for (int n = 2; fs::exists(fs::symlink_status(free, ignored)); ++n) free = path.string() + fmt::format("-{}", n);
  return free;
}

fs::path make_new_folder(const fs::path& path) {
  while (true) { // another process that makes a folder at the same time gets another name
    std::error_code error;
    fs::path folder = free_name(path);
    if (fs::create_directory(folder, error)) return folder;
    if (error && error != std::errc::file_exists) throw failed(folder.string(), "cannot be made: " + error.message());
  }
}

std::string save_picture(const fs::path& file, const job::Picture& picture, const PictureToSave& shown) {
  const std::string extension = lower_case(file.extension().string());
  if (extension == ".png") return "saved " + file.string() + write_shown(file, shown);
  if (extension != ".exr")
    throw bad_input(file.string(), "a picture cannot be saved as \"" + extension + "\"",
                    "expected .png (as shown) or .exr (linear, with layers)");
  image::write_exr(file, run::with_layers(picture));
  return "saved " + file.string();
}

fs::path save_files(const fs::path& folder, const job::Snapshot& of, TaskControl& control) {
  const fs::path new_folder = make_new_folder(folder);
  for (std::size_t i = 0; i < of.files.size(); ++i) {
    control.progress(static_cast<double>(i) / static_cast<double>(of.files.size()));
    write_file_whole(new_folder / of.files[i].name, of.files[i].write);
  }
  return new_folder;
}

DroppedMesh read_dropped_mesh(const std::filesystem::path& file) {
  std::error_code ignored;
  DroppedMesh dropped;
  dropped.file = std::filesystem::absolute(file, ignored);
  const scene::Mesh mesh = scene::load_mesh(dropped.file);
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner) {
      const glm::dvec3 p = mesh.middle + glm::dvec3(mesh.positions[triangle[corner]]);
      dropped.box = scene::enclosing(dropped.box, {p, p});
    }
  dropped.closed = scene::inspect(mesh).closed();
  return dropped;
}

WithMesh with_mesh(preset::Preset preset, const DroppedMesh& mesh) {
  preset::Scene& scene = preset.scene;
  preset::Object object;
  object.name = untaken_name(mesh.file.stem().string(), [&](const std::string& name) {
    return std::ranges::find(scene.objects, name, &preset::Object::name) != scene.objects.end();
  });
  object.mesh = mesh.file.string();
  object.material = material_for(scene);
  const preset::Material& material = scene.materials.at(object.material);
  const bool body = is_body(material);
  if (body && !mesh.closed && scene.damaged_meshes == preset::Scene::DamagedMeshes::refuse)
    throw bad_input(mesh.file.string(), "is not closed, so it cannot be of '" + object.material + "', a dielectric",
                    "a closed mesh, as the preset's damaged_meshes is \"refuse\"",
                    "mend it, or set damaged_meshes to \"report\"");
  const glm::dvec3 edges = mesh.box.high - mesh.box.low;
  const double longest = std::max({edges.x, edges.y, edges.z});
  const double factor = with_digits(part_of_view * view_at_target(scene.camera) / longest, 3);
  const glm::dvec3 middle = 0.5 * mesh.box.low + 0.5 * mesh.box.high, foot{middle.x, mesh.box.low.y, middle.z};
  const glm::dvec3 place = free_place(preset, factor * edges);
  const double size = factor * longest;
  object.transform.scale = {factor, factor, factor};
  object.transform.translate = rounded_place(place - factor * foot, size);
  std::string note =
      fmt::format("{} is the object '{}' of '{}', scaled by {:g} to {:.3g} {}", mesh.file.filename().string(),
                  object.name, object.material, factor, size, unit_word(preset));
  if (body && !mesh.closed) note += "; it is not closed: light that enters may never leave";
  scene.objects.push_back(std::move(object));
  preset::check(preset, [&](const std::string& pointer) { return Location(mesh.file.string(), pointer); });
  return {std::move(preset), std::move(note)};
}

} // namespace nephroid::ui
