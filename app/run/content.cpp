// SPDX-License-Identifier: Apache-2.0
#include "run/content.h"

#include "base/hashed_bytes.h"
#include "engine/engine.h"
#include "preset/read.h"
#include "scatter/spectra.h"
#include "scene/mesh.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace nephroid::run {
namespace fs = std::filesystem;
namespace {

std::uint64_t hash_of_file(const fs::path& file) {
  PieceHash hash;
  if (!scene::has_further_files(file)) {
    const std::unique_ptr<ByteSource> source = open_file(file);
    HashedSource bytes(*source, file);
    read_to_end(bytes);
    return bytes.hash();
  }
  const std::shared_ptr<const scene::Mesh> mesh = scene::load_mesh_once(file);
  hash.add(std::as_bytes(std::span(mesh->positions)));
  hash.add(std::as_bytes(std::span(&mesh->middle, 1)));
  hash.add(std::as_bytes(std::span(mesh->normals)));
  hash.add(std::as_bytes(std::span(mesh->triangles)));
  return hash.value();
}

std::string content_of(const std::string& name, const FileFinder& finder) {
  try {
    return fmt::format("{:016x}", hash_of_file(scatter::find_dispersion(name, finder, {})));
  } catch (const Error&) {
    return {}; // whoever needs the file will say so
  }
}

const plan::Input* find_input(const std::vector<plan::Input>& inputs, const std::string& file) {
  const auto found = std::ranges::find(inputs, file, &plan::Input::file);
  return found == inputs.end() ? nullptr : &*found;
}

/// The preset without what changes no sum.
preset::Preset settings_only(preset::Preset preset) {
  preset.name = preset.description = preset.source = "";
  preset.display = {};
  preset.stop = {};
  preset.reference = {};
  preset.animation.reset(); // its fields are in their places
  preset.measure.perceptual = false;
  preset.measure.mask.reset();
  return preset;
}

} // namespace

std::vector<plan::Input> read_inputs(const preset::Preset& preset, const std::vector<plan::Input>& known) {
  const FileFinder finder(fs::path(preset.source).parent_path());
  std::vector<plan::Input> inputs;
  preset::with_file_names(preset, [&](const std::string& name) {
    if (find_input(inputs, name)) return name;
    const plan::Input* const before = find_input(known, name);
    inputs.push_back({name, before ? before->content : content_of(name, finder)});
    return name;
  });
  return inputs;
}

std::string changed_input(const std::vector<plan::Input>& before, const std::vector<plan::Input>& now) {
  for (const plan::Input& input : now) {
    const plan::Input* then = find_input(before, input.file);
    for (auto other = before.begin(); !then && other != before.end(); ++other) // elsewhere it has its whole path
      if (other->file.ends_with("/" + input.file) || input.file.ends_with("/" + other->file)) then = &*other;
    if (then && then->content != input.content)
      return fmt::format("the file '{}' {} since the run began", input.file,
                         input.content.empty() ? "is gone" : "has changed");
  }
  return {};
}

std::string changed_input(const fs::path& folder, const std::vector<plan::Input>& now) {
  try {
    return changed_input(plan::inputs_of(read_file(folder / "plan.json")), now);
  } catch (const Error&) {
    return {};
  }
}

std::uint64_t content_hash(const preset::Preset& preset, const std::vector<plan::Input>& inputs) {
  const preset::Preset settings = preset::with_file_names(settings_only(preset), [&](const std::string& name) {
    const plan::Input* const input = find_input(inputs, name);
    return input ? input->content : name;
  });
  return hash_of(fmt::format("{} {}", engine::engine_of(preset).state_version, preset::to_json(settings)));
}

} // namespace nephroid::run
