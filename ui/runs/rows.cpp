// SPDX-License-Identifier: Apache-2.0
#include "ui/runs/rows.h"

#include "base/error.h"
#include "preset/json_text.h"
#include "ui/state/run_record.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace nephroid::ui {
namespace {

constexpr std::uint32_t present_colour = 0xffe4e4e4; ///< as the line of the run in hand in the panel "Error against time"

RunRow row_of(const PinnedRun& run)
{
  RunRow row{.pin = run.id, .name = run.name, .colour = run.colour};
  row.has_picture = run.picture != nullptr;
  if (const auto& record = run.record) {
    if (!record->engine.empty()) row.engine = record->engine;
    if (record->steps) row.steps = fmt::format("{} {}{}", *record->steps, record->steps_name, record->finished ? "" : "...");
    if (record->work_seconds) row.seconds_value = *record->work_seconds;
    row.preset = record->preset;
  } else if (!run.history->rows.empty()) // a table alone has the time of its last row
    row.seconds_value = run.history->rows.back().seconds;
  if (row.seconds_value == row.seconds_value) row.seconds = fmt::format("{:.3g} s", row.seconds_value);
  if (const auto error = known_error(*run.history)) {
    row.error_value = error->value;
    row.error = fmt::format("{:.3g} {}", error->value, error->metric);
    row.error_kind = error->is_estimate ? "estimate" : "to its reference";
  }
  return row;
}

/// A value as JSON, for a row.
std::string short_value(const std::string& text)
{
  constexpr std::size_t longest = 24;
  if (text == "null") return "none";
  if (text.size() <= longest) return text;
  const preset::Json value = preset::Json::parse(text, nullptr, false);
  if (value.is_array()) return fmt::format("[{} items]", value.size());
  if (value.is_object()) return value.contains("type") && value["type"].is_string() ? value["type"].get<std::string>() + " {...}" : "{...}";
  return text.substr(0, longest) + "...";
}

std::string line_of(const preset::Difference& d)
{
  return fmt::format("{}: {} -> {}", d.path, short_value(d.before), short_value(d.after));
}

std::string all_lines(const std::vector<preset::Difference>& differences)
{
  constexpr std::size_t most = 40;
  std::string text = "From the present preset to this one:";
  for (std::size_t i = 0; i < std::min(most, differences.size()); ++i) text += '\n' + line_of(differences[i]);
  if (differences.size() > most) text += fmt::format("\n{} more", differences.size() - most);
  return text;
}

/// The present preset as one that stays.
std::shared_ptr<const preset::Preset> present_of(const Context& context)
{
  return context.edits ? context.edits->state().entries[context.edits->state().index].preset : nullptr;
}

} // namespace

std::vector<RunRow> run_rows(const Context& context)
{
  std::vector<RunRow> rows;
  if (context.run.snapshot()) {
    rows.push_back(row_of(look_at_run(context.run)));
    rows.back().name = "this run";
  } else if (context.preset()) {
    rows.push_back({.name = "this run", .engine = context.engine()});
  }
  if (!rows.empty()) rows.back().colour = present_colour;
  for (const PinnedRun& run : context.comparing.pinned().all()) rows.push_back(row_of(run));
  return rows;
}

void PresetDifferences::begin_frame()
{
  std::erase_if(known_, [](const auto& known) { return !known->used; });
  for (const auto& known : known_) known->used = false;
}

const PresetDifferences::Known& PresetDifferences::of(const RunRow& row, const Context& context)
{
  static const Known none, unknown{nullptr, nullptr, "its preset is not known", {}};
  if (!row.preset) return row.pin == 0 ? none : unknown;
  const auto present = present_of(context);
  for (const auto& known : known_)
    if (known->of == row.preset && known->present == present) {
      known->used = true;
      return *known;
    }
  Known texts{row.preset, present, {}, {}};
  if (present) try {
      const std::vector<preset::Difference> all = preset::differences(*present, *row.preset);
      texts.in_short = all.empty() ? "as the present preset" : line_of(all.front());
      if (all.size() > 1) texts.in_short += fmt::format(", {} more", all.size() - 1);
      if (!all.empty()) texts.in_full = all_lines(all);
    } catch (const Error& error) {
      texts.in_short = error.line();
    }
  return *known_.emplace_back(std::make_unique<Known>(std::move(texts)));
}

command::Edit taken(const RunRow& row, const preset::Preset& present)
{
  preset::Preset edited = preset::moved_to_file(*row.preset, present.source);
  if (row.preset->source == present.source) {
    edited.name = present.name;
    edited.description = present.description;
  }
  return {"take the preset of " + row.name, std::move(edited)};
}

} // namespace nephroid::ui
