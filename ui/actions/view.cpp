// SPDX-License-Identifier: Apache-2.0
// The menu "View": how the picture is shown, and what it is held against.
#include "ui/actions/table.h"
#include "ui/inspector/pixel.h"

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

void as_it_is(C c)
{
  look(c, [](Look& l) { l.exposure_stops = 0; });
}

void fit(C c)
{
  look(c, [](Look& l) { l.fit = true; });
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

template <ToneCurve curve>
void tone(C c)
{
  look(c, [](Look& l) { l.tone = curve; });
}
template <ToneCurve curve>
bool has_tone(C c)
{
  return c.chosen.look.tone == curve;
}

void next_tone(C c)
{
  look(c, [](Look& l) {
    l.tone = l.tone == ToneCurve::standard ? ToneCurve::filmic
             : l.tone == ToneCurve::filmic ? ToneCurve::false_colour
                                           : ToneCurve::standard;
  });
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
  const char* menu = "View";
  return {
      {menu, "Flip", ImGuiKey_R, false, "While held: the reference, or the pinned run that is compared with", can_flip, flip,
       why_not_comparable, flip_back},
      {menu, "Difference", ImGuiKey_D, false, "The difference from it in false colour", can_difference, difference, why_not_comparable},
      {menu, "Compare with the next", ImGuiKey_N, false, "The reference, then each pinned run", has_choice, compare_with_next, no_choice},
      {menu, "Fit", ImGuiKey_F, false, "The whole picture in the panel", has_picture, fit},
      {menu, "Actual size", ImGuiKey_1, false, "One pixel of the picture is one of the screen", has_picture, actual_size},
      {menu, "Brighter", ImGuiKey_E, true, "Half a stop more exposure", always, expose<1>},
      {menu, "Darker", shift | ImGuiKey_E, true, "Half a stop less exposure", always, expose<-1>},
      {menu, "Exposure 0", ImGuiKey_0, false, "The picture as image.png shows it", always, as_it_is},
      {menu, "Next layer", ImGuiKey_L, false, "All of the light, then each layer of the picture", has_layers, next_layer<1>, no_layers},
      {menu, "Previous layer", shift | ImGuiKey_L, false, "The same the other way round", has_layers, next_layer<-1>, no_layers},
      {menu, "Next tone curve", ImGuiKey_T, false, "As image.png, filmic, false colour", always, next_tone},
      {menu, "Tone as image.png", 0, false, "sRGB, clipped at 1", always, tone<ToneCurve::standard>, nullptr, nullptr,
       has_tone<ToneCurve::standard>},
      {menu, "Filmic tone", 0, false, "A soft shoulder for pictures with a wide range", always, tone<ToneCurve::filmic>, nullptr, nullptr,
       has_tone<ToneCurve::filmic>},
      {menu, "False colour", 0, false, "The luminance as a colour, on a logarithmic scale", always, tone<ToneCurve::false_colour>, nullptr,
       nullptr, has_tone<ToneCurve::false_colour>},
      {menu, "Inspect pixel", ImGuiKey_I, false, "The pixel in the middle, or none; Alt and a click takes another", has_picture, inspect,
       nullptr, nullptr, has_pixel},
      {menu, "Pixel to the left", ImGuiKey_LeftArrow, true, "Inspect the pixel beside", can_step, move_pixel<-1, 0>},
      {menu, "Pixel to the right", ImGuiKey_RightArrow, true, "Inspect the pixel beside", can_step, move_pixel<1, 0>},
      {menu, "Pixel above", ImGuiKey_UpArrow, true, "Inspect the pixel above", can_step, move_pixel<0, -1>},
      {menu, "Pixel below", ImGuiKey_DownArrow, true, "Inspect the pixel below", can_step, move_pixel<0, 1>},
      {menu, "Copy pixel", 0, false, "The values of the pixel that is inspected, with tabs between", has_pixel, copy_pixel, no_pixel},
      {menu, "Statistics of the picture", shift | ImGuiKey_I, false, "Of all its pixels, or none; Alt and a drag takes a rectangle",
       has_picture, whole_region, nullptr, nullptr, has_region},
      {menu, "Find a preset", ctrl | ImGuiKey_P, false, "The panel Presets, to type what is looked for", always,
       [](C c) {
         c.push(command::ShowPanel{"presets", true});
       }},
  };
}

} // namespace nephroid::ui
