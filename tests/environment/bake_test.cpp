// SPDX-License-Identifier: Apache-2.0
// Baked spheres against closed forms and against rays in double precision: a ball of glass, of nothing, a mirror;
// energy; a turned object; colours. Bakes on disk whose header makes no sense: refused before anything is allocated for
// them.
#include "base/hashed_bytes.h"
#include "environment/bake/bake.h"
#include "environment/checks.h"
#include "tests/environment/bakes.h"
#include "tests/support/test.h"

namespace nephroid::bake_test {

using environment::Bake;
using std::numbers::pi;
using testing::HasSubstr;

/// Of a step, which is the upper half of a float: 8 bits. Texels with one, two, ... photons are rounded alike, so that
/// it does not average out.
constexpr double half_rounding = 0x1p-9;

const glm::dvec3 slanted = glm::normalize(glm::dvec3(0.3, -0.8, 0.5));

// All spheres beyond the surface get the same, which is what left the ball: E r^2 is a power per solid angle.
TEST(Bake, EverySphereGetsTheSamePower) {
  const Bake bake = bake_of(bake_preset(glass_ball, {"environment.spheres=8"}), {slanted});
  for (std::size_t i = 0; i < bake.radii.size(); ++i)
    EXPECT_NEAR(power_through(bake, 0, i).x, bake.baked[0].sent, half_rounding * bake.baked[0].sent) << i;
  EXPECT_NEAR(bake.baked[0].sent + bake.baked[0].lost, bake.baked[0].met, 1e-9);
  EXPECT_NEAR(bake.baked[0].met, pi / 4, 1e-5); // of a square of side 2, as much as the ball's disc
  EXPECT_EQ(bake.channels, 1);
}

// The same for a box, whose corners the inner spheres cut: those beyond the corners get all of it, the inner ones less.
TEST(Bake, SpheresInsideTheCornersGetWhatIsOutsideOfTheBox) {
  const std::string box = R"({"name": "box", "shape": {"type": "box", "size": [2, 1, 1.5]}, "material": "glass"})";
  const preset::Preset p =
      bake_preset(box, {"environment.radii=uniform", "environment.reach=1", "environment.spheres=9"});
  const Bake bake = bake_of(p, {slanted});
  EXPECT_NEAR(bake.radii.front(), 0.5, 0.001); // the nearest sides
  const double corner = glm::length(glm::dvec3(1, 0.5, 0.75));
  for (std::size_t i = 0; i < bake.radii.size(); ++i) {
    const double power = power_through(bake, 0, i).x;
    if (bake.radii[i] > corner)
      EXPECT_NEAR(power, bake.baked[0].sent, half_rounding * bake.baked[0].sent) << bake.radii[i];
    else
      EXPECT_LT(power, 0.999 * bake.baked[0].sent) << bake.radii[i];
  }
}

// Two walls of a mirror that stand on each other: light from one side meets both. What goes from wall to wall is
// outside of the spheres that enclose both, so these get what leaves the mirror and no more.
TEST(Bake, LightThatMeetsTheObjectAgainGoesNoFarther) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("walls.obj", "v 0 0 0\nv 0 2 0\nv 2 2 0\nv 2 0 0\nv 0 2 2\nv 0 0 2\nf 1 4 3 2\nf 1 2 5 6\n");
  const std::string object = R"({"name": "walls", "mesh": ")" + file + R"(", "material": "mirror"})";
  const Bake bake = bake_of(bake_preset(object, {"environment.spheres=4"}), {glm::normalize(glm::dvec3(-1, 0.1, -1))});
  EXPECT_GT(bake.baked[0].met, 0.5);
  for (std::size_t i = 2; i < 4; ++i)
    EXPECT_NEAR(power_through(bake, 0, i).x, bake.baked[0].sent, half_rounding * bake.baked[0].sent) << i;
}

// Light goes straight on through a ball with n = 1: on a sphere it meets with the cosine of the angle from its axis, so
// E is that cosine for sin(angle) < 1 / r, and 0 elsewhere. The fluence would be 1.
TEST(Bake, IsTheIrradianceOnTheSphere) {
  preset::Preset p =
      bake_preset(glass_ball, {"scene.materials.glass.dispersion=1", "environment.resolution=64",
                               "environment.spheres=3", "environment.reach=1", "environment.photons=2000000"});
  const Bake bake = bake_of(p, {slanted});
  for (std::size_t i = 0; i < 3; ++i) {
    const double r = bake.radii[i];
    int texels = 0;
    for (std::size_t t = 0; t < bake.map.texels(); ++t) {
      const double cosine = glm::dot(bake.map.direction(t), slanted), sine = std::sqrt(1 - cosine * cosine);
      if (cosine < 0.3 || std::abs(sine * r - 1) < 0.1) continue; // texels across the edge, or nearly along the light
      const double expected = sine * r < 1 ? cosine * r * r / 4 : 0;
      EXPECT_NEAR(bake.at(0, i, t).x, expected, 0.1 * expected) << "radius " << r << ", cosine " << cosine;
      ++texels;
    }
    EXPECT_GT(texels, 100);
  }
}

// Light straight down on a flat mirror below the middle goes straight up. On a sphere of radius r it is E = |cos psi|
// where it comes in from below, which is farther from the axis than where the sphere cuts the mirror, and where it
// leaves above. A speck above the mirror's corner makes the middle of the box about both the middle of the spheres.
TEST(Bake, MarksWhereLightComesInAndWhereItLeaves) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("m.obj", "v -2 -2 -1\nv 2 -2 -1\nv 2 2 -1\nv -2 2 -1\nv 1.9 1.9 1\nv 1.91 1.9 1\nv 1.9 1.91 1\n"
                            "f 1 2 3 4\nf 5 6 7\n");
  const std::string object = R"({"name": "mirror", "mesh": ")" + file + R"(", "material": "mirror"})";
  const Bake bake =
      bake_of(bake_preset(object, {"environment.resolution=32", "environment.spheres=5", "environment.radii=uniform",
                                   "environment.reach=1", "environment.photons=2000000"}),
              {{0, 0, -1}});
  const double r = bake.radii[1], cut = std::sqrt(r * r - 1);
  ASSERT_NEAR(r, 1.75, 0.01);
  int below = 0, above = 0;
  for (std::size_t t = 0; t < bake.map.texels(); ++t) {
    const glm::dvec3 d = bake.map.direction(t);
    const double from_axis = r * std::hypot(d.x, d.y);
    if (std::abs(d.z) < 0.2 || (d.z < 0 && std::abs(from_axis - cut) < 0.25))
      continue; // texels nearly along the light, or on the edge
    const bool lit = d.z > 0 || from_axis > cut;
    EXPECT_NEAR(bake.at(0, 1, t).x, lit ? std::abs(d.z) * r * r / 16 : 0, 0.02 * r * r / 16)
        << d.x << " " << d.y << " " << d.z;
    if (lit) ++(d.z > 0 ? above : below);
  }
  EXPECT_GT(below, 50);
  EXPECT_GT(above, 300);
}

// Parallel light on a mirror ball of radius 1 that meets it at the angle i from its axis is turned back at 2 i. From
// there the sphere of radius r is crossed at psi = 2 i - gamma, sin(gamma) = sin(i) / r (law of sines), so of the power
// sin(i) cos(i) di through a ring of azimuth 1, each solid angle sin(psi) dpsi gets sin(i) cos(i) / (sin(psi) (2 -
// cos(i) / (r cos(gamma)))): far away 1/4, the same everywhere.
TEST(Bake, AMirrorBallIsAsTheLawOfSinesHasIt) {
  const std::string ball = R"({"name": "ball", "shape": {"type": "sphere", "radius": 1}, "material": "mirror"})";
  const Bake bake = bake_of(bake_preset(ball, {"environment.resolution=40", "environment.spheres=4",
                                               "environment.reach=40", "environment.photons=2000000"}),
                            {slanted});
  EXPECT_NEAR(bake.baked[0].sent, pi / 4, 1e-5);
  for (std::size_t sphere = 1; sphere < 4; ++sphere) {
    const double r = bake.radii[sphere];
    const auto psi_of = [&](double i) { return 2 * i - std::asin(std::sin(i) / r); };
    const auto expected = [&](std::size_t texel) {
      const double psi = std::acos(-glm::dot(bake.map.direction(texel), slanted));
      if (psi > psi_of(pi / 2)) return 0.0;
      double low = 0, high = pi / 2;
      for (int k = 0; k < 60; ++k) (psi_of((low + high) / 2) < psi ? low : high) = (low + high) / 2;
      const double gamma = std::asin(std::sin(low) / r);
      return std::sin(low) * std::cos(low) / (std::sin(psi) * (2 - std::cos(low) / (r * std::cos(gamma)))) /
             4; // over size^2
    };
    EXPECT_LT(relative_distance(bake, 0, sphere, expected), 0.03) << r;
  }
}

// A mirror that takes half of the light of every wavelength has one channel, a blue one three, and glass that does not
// disperse one.
TEST(Bake, MirrorsTakeTheirPart) {
  const auto mirror = [](const std::string& reflectance) {
    const std::string ball = R"({"name": "ball", "shape": {"type": "sphere", "radius": 1}, "material": "mirror"})";
    return bake_of(
        bake_preset(ball, {"scene.materials.mirror.reflectance=" + reflectance, "environment.resolution=32"}),
        {slanted});
  };
  const Bake grey = mirror("0.5");
  EXPECT_EQ(grey.channels, 1);
  EXPECT_NEAR(grey.baked[0].sent, 0.5 * pi / 4, 1e-5);
  EXPECT_NEAR(grey.baked[0].absorbed, 0.5 * pi / 4, 1e-5);
  EXPECT_NEAR(power_through(grey, 0, 15).x, 0.5 * pi / 4, 1e-4);
  const Bake blue = mirror(R"("blue")");
  EXPECT_EQ(blue.channels, 3);
  const glm::dvec3 rgb = power_through(blue, 0, 15);
  EXPECT_GT(rgb.z, 1.5 * rgb.y);
  EXPECT_GT(rgb.z, 2 * rgb.x);
}

// How far the light in front of a ball is spread about its axis, channel by channel: the sum of power times 1 -
// cos(angle) over the directions whose cosine is above 0.2. For each wavelength from the rays of a ball of its index,
// in double.
glm::dvec3 ball_spread(const optics::Spectrum& n, double r) {
  constexpr int rings = 500, step_nm = 5;
  glm::dvec3 spread(0), white(0);
  for (int w = 0; w < optics::wavelength_count; w += step_nm) {
    optics::Spectrum one{};
    const auto i = static_cast<std::size_t>(w);
    for (const optics::Spectrum& primary : optics::primary_spectra()) one[i] += primary[i];
    const optics::Colour rgb = optics::xyz_to_linear_srgb(optics::to_xyz(one));
    double of_wavelength = 0;
    for (int k = 0; k < rings; ++k) {
      const double h = (k + 0.5) / rings;
      for (const optics::BallRay& ray : environment::ball_rays(n[i])(h)) {
        const double cosine = environment::crossing(ray, r).x / r;
        if (cosine > 0.2) of_wavelength += 2 * pi * h / rings * ray.share / 4 * (1 - cosine);
      }
    }
    white += glm::dvec3(rgb[0], rgb[1], rgb[2]);
    spread += of_wavelength * glm::dvec3(rgb[0], rgb[1], rgb[2]);
  }
  return spread / white;
}

// White light stays white in all: each channel has all of the power, within the noise of wavelengths drawn by chance.
// Its colours lie where the index of each wavelength says.
TEST(Bake, DispersionMovesColoursAndKeepsTheirSum) {
  const preset::Preset p =
      bake_preset(glass_ball, {R"(scene.materials.glass.dispersion={"type": "cauchy", "coefficients": [1.4, 0.05]})",
                               "environment.resolution=64", "environment.photons=2000000"});
  const environment::Caster caster = environment::make_caster(p);
  const Bake bake = bake_of(p, {slanted});
  ASSERT_EQ(bake.channels, 3);
  const glm::dvec3 power = power_through(bake, 0, 15),
                   expected = ball_spread(caster.scene.materials[0].n, bake.radii[15]);
  glm::dvec3 spread(0);
  for (std::size_t t = 0; t < bake.map.texels(); ++t)
    if (const double cosine = glm::dot(bake.map.direction(t), slanted); cosine > 0.2)
      spread += bake.at(0, 15, t) * bake.map.solid_angle() * (1 - cosine);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(power[c], pi / 4, 0.002) << c;
    EXPECT_NEAR(spread[c], expected[c], 0.008 * expected[c]) << c; // colours are rounded
  }
  EXPECT_GT(std::abs(expected.z - expected.x), 0.02 * expected.x); // far more than the channels may be off
}

// A tetrahedron with no symmetry, and the same turned by a quarter about z, which takes the 26 directions to each other
// and the map's texels to each other.
TEST(Bake, ATurnedMeshHasTurnedSpheres) {
  const TemporaryFolder folder;
  const std::vector<glm::dvec3> corners{{1, 0.2, -0.3}, {-0.5, 0.9, 0.1}, {-0.4, -0.8, 0.2}, {0.1, 0.1, 1}};
  const auto turned = [](const glm::dvec3& v) { return glm::dvec3(-v.y, v.x, v.z); };
  const auto mesh_of = [&](bool turns, const std::string& name) {
    std::string text;
    for (const glm::dvec3& c : corners) {
      const glm::dvec3 v = turns ? turned(c) : c;
      text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
    }
    return folder.write(name, text + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  };
  const auto bake = [&](const std::string& file, const glm::dvec3& light) {
    const std::string object = R"({"name": "stone", "mesh": ")" + file + R"(", "material": "glass"})";
    return bake_of(
        bake_preset(object, {"environment.resolution=12", "environment.spheres=4", "environment.photons=1000000"}),
        {light});
  };
  for (const std::size_t i : {std::size_t{0}, std::size_t{4}, std::size_t{17}}) {
    const glm::dvec3 light = environment::light_directions(26)[i];
    const Bake a = bake(mesh_of(false, "a.obj"), light), b = bake(mesh_of(true, "b.obj"), turned(light));
    EXPECT_NEAR(a.baked[0].met, b.baked[0].met, 0.002 * a.baked[0].met);
    for (std::size_t sphere = 1; sphere < 4; ++sphere)
      EXPECT_LT(
          relative_distance(a, 0, sphere,
                            [&](std::size_t t) { return b.at(0, sphere, b.map.texel(turned(a.map.direction(t)))).x; }),
          0.03)
          << "direction " << i << ", sphere " << sphere;
    EXPECT_GT(relative_distance(a, 0, 3, [&](std::size_t t) { return b.at(0, 3, t).x; }),
              0.2); // it is not all the same
  }
}

// What the preset does to the object's place changes no bit; a scale does.
TEST(Bake, IsOfTheObjectWhereverItStands) {
  const auto key_and_bake = [](const std::string& transform) {
    const std::string box =
        R"({"name": "box", "shape": {"type": "box", "size": [2, 1, 1.5]}, "material": "glass", "transform": )" +
        transform + "}";
    const preset::Preset p = bake_preset(box, {"environment.resolution=16", "environment.photons=10000"});
    return std::pair(environment::bake_key(p, environment::make_caster(p)), bake_of(p, {slanted}));
  };
  const auto [key, bake] = key_and_bake("{}");
  const auto [moved_key, moved] = key_and_bake(R"({"translate": [3, -70, 0.1], "rotate_deg": [10, 20, 30]})");
  const auto [scaled_key, scaled] = key_and_bake(R"({"scale": [1, 1.1, 1]})");
  EXPECT_EQ(key, moved_key);
  EXPECT_EQ(bake.texels, moved.texels);
  EXPECT_EQ(bake.blocks, moved.blocks);
  EXPECT_NE(key, scaled_key);
  EXPECT_NE(bake.texels, scaled.texels);
}

// The border of a map shows texels that are beside its edge on the sphere, and a bake has there what these have.
TEST(Bake, GoesOnBeyondTheEdgesOfItsMap) {
  const Bake bake = bake_of(bake_preset(glass_ball, {"environment.resolution=24", "environment.spheres=3"}), {slanted});
  const std::size_t stored = bake.map.stored_texels();
  ASSERT_EQ(bake.texels.size(), 3 * stored);
  const double across = std::sqrt(bake.map.solid_angle());
  for (std::size_t i = 0; i < stored; ++i) {
    const std::size_t row = std::clamp<std::size_t>(i / 26, 1, 24), column = std::clamp<std::size_t>(i % 26, 1, 24),
                      inside = row * 26 + column, texel = bake.map.texel_of_stored(i),
                      inside_texel = bake.map.texel_of_stored(inside);
    EXPECT_LT(glm::distance(bake.map.direction(texel), bake.map.direction(inside_texel)), 2.5 * across) << i;
    EXPECT_EQ(bake.map.stored_texel(inside_texel), inside);
    for (std::size_t map = 0; map < 3; ++map) {
      const auto step = [&](std::size_t texel_of_map) {
        const std::uint32_t code =
            bake.blocks[map * bake.map_blocks() + bake.map.blocks() + bake.map.block(texel_of_map)];
        return std::bit_cast<float>(code << 16);
      };
      EXPECT_NEAR(step(i) * bake.texels[map * stored + i], bake.at(0, map, texel).x,
                  1.01 * (step(i) + step(bake.map.stored_texel(texel))) / 2);
    }
  }
}

// Light along a flat mirror meets nothing of it.
TEST(Bake, OfAnObjectThatNoPhotonMeetsIsBlack) {
  const std::string quad = R"({"name": "quad", "shape": {"type": "quad", "size": [2, 1, 2]}, "material": "mirror"})";
  const Bake bake =
      bake_of(bake_preset(quad, {"environment.resolution=16", "environment.spheres=3", "environment.photons=1000"}),
              {{1, 0, 0}});
  EXPECT_EQ(bake.baked[0].met, 0);
  EXPECT_EQ(bake.baked[0].sent, 0);
  EXPECT_EQ(std::ranges::count(bake.texels, 0), static_cast<std::ptrdiff_t>(bake.texels.size()));
  for (std::size_t t = 0; t < bake.map.texels();
       ++t) { // goes straight away from the middle, as in its block's last texel
    const std::size_t way = bake.blocks[bake.map.block(bake.map.stored_texel(t))];
    EXPECT_LT(glm::distance(Bake::way_map.direction(way), bake.map.direction(t)),
              4.5 * std::sqrt(bake.map.solid_angle()));
  }
}

TEST(Bake, KnowsItsTimeLeftAfterADirection) {
  const environment::BakeTask task =
      environment::make_task(bake_preset(glass_ball, {"environment.resolution=16", "environment.photons=1000"}));
  environment::Baker baker(task, bake_context());
  EXPECT_EQ(baker.seconds_left(), std::nullopt);
  while (baker.bake().baked.empty()) baker.advance();
  EXPECT_GT(baker.seconds_left().value(), 0);
  while (!baker.finished()) baker.advance();
  EXPECT_EQ(baker.seconds_left(), 0);
}

class BakeFile : public testing::Test {
protected:
  static constexpr environment::BakeIdentity identity{.key = 7, .kernels = 9};

  BakeFile() {
    Bake bake;
    bake.map.side = 2;
    bake.radii = {1, 2};
    test::bake_by(bake, [](std::size_t, double, const glm::dvec3&) { return glm::dvec3(3); });
    environment::write_bake(file, identity, bake);
    bytes = read_file(file);
  }

  /// Number `at` of the header's counts (directions, spheres, side, channels) is another one, and `length` bytes follow
  /// the header.
  std::string refusal(std::size_t at, std::uint64_t count, std::size_t length) const {
    constexpr std::size_t counts = 40, header = 80;
    std::string changed = bytes.substr(0, header);
    std::memcpy(changed.data() + counts + 8 * at, &count, sizeof count);
    changed.resize(header + length);
    PieceHash hash;
    hash.add(std::as_bytes(std::span(changed)));
    const std::uint64_t value = hash.value();
    changed.append(reinterpret_cast<const char*>(&value), sizeof value);
    write_file_whole(file, changed);
    return test::refusal_of([&] { environment::read_bake(file, identity); });
  }

  test::TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "a.bake";
  std::string bytes;
};

TEST_F(BakeFile, IsReadAsItWasWritten) { EXPECT_EQ(environment::read_bake(file, identity).baked.size(), 26u); }

// Nothing of the file is needed once it is read: not if somebody cuts it then.
TEST_F(BakeFile, MayBeCutWhileItsBakeIsInUse) {
  const Bake bake = environment::read_bake(file, identity);
  std::filesystem::resize_file(file, 1);
  for (std::size_t t = 0; t < bake.map.texels(); ++t) EXPECT_NEAR(bake.at(25, 1, t).y, 3, 0.01);
  EXPECT_THAT(test::refusal_of([&] { environment::read_bake(file, identity); }), HasSubstr("a.bake: is no bake"));
}

TEST_F(BakeFile, HasCountsThatABakeCanHave) {
  EXPECT_THAT(refusal(0, 0, 16),
              HasSubstr("a.bake: says that it has 0 directions, 2 spheres, 2 x 2 texels and 1 channels"));
  EXPECT_THAT(refusal(0, 27, 16 + 27 * 32 + 27 * 2 * 4 * 4), HasSubstr("27 directions"));
  EXPECT_THAT(refusal(1, 0, 26 * 32), HasSubstr("0 spheres"));
  EXPECT_THAT(refusal(2, 0, 16 + 26 * 32), HasSubstr("0 x 0 texels"));
  // 2^32 x 2^32 texels are 0 of them modulo 2^64, so that the length is right.
  EXPECT_THAT(refusal(2, std::uint64_t{1} << 32, 16 + 26 * 32), HasSubstr("4294967296 x 4294967296 texels"));
  EXPECT_THAT(refusal(3, 2, 16 + 26 * 32 + 26 * 2 * 4 * 6), HasSubstr("2 channels"));
}

} // namespace nephroid::bake_test
