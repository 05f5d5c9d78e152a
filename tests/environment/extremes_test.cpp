// SPDX-License-Identifier: Apache-2.0
// Extreme skies, lamps, objects and receivers of engine 2. docs/notebook/extremes.md sums it up.
#include "tests/support/extremes.h"

#include "environment/checks.h"
#include "image/image.h"
#include "tests/environment/maps.h"
#include "tests/environment/picture_files.h"
#include "tests/environment/views.h"

namespace nephroid::extremes_test {

/// One for all cases: most have the same ball.
const TemporaryFolder& cache() {
  static const TemporaryFolder folder;
  return folder;
}

environment::EnvironmentPlan planned(const preset::Preset& p) {
  const scene::Scene scene = scene::load_scene(p);
  return environment::make_plan(p, scene, scene::build_bvh(scene.geometry));
}
job::Snapshot shown(const preset::Preset& p) {
  const auto job = environment::make_job(p, planned(p), bake_context());
  while (!job->finished()) job->advance();
  return job->snapshot();
}
bool runs(const preset::Preset& p, const std::string& name) {
  const environment::EnvironmentPlan plan = planned(p);
  return std::ranges::any_of(plan.decisions,
                             [&](const plan::Decision& pass) { return pass.name == name && pass.runs; });
}
/// The first note of the plan.
std::string note(const preset::Preset& p) {
  const environment::EnvironmentPlan plan = planned(p);
  return plan.notes.empty() ? "" : plan.notes.front();
}

const std::string floor_below = facing_quad("floor", {0, -1.5, 0}, {0, 1, 0}, 40);

/// The ball over a floor.
preset::Preset floor_scene(const std::string& others = floor_below, const preset::Overrides& more = {}) {
  preset::Preset p = ball_and(others, more);
  p.source = "p.json";
  look(p, {2.5, 1.5, 3}, {0, -1, 0}, 50);
  return p;
}
preset::Preset under_lamp(const glm::dvec3& direction = {0.3, -1, 0.2}, double irradiance = 1) {
  preset::Preset p = floor_scene();
  p.scene.lights = {lamp(direction, irradiance)};
  return p;
}

/// A sky of a file in the folder of caches.
preset::Preset under_file(const std::string& name, const std::string& bytes) {
  preset::Preset p = floor_scene();
  p.scene.environment.emplace().file = cache().write(name, bytes);
  return p;
}
preset::Preset under_picture(const image::Image& picture) {
  preset::Preset p = floor_scene();
  p.scene.environment.emplace().file = (cache().path() / "sky.exr").string();
  image::write_exr(p.scene.environment->file, picture);
  return p;
}
/// 64 x 32 texels of `others`, one of them `texel`.
preset::Preset under_texel(float texel, float others = 1) {
  image::Image picture{64, 32, {"R", "G", "B"}, std::vector<float>(3 * 64 * 32, others), {}};
  for (std::size_t c = 0; c < 3; ++c) picture.data[3 * (64 * 8 + 40) + c] = texel;
  return under_picture(picture);
}
preset::Preset under_even_sky(double radiance = 1) {
  preset::Preset p = floor_scene();
  even_light(p, radiance);
  return p;
}

Outcome same_picture(const preset::Preset& a, const preset::Preset& b, double tolerance, double factor = 1) {
  return at_most(largest_difference(shown(a).picture->rgb, shown(b).picture->rgb, factor), tolerance);
}
Outcome refuses(const preset::Preset& p, const std::string& line) {
  return refused([&] { planned(p); }, line);
}
Outcome refuses_setting(const std::string& setting, const std::string& line) {
  return refused([&] { bake_preset(glass_ball, {"environment." + setting}); }, line);
}

/// The mean of the lights' directions by their irradiance, to the middle of the bright texel, in degrees.
double off_the_sun(const preset::Preset& p) {
  const job::Snapshot made = shown(p);
  const auto curve = std::ranges::find(made.curves, "lights", &job::Curve::name);
  glm::dvec3 sum(0);
  for (const std::vector<double>& row : curve->rows) sum += row[4] * direction_of(row[2], row[1]);
  return std::acos(std::min(glm::dot(glm::normalize(sum), map_direction(40.5, 8.5, 64, 32)), 1.0)) * 180 / pi;
}

constexpr double floor_at = 1.5;

/// The ball as if it were not there, over a floor, seen from above.
preset::Preset over_nothing(bool ball) {
  preset::Preset p =
      floor_scene(floor_below, {"scene.materials.glass.dispersion=1", "environment.photons=40000",
                                "environment.resolution=96", "environment.spheres=16", "stop.passes=16"});
  if (!ball) p.scene.objects[0].transform.translate = {0, 0, 1000};
  p.scene.lights = {lamp({0, -1, 0})};
  look(p, {0, 6, 0}, {0, -floor_at, 0}, 40);
  return p;
}
/// The caustic's power over that of the light that meets the ball.
double through_nothing() {
  const double lit = mean(layer_rgb(shown(over_nothing(false)), "direct")).y,
               side = 2 * (6 + floor_at) * std::tan(pi / 9);
  return mean(layer_rgb(shown(over_nothing(true)), "caustic")).y / lit * side * side / pi;
}
/// Of a ball that stands this high above the floor.
double caustic_above(double gap) {
  preset::Preset p = floor_scene(facing_quad("floor", {0, -1 - gap, 0}, {0, 1, 0}, 40));
  p.scene.lights = {lamp({0.3, -1, 0.2})};
  look(p, {2.5, 1, 3}, {0.3, -1, 0.2}, 30);
  return mean(layer_rgb(shown(p), "caustic")).y;
}

/// The part that a ball of this glass sends on of what meets it.
double sent(const preset::Preset& p) {
  const environment::BakedDirection baked = bake_of(p, {{0, -1, 0}}).baked.at(0);
  return baked.sent / baked.met;
}
preset::Preset black_glass() {
  preset::Preset p = ball_and("");
  p.scene.materials["glass"].dispersion.type = preset::Dispersion::Type::file;
  p.scene.materials["glass"].dispersion.file = write_constant_nk(cache().path() / "glass.yml", 1.5, 1e12);
  return p;
}
/// The mean over seeds, whose scatter is 0.0018 each.
double mean_sent(preset::Preset p) {
  constexpr unsigned seeds = 16;
  double sum = 0;
  for (p.seed = 1; p.seed <= seeds; ++p.seed) sum += sent(p);
  return sum / seeds;
}
/// The mean of Fresnel's reflectance over the ball's disc.
double reflected_by_ball() {
  double sum = 0;
  for (int i = 0; i < 10000; ++i) {
    const double h = (i + 0.5) / 10000;
    sum += 2 * h * environment::ball_rays(1.5, -1)(h).front().share / 10000;
  }
  return sum;
}

Outcome inside_the_ball() {
  preset::Preset p = ball_and("");
  even_light(p);
  look(p, {0.3, 0.1, 0.2}, {0, 1, -3}, 90);
  const job::Snapshot made = shown(p);
  const auto [low, high] = std::ranges::minmax(layer_rgb(made, "background"));
  return both(near(low, 2.25, 1e-3), near(high, 2.25, 1e-3));
}

/// A small white square below the ball's middle, facing it: its caustic, times what the lamp makes of it in the open.
double on_square(double below) {
  preset::Preset p = ball_and(facing_quad("square", {0, -below, 0}, {0, 1, 0}, 0.2 * below));
  p.scene.lights = {lamp({0, -1, 0})};
  const double eye = std::min(below, 0.5); // in the glass: radiance there is n^2 of that outside
  look(p, {0, eye, 0.3 * eye}, {0, -below, 0}, 1);
  return pi * mean(layer_rgb(shown(p), "caustic")).y;
}

/// The medium's light, the sum of a picture's.
double in_the_air(const std::string& setting) {
  preset::Preset p = under_lamp();
  preset::Preset q = floor_scene(floor_below, {"environment." + setting});
  q.scene.lights = p.scene.lights;
  return mean(layer_rgb(shown(q), "volume")).y;
}

image::Image grey(int width, int height, std::vector<std::string> channels, std::vector<float> texel) {
  image::Image picture{width, height, std::move(channels), {}, {}};
  for (int i = 0; i < width * height; ++i) picture.data.insert(picture.data.end(), texel.begin(), texel.end());
  return picture;
}

preset::Preset lamps_of(const std::vector<preset::Light>& lights) {
  preset::Preset p = under_lamp();
  p.scene.lights = lights;
  return p;
}

std::string sky_refusal(const std::string& what) {
  return (cache().path() / "sky.exr").string() + ": red of the texel in row 8, column 40 (from 0) " + what +
         "; expected radiances of 0 or more; mend the picture";
}

const Extreme cases[] = {
    {"OneChannelMap", "a map of one channel", "the same grey in three",
     [] {
       return same_picture(under_picture(grey(64, 32, {"Y"}, {1})),
                           under_picture(grey(64, 32, {"R", "G", "B"}, {1, 1, 1})), 0);
     }},
    {"FourChannelMap", "a map with alpha", "the same without",
     [] {
       return same_picture(under_picture(grey(64, 32, {"R", "G", "B", "A"}, {1, 1, 1, 0.5F})),
                           under_picture(grey(64, 32, {"R", "G", "B"}, {1, 1, 1})), 0);
     }},
    {"HalfMap", "a map of half floats", "the same grey in floats",
     [] {
       return same_picture(under_file("half.exr", half_exr(64, 32, 0x3c00)),
                           under_picture(grey(64, 32, {"R", "G", "B"}, {1, 1, 1})), 0);
     }},
    {"ByteMap", "a map of bytes, all white", "the same white in floats",
     [] {
       const std::vector<float> white(3 * 64 * 32, 1);
       return same_picture(under_file("white.png", image::png(64, 32, white)),
                           under_picture({64, 32, {"R", "G", "B"}, white, {}}), 0);
     }},
    {"OddMap", "a map of 7 x 5 texels", "said, and stretched",
     [] {
       return says(note(under_picture(grey(7, 5, {"R", "G", "B"}, {1, 1, 1}))),
                   "environment sky.exr: has 7 x 5 texels; a latitude-longitude picture is twice as wide as high, so "
                   "it is stretched to that");
     }},
    {"MapOfOneTexel", "a map of one texel", "an even sky",
     [] {
       return same_picture(under_picture(grey(1, 1, {"R", "G", "B"}, {1, 1, 1})), under_even_sky(), 1e-6);
     }},
    {"BlackMap", "a map all black", "no light: the bake alone is shown",
     [] {
       return exactly(runs(under_picture(grey(64, 32, {"R", "G", "B"}, {0, 0, 0})), "view") ? 1 : 0, 0);
     }},
    {"SunOfOneTexel", "one texel of 3e4 among 1: how far the lights' mean direction is from its middle, in degrees",
     "the texel is 5.6 degrees wide", [] { return at_most(off_the_sun(under_texel(3e4F)), 0.2); }},
    {"BrightestFloat", "one texel of 3e38 among 1, the same", "the same",
     [] { return at_most(off_the_sun(under_texel(3e38F)), 0.2); }},
    {"NanTexel", "a texel that is not a number", "refused",
     [] { return refuses(under_texel(NAN), sky_refusal("is not a number")); }},
    {"InfiniteTexel", "an infinite texel", "refused",
     [] { return refuses(under_texel(INFINITY), sky_refusal("is infinite")); }},
    {"NegativeTexel", "a texel of -1e6", "refused",
     [] { return refuses(under_texel(-1e6F), sky_refusal("is negative")); }},
    {"FaintSky", "a sky of radiance 1e-30", "1e-30 times that of 1",
     [] { return same_picture(under_even_sky(1e-30), under_even_sky(), 1e-5, 1e30); }},
    {"BrightSky", "a sky of radiance 1e9", "1e9 times that of 1",
     [] { return same_picture(under_even_sky(1e9), under_even_sky(), 1e-5, 1e-9); }},
    {"BrightLamp", "a lamp of 1e9 W/m^2", "1e9 times that of 1",
     [] {
       return same_picture(under_lamp({0.3, -1, 0.2}, 1e9), under_lamp(), 1e-5, 1e-9);
     }},
    {"BakedDirection", "a lamp along a baked direction, beside one that is 1e-7 off", "continuity",
     [] {
       return same_picture(under_lamp({0, -1, 0}), under_lamp({1e-7, -1, 1e-7}), 1e-3);
     }},
    {"FromBelow", "a lamp from right below, where the floor is not: along a baked direction, beside 1e-7 off",
     "continuity",
     [] {
       preset::Preset a = floor_scene(facing_quad("ceiling", {0, 2, 0}, {0, -1, 0}, 8)), b = a;
       look(a, {1.5, 1.2, 1.5}, {0, 2, 0}, 40);
       b.scene.camera = a.scene.camera;
       a.scene.lights = {lamp({0, 1, 0})};
       b.scene.lights = {lamp({1e-7, 1, 1e-7})};
       return same_picture(a, b, 1e-3);
     }},
    {"TwoLampsInOne", "two lamps in one direction, half as bright each", "one lamp",
     [] {
       const glm::dvec3 way(0.3, -1, 0.2);
       return same_picture(lamps_of({lamp(way, 0.5), lamp(way, 0.5)}), under_lamp(way), 1e-5);
     }},
    {"ThousandLamps", "a thousand lamps in one direction", "one lamp",
     [] {
       const glm::dvec3 way(0.3, -1, 0.2);
       return same_picture(lamps_of(std::vector<preset::Light>(1000, lamp(way, 0.001))), under_lamp(way), 1e-4);
     }},
    {"NoLights", "0 lights", "refused",
     [] {
       return refuses_setting("lights=0", "--set environment.lights=0: is 0; expected a whole number from 6 to 4096");
     }},
    {"TooManyLights", "100000 lights", "refused",
     [] {
       return refuses_setting("lights=100000",
                              "--set environment.lights=100000: is 100000; expected a whole number from 6 to 4096");
     }},
    {"NoSpheres", "0 spheres", "refused",
     [] {
       return refuses_setting("spheres=0", "--set environment.spheres=0: is 0; expected a whole number from 2 to 64");
     }},
    {"OneSphere", "1 sphere", "refused",
     [] {
       return refuses_setting("spheres=1", "--set environment.spheres=1: is 1; expected a whole number from 2 to 64");
     }},
    {"TooManySpheres", "1000 spheres", "refused",
     [] {
       return refuses_setting("spheres=1000",
                              "--set environment.spheres=1000: is 1000; expected a whole number from 2 to 64");
     }},
    {"NoDirections", "0 directions", "refused",
     [] {
       return refuses_setting("directions=0",
                              "--set environment.directions=0: is 0; expected a whole number from 26 to 386");
     }},
    {"TooManyDirections", "1538 directions", "refused",
     [] {
       return refuses_setting("directions=1538",
                              "--set environment.directions=1538: is 1538; expected a whole number from 26 to 386");
     }},
    {"ObjectBeyondItsSpheres", "a box that reaches beyond the largest sphere", "refused",
     [] {
       preset::Preset p =
           bake_preset(R"({"name": "cube", "shape": {"type": "box"}, "material": "glass"})", {"environment.reach=0.8"});
       return refuses(p, "own.json#/environment/reach: is 0.8: a sphere of radius 0.8 does not enclose object 'cube', "
                         "which reaches 0.866 from its "
                         "middle; expected at least 0.867");
     }},
    {"IndexOfOne", "n = 1, a floor at 1.5 radii: the caustic's power over that of the light that meets the ball",
     "all of it, straight on; a texel is 2 degrees", [] { return near(through_nothing(), 1, 0.04); }},
    {"TouchesTheFloor", "a ball that touches the floor", "one that is 1e-3 above it",
     [] { return near(caustic_above(0) / caustic_above(1e-3), 1, 0.02); }},
    {"BlackGlass", "glass with k = 1e12: what it sends on", "what its face reflects",
     [] { return near(mean_sent(black_glass()), reflected_by_ball(), 0.002); }},
    {"BlackMirror", "a mirror that reflects nothing: what it sends on", "nothing",
     [] {
       preset::Preset p = ball_and("", {"scene.materials.mirror.reflectance=0"});
       p.scene.objects[0].material = "mirror";
       return exactly(sent(p), 0);
     }},
    {"CameraInside", "a camera in the glass under an even sky: the darkest and the brightest number",
     "n^2: radiance over n^2 stays", inside_the_ball},
    {"ReceiverInside",
     "a square in the ball below its middle, at 0.5 and at 0.001 of its radius: its caustic over that right below the "
     "ball",
     "light inside is not known: that of the smallest sphere stands for it",
     [] {
       const double below = on_square(1.002) / (2.25 * 0.96); // that is seen through the ball's face
       return both(near(on_square(0.5) / below, 1, 0.05), near(on_square(1e-3) / below, 1, 0.05));
     }},
    {"DenseMedium", "a medium of extinction 1000: its light in the picture", "all is lost on the way",
     [] { return at_most(in_the_air("extinction=1000"), 1e-30); }},
    {"SharpPhase", "anisotropy 1", "refused",
     [] {
       return refuses_setting("anisotropy=1",
                              "--set environment.anisotropy=1: is 1; expected a number from -0.95 to 0.95");
     }},
    {"BlackMedium", "a medium that only absorbs", "no light in the air",
     [] {
       preset::Preset p = floor_scene(floor_below, {"environment.extinction=1", "environment.albedo=0"});
       p.scene.lights = {lamp({0, -1, 0})};
       return exactly(runs(p, "volume") ? 1 : 0, 0);
     }},
};

class EnvironmentExtremes : public testing::TestWithParam<Extreme> {
  CacheHome home_{cache().path()};
};
TEST_P(EnvironmentExtremes, IsRight) { expect_right(GetParam()); }
INSTANTIATE_TEST_SUITE_P(All, EnvironmentExtremes, testing::ValuesIn(cases),
                         [](const auto& test) { return test.param.name; });

} // namespace nephroid::extremes_test
