// SPDX-License-Identifier: Apache-2.0
#include "ui/view/look_bar.h"

#include "measure/difference.h"
#include "ui/view/colour_scale.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <cmath>
#include <vector>

namespace nephroid::ui {
namespace {

struct NamedTone {
  ToneCurve curve;
  const char *name, *help;
};
constexpr std::array tones{
    NamedTone{ToneCurve::standard, "as image.png", "sRGB, clipped at 1: the bytes of image.png"},
    NamedTone{ToneCurve::filmic, "filmic", "For a wide range: a soft shoulder up to 5.6 times white (Hable 2010), then sRGB"},
    NamedTone{ToneCurve::false_colour, "false colour",
              "The luminance as a colour, on a logarithmic scale in W/m2/sr. Exposure plays no part."},
};

void draw_layer_choice(const Context& context, WidgetPlaces& places)
{
  const std::string& chosen = context.comparing.comparison().layer;
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 8);
  if (!ImGui::BeginCombo("##layer", chosen.empty() ? "all" : chosen.c_str())) return places.note("layer");
  if (ImGui::Selectable("all", chosen.empty())) context.push(command::ShowLayer{});
  if (const auto& snapshot = context.run.snapshot())
    for (const job::Layer& layer : snapshot->picture->layers) {
      if (ImGui::Selectable(layer.name.c_str(), chosen == layer.name)) context.push(command::ShowLayer{layer.name});
      places.note("layer " + layer.name);
    }
  ImGui::EndCombo();
}

void draw_tone_choice(const Context& context, WidgetPlaces& places)
{
  Look look = context.look();
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 8);
  if (!ImGui::BeginCombo("##tone", tone_name(look.tone))) return places.note("tone");
  for (const NamedTone& tone : tones) {
    if (ImGui::Selectable(tone.name, tone.curve == look.tone)) {
      look.tone = tone.curve;
      context.push(command::SetLook{look});
    }
    places.note("tone " + std::string(tone.name));
    ImGui::SetItemTooltip("%s", tone.help);
  }
  ImGui::EndCombo();
}

void draw_range_choice(const Context& context, const LuminanceRange& shown, WidgetPlaces& places)
{
  const auto set = [&](const std::optional<LuminanceRange>& range) {
    Look look = context.look();
    look.false_colour = range;
    context.push(command::SetLook{look});
  };
  bool automatic = !context.chosen.look.false_colour;
  if (ImGui::Checkbox("Auto range", &automatic)) set(automatic ? std::nullopt : std::optional(shown));
  places.note("auto range");
  ImGui::SetItemTooltip("From where 1 %% of the pixels are below to where 99.9 %% are; else as typed here.");
  LuminanceRange typed = shown;
  ImGui::BeginDisabled(automatic);
  const auto number = [&](const char* label, double& value, const char* help) {
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 5);
    ImGui::InputDouble(label, &value, 0, 0, "%.3g");
    const bool done = ImGui::IsItemDeactivatedAfterEdit();
    places.note(label + 2);
    ImGui::SetItemTooltip("%s", help);
    return done;
  };
  const bool low = number("##low", typed.low, "W/m2/sr at the foot of the colours");
  const bool high = number("##high", typed.high, "W/m2/sr at their end");
  ImGui::EndDisabled();
  if (!low && !high) return;
  if (typed.low > 0 && typed.high > typed.low && std::isfinite(typed.high))
    set(typed);
  else
    context.note("false colour: the range needs 0 < low < high");
}

} // namespace

const char* tone_name(ToneCurve curve)
{
  for (const NamedTone& tone : tones)
    if (tone.curve == curve) return tone.name;
  return "";
}

void draw_look_bar(const Context& context, const Tone& tone, WidgetPlaces& places)
{
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Layer");
  ImGui::SameLine();
  draw_layer_choice(context, places);
  ImGui::SameLine(0, ImGui::GetFontSize());
  ImGui::TextUnformatted("Tone");
  ImGui::SameLine();
  draw_tone_choice(context, places);
  if (tone.curve != ToneCurve::false_colour) return;
  const float width = ImGui::CalcTextSize("Auto range").x + 14 * ImGui::GetFontSize();
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
  draw_range_choice(context, tone.range, places);
}

void draw_luminance_scale(const LuminanceRange& range, const Canvas& canvas)
{
  const double low = std::log10(range.low), high = std::log10(range.high);
  std::vector<ScaleMark> marks{{0, fmt::format("{:.3g}", range.low)}, {1, fmt::format("{:.3g}", range.high)}};
  for (int decade = static_cast<int>(std::ceil(low)); decade <= high; ++decade) // numbers that would touch the ends are left out
    if (const double position = (decade - low) / (high - low); position > 0.06 && position < 0.94)
      marks.emplace_back(position, fmt::format("{:.3g}", std::pow(10.0, decade)));
  if (marks.size() > 12) marks.resize(2);
  const std::array keys{ScaleKey{negative_colour, "negative"}, ScaleKey{infinite_colour, "infinite"}, ScaleKey{nan_colour, "NaN"}};
  draw_scale(
      canvas, "W/m2/sr", marks, [](float position) { return measure::map_colour(static_cast<double>(position)); }, keys);
}

} // namespace nephroid::ui
