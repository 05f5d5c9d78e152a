// SPDX-License-Identifier: Apache-2.0
#include "ui/view/panel.h"

#include "measure/lab.h"
#include "ui/view/bars.h"

#include <fmt/format.h>
#include <imgui.h>

namespace nephroid::ui {
namespace {

/// What is said where the renderer has no texture of the size (0: it has every size); else empty.
std::string too_large_hint(const std::array<int, 2>& size)
{
  const ImGuiPlatformIO& platform = ImGui::GetPlatformIO();
  const auto beyond = [](int length, int limit) { return limit > 0 && length > limit; };
  if (!beyond(size[0], platform.Renderer_TextureMaxWidth) && !beyond(size[1], platform.Renderer_TextureMaxHeight)) return {};
  return fmt::format("The picture is {} x {}; this display's OpenGL shows at most {} x {}. It is computed all the same: "
                     "save it with Ctrl+E, or lower scene.camera.resolution.",
                     size[0], size[1], platform.Renderer_TextureMaxWidth, platform.Renderer_TextureMaxHeight);
}

/// What to do or to wait for before the first picture.
std::string waiting_hint(const Context& context)
{
  if (context.run.status().state == job::State::failed) return "No picture: see the message below";
  if (context.run.status().state == job::State::cancelled) return "Cancelled before the first picture; start again: F5";
  if (context.run.status().state == job::State::running) return "The first picture is being made";
  return "Preparing: reading the scene, building the kernels";
}

/// The newest map, where it is of the metric and the pictures that are compared now; of the run's own picture an earlier one will do.
std::shared_ptr<const ShownDifference> fitting_map(const Context& context, const HeldPicture& other, const std::array<int, 2>& size)
{
  const auto& map = context.comparing.difference();
  if (!map || map->of.metric != context.comparing.comparison().metric || map->of.other.owner != other.owner) return nullptr;
  const measure::Pixels& of = map->of.picture.pixels;
  return of.width == size[0] && of.height == size[1] ? map : nullptr;
}

/// The map, or why there is none yet.
void show_difference(const Context& context, const HeldPicture& other, ShownPicture& shown)
{
  const auto map = fitting_map(context, other, shown.size);
  const Comparison& comparison = context.comparing.comparison();
  shown.label = fmt::format("{} to {}", metric_name(comparison.metric), comparison.pin == 0 ? "the reference" : other_name(context));
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

std::size_t index_of(const std::array<int, 2>& size, const std::array<int, 2>& pixel)
{
  return static_cast<std::size_t>(pixel[1]) * static_cast<std::size_t>(size[0]) + static_cast<std::size_t>(pixel[0]);
}

Rgb value_at(std::span<const float> rgb, const std::array<int, 2>& size, const std::array<int, 2>& pixel)
{
  const std::size_t index = 3 * index_of(size, pixel);
  return {rgb[index], rgb[index + 1], rgb[index + 2]};
}

std::string text_of(const Rgb& value, double white, const char* format)
{
  return fmt::format(fmt::runtime(format), value[0], value[1], value[2], white * measure::luminance(value.data()));
}

} // namespace

ShownPicture shown_picture(const Context& context)
{
  ShownPicture shown;
  if (const preset::Preset* preset = context.preset()) shown.size = preset->scene.camera.resolution;
  const auto& snapshot = context.run.snapshot();
  if (!snapshot) {
    shown.hint = waiting_hint(context);
    return shown;
  }
  const job::Picture& picture = *snapshot->picture;
  shown.size = {picture.width, picture.height};
  const Comparison& comparison = context.comparing.comparison();
  if (shown.hint = too_large_hint(shown.size); !shown.hint.empty()) return shown;
  if (!comparison.flip && !comparison.difference) {
    const HeldPicture held = context.comparing.picture();
    shown.owner = held.owner;
    shown.rgb = held.pixels.rgb;
    if (const std::string why = context.comparing.why_no_picture(); !why.empty())
      shown.hint = fmt::format("Nothing to show: {}. Choose above, or go on with L.", why);
    shown.label = snapshot->caption.empty() ? comparison.layer : snapshot->caption;
    if (context.run.snapshot_is_previous()) shown.label = "Previous picture" + (shown.label.empty() ? "" : ": " + shown.label);
  } else if (const HeldPicture other = context.comparing.other_picture(); !other.owner)
    shown.hint = "Nothing to compare with: " + context.comparing.why_not();
  else if (comparison.flip) {
    shown.owner = other.owner;
    shown.rgb = other.pixels.rgb;
    shown.label = other_name(context) + (comparison.layer.empty() ? "" : ": " + comparison.layer);
  } else
    show_difference(context, other, shown);
  return shown;
}

std::string pixel_text(const Context& context, const std::array<int, 2>& pixel)
{
  const auto& snapshot = context.run.snapshot();
  if (!snapshot || !context.preset()) return {};
  const job::Picture& picture = *snapshot->picture;
  const std::array<int, 2> size{picture.width, picture.height};
  const double white = context.preset()->white;
  constexpr const char* format = "R {:.4g}   G {:.4g}   B {:.4g}   Y {:.4g} W/m2/sr";
  const HeldPicture held = context.comparing.picture();
  const Rgb of_run = value_at(held.owner ? held.pixels.rgb : std::span<const float>(picture.rgb), size, pixel);
  std::string text = fmt::format("({}, {})   ", pixel[0], pixel[1]) + text_of(of_run, white, format);
  const Comparison& comparison = context.comparing.comparison();
  const HeldPicture other = context.comparing.other_picture();
  if (!(comparison.flip || comparison.difference) || !other.owner) return text;
  const Rgb of_other = value_at(other.pixels.rgb, size, pixel);
  const Rgb difference{of_run[0] - of_other[0], of_run[1] - of_other[1], of_run[2] - of_other[2]};
  text += fmt::format("\n{}   {}\ndifference   {}", other_name(context), text_of(of_other, white, format),
                      text_of(difference, white, "R {:+.4g}   G {:+.4g}   B {:+.4g}   Y {:+.4g} W/m2/sr"));
  if (const auto map = fitting_map(context, other, size); comparison.difference && map && map->values)
    text += fmt::format("   {} {:.4g}", metric_name(map->of.metric), (*map->values)[index_of(size, pixel)]);
  return text;
}

} // namespace nephroid::ui
