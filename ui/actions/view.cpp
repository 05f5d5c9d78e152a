// SPDX-License-Identifier: Apache-2.0
// The menu "View": how the picture is shown, and what it is held against.
#include "ui/actions/table.h"
#include "ui/inspector/pixels.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>

namespace nephroid::ui {
namespace {

template <class Change>
void look(C c, Change change)
{
  Look look = c.look();
  change(look);
  c.push(command::SetLook{look});
}

template <int half_stops>
void expose(C c)
{
  look(c, [](Look& l) { l.exposure_stops += half_stops / 2.0; });
}

void actual_size(C c)
{
  const job::Picture& picture = *c.run.snapshot()->picture;
  look(c, [&](Look& l) {
    l.fit = false;
    l.zoom = 1;
    l.centre = {picture.width / 2.0, picture.height / 2.0};
  });
}

// What is on can be turned off, whatever became of the other picture.
bool can_flip(C c) { return c.comparing.comparison().flip || c.comparing.why_not().empty(); }
bool can_difference(C c) { return c.comparing.comparison().difference || c.comparing.why_not().empty(); }
std::string why_not_comparable(C c) { return c.comparing.why_not(); }
bool has_choice(C c) { return !c.comparing.pinned().all().empty(); }
std::string no_choice(C) { return "no run is pinned"; }

void flip(C c) { c.push(command::Flip{!c.comparing.comparison().flip}); }
void flip_back(C c)
{
  if (c.comparing.comparison().flip) c.push(command::Flip{false});
}

void difference(C c)
{
  const Comparison& now = c.comparing.comparison();
  c.push(command::ShowDifference{!now.difference, now.metric, now.scale});
}

/// The reference, then each pinned run, and round again.
void compare_with_next(C c)
{
  const std::vector<PinnedRun>& runs = c.comparing.pinned().all();
  const auto next = std::find_if(runs.begin(), runs.end(), [&](const PinnedRun& run) { return run.id > c.comparing.comparison().pin; });
  c.push(command::CompareWith{next == runs.end() ? 0 : next->id});
}

bool has_layers(C c) { return has_picture(c) && !c.run.snapshot()->picture->layers.empty(); }
std::string no_layers(C c) { return has_picture(c) ? "this engine's picture has no layers" : "there is no picture yet"; }

/// All of the light, then each layer, and round again; back where step is -1.
template <int step>
void next_layer(C c)
{
  const std::vector<job::Layer>& layers = c.run.snapshot()->picture->layers;
  const auto now =
      std::find_if(layers.begin(), layers.end(), [&](const job::Layer& l) { return l.name == c.comparing.comparison().layer; });
  const auto count = std::ssize(layers) + 1;
  const auto next = ((now == layers.end() ? 0 : now - layers.begin() + 1) + step + count) % count;
  c.push(command::ShowLayer{next == 0 ? "" : layers[static_cast<std::size_t>(next - 1)].name});
}

Action tone_action(const char* name, const char* help, ToneCurve curve)
{
  return switching({name, 0, help, always, [curve](C c) { look(c, [&](Look& l) { l.tone = curve; }); }},
                   [curve](C c) { return c.chosen.look.tone == curve; });
}

void next_tone(C c)
{
  look(c, [](Look& l) { l.tone = static_cast<ToneCurve>((static_cast<int>(l.tone) + 1) % tone_curves); });
}

bool has_pixel(C c) { return c.chosen.pixel.has_value(); }
/// The arrow keys are those of what is selected, where something is.
bool can_step(C c) { return has_pixel(c) && c.selection() == Selection{}; }

/// The pixel in the middle of what is shown; none where one was.
void inspect(C c)
{
  if (c.chosen.pixel) return c.push(command::InspectPixel{});
  const job::Picture& picture = *c.run.snapshot()->picture;
  const Look look = c.look();
  const auto middle = [&](std::size_t i, int length) {
    return std::clamp(look.fit ? length / 2 : static_cast<int>(std::clamp(look.centre[i], 0.0, 1e9)), 0, length - 1);
  };
  c.push(command::InspectPixel{std::array{middle(0, picture.width), middle(1, picture.height)}});
}

template <int dx, int dy>
void move_pixel(C c)
{
  if (!has_picture(c)) return;
  const job::Picture& picture = *c.run.snapshot()->picture;
  const auto [x, y] = *c.chosen.pixel;
  c.push(command::InspectPixel{std::array{std::clamp(x + dx, 0, picture.width - 1), std::clamp(y + dy, 0, picture.height - 1)}});
}

std::string no_pixel(C) { return "no pixel is inspected"; }
void copy_pixel(C c) { ImGui::SetClipboardText(pixel_as_text(c, *c.chosen.pixel).c_str()); }

bool has_region(C c) { return c.chosen.region.has_value(); }

void whole_region(C c)
{
  const job::Picture& picture = *c.run.snapshot()->picture;
  c.push(command::SelectRegion{c.chosen.region ? std::nullopt : std::optional(PixelRegion{{0, 0}, {picture.width, picture.height}})});
}

} // namespace

std::vector<Action> view_actions()
{
  return {
      {"Flip", ImGuiKey_R, "While held: the reference, or the pinned run that is compared with", can_flip, flip, why_not_comparable,
       flip_back},
      {"Difference", ImGuiKey_D, "The difference from it in false colour", can_difference, difference, why_not_comparable},
      {"Compare with the next", ImGuiKey_N, "The reference, then each pinned run", has_choice, compare_with_next, no_choice},
      {"Fit", ImGuiKey_F, "The whole picture in the panel", has_picture, [](C c) { look(c, [](Look& l) { l.fit = true; }); }},
      {"Actual size", ImGuiKey_1, "One pixel of the picture is one of the screen", has_picture, actual_size},
      repeating({"Brighter", ImGuiKey_E, "Half a stop more exposure", always, expose<1>}),
      repeating({"Darker", shift | ImGuiKey_E, "Half a stop less exposure", always, expose<-1>}),
      {"Exposure 0", ImGuiKey_0, "The picture as image.png shows it", always, [](C c) { look(c, [](Look& l) { l.exposure_stops = 0; }); }},
      {"Next layer", ImGuiKey_L, "All of the light, then each layer of the picture", has_layers, next_layer<1>, no_layers},
      {"Previous layer", shift | ImGuiKey_L, "The same the other way round", has_layers, next_layer<-1>, no_layers},
      {"Next tone curve", ImGuiKey_T, "As image.png, filmic, false colour", always, next_tone},
      tone_action("Tone as image.png", "sRGB, clipped at 1", ToneCurve::standard),
      tone_action("Filmic tone", "A soft shoulder for pictures with a wide range", ToneCurve::filmic),
      tone_action("False colour", "The luminance as a colour, on a logarithmic scale", ToneCurve::false_colour),
      {"Inspect pixel", ImGuiKey_I, "The pixel in the middle, or none; Alt and a click takes another", has_picture, inspect, nullptr,
       nullptr, has_pixel},
      repeating({"Pixel to the left", ImGuiKey_LeftArrow, "Inspect the pixel beside", can_step, move_pixel<-1, 0>}),
      repeating({"Pixel to the right", ImGuiKey_RightArrow, "Inspect the pixel beside", can_step, move_pixel<1, 0>}),
      repeating({"Pixel above", ImGuiKey_UpArrow, "Inspect the pixel above", can_step, move_pixel<0, -1>}),
      repeating({"Pixel below", ImGuiKey_DownArrow, "Inspect the pixel below", can_step, move_pixel<0, 1>}),
      {"Copy pixel", 0, "The values of the pixel that is inspected, with tabs between", has_pixel, copy_pixel, no_pixel},
      {"Statistics of the picture", shift | ImGuiKey_I, "Of all its pixels, or none; Alt and a drag takes a rectangle", has_picture,
       whole_region, nullptr, nullptr, has_region},
      {"Find a preset", ctrl | ImGuiKey_P, "The panel Presets, to type what is looked for", always,
       [](C c) {
         c.push(command::ShowPanel{"presets", true});
       }},
  };
}

} // namespace nephroid::ui
