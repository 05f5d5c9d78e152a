// SPDX-License-Identifier: Apache-2.0
#include "ui/view/panel.h"

#include "measure/lab.h"
#include "ui/view/bars.h"

#include <fmt/format.h>

namespace nephroid::ui {
namespace {

/// The hint where the renderer has no texture of the size (0: it has every size); else empty. is_run: about the run's
/// picture.
std::string too_large_hint(const std::array<int, 2>& size, bool is_run) {
  const ImGuiPlatformIO& platform = ImGui::GetPlatformIO();
  const auto beyond = [](int length, int limit) { return limit > 0 && length > limit; };
  if (!beyond(size[0], platform.Renderer_TextureMaxWidth) && !beyond(size[1], platform.Renderer_TextureMaxHeight))
    return {};
  return fmt::format("The picture is {} x {}; this display's OpenGL shows at most {} x {}. {}", size[0], size[1],
                     platform.Renderer_TextureMaxWidth, platform.Renderer_TextureMaxHeight,
                     is_run ? "It is computed all the same: save it with Ctrl+E, or lower scene.camera.resolution."
                            : "It is measured all the same.");
}

/// The hint before the first picture: what to do or to wait for.
std::string waiting_hint(const Context& context) {
  if (context.run.status().state == job::State::failed) return "No picture: see the message below";
  if (context.run.status().state == job::State::cancelled) return "Cancelled before the first picture; start again: F5";
  if (context.run.status().state == job::State::running) return "The first picture is being made";
  const std::string doing = context.run.preparation();
  return doing.empty() ? "Preparing" : "Preparing: " + doing;
}

/// The newest map, where it has the present metric and pictures.
std::shared_ptr<const ShownDifference> fitting_map(const Context& context) {
  const auto& map = context.comparing.difference();
  if (!map || map->of.metric != context.comparing.comparison().metric) return nullptr;
  return context.comparing.are_compared(map->of.picture, map->of.other) ? map : nullptr;
}

/// Shows the map, or why there is none yet.
void show_difference(const Context& context, ShownPicture& shown) {
  const auto map = fitting_map(context);
  const Comparison& comparison = context.comparing.comparison();
  shown.label = fmt::format("{} to {}", metric_name(comparison.metric),
                            comparison.pin == 0 ? "the reference" : context.comparing.other_name());
  if (comparison.shown != 0) shown.label = context.comparing.name() + ": " + shown.label;
  if (!map)
    shown.hint = "The difference is being computed";
  else if (!map->error.empty())
    shown.hint = map->error;
  else {
    shown.owner = map;
    shown.rgba = map->rgba;
  }
}

using Rgb = std::array<float, 3>;

/// The index of a pixel; nothing where it lies outside.
std::optional<std::size_t> index_in(const std::array<int, 2>& size, const std::array<int, 2>& pixel) {
  if (pixel[0] < 0 || pixel[1] < 0 || pixel[0] >= size[0] || pixel[1] >= size[1]) return std::nullopt;
  return static_cast<std::size_t>(pixel[1]) * static_cast<std::size_t>(size[0]) + static_cast<std::size_t>(pixel[0]);
}

std::optional<Rgb> value_at(const measure::Pixels& picture, const std::array<int, 2>& pixel) {
  const auto index = index_in({picture.width, picture.height}, pixel);
  if (!index) return std::nullopt;
  return Rgb{picture.rgb[3 * *index], picture.rgb[3 * *index + 1], picture.rgb[3 * *index + 2]};
}

/// sign: "+" where plus signs are written, too.
std::string text_of(const Rgb& value, double white, const char* sign = "") {
  const std::string format = fmt::format("R {{:{0}.4g}}   G {{:{0}.4g}}   B {{:{0}.4g}}   Y {{:{0}.4g}} W/m2/sr", sign);
  return fmt::format(fmt::runtime(format), value[0], value[1], value[2], white * measure::luminance(value.data()));
}

} // namespace

ShownPicture shown_picture(const Context& context) {
  ShownPicture shown;
  shown.size = context.preset()->scene.camera.resolution;
  const Comparing& comparing = context.comparing;
  const Comparison& comparison = comparing.comparison();
  const auto source = comparing.source();
  const bool is_run = comparison.shown == 0;
  if (!source) {
    shown.hint = is_run ? waiting_hint(context) : "Nothing to show: " + comparing.why_no_picture();
    return shown;
  }
  shown.size = {source->width, source->height};
  if (shown.hint = too_large_hint(shown.size, is_run); !shown.hint.empty()) return shown;
  if (!comparison.flip && !comparison.difference) {
    const HeldPicture held = comparing.picture();
    shown.owner = held.owner;
    shown.rgb = held.pixels.rgb;
    if (const std::string why = comparing.why_no_picture(); !why.empty())
      shown.hint = fmt::format("Nothing to show: {}. Choose above, or go on with L.", why);
    shown.label = comparison.layer;
    if (const std::string& caption = context.run.snapshot()->caption; is_run && !caption.empty())
      shown.label = shown.label.empty() ? caption : shown.label + ": " + caption;
    if (is_run && shown.label.empty()) shown.label = context.run.exposure();
    if (!is_run || comparison.arrangement != Arrangement::single)
      shown.label = comparing.name() + (shown.label.empty() ? "" : ": " + shown.label);
    if (is_run && context.run.snapshot_is_previous() && !context.playback.playing())
      shown.label = "Previous picture" + (shown.label.empty() ? "" : ": " + shown.label);
  } else if (const HeldPicture other = comparing.other_picture(); !other.owner)
    shown.hint = "Nothing to compare with: " + comparing.why_not();
  else if (comparison.flip) {
    shown.owner = other.owner;
    shown.rgb = other.pixels.rgb;
    shown.label = comparing.other_name() + (comparison.layer.empty() ? "" : ": " + comparison.layer);
  } else
    show_difference(context, shown);
  return shown;
}

ShownPicture picture_beside(const Context& context) {
  ShownPicture shown;
  shown.size = {0, 0};
  const Comparing& comparing = context.comparing;
  const Comparison& comparison = comparing.comparison();
  if (comparison.arrangement == Arrangement::single) return shown;
  const HeldPicture other = comparing.picture_beside();
  if (!other.owner) {
    shown.hint = "Nothing to compare with: " + comparing.why_none_beside();
    return shown;
  }
  shown.size = {other.pixels.width, other.pixels.height};
  shown.label = comparing.other_name() + (comparison.layer.empty() ? "" : ": " + comparison.layer);
  if (shown.hint = too_large_hint(shown.size, comparison.pin == Comparison::run_in_hand); !shown.hint.empty())
    return shown;
  shown.owner = other.owner;
  shown.rgb = other.pixels.rgb;
  return shown;
}

std::string pixel_text(const Context& context, const std::array<int, 2>& pixel) {
  const auto source = context.comparing.source();
  if (!source) return {};
  const auto text_in = [&](const std::optional<Rgb>& rgb) {
    return rgb ? text_of(*rgb, context.white()) : "outside of it";
  };
  const HeldPicture held = context.comparing.picture();
  const auto value =
      value_at(held.owner ? held.pixels : measure::Pixels{source->width, source->height, source->rgb, {}}, pixel);
  const Comparison& comparison = context.comparing.comparison();
  const bool is_single = comparison.arrangement == Arrangement::single;
  const HeldPicture other = is_single ? context.comparing.other_picture() : context.comparing.picture_beside();
  const bool compares = other.owner && (comparison.flip || comparison.difference || !is_single);
  const auto other_value = compares ? value_at(other.pixels, pixel) : std::nullopt;
  if (!value && !other_value) return {};
  std::string text = fmt::format("({}, {})   ", pixel[0], pixel[1]) + text_in(value);
  if (!compares) return text;
  text += fmt::format("\n{}   {}", context.comparing.other_name(), text_in(other_value));
  if (!value || !other_value) return text;
  const Rgb difference{(*value)[0] - (*other_value)[0], (*value)[1] - (*other_value)[1],
                       (*value)[2] - (*other_value)[2]};
  text += "\ndifference   " + text_of(difference, context.white(), "+");
  if (const auto map = fitting_map(context); comparison.difference && map && map->values)
    text += fmt::format("   {} {:.4g}", metric_name(map->of.metric),
                        (*map->values)[*index_in({other.pixels.width, other.pixels.height}, pixel)]);
  return text;
}

} // namespace nephroid::ui
