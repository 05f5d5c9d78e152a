// SPDX-License-Identifier: Apache-2.0
// Baked spheres under lights, on a device: bakes made by formula, looked up where the formula says what is there.
#include "environment/light/caustics.h"

#include "scene/ray.h"
#include "tests/environment/bakes.h"
#include "tests/environment/maps.h"

namespace nephroid::caustics_test {

using namespace nephroid::environment;
using scene::even_direction;

/// of(direction of the bake, radius, place on its sphere): E r^2 over size^2, linear sRGB.
template <class Of>
Bake made_bake(int side, int channels, const std::vector<double>& radii, const Of& of) {
  Bake bake;
  bake.map.side = side;
  bake.channels = channels;
  bake.size = 2;
  bake.radii = radii;
  test::bake_by(bake, of);
  return bake;
}

/// All texels of a cube of receivers, each at one distance of the list, or all at one.
class Cast {
public:
  /// bake outlives it.
  Cast(const Bake& bake, int size)
      : caustics(bake, test::bake_context()), size_(size),
        count_(6 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size)),
        list_(test::bake_context(), "list", count_), distances_(test::bake_context(), "distances", count_),
        normals_(test::bake_context(), "normals", count_), sums_(test::bake_context(), "caustics", 3 * count_) {
    std::vector<shared::float4> normals;
    for (std::size_t i = 0; i < count_; ++i) {
      const glm::vec3 normal(-direction(i));
      normals.push_back({normal.x, normal.y, normal.z, 0});
    }
    normals_.write(normals);
    std::vector<std::uint32_t> all(count_);
    std::iota(all.begin(), all.end(), 0U);
    list_.write(all);
  }

  /// E r^2: [texel].
  std::vector<glm::dvec3> at(double distance) {
    distances_.write(std::vector<float>(count_, static_cast<float>(distance)));
    caustics.cast({&list_, 0, static_cast<std::uint32_t>(count_), &distances_, &normals_, &sums_, size_});
    const std::vector<float> read = sums_.read();
    std::vector<glm::dvec3> values;
    for (std::size_t i = 0; i < count_; ++i) values.emplace_back(read[3 * i], read[3 * i + 1], read[3 * i + 2]);
    return values;
  }
  /// Of a texel's middle, unit.
  glm::dvec3 direction(std::size_t texel) const {
    const auto n = static_cast<std::size_t>(size_);
    const auto at = [&](std::size_t i) { return middle(static_cast<int>(i), size_); };
    return glm::normalize(position({static_cast<int>(texel / n / n), at(texel % n), at(texel / n % n)}));
  }

  Caustics caustics;

private:
  int size_;
  std::size_t count_;
  compute::Buffer<std::uint32_t> list_;
  compute::Buffer<float> distances_;
  compute::Buffer<shared::float4> normals_; ///< towards the middle
  compute::Buffer<float> sums_;
};

/// Largest and root mean square distance from of(direction), over the mean of it.
struct Off {
  double most = 0, mean = 0;
};
template <class Of>
Off off(const Cast& cast, const std::vector<glm::dvec3>& found, const Of& of) {
  double squares = 0, sum = 0;
  Off o;
  for (std::size_t t = 0; t < found.size(); ++t) {
    const glm::dvec3 expected = of(cast.direction(t));
    const double distance = glm::length(found[t] - expected);
    o.most = std::max(o.most, distance);
    squares += distance * distance;
    sum += glm::length(expected);
  }
  const auto count = static_cast<double>(found.size());
  return {o.most * count / sum, std::sqrt(squares / count) * count / sum};
}

/// Another colour, another place and another direction: another value, from 0.4 to 1.7.
glm::dvec3 smooth(std::size_t direction, const glm::dvec3& place) {
  const auto number = static_cast<int>(direction);
  const glm::dvec3 along = even_direction(number, 26), across = even_direction((number + 9) % 26, 26);
  return {1 + 0.3 * glm::dot(place, along) + 0.3 * std::pow(glm::dot(place, across), 2),
          1 + 0.5 * glm::dot(place, across), 0.8 + 0.4 * glm::dot(place, glm::cross(along, across))};
}

// The object is turned so that a texel's middle and a light that was baked are where the one texel of a cube's face
// looks.
TEST(Caustics, AtATexelsMiddleAreWhatWasBaked) {
  const Bake bake =
      made_bake(12, 3, {1, 1.5, 3}, [](std::size_t i, double r, const glm::dvec3& d) { return r * smooth(i, d); });
  Cast cast(bake, 1);
  ASSERT_EQ(cast.direction(0), glm::dvec3(1, 0, 0));
  const glm::dvec3 light(3, 2, 5);
  for (std::size_t texel = 0; texel < bake.map.texels(); texel += 5) {
    const std::size_t direction = texel % 26, sphere = texel % 3;
    const glm::dmat3 turn = shortest_turn(bake.map.direction(texel), {1, 0, 0});
    cast.caustics.set_lights({{turn * bake.directions[direction], light}}, turn);
    const glm::dvec3 expected = 4.0 * light * bake.at(direction, sphere, texel), found = cast.at(bake.radii[sphere])[0];
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-3 * expected[c]) << texel << " " << c;
  }
}

// Between texels and over all edges of the square there is no jump: what is found differs from a smooth formula by what
// straight lines between texels leave out.
TEST(Caustics, BetweenTexelsFollowTheFormula) {
  for (const int side : {16, 64})
    for (const int channels : {1, 3}) { // colours are those of blocks
      const auto of = [&](std::size_t i, const glm::dvec3& d) {
        return channels == 3 ? smooth(i, d) : glm::dvec3(smooth(i, d).x);
      };
      const Bake bake =
          made_bake(side, channels, {1, 2}, [&](std::size_t i, double, const glm::dvec3& d) { return of(i, d); });
      Cast cast(bake, 48);
      const glm::dmat3 turn = scene::rotation({33, -12, 71});
      cast.caustics.set_lights({{turn * bake.directions[7], glm::dvec3(1)}}, turn);
      const Off o = off(cast, cast.at(1), [&](const glm::dvec3& d) { return 4.0 * of(7, glm::transpose(turn) * d); });
      fmt::print("{} x {} texels, {} channels: {:.3f} % off, {:.3f} % at most\n", side, side, channels, 100 * o.mean,
                 100 * o.most);
      EXPECT_LT(o.mean, channels == 1 ? 0.003 + 0.1 / side : 0.005 + 0.75 / side);
      EXPECT_LT(o.most, channels == 1 ? 0.012 + 0.9 / side : 0.012 + 2.8 / side);
    }
}

// What an object without directions of its own does, as a ball, goes with the light, whichever directions were baked.
TEST(Caustics, OfABallGoWithTheLight) {
  const std::vector<glm::dvec3> baked = light_directions(26);
  const auto of_angle = [](double cosine) { return glm::dvec3(1 + 0.5 * cosine + 0.3 * cosine * cosine * cosine); };
  const Bake bake = made_bake(
      48, 1, {1, 2}, [&](std::size_t i, double, const glm::dvec3& d) { return of_angle(glm::dot(d, baked[i])); });
  Cast cast(bake, 24);
  const glm::dmat3 turn = scene::rotation({-61, 140, 8});
  Off all;
  for (int i = 0; i < 20; ++i) {
    const glm::dvec3 light = even_direction(i, 20);
    cast.caustics.set_lights({{light, glm::dvec3(1)}}, turn);
    const Off o = off(cast, cast.at(1.5), [&](const glm::dvec3& d) { return 4.0 * of_angle(glm::dot(d, light)); });
    all = {std::max(all.most, o.most), std::max(all.mean, o.mean)};
  }
  fmt::print("a ball's: {:.3f} % off, {:.3f} % at most\n", 100 * all.mean, 100 * all.most);
  EXPECT_LT(all.mean, 0.006);
  EXPECT_LT(all.most, 0.05); // where the map is folded
}

// Between four baked directions: their values, each turned, by the weights.
TEST(Caustics, BetweenDirectionsAreWeighted) {
  const std::vector<glm::dvec3> baked = light_directions(26);
  const Bake bake = made_bake(48, 3, {1, 2}, [](std::size_t i, double, const glm::dvec3& d) { return smooth(i, d); });
  Cast cast(bake, 24);
  const glm::dvec3 light = glm::normalize(glm::dvec3(0.4, -1, 0.7));
  cast.caustics.set_lights({{light, {1, 2, 3}}}, glm::dmat3(1));
  const std::vector<NearDirection> near = near_directions(light, 26);
  ASSERT_EQ(near.size(), 4u);
  const Off o = off(cast, cast.at(1), [&](const glm::dvec3& d) {
    glm::dvec3 sum(0);
    for (const NearDirection& n : near) {
      const auto i = static_cast<std::size_t>(n.direction);
      sum += n.weight * smooth(i, shortest_turn(light, baked[i]) * d);
    }
    return glm::dvec3(4, 8, 12) * sum;
  });
  EXPECT_LT(o.mean, 0.013);
  EXPECT_LT(o.most, 0.05);
}

TEST(Caustics, BetweenSpheresAreLinear) {
  const std::vector<double> radii{1, 1.5, 3, 4};
  // Each is 255 steps that 8 bits of a float hold.
  const auto of_radius = [](double r) { return 255.0 / 256 * (r < 1.2 ? 1.0 : r < 2 ? 3.0 : r < 3.5 ? 0.5 : 2.0); };
  const Bake bake =
      made_bake(8, 1, radii, [&](std::size_t, double r, const glm::dvec3&) { return glm::dvec3(of_radius(r)); });
  Cast cast(bake, 2);
  cast.caustics.set_lights({{even_direction(3, 10), {1, 10, 0.1}}}, glm::dmat3(1));
  const auto expect = [&](double distance, double value) {
    for (const glm::dvec3& found : cast.at(distance)) {
      EXPECT_NEAR(found.x, 4 * value, 1e-5 * value) << distance;
      EXPECT_NEAR(found.y, 40 * value, 1e-4 * value) << distance;
      EXPECT_NEAR(found.z, 0.4 * value, 1e-6 * value) << distance;
    }
  };
  for (std::size_t i = 0; i + 1 < radii.size(); ++i)
    for (const double part : {0.0, 0.25, 0.5, 0.999, 1.0})
      expect(radii[i] + part * (radii[i + 1] - radii[i]),
             (1 - part) * of_radius(radii[i]) + part * of_radius(radii[i + 1]));
  for (const double beyond : {4.0, 4.001, 10.0, 1e6}) expect(beyond, of_radius(4));         // the inverse square
  for (const double within : {0.01, 0.999}) expect(within, within * within * of_radius(1)); // E stays
  for (const glm::dvec3& found : cast.at(std::numeric_limits<double>::infinity()))
    EXPECT_EQ(found, glm::dvec3(0)); // nothing is there
}

TEST(Caustics, LightsAdd) {
  const Bake bake =
      made_bake(16, 3, {1, 2}, [](std::size_t i, double r, const glm::dvec3& d) { return r * smooth(i, d); });
  Cast cast(bake, 6);
  const DistantLight a{even_direction(3, 10), {1, 2, 3}}, b{even_direction(7, 10), {0.5, 0, 4}};
  const auto of = [&](const std::vector<DistantLight>& lights) {
    cast.caustics.set_lights(lights, scene::rotation({10, 20, 30}));
    return cast.at(1.25);
  };
  // More lights than before, fewer, and black ones.
  const auto first = of({a}), both = of({a, b}), second = of({b}), again = of({{a.direction, glm::dvec3(0)}, a});
  EXPECT_EQ(again, first);
  for (std::size_t t = 0; t < both.size(); ++t)
    EXPECT_LT(glm::distance(both[t], first[t] + second[t]), 1e-5 * glm::length(both[t]));
}

// Where all light is hidden, or none is lit, nothing is cast: from the beginning, and after there was light.
TEST(Caustics, WithoutLightAreBlack) {
  const Bake bake = made_bake(8, 1, {1, 2}, [](std::size_t, double, const glm::dvec3&) { return glm::dvec3(1); });
  Cast cast(bake, 2);
  const std::vector<glm::dvec3> black(24, glm::dvec3(0));
  const auto expect_black = [&](const std::vector<DistantLight>& lights) {
    cast.caustics.set_lights(lights, glm::dmat3(1));
    EXPECT_EQ(cast.at(1), black);
  };
  expect_black({});
  cast.caustics.set_lights({{{0, -1, 0}, glm::dvec3(1)}}, glm::dmat3(1));
  EXPECT_NE(cast.at(1), black);
  expect_black({{{0, -1, 0}, glm::dvec3(0)}});
}

// However an even sky is cut, all its light meets the ball, and on all around lies what left the ball: E r^2 over all
// directions is the power.
TEST(Caustics, OfAnEvenSkyHaveItsPower) {
  const Bake bake = test::bake_of(test::bake_preset(
      test::glass_ball, {"environment.resolution=24", "environment.spheres=2", "environment.photons=10000"}));
  const CubeMap sky = make_cube_map(test::uniform_map(64, 32));
  constexpr int size = 64;
  Cast cast(bake, size);
  double sent = 0;
  for (const BakedDirection& direction : bake.baked)
    sent += 4 * direction.sent / static_cast<double>(bake.baked.size());
  for (const int q : {8, 24, 64, 256}) {
    const Segmentation lights = segment(sky, {.lights = q});
    cast.caustics.set_lights(environment_lights(whole_lights(lights), 0), glm::dmat3(1));
    const std::vector<glm::dvec3> found = cast.at(10);
    double power = 0, squares = 0;
    for (std::size_t t = 0; t < found.size(); ++t) {
      const CubePoint at = met_point(cast.direction(t));
      const int x = texel_of(at.s, size), y = texel_of(at.t, size);
      const double sr = solid_angle({x, y, x + 1, y + 1}, size);
      power += sr * found[t].y;
      squares += sr / (4 * test::pi) * std::pow(found[t].y / test::pi - 1, 2);
    }
    fmt::print("q = {}: power over that sent {:.4f}; E r^2 {:.1f} % from even\n", q, power / (4 * test::pi * sent),
               100 * std::sqrt(squares));
    EXPECT_NEAR(power, 4 * test::pi * sent, 0.005 * power) << q;
  }
}

// The object turned with its light: the same, turned. A quarter about y takes the cube's texels to each other.
TEST(Caustics, TurnWithTheObjectAndItsLight) {
  const Bake bake =
      made_bake(24, 3, {1, 2}, [](std::size_t i, double r, const glm::dvec3& d) { return r * smooth(i, d); });
  constexpr int size = 8;
  Cast cast(bake, size);
  const glm::dmat3 quarter = scene::rotation({0, 90, 0}), before = scene::rotation({20, 70, -30});
  const DistantLight light{even_direction(4, 9), {1, 2, 3}};
  const auto of = [&](const glm::dmat3& turn) {
    cast.caustics.set_lights({{turn * light.direction, light.irradiance}}, turn * before);
    return cast.at(1.3);
  };
  const std::vector<glm::dvec3> a = of(glm::dmat3(1)), b = of(quarter);
  double changes = 0;
  for (std::size_t t = 0; t < a.size(); ++t) {
    const CubePoint met = met_point(quarter * cast.direction(t));
    const std::size_t turned_texel =
        (static_cast<std::size_t>(met.face) * size + static_cast<std::size_t>(texel_of(met.t, size))) * size +
        static_cast<std::size_t>(texel_of(met.s, size));
    EXPECT_LT(glm::distance(a[t], b[turned_texel]), 1e-4 * glm::length(a[t])) << t;
    changes = std::max(changes, glm::distance(a[t], b[t]));
  }
  EXPECT_GT(changes, 1);
}

TEST(Caustics, OneChannelIsThreeAlike) {
  const auto of = [](std::size_t i, double r, const glm::dvec3& d) { return glm::dvec3(r * smooth(i, d).x); };
  const Bake one_channel = made_bake(16, 1, {1, 2}, of), three_channels = made_bake(16, 3, {1, 2}, of);
  Cast one(one_channel, 8), three(three_channels, 8);
  const std::vector<DistantLight> lights{{even_direction(4, 9), {1, 2, 3}}};
  one.caustics.set_lights(lights, glm::dmat3(1));
  three.caustics.set_lights(lights, glm::dmat3(1));
  const std::vector<glm::dvec3> a = one.at(1.7), b = three.at(1.7);
  for (std::size_t t = 0; t < a.size(); ++t) EXPECT_LT(glm::distance(a[t], b[t]), 1e-5 * glm::length(a[t]));
}

} // namespace nephroid::caustics_test
