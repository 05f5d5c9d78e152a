// SPDX-License-Identifier: Apache-2.0
// Pictures as environment maps, as masks, and as what engine 3 wants. The input is a whole Radiance picture, whose
// reader is ours, or what pixels hold, of a few sizes and channels: OpenImageIO's readers are not ours.
#include "image/image.h"
#include "inverse/pictures/target.h"
#include "measure/read_picture.h"
#include "scene/scene.h"
#include "tests/fuzz/harness.h"

namespace nephroid::fuzz {
namespace {

/// A portable float map: W bytes wide and H high by the first two bytes of the input, with one channel or three by the
/// third.
fs::path map_of(std::string_view input, int& width, int& height) {
  const auto byte = [&](std::size_t at) { return at < input.size() ? static_cast<unsigned char>(input[at]) : 0; };
  width = 1 + byte(0) % 16;
  height = 1 + byte(1) % 16;
  const std::size_t channels = byte(2) % 2 == 0 ? 3 : 1;
  std::string pixels(input.substr(std::min<std::size_t>(3, input.size())));
  pixels.resize(static_cast<std::size_t>(width * height) * channels * sizeof(float));
  return write("map.pfm", fmt::format("P{}\n{} {}\n-1.0\n", channels == 3 ? 'F' : 'f', width, height) + pixels);
}

std::string pixels(int width, int height, bool grey, float value) {
  std::string bytes{static_cast<char>(width - 1), static_cast<char>(height - 1), static_cast<char>(grey)};
  for (int i = 0; i < width * height * (grey ? 1 : 3); ++i) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    value *= 1.5f;
  }
  return bytes;
}

} // namespace

void read(std::string_view input) {
  int width = 0, height = 0; // of a map of ours
  const fs::path file = input.starts_with("#?") ? write("map.hdr", input) : map_of(input, width, height);
  const FileFinder finder(folder());
  accepts([&] {
    preset::Environment environment{.type = preset::Environment::Type::file, .file = file.string(), .lights = true};
    std::vector<std::string> warnings;
    const scene::Environment map = scene::make_environment(environment, finder, "fuzz.json", warnings);
    if (width > 0 && (map.width != width || map.height != height)) finding("another size is read");
    if (!map.lights) return;
    const scene::EnvironmentFlux flux = scene::flux_of(map);
    if (!std::isfinite(flux.power)) finding("a flux that is no number");
    scene::make_environment_light(map);
  });
  accepts([&] { measure::read_mask(file, width, height); });
  for (const bool changed : {false, true})
    accepts([&] {
      inverse::Picture wanted{.type = inverse::Picture::Type::file, .file = file.string()};
      if (changed) {
        wanted.fit = inverse::Picture::Fit::cover;
        wanted.invert = true;
        wanted.ground = 0.5;
        wanted.turn_deg = 90;
      }
      inverse::Layout layout{.facets = {16, 16}, .cells = {8, 8}, .distances = {100}};
      std::vector<std::string> notes;
      inverse::make_target(wanted, layout, finder, "fuzz.json", notes);
    });
}

std::vector<std::string> seeds() {
  const std::string rgbe = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n", xyze = "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n";
  return {pixels(4, 2, false, 1e-3f),
          pixels(8, 4, true, 0.1f),
          pixels(1, 1, false, 0),
          rgbe + "EXPOSURE=2\nEXPOSURE= 5e-1\nCOLORCORR= 1 2 .5\n\n-Y 1 +X 2\nabcdefgh",
          rgbe + "PRIMARIES= .64 .33 .29 .6 .15 .06 .3333 .3333\nGAMMA=2.2\n\n+X 1 -Y 2\nabcdefgh",
          xyze + "PIXASPECT=2\n\n+Y 1 -X 8\n" + std::string{2, 2, 0, 8} + "\x88Z\x88Z\3ZZZ\x85Z\x88\x80",
          xyze + "VIEW= -vta\n\n-X 1 +Y 6\nabcd" + std::string{1, 1, 1, 5}};
}

} // namespace nephroid::fuzz
