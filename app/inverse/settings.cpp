// SPDX-License-Identifier: Apache-2.0
// The settings of engine 3 as the preset knows them, and what one of their fields cannot say alone. What needs a file
// read is refused by the plan (layout.cpp, pictures/target.cpp).
#include "inverse/settings.h"

#include "base/error.h"
#include "inverse/describe_settings.h"
#include "preset/place.h"
#include "preset/settings_type.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::inverse {
namespace {

using preset::Where;

/// Bytes of a text that is drawn. A QR code says itself what it holds.
constexpr std::size_t most_text = 100;

void check_picture(const Picture& p, const std::string& pointer, const Where& where) {
  const bool hollow = p.type == Picture::Type::ring || p.type == Picture::Type::star;
  if (hollow && p.inner >= p.radius)
    throw bad_input(where(preset::child(pointer, "inner")),
                    fmt::format("is {}, and the outer radius {}", p.inner, p.radius),
                    "expected less than the outer radius");
  const bool words = p.type == Picture::Type::text, code = p.type == Picture::Type::qr;
  if (((words || code) && p.text.empty()) || (words && p.text.size() > most_text))
    throw bad_input(where(preset::child(pointer, "text")), fmt::format("has {} bytes", p.text.size()),
                    words ? fmt::format("expected a text of 1 to {}", most_text) : "expected a text");
  if (words)
    for (const char c : p.text)
      if (c < ' ' || c > '~')
        throw bad_input(
            where(preset::child(pointer, "text")), fmt::format("is \"{}\", and only printable ASCII is drawn", p.text),
            "expected letters without accents, digits and signs in one line", "draw other ones as a picture file");
  if (p.levels[0] >= p.levels[1])
    throw bad_input(where(preset::child(pointer, "levels")), fmt::format("is [{}, {}]", p.levels[0], p.levels[1]),
                    "expected the darker one first");
  if (p.type == Picture::Type::file && std::fmod(p.turn_deg, 90) != 0)
    throw bad_input(where(preset::child(pointer, "turn_deg")),
                    fmt::format("is {}, and a file is turned by quarters", p.turn_deg), "expected a multiple of 90",
                    "turn the file itself by other angles");
  if (p.type == Picture::Type::star && p.count < 2)
    throw bad_input(where(preset::child(pointer, "count")), fmt::format("is {}", p.count),
                    "expected a star of at least 2 points");
}

void check_light(const Light& light, const Settings& s, const std::string& pointer, const Where& where) {
  if ((light.type == Light::Type::area || light.type == Light::Type::mesh) && s.sun_deg.value_or(0) > 0)
    throw bad_input(where("/inverse/sun_deg"), fmt::format("is {} degrees, and a lamp has a size", *s.sun_deg),
                    fmt::format("expected 0 with a light of type {}", preset::word(light.type)), "remove it");
  if (light.type == Light::Type::sun) preset::check_place(light.place, preset::child(pointer, "place"), where);
}

void check_receivers(const Settings& s, const std::string& pointer, const Where& where) {
  for (std::size_t j = 0; j < s.receivers.size(); ++j) {
    const std::string at = preset::child(pointer, j);
    check_picture(s.receivers[j].picture, preset::child(at, "picture"), where);
    if (s.method == Settings::Method::thesis && s.receivers[j].weight != 1)
      throw bad_input(where(preset::child(at, "weight")),
                      fmt::format("is {}, and the method 'thesis' has all pictures alike", s.receivers[j].weight),
                      "expected 1", "or choose the method 'assign'");
    if (s.method == Settings::Method::thesis && s.receivers[j].offset_mm != std::array<double, 2>{0, 0})
      throw bad_input(where(preset::child(at, "offset_mm")),
                      "is not for the method 'thesis', which has all pictures before the object", "expected [0, 0]",
                      "or choose the method 'assign', or 'lens' for one picture");
    if (s.receivers[j].light && s.method != Settings::Method::assign)
      throw bad_input(where(preset::child(at, "light")),
                      fmt::format("is of its own, and the method '{}' has one light", preset::word(s.method)),
                      "expected none", "or choose the method 'assign'");
    if (s.receivers[j].light) check_light(*s.receivers[j].light, s, preset::child(at, "light"), where);
    if (s.receivers[j].light && s.receivers[j].light->spectrum)
      throw bad_input(where(preset::child(preset::child(at, "light"), "spectrum")),
                      "is of one receiver, and all lights have the spectrum of inverse.light", "expected none",
                      "give inverse.light the spectrum");
    if (j == 0) continue;
    const double before = s.receivers[j - 1].distance_mm, now = s.receivers[j].distance_mm;
    if (now < before)
      throw bad_input(where(preset::child(at, "distance_mm")),
                      fmt::format("is {} mm, and the receiver before stands at {} mm", now, before),
                      "expected receivers in the order of their distance", "sort them, the nearest first");
    for (std::size_t k = 0; k < j; ++k)
      if (const Receiver& other = s.receivers[k];
          other.distance_mm == now && other.offset_mm == s.receivers[j].offset_mm &&
          is_same_but_spectrum(other.light.value_or(s.light), s.receivers[j].light.value_or(s.light)))
        throw bad_input(where(preset::child(at, "distance_mm")),
                        fmt::format("is {} mm, and {} stands at the same place in the same light", now,
                                    k + 1 == j ? "the receiver before" : fmt::format("receiver {}", k + 1)),
                        "expected each at its own", "choose another distance_mm, offset_mm or light");
  }
}

void check_far(const Settings& s, const std::string& pointer, const Where& where) {
  const Intensity& far = *s.far;
  if (far.type == Intensity::Type::picture) check_picture(far.picture, preset::child(pointer, "picture"), where);
  if (s.receivers != std::vector<Receiver>(1))
    throw bad_input(where("/inverse/receivers"), "stand beside 'far', and directions are of one target alone",
                    "expected one of both", "take 'far' or 'receivers' away");
  if (s.receiver_mm)
    throw bad_input(where("/inverse/receiver_mm"), "is a size in mm, and 'far' has one in degrees", "expected none",
                    "remove it");
  if (s.method == Settings::Method::thesis)
    throw bad_input(where("/inverse/method"), "is \"thesis\", which aims at receivers", "expected no 'far'",
                    "choose the method 'lens' or 'assign'");
  if (s.light.type == Light::Type::area && (s.light.size_mm[0] > s.size_mm[0] || s.light.size_mm[1] > s.size_mm[1]))
    throw bad_input(where("/inverse/light/size_mm"),
                    fmt::format("is {} x {} mm, and the object {} x {} mm", s.light.size_mm[0], s.light.size_mm[1],
                                s.size_mm[0], s.size_mm[1]),
                    "expected a lamp smaller than the object, which spreads its light too far otherwise",
                    "choose a smaller lamp or a larger size_mm");
  if (far.candela && !far.lumens)
    throw bad_input(where(preset::child(pointer, "lumens")), "is not given, and 'candela' is",
                    "expected the lumens of the lamp, which candela are of", "give 'lumens', or remove 'candela'");
}

/// The camera gives the size of the sheet of pictures; whatever else a scene has, this engine has none of it.
void check_scene(const preset::Preset& preset, const Where& where) {
  const auto refuse = [&](const char* key) {
    throw bad_input(where(preset::child("/scene", key)),
                    "has no meaning for the engine 'inverse', which makes its own object and light", "expected none",
                    "remove it");
  };
  if (!preset.scene.objects.empty()) refuse("objects");
  if (!preset.scene.lights.empty()) refuse("lights");
  if (preset.scene.environment) refuse("environment");
  if (!is_plain(preset.scene.camera))
    throw bad_input(where("/scene/camera"), "has an aperture, a shift or an orthographic projection",
                    "expected a pinhole for engine inverse", "remove them");
}

void check(const preset::Preset& preset, const Where& where) {
  using Method = Settings::Method;
  const Settings& s = settings(preset);
  const auto refuse = [&](const char* field, const std::string& what, const char* expected, const char* remedy = "") {
    throw bad_input(where(preset::child("/inverse", field)), what, expected, remedy);
  };
  const bool lens = s.method == Method::lens, free_heights = s.heights == Settings::Heights::free;
  check_scene(preset, where);
  check_light(s.light, s, "/inverse/light", where);
  check_receivers(s, "/inverse/receivers", where);
  if (s.far) check_far(s, "/inverse/far", where);
  if (s.frames > 0 && s.receivers.size() == 1)
    refuse("frames", fmt::format("is {}, and there is one receiver", s.frames),
           "expected two or more, between which a screen can move", "add a receiver, or take 'frames' away");
  const auto is_lamp = [&](const Receiver& r) {
    const Light::Type type = r.light ? r.light->type : s.light.type;
    return type != Light::Type::parallel && type != Light::Type::sun;
  };
  if (s.frames > 0 && std::ranges::any_of(s.receivers, is_lamp) && !std::ranges::all_of(s.receivers, is_lamp))
    refuse("frames", fmt::format("is {}, and receivers are lit by lamps and by parallel light", s.frames),
           "expected lights between which there is a way", "take 'frames' away");
  if (s.index.type == preset::Dispersion::Type::constant && s.index.n == 1)
    refuse("index", "is 1, which bends no light", "expected another index, such as 1.5");
  if (free_heights && s.method == Method::thesis)
    refuse("heights", "is free, and the method 'thesis' aims from facets in one plane", "expected 'flat'",
           "or choose the method 'assign'");
  if (s.stock_mm && s.thickness_mm != Settings{}.thickness_mm)
    refuse("stock_mm", fmt::format("is {} mm, and thickness_mm is {} mm", *s.stock_mm, s.thickness_mm),
           "expected one of both", "remove thickness_mm: the sheet and the relief say it");
  if (lens && s.receivers.size() > 1)
    refuse("method", fmt::format("is \"lens\", and there are {} receivers", s.receivers.size()),
           "expected one, because a smooth surface casts one picture", "choose \"assign\", or keep one receiver");
  if (!lens && s.outline == Settings::Outline::round)
    refuse("outline", fmt::format("is \"round\", and the method \"{}\" makes rows of facets", preset::word(s.method)),
           "expected \"rectangle\"", "or choose the method \"lens\"");
  if (lens && free_heights)
    refuse("heights", "is \"free\", and the method \"lens\" makes a surface without steps", "expected none",
           "remove it");
  if (lens && s.draft_deg > 0)
    refuse("draft_deg", fmt::format("is {}, and the method \"lens\" makes a surface without walls", s.draft_deg),
           "expected 0", "remove it");
  if (s.smoothing_normals > 0 && s.method != Method::assign)
    refuse("smoothing_normals", fmt::format("is {}, and only the method 'assign' has such a term", s.smoothing_normals),
           "expected 0", "or choose the method 'assign'");
  if (s.light.spectrum && s.band_nm > 0)
    refuse("band_nm", fmt::format("is {} nm, and light.spectrum has the light's wavelengths", s.band_nm),
           "expected one of both", "remove it");
  if (s.kind == Settings::Kind::mirror) {
    if (s.index != preset::Dispersion{})
      refuse("index", "is of glass, and \"kind\" is \"mirror\"", "expected none", "remove it");
    if (s.band_nm > 0)
      refuse("band_nm", fmt::format("is {} nm, and a mirror sends all wavelengths alike", s.band_nm), "expected 0",
             "remove it");
  }
  const double first_nm = s.wavelength_nm - s.band_nm / 2, last_nm = s.wavelength_nm + s.band_nm / 2;
  if (first_nm < 380 || last_nm > 780)
    refuse("band_nm", fmt::format("is {} nm, and the light would have {} to {} nm", s.band_nm, first_nm, last_nm),
           "expected a band within 380 to 780 nm", "for all of it take 400 about a wavelength_nm of 580");
  if (preset.stop.error && !preset.reference)
    throw bad_input(where("/stop/error"), "the engine 'inverse' makes no estimate of its error",
                    "expected 'stop.passes' or 'stop.seconds'");
}

} // namespace

const preset::SettingsType& settings_type() {
  static constexpr std::string_view without[] = {"scene.materials",
                                                 "scene.objects",
                                                 "scene.lights",
                                                 "scene.environment",
                                                 "scene.camera.projection",
                                                 "scene.camera.height",
                                                 "scene.camera.shift",
                                                 "scene.camera.aperture",
                                                 "scene.camera.focus_distance",
                                                 "white",
                                                 "display",
                                                 "reference",
                                                 "stop.error"};
  static const preset::SettingsType type = preset::settings_type<Settings>(
      "inverse", "One object of glass, or a mirror, that casts several pictures at several distances.", check, without);
  return type;
}

} // namespace nephroid::inverse
