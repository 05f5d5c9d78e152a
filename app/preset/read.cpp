// SPDX-License-Identifier: Apache-2.0
#include "preset/read.h"

#include "base/error.h"
#include "preset/animation.h"
#include "preset/document.h"
#include "preset/origins.h"
#include "preset/sweep.h"
#include "preset/walks.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::preset {
namespace {

/// The preset's own name, or else its file's.
std::string base_name(const Document& document)
{
  const auto own = document.value().find("name");
  const bool is_named = own != document.value().end() && own->is_string();
  return is_named ? own->get<std::string>() : std::filesystem::path(document.origins().main().place.name).stem().string();
}

Preset finish(const SweptDocument& run)
{
  const Document& document = run.document;
  const std::string name = base_name(document) + run.suffix;
  const Provenance provenance{std::make_shared<const Origins>(document.origins()), run.suffix.empty() ? std::string() : name, std::nullopt};
  Preset unread;
  unread.provenance = provenance;
  return at_origins(unread, [&] {
    Preset preset;
    read(document, preset);
    preset.name = name;
    preset.source = document.origins().main().place.name;
    preset.provenance = provenance;
    if (preset.animation) preset = at_start(preset);
    check(preset, [&](const std::string& pointer) { return preset.provenance.origins->where(pointer); });
    return preset;
  });
}

std::vector<SweptDocument> runs_of(Document document, const Overrides& overrides)
{
  for (const std::string& text : overrides) apply_override(document, text);
  return expand_sweep(std::move(document), overrides);
}

const SweptDocument& only(const std::vector<SweptDocument>& runs)
{
  if (runs.size() != 1)
    throw bad_input(runs.front().document.origins().main().place / "sweep", fmt::format("gives {} runs", runs.size()),
                    "one preset is wanted here", "fix the swept keys by --set, or --set sweep=null");
  return runs.front();
}

Document load(const std::string& name) { return load_document(find_preset(name, {}, "preset")); }

WithSweep with_sweep(Document document, const Overrides& overrides)
{
  for (const std::string& text : overrides) apply_override(document, text);
  const Document whole = document;
  Sweep sweep = take_sweep(document, overrides);
  try {
    return {finish({std::move(document), ""}), sweep};
  } catch (const Error&) {
    if (sweep.empty()) throw;
  }
  return {finish({first_run(whole, overrides), ""}), std::move(sweep)};
}

} // namespace

std::vector<Preset> read_presets(const std::string& name, const Overrides& overrides)
{
  std::vector<Preset> presets;
  for (const SweptDocument& run : runs_of(load(name), overrides)) presets.push_back(finish(run));
  return presets;
}

Preset read_preset(const std::string& name, const Overrides& overrides) { return finish(only(runs_of(load(name), overrides))); }

Preset parse_preset(const std::string& json, const std::string& source, const Overrides& overrides)
{
  return finish(only(runs_of(parse_document(json, source), overrides)));
}

WithSweep read_with_sweep(const std::string& name, const Overrides& overrides) { return with_sweep(load(name), overrides); }

WithSweep parse_with_sweep(const std::string& json, const std::string& source) { return with_sweep(parse_document(json, source), {}); }

Preset parse_first_run(const std::string& json, const std::string& source)
{
  return finish({first_run(parse_document(json, source), {}), ""});
}

std::vector<SweptRun> swept_runs(const Preset& preset, const Sweep& sweep)
{
  Document document = parse_document(to_json(preset), preset.source);
  const Origin origin{Place(preset.source), true, std::filesystem::path(preset.source).parent_path()};
  for (const SweptField& field : sweep)
    if (std::ranges::count(sweep, field.key, &SweptField::key) > 1)
      throw bad_input(Place(preset.source) / "sweep", in_quotes(field.key) + " is swept twice");
  document.set({"sweep"}, to_json(sweep), origin);
  std::vector<SweptRun> runs;
  for (const SweptDocument& run : expand_sweep(std::move(document), {})) {
    SweptRun& swept = runs.emplace_back(SweptRun{base_name(run.document) + run.suffix, std::nullopt, {}});
    try {
      swept.preset = finish(run);
    } catch (const Error& error) {
      swept.why_not = error.line();
    }
  }
  return runs;
}

} // namespace nephroid::preset
