// SPDX-License-Identifier: Apache-2.0
// Pictures as environment maps, as masks, and as what engine 3 wants. The input is what pixels hold, of a few sizes and
// channels: OpenImageIO's own readers are not ours.
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
  int width = 0, height = 0;
  const fs::path file = map_of(input, width, height);
  const FileFinder finder(folder());
  accepts([&] {
    preset::Environment environment{.type = preset::Environment::Type::file, .file = file.string(), .lights = true};
    std::vector<std::string> warnings;
    const scene::Environment map = scene::make_environment(environment, finder, "fuzz.json", warnings);
    if (map.width != width || map.height != height) finding("another size is read");
    if (!map.lights) return;
    const scene::EnvironmentFlux flux = scene::flux_of(map);
    if (!std::isfinite(flux.power)) finding("a flux that is no number");
    scene::make_environment_light(map);
  });
  accepts([&] { measure::read_mask(file, width, height); });
  accepts([&] {
    inverse::Picture wanted{.type = inverse::Picture::Type::file, .file = file.string()};
    inverse::Layout layout{.facets = {16, 16}, .cells = {8, 8}, .distances = {100}};
    inverse::make_target(wanted, layout, finder, "fuzz.json");
  });
}

std::vector<std::string> seeds() {
  return {pixels(4, 2, false, 1e-3f), pixels(8, 4, true, 0.1f), pixels(1, 1, false, 0)};
}

} // namespace nephroid::fuzz
