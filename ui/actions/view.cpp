// SPDX-License-Identifier: Apache-2.0
// The menu "View": how the picture is shown.
#include "preset/choices.h"
#include "run/display.h"
#include "ui/actions/table.h"
#include "ui/inspector/pixels.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace nephroid::ui {
namespace {

template <class Change>
void change_view(C c, Change change) {
  ViewSettings view_settings = c.view_settings();
  change(view_settings);
  c.push(command::SetViewSettings{view_settings});
}

template <int half_stops>
void expose(C c) {
  change_view(c, [](ViewSettings& l) { l.exposure_stops += half_stops / 2.0; });
}

bool is_shown(C c) { return c.comparing.source() != nullptr; }

void actual_size(C c) {
  const job::Picture& picture = *c.comparing.source();
  change_view(c, [&](ViewSettings& l) {
    l.fit = false;
    l.zoom = 1;
    l.centre = {picture.width / 2.0, picture.height / 2.0};
  });
}

bool has_layers(C c) { return c.comparing.source() && !c.comparing.source()->layers.empty(); }
std::string no_layers(C c) {
  if (c.comparing.comparison().shown != 0) return c.comparing.name() + " has no layers";
  return has_picture(c) ? "this engine's picture has no layers" : "there is no picture yet";
}

/// All of the light, then each layer, and round again; back where step is -1.
template <int step>
void next_layer(C c) {
  const std::vector<job::Layer>& layers = c.comparing.source()->layers;
  const auto now = std::find_if(layers.begin(), layers.end(),
                                [&](const job::Layer& l) { return l.name == c.comparing.comparison().layer; });
  const auto count = std::ssize(layers) + 1;
  const auto next = ((now == layers.end() ? 0 : now - layers.begin() + 1) + step + count) % count;
  c.push(command::ShowLayer{next == 0 ? "" : layers[static_cast<std::size_t>(next - 1)].name});
}

void show_false_colour(C c, bool on) {
  if (c.view_settings().false_colour != on) change_view(c, [on](ViewSettings& l) { l.false_colour = on; });
}

bool has_tones(C c) { return c.preset() && run::has_display(*c.preset()); }
std::string no_tones(C c) { return c.preset() ? "this engine's pictures are shown as they are" : "no preset is open"; }
bool has_lamp(C c) { return has_tones(c) && !c.preset()->scene.lights.empty(); }
std::string no_lamp(C c) { return has_tones(c) ? "the scene has no lamp" : no_tones(c); }

void set_tone(C c, preset::Display::Tone tone) {
  show_false_colour(c, false);
  if (c.preset()->display.tone != tone)
    c.edit(fmt::format("tone {}", preset::word(tone)), [tone](preset::Preset& p) { p.display.tone = tone; });
}

constexpr std::span tones{preset::choices<preset::Display::Tone>};

template <std::size_t i>
Action tone_action(const char* name) {
  return switching({name, 0, tones[i].sentence.data(), has_tones, [](C c) { set_tone(c, tones[i].value); }, no_tones},
                   [](C c) { return has_tones(c) && c.preset()->display.tone == tones[i].value; });
}

void next_tone(C c) {
  const auto now = std::ranges::find(tones, c.preset()->display.tone, [](const auto& tone) { return tone.value; });
  set_tone(c, tones[static_cast<std::size_t>(now - tones.begin() + 1) % tones.size()].value);
}

/// Between two values of a field of the preset's `display`.
template <auto field, auto on, auto off>
Action display_action(const char* name, const char* help, bool (*can)(C), std::string (*why_not)(C)) {
  return switching(
      {name, 0, help, can,
       [name](C c) { c.edit(name, [](preset::Preset& p) { p.display.*field = p.display.*field == on ? off : on; }); },
       why_not},
      [](C c) { return has_tones(c) && c.preset()->display.*field == on; });
}

bool has_pixel(C c) { return c.view_state.pixel.has_value(); }
/// The arrow keys are those of what is selected, where something is.
bool can_step(C c) { return has_pixel(c) && c.selection() == Selection{}; }

/// The pixel in the middle of what is shown; none where one was.
void inspect(C c) {
  if (c.view_state.pixel) return c.push(command::InspectPixel{});
  const job::Picture& picture = *c.comparing.source();
  const ViewSettings view_settings = c.view_settings();
  const auto middle = [&](std::size_t i, int length) {
    return std::clamp(view_settings.fit ? length / 2 : static_cast<int>(std::clamp(view_settings.centre[i], 0.0, 1e9)),
                      0, length - 1);
  };
  c.push(command::InspectPixel{std::array{middle(0, picture.width), middle(1, picture.height)}});
}

template <int dx, int dy>
void move_pixel(C c) {
  if (!is_shown(c)) return;
  const job::Picture& picture = *c.comparing.source();
  const auto [x, y] = *c.view_state.pixel;
  c.push(command::InspectPixel{
      std::array{std::clamp(x + dx, 0, picture.width - 1), std::clamp(y + dy, 0, picture.height - 1)}});
}

std::string no_pixel(C) { return "no pixel is inspected"; }
void copy_pixel(C c) { ImGui::SetClipboardText(pixel_as_text(c, *c.view_state.pixel).c_str()); }

bool has_region(C c) { return c.view_state.region.has_value(); }

void whole_region(C c) {
  const job::Picture& picture = *c.comparing.source();
  c.push(command::SelectRegion{
      c.view_state.region ? std::nullopt : std::optional(PixelRegion{{0, 0}, {picture.width, picture.height}})});
}

} // namespace

std::vector<Action> view_actions() {
  return {
      {"Fit", ImGuiKey_F, "The whole picture in the panel", is_shown,
       [](C c) { change_view(c, [](ViewSettings& l) { l.fit = true; }); }},
      {"Actual size", shift | ImGuiKey_F, "One pixel of the picture is one of the screen", is_shown, actual_size},
      repeating({"Brighter", ImGuiKey_E, "Half a stop more exposure", always, expose<1>}),
      repeating({"Darker", shift | ImGuiKey_E, "Half a stop less exposure", always, expose<-1>}),
      {"Exposure 0", ImGuiKey_0, "The picture as image.png shows it", always,
       [](C c) { change_view(c, [](ViewSettings& l) { l.exposure_stops = 0; }); }},
      {"Next layer", ImGuiKey_L, "All of the light, then each layer of the picture", has_layers, next_layer<1>,
       no_layers},
      {"Previous layer", shift | ImGuiKey_L, "The same the other way round", has_layers, next_layer<-1>, no_layers},
      {"Next tone curve", ImGuiKey_T, "What becomes of light above white: reinhard, filmic, clip", has_tones, next_tone,
       no_tones},
      tone_action<0>("Tone reinhard"),
      tone_action<1>("Tone filmic"),
      tone_action<2>("Tone clip"),
      switching({"False colour", 0, "The luminance as a colour, on a logarithmic scale", always,
                 [](C c) { show_false_colour(c, !c.view_settings().false_colour); }},
                [](C c) { return c.view_state.view_settings.false_colour; }),
      display_action<&preset::Display::gamut, preset::Display::Gamut::oklch, preset::Display::Gamut::clip>(
          "Keep hues", "Colours that sRGB does not have become less colourful, or else are clipped", has_tones,
          no_tones),
      display_action<&preset::Display::white_balance, preset::Display::WhiteBalance::light,
                     preset::Display::WhiteBalance::d65>(
          "The lamp is white", "White balance for the first lamp of the scene, or else for D65", has_lamp, no_lamp),
      {"Inspect pixel", ImGuiKey_I, "The pixel in the middle, or none; Alt and a click takes another", is_shown,
       inspect, nullptr, nullptr, has_pixel},
      repeating({"Pixel to the left", ImGuiKey_LeftArrow, "Inspect the pixel beside", can_step, move_pixel<-1, 0>}),
      repeating({"Pixel to the right", ImGuiKey_RightArrow, "Inspect the pixel beside", can_step, move_pixel<1, 0>}),
      repeating({"Pixel above", ImGuiKey_UpArrow, "Inspect the pixel above", can_step, move_pixel<0, -1>}),
      repeating({"Pixel below", ImGuiKey_DownArrow, "Inspect the pixel below", can_step, move_pixel<0, 1>}),
      {"Copy pixel", 0, "The values of the pixel that is inspected, with tabs between", has_pixel, copy_pixel,
       no_pixel},
      {"Statistics of the picture", shift | ImGuiKey_I, "Of all its pixels, or none; Alt and a drag takes a rectangle",
       is_shown, whole_region, nullptr, nullptr, has_region},
      {"Find a preset", ctrl | ImGuiKey_P, "The panel Presets, to type what is looked for", always,
       [](C c) { c.push(command::ShowPanel{"presets"}); }},
  };
}

} // namespace nephroid::ui
