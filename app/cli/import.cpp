// SPDX-License-Identifier: Apache-2.0
// `nephroid import`: a glTF, Mitsuba or PBRT scene or a stone of GemCad as a preset.
#include "formats/import/import.h"
#include "base/files.h"
#include "cli/progress.h"
#include "cli/verb.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>

namespace nephroid::cli {
namespace fs = std::filesystem;
namespace {

struct ImportOptions {
  fs::path file, output;
  bool replace = false;
};

/// What is done: a live line on a terminal, else a line every few seconds.
class ProgressLines {
public:
  void tell(const std::string& doing) {
    if (progress_style(false) == ProgressStyle::live) return line_.show(doing);
    constexpr auto between = std::chrono::seconds(3);
    if (std::chrono::steady_clock::now() < last_ + between) return;
    last_ = std::chrono::steady_clock::now();
    fmt::print(stderr, "{}\n", doing);
  }

private:
  LiveLine line_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

void import_scene(const ImportOptions& options) {
  const fs::path preset =
      options.output.empty() ? fs::path(options.file.filename()).replace_extension(".json") : options.output;
  if (!options.replace && is_there(preset))
    throw bad_input(preset.string(), "is there already", {}, "choose another file with -o, or --replace it");
  const formats::Imported imported = [&] {
    ProgressLines progress;
    return formats::import_scene(options.file, preset, {{}, [&](const std::string& doing) { progress.tell(doing); }});
  }();
  for (const std::string& note : imported.notes) fmt::print(stderr, "note: {}\n", note);
  fmt::print(stderr, "{}\n", imported.counts());
  fmt::print("{}\n", imported.preset.string());
}

} // namespace

void add_import(CLI::App& program, Session&) {
  const auto options = std::make_shared<ImportOptions>();
  Verb verb(program, "import",
            "A preset from a glTF, Mitsuba or PBRT scene or a stone of GemCad: meshes, camera, lights, materials",
            {{"nephroid import scene.gltf", "writes scene.json"}, {"nephroid run scene.json --seconds 10", ""}},
            "Takes .gltf, .glb, .xml of Mitsuba, .pbrt and .asc of GemCad. Meshes become PLY files in a folder beside "
            "the preset. What has no counterpart is left out and said\n"
            "on standard error. Standard output has the preset's file: nephroid run takes it.");
  verb.option("FILE", options->file, {.says = "The scene", .required = true});
  verb.option("-o,--output", options->output,
              {.type = "PRESET", .says = "The preset; without it FILE's name with .json, in the current folder"});
  verb.flag("--replace", options->replace, "Write over a preset that is there");
  verb.work([options] { import_scene(*options); });
}

} // namespace nephroid::cli
