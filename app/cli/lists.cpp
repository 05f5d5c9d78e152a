// SPDX-License-Identifier: Apache-2.0
// The verbs that list what there is and render nothing: presets, devices, schema, version.
#include "base/build_info.h"
#include "base/counted.h"
#include "base/json_output.h"
#include "cli/verb.h"
#include "compute/compute.h"
#include "preset/read.h"

#include <CLI/Version.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace nephroid::cli {
namespace {

using Json = nlohmann::ordered_json;

void print_presets(bool json) {
  const std::vector<preset::ShippedPreset> presets = preset::shipped_presets();
  if (json) {
    Json list = Json::array();
    for (const preset::ShippedPreset& p : presets)
      list.push_back({{"name", p.name}, {"description", p.description}, {"file", p.file.string()}});
    fmt::print("{}\n", json_text(list));
    return;
  }
  std::size_t width = 0;
  for (const preset::ShippedPreset& p : presets) width = std::max(width, p.name.size());
  for (const preset::ShippedPreset& p : presets) fmt::print("{:{}}  {}\n", p.name, width, p.description);
}

Json to_json(const compute::DeviceInfo& device) {
  return {{"index", device.index},
          {"name", device.name},
          {"type", device.type},
          {"platform", device.platform},
          {"driver", device.driver},
          {"version", device.version},
          {"compute_units", device.compute_units},
          {"memory_bytes", device.memory_bytes},
          {"max_buffer_bytes", device.max_buffer_bytes},
          {"max_group_items", device.max_group_items},
          {"fp64", device.fp64},
          {"int64_atomics", device.int64_atomics}};
}

void print_devices(bool json) {
  if (const std::string note = compute::prepare_kernel_cache(); !note.empty())
    fmt::print(stderr, "nephroid: {}\n", note);
  const std::vector<compute::DeviceInfo> devices = compute::list_devices();
  if (devices.empty()) throw compute::no_device_error();
  if (json) {
    Json list = Json::array();
    for (const compute::DeviceInfo& device : devices) list.push_back(to_json(device));
    fmt::print("{}\n", json_text(Json{{"devices", list}}));
    return;
  }
  for (const compute::DeviceInfo& device : devices) fmt::print("{}\n", device_line(device));
}

std::string dotted(int major, int minor, int patch) { return fmt::format("{}.{}.{}", major, minor, patch); }

/// Versions of libraries that are compiled in as headers. The others' versions are those of their packages.
std::map<std::string, std::string> libraries() {
  return {
      {"CLI11", CLI11_VERSION},
      {"fmt", dotted(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"nlohmann-json", dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)}};
}

void print_version(bool json) {
  const std::map<std::string, std::string> used = libraries();
  if (json) {
    const Json all{{"version", version()}, {"commit", commit()}, {"compiler", compiler()}, {"libraries", used}};
    fmt::print("{}\n", json_text(all));
    return;
  }
  fmt::print("{}\n{}\n", program_name(), compiler());
  for (const auto& [name, number] : used) fmt::print("{} {}\n", name, number);
}

/// Adds a verb whose only option is --json; `json` is its help.
void list_verb(Verb&& verb, const char* json, void (*print)(bool json)) {
  const auto as_json = std::make_shared<bool>(false);
  verb.flag("--json", *as_json, json);
  verb.work([as_json, print] { print(*as_json); });
}

} // namespace

std::string device_line(const compute::DeviceInfo& device) {
  return fmt::format("{}  {}  ({}, {}, {:.1f} GB, {} {}{}{})", device.index, device.name, device.type,
                     counted(device.compute_units, "compute unit"), static_cast<double>(device.memory_bytes) * 1e-9,
                     device.platform, device.driver, device.fp64 ? "" : ", no fp64",
                     device.int64_atomics ? "" : ", no 64-bit atomics");
}

void add_presets(CLI::App& program, Session&) {
  list_verb({program,
             "presets",
             "The shipped presets, with a line each",
             {{"nephroid presets", "their names; `nephroid run NAME` renders one"},
              {"nephroid presets --json", "with the file of each"}}},
            "A list of {\"name\",\"description\",\"file\"}", print_presets);
}

void add_devices(CLI::App& program, Session&) {
  list_verb({program, "devices", "The OpenCL devices that --device chooses from", {{"nephroid devices", ""}}},
            "One object: {\"devices\":[{\"index\",\"name\",\"type\",...}]}", print_devices);
}

void add_schema(CLI::App& program, Session&) {
  Verb verb(
      program, "schema", "The JSON Schema of preset files, for editors",
      {{"nephroid schema > schema.json", "name it as \"$schema\" in a preset, and an editor completes its keys"}});
  verb.work([] { fmt::print("{}\n", preset::schema()); });
}

void add_version(CLI::App& program, Session&) {
  list_verb({program, "version", "The program's version, commit, compiler and libraries", {{"nephroid version", ""}}},
            "One JSON object", print_version);
}

} // namespace nephroid::cli
