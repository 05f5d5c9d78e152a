// SPDX-License-Identifier: Apache-2.0
#include "ui/state/document.h"

#include "base/error.h"
#include "base/files.h"
#include "engine/engine.h"
#include "preset/animation.h"
#include "preset/change_engine.h"
#include "preset/settings_type.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace nephroid::ui {
namespace {

/// The preset with a map as its environment, as bright and as turned as the one before. The run finds out whether the
/// map can be read.
preset::Preset surrounded(preset::Preset preset, const std::string& map) {
  std::error_code ignored;
  preset::Environment environment;
  if (const auto& before = preset.scene.environment) {
    environment.radiance = before->radiance;
    environment.rotate_deg = before->rotate_deg;
    environment.lights = before->lights;
  }
  environment.file = std::filesystem::absolute(map, ignored).string();
  preset.scene.environment = environment;
  return preset;
}

} // namespace

void Document::open(UndoStack edits) {
  edits_.emplace(std::move(edits));
  run_.start(*edits_);
}

void Document::close() {
  edits_.reset();
  run_.forget();
  view_state_.view_settings = ViewSettings{};
  view_state_.region.reset();
  view_state_.lines.clear();
  view_state_.selection = {};
  carry_out(command::InspectPixel{});
  services_.tasks.forget(meshes_);
}

bool Document::take_over(preset::WithSweep read) {
  const std::string source = edits_->current().source;
  const bool is_other_run = read.preset != *edits_->in_file();
  if (!is_other_run && read.sweep == edits_->sweep()) return false; // as after a save by this window
  edits_->push("reload " + std::filesystem::path(source).filename().string(), std::move(read.preset),
               std::move(read.sweep));
  edits_->mark_saved(source);
  if (is_other_run) run_.follow_edit(*edits_);
  return true;
}

void Document::take_picture(const std::string& file) {
  if (!is_there(file)) throw bad_input(file, "there is no such picture");
  preset::Preset edited = edits_->current();
  engine::PictureEdit taken = engine::engine_of(edited).take_picture(edited, file);
  edit({std::move(taken.edit), std::move(edited)});
  services_.messages.note(std::move(taken.note));
}

bool Document::take_texture(const std::string& file) {
  if (view_state_.selection.kind != Selection::Kind::object) return false;
  preset::Preset edited = edits_->current();
  if (view_state_.selection.index >= edited.scene.objects.size()) return false;
  const preset::Object& object = edited.scene.objects[view_state_.selection.index];
  if (object.shape && object.shape->type == preset::Shape::Type::sphere) return false; // which has no u, v
  const std::string name = object.material;
  const auto material = edited.scene.materials.find(name);
  if (material == edited.scene.materials.end() || !is_matt(material->second.type)) return false;
  if (!is_there(file)) throw bad_input(file, "there is no such picture");
  preset::Texture texture = material->second.texture.value_or(preset::Texture());
  texture.type = preset::Texture::Type::file;
  texture.file = std::filesystem::absolute(file).string();
  material->second.texture = texture;
  const std::string picture = std::filesystem::path(file).filename().string();
  edit({"texture " + picture, std::move(edited)});
  services_.messages.note(fmt::format("{} is the texture of the material '{}'", picture, name));
  return true;
}

void Document::read_mesh(const std::filesystem::path& file) {
  services_.tasks.start(
      meshes_, {"reading " + file.string(), TaskKind::request}, [file] { return read_dropped_mesh(file); },
      [this](const DroppedMesh& mesh) { add_object(mesh); });
}

void Document::add_object(const DroppedMesh& mesh) {
  if (!edits_) return;
  WithMesh with_it = with_mesh(edits_->current(), mesh);
  const std::size_t index = with_it.preset.scene.objects.size() - 1;
  edit({"add " + mesh.file.filename().string(), std::move(with_it.preset)});
  carry_out(command::Select{{Selection::Kind::object, index}});
  services_.messages.note(with_it.note);
}

void Document::update() {
  const auto white = run_.fitted_white();
  if (!white || !edits_ || edits_->current().white) return;
  edits_->fit_white(*white);
  if (preset::has_white(edits_->current()))
    services_.messages.note(fmt::format("white {} fits the first picture", *white));
}

void Document::carry_out(const command::Edit& c) {
  try {
    edit(c);
  } catch (const std::exception& error) {
    services_.messages.error(error);
    refused_edit_ = services_.messages.newest();
  }
}

namespace {

/// Whether things came or went, or the surroundings are of another type.
bool has_other_things(const preset::Scene& a, const preset::Scene& b) {
  const auto type = [](const preset::Scene& scene) {
    return scene.environment ? std::optional(scene.environment->type) : std::nullopt;
  };
  return a.objects.size() != b.objects.size() || a.lights.size() != b.lights.size() || type(a) != type(b);
}

} // namespace

/// Throws bad_input where the preset could not be read again: a number is out of its range, wherever it came from, or
/// two fields contradict each other.
void Document::edit(const command::Edit& c) {
  if (!edits_) return;
  services_.messages.dismiss(refused_edit_); // a drag of the mouse makes a new one at every move
  preset::Preset edited = c.preset;
  edited.provenance = {}; // errors from now on are about what was typed here, not about the file or an option
  std::string label = c.label;
  if (!c.was_read) {
    if (const preset::Preset& now = edits_->current(); now.animation && edited.animation == now.animation) {
      edited = preset::read_json(
          preset::with_keys(preset::as_json(now), preset::as_json(edited), edits_->frame(), edited.source),
          edited.source);
      edited.provenance = {};
      const std::vector<preset::Track>&tracks = edited.animation->tracks, &before = now.animation->tracks;
      const bool same_fields = std::ranges::equal(tracks, before, {}, &preset::Track::path, &preset::Track::path);
      if (same_fields && tracks != before) label += fmt::format(", a key at frame {}", edits_->frame());
    } else
      preset::with_overrides(edited, {});
  }
  if (edited.settings.engine() != edits_->current().settings.engine()) note_left_out(edited.settings.engine());
  if (edits_->has_fitted_white() && edited.white == edits_->current().white &&
      has_other_things(edited.scene, edits_->current().scene))
    edited.white.reset(); // it fitted another picture
  edits_->push(std::move(label), std::move(edited), c.gesture);
  run_.follow_edit(*edits_, c.live);
}

/// Makes a note of what is lost when the engine changes.
void Document::note_left_out(std::string_view engine) {
  auto json = preset::as_json(edits_->current());
  if (const auto keys = preset::take_foreign(json, engine); !keys.empty())
    services_.messages.note(preset::left_out_note(engine, keys) + " (Undo brings it back)");
}

void Document::carry_out(const command::SetSweep& c) {
  if (!edits_ || c.sweep == edits_->sweep()) return;
  edits_->push(c.label, *edits_->in_file(), c.sweep);
}

/// Undoes or redoes. The run follows, unless only the sweep changed.
void Document::step(bool (UndoStack::*by)()) {
  if (!edits_) return;
  const preset::Preset before = edits_->current();
  if ((*edits_.*by)() && before != edits_->current()) run_.adopt_or_start(*edits_);
}

/// Throws bad_input where the preset cannot be in this frame.
void Document::carry_out(const command::ShowFrame& c) {
  if (!edits_ || !edits_->in_file()->animation) return;
  const int frame = std::clamp(c.frame, 0, edits_->in_file()->animation->frames - 1);
  if (frame == edits_->frame()) return;
  preset::at_frame(*edits_->in_file(), frame);
  const preset::Preset before = edits_->current();
  edits_->show(frame);
  if (before != edits_->current()) run_.follow_edit(*edits_, c.live);
}

void Document::carry_out(const command::Restart&) {
  if (edits_) run_.start(*edits_);
}

void Document::carry_out(const command::Select& c) {
  view_state_.selection = in_preset(c.selection, preset());
  view_state_.nudged.at_s = command::Nudged{}.at_s; // another selection is another entry to undo
}

void Document::carry_out(const command::InspectPixel& c) {
  view_state_.pixel = c.pixel;
  if (c.pixel) view_state_.selection = {}; // the arrow keys now move the pixel
  run_.watch_spectrum(c.pixel);
}

/// Throws bad_input where the file does not exist or is no map: the dialog stays open then.
void Document::carry_out(const command::OpenMap& c) {
  if (!edits_) return;
  if (kind_of(c.file) != FileKind::map)
    throw bad_input(c.file, "is no map of an environment", "expected a file .hdr or .exr");
  if (!is_there(c.file)) throw bad_input(c.file, "there is no such file");
  const std::string name = std::filesystem::path(c.file).filename().string();
  edit({"surround with " + name, surrounded(edits_->current(), c.file)});
  services_.messages.note(name + " is the environment");
  services_.follow_ups.push_back(command::Ask{});
}

/// Throws bad_input where the file does not exist or is no mesh: the dialog stays open then.
void Document::carry_out(const command::AddMesh& c) {
  if (!edits_) return;
  if (kind_of(c.file) != FileKind::mesh) throw bad_input(c.file, "is no mesh", "expected a file .obj, .ply or .stl");
  if (!is_there(c.file)) throw bad_input(c.file, "there is no such file");
  read_mesh(c.file);
  services_.follow_ups.push_back(command::Ask{});
}

void Document::carry_out(const command::LoadDispersion& c) {
  if (!edits_)
    throw bad_input(c.file, "is dispersion data, and no preset is open", {}, "open a preset with glass, then load it");
  preset::Preset edited = edits_->current();
  const std::string material = shown_dielectric(edited, view_state_.material);
  if (material.empty())
    throw bad_input(c.file, "is dispersion data, and this preset has no dielectric",
                    "expected a material of type \"dielectric\"");
  edited.scene.materials.at(material).dispersion = load_dispersion(c.file, edited.source);
  const std::string name = std::filesystem::path(c.file).stem().string();
  edit({"load " + name + " into " + material, std::move(edited)});
  services_.messages.note("loaded " + name + " into the material '" + material + "'");
}

} // namespace nephroid::ui
