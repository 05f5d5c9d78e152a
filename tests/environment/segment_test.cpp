// SPDX-License-Identifier: Apache-2.0
// Segmentations: both methods against a plain program that tries every cut, flux and tiling, closed forms, and the
// extremes.
#include "environment/segment/irradiance.h"
#include "environment/segment/segment.h"
#include "tests/environment/maps.h"
#include "tests/support/pictures.h"

namespace nephroid::segment_test {

using namespace nephroid::environment;

const std::vector<SegmentMethod> methods{SegmentMethod::variance, SegmentMethod::thesis};
const std::vector<SegmentWeights> all_weights{SegmentWeights::solid_angle, SegmentWeights::texel};

CubeMap black_cube(int size) { return {size, std::vector<double>(18 * static_cast<std::size_t>(size * size), 0.0)}; }

/// White light; of(face, x, y): the flux.
template <class Of>
CubeMap made_cube(int size, const Of& of) {
  CubeMap cube = black_cube(size);
  for (int face = 0; face < face_count; ++face)
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x)
        for (std::size_t c = 0; c < 3; ++c) cube.flux[3 * cube.texel(face, x, y) + c] = of(face, x, y);
  return cube;
}

CubeMap hashed_cube(int size, unsigned seed, double decades) {
  return made_cube(
      size, [=](int face, int x, int y) { return std::pow(10, decades * test::hashed(x + 31 * face, y, 0, seed)); });
}

glm::dvec3 texel_direction(const CubeMap& cube, int face, int x, int y) {
  return glm::normalize(position({face, middle(x, cube.size), middle(y, cube.size)}));
}

/// That every texel is in just one region, and all flux in the lights.
void expect_whole(const CubeMap& cube, const Segmentation& segmentation) {
  std::vector<int> times(cube.flux.size() / 3);
  double solid_angles = 0;
  glm::dvec3 flux{0}, right{0};
  for (const auto* regions : {&segmentation.lights, &segmentation.dropped})
    for (const Region& region : *regions) {
      for (int y = region.rect.y0; y < region.rect.y1; ++y)
        for (int x = region.rect.x0; x < region.rect.x1; ++x) ++times[cube.texel(region.face, x, y)];
      solid_angles += region.solid_angle_sr;
      EXPECT_NEAR(glm::length(region.direction), 1, 1e-15);
      const CubePoint met = met_point(region.direction);
      EXPECT_EQ(met.face, region.face);
      EXPECT_THAT(met.s, testing::AllOf(testing::Ge(border(region.rect.x0, cube.size)),
                                        testing::Le(border(region.rect.x1, cube.size))));
      EXPECT_THAT(met.t, testing::AllOf(testing::Ge(border(region.rect.y0, cube.size)),
                                        testing::Le(border(region.rect.y1, cube.size))));
    }
  EXPECT_EQ(std::count(times.begin(), times.end(), 1), static_cast<std::ptrdiff_t>(times.size()))
      << "regions overlap or leave a gap";
  EXPECT_NEAR(solid_angles, 4 * test::pi, 1e-11);
  for (std::size_t i = 0; i < times.size(); ++i) right += cube.flux_of(i);
  for (const Region& light : segmentation.lights) flux += light.flux;
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(flux[c], right[c], 1e-12 * right[c]);
    EXPECT_NEAR(segmentation.total_flux[c], right[c], 1e-12 * right[c]);
  }
}

/// The same by trying all: sums anew for each cut, variance as squared distances from the mean, the best region by
/// looking at all.
class PlainSegmenter {
public:
  PlainSegmenter(const CubeMap& cube, SegmentMethod method, SegmentWeights weights)
      : cube_(cube), method_(method), weights_(weights) {}

  std::vector<std::pair<int, Rect>> regions(int count) const {
    std::vector<std::pair<int, Rect>> all;
    for (int face = 0; face < face_count; ++face) all.emplace_back(face, Rect{0, 0, cube_.size, cube_.size});
    while (static_cast<int>(all.size()) < count) {
      const auto importance = [&](const std::pair<int, Rect>& r) {
        if (r.second.width() * r.second.height() == 1) return -1.0;
        return method_ == SegmentMethod::thesis ? radiance(r.first, r.second) : variance(r.first, r.second);
      };
      const auto most = std::max_element(all.begin(), all.end(),
                                         [&](const auto& a, const auto& b) { return importance(a) < importance(b); });
      const auto [first, second] = cut(most->first, most->second);
      most->second = first;
      all.emplace_back(most->first, second);
    }
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
      return std::tuple(a.first, a.second.y0, a.second.x0) < std::tuple(b.first, b.second.y0, b.second.x0);
    });
    return all;
  }

private:
  double weight(int face, int x, int y) const {
    const glm::dvec3 flux = cube_.flux_of(cube_.texel(face, x, y));
    const double luminance = 0.2126 * flux.x + 0.7152 * flux.y + 0.0722 * flux.z;
    return weights_ == SegmentWeights::texel ? luminance / solid_angle({x, y, x + 1, y + 1}, cube_.size) : luminance;
  }
  template <class Work>
  static void each_texel(const Rect& r, const Work& work) {
    for (int y = r.y0; y < r.y1; ++y)
      for (int x = r.x0; x < r.x1; ++x) work(x, y);
  }
  double radiance(int face, const Rect& r) const {
    double sum = 0;
    each_texel(r, [&](int x, int y) { sum += weight(face, x, y); });
    return sum;
  }
  double variance(int face, const Rect& r) const {
    glm::dvec3 mean{0};
    each_texel(r, [&](int x, int y) { mean += weight(face, x, y) * texel_direction(cube_, face, x, y); });
    mean /= radiance(face, r);
    double sum = 0;
    each_texel(r, [&](int x, int y) {
      const glm::dvec3 off = texel_direction(cube_, face, x, y) - mean;
      sum += weight(face, x, y) * glm::dot(off, off);
    });
    return sum;
  }
  static double deviation(const Rect& r) {
    const double aspect = double(std::max(r.width(), r.height())) / std::min(r.width(), r.height());
    return (aspect - 1) * (aspect - 1);
  }

  std::pair<Rect, Rect> cut(int face, const Rect& r) const {
    struct Best {
      double cost = std::numeric_limits<double>::infinity();
      Rect first, second;
    } across, along;
    const auto consider = [&](Best& best, const Rect& first, const Rect& second) {
      const double cost = method_ == SegmentMethod::thesis ? std::abs(radiance(face, first) - radiance(face, second))
                                                           : variance(face, first) + variance(face, second);
      if (cost < best.cost) best = {cost, first, second};
    };
    for (int y = r.y0 + 1; y < r.y1; ++y) consider(across, {r.x0, r.y0, r.x1, y}, {r.x0, y, r.x1, r.y1});
    for (int x = r.x0 + 1; x < r.x1; ++x) consider(along, {r.x0, r.y0, x, r.y1}, {x, r.y0, r.x1, r.y1});
    bool is_across = across.cost < along.cost;
    if (method_ == SegmentMethod::thesis && std::isfinite(across.cost) && std::isfinite(along.cost))
      is_across =
          deviation(across.first) + deviation(across.second) <= deviation(along.first) + deviation(along.second);
    const Best& best = is_across ? across : along;
    return {best.first, best.second};
  }

  const CubeMap& cube_;
  SegmentMethod method_;
  SegmentWeights weights_;
};

TEST(Segment, CutsAreThoseOfAProgramThatTriesAll) {
  int regions = 0;
  for (const int size : {2, 5, 8})
    for (unsigned seed = 1; seed <= 4; ++seed)
      for (const SegmentMethod method : methods)
        for (const SegmentWeights weights : all_weights) {
          SCOPED_TRACE(testing::Message()
                       << size << ", seed " << seed << ", method " << int(method) << ", weights " << int(weights));
          const CubeMap cube = hashed_cube(size, seed, seed);
          const int lights = std::min(40, 6 * size * size);
          const Segmentation segmentation = segment(cube, {lights, method, weights, 0});
          const auto right = PlainSegmenter(cube, method, weights).regions(lights);
          ASSERT_THAT(segmentation.lights, SizeIs(right.size()));
          for (std::size_t i = 0; i < right.size(); ++i) {
            EXPECT_EQ(segmentation.lights[i].face, right[i].first);
            EXPECT_EQ(segmentation.lights[i].rect, right[i].second) << i;
            ++regions;
          }
          expect_whole(cube, segmentation);
        }
  EXPECT_GT(regions, 1000);
}

// Flux and direction of a region by sums over its texels.
TEST(Segment, ARegionHasItsTexelsLightAndTheirMeanDirection) {
  CubeMap cube = hashed_cube(16, 7, 3);
  for (std::size_t i = 0; i < cube.flux.size(); i += 3) cube.flux[i] *= 2; // reddish
  for (const Region& light : segment(cube, {.lights = 30}).lights) {
    glm::dvec3 flux{0}, moment{0};
    for (int y = light.rect.y0; y < light.rect.y1; ++y)
      for (int x = light.rect.x0; x < light.rect.x1; ++x) {
        flux += cube.flux_of(cube.texel(light.face, x, y));
        moment += cube.flux_of(cube.texel(light.face, x, y)).y * texel_direction(cube, light.face, x, y);
      }
    EXPECT_LT(glm::distance(light.flux, flux), 1e-12 * glm::length(flux));
    EXPECT_LT(glm::distance(light.direction, glm::normalize(moment)), 1e-14);
    EXPECT_EQ(light.solid_angle_sr, solid_angle(light.rect, 16));
  }
}

TEST(Segment, MapsOfAllKindsKeepTheirFlux) {
  for (const test::NamedMap& named : test::synthetic_maps(64)) {
    const CubeMap cube = make_cube_map(named.map);
    const glm::dvec3 right = test::flux_of_texels(named.map);
    for (const SegmentMethod method : methods)
      for (const int lights : {6, 24, 256}) {
        SCOPED_TRACE(named.name);
        const Segmentation segmentation = segment(cube, {.lights = lights, .method = method});
        expect_whole(cube, segmentation);
        EXPECT_THAT(segmentation.lights, SizeIs(static_cast<std::size_t>(lights)));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(segmentation.total_flux[c] / right[c], 1, 1e-12);
      }
  }
}

// Six equal lights along the axes; whatever the lights are, a direction's cosine has the mean 1/4 over all normals, so
// the mean irradiance is a quarter of the flux: pi times the radiance.
TEST(Segment, AUniformMapBecomesEvenLights) {
  const CubeMap cube = make_cube_map(test::uniform_map(32, 16, {2, 1, 0.5}));
  const Segmentation six = segment(cube, {.lights = 6});
  ASSERT_THAT(six.lights, SizeIs(6));
  for (const Region& light : six.lights) {
    EXPECT_LT(glm::distance(light.direction, position({light.face, 0, 0})), 1e-12);
    EXPECT_NEAR(light.flux.y, 4 * test::pi / 6, 3e-4);
    EXPECT_NEAR(light.flux.x, 2 * light.flux.y, 1e-12);
    EXPECT_NEAR(light.solid_angle_sr, 4 * test::pi / 6, 1e-14);
  }
  const std::vector<glm::dvec3> truth = irradiances(cube, 100);
  double last = 1;
  for (const int lights : {6, 24, 96, 384}) {
    for (const SegmentMethod method : methods) {
      const Segmentation even = segment(cube, {.lights = lights, .method = method});
      expect_whole(cube, even);
      EXPECT_NEAR(even.total_flux.y / 4, test::pi, 1e-12);
      for (const Region& light : even.lights) EXPECT_NEAR(light.flux.y / light.solid_angle_sr, 1, 0.02) << lights;
    }
    const double error = irradiance_error(truth, segment(cube, {.lights = lights}));
    EXPECT_LT(error, 0.4 * last) << lights;
    last = error;
  }
}

// A sun of one degree across, 3e4 times the sky, anywhere: its light points to it. By halving, once there are lights
// enough to halve the sky around it.
TEST(Segment, ASunIsFound) {
  double worst = 0;
  for (const auto& [elevation, azimuth] : std::vector<std::pair<double, double>>{
           {50, 20}, {0, 0}, {35.26, 45}, {0, 45}, {45, 90}, {89.8, 10}, {-30, 179.9}, {7, -135}, {-88, 100}}) {
    const scene::Environment map = test::made_map(512, 256, [&, e = elevation, a = azimuth](const glm::dvec3& d) {
      return test::sky_with_lamps(d, {0.3, 0.5, 1}, {0.2, 0.2, 0.2}, {{e, a, 0.5, {3e4, 3e4, 3e4}}});
    });
    const CubeMap cube = make_cube_map(map);
    for (const SegmentMethod method : methods)
      for (const int lights : {8, 24, 64}) {
        if (lights < 24 && method == SegmentMethod::thesis) continue;
        const Segmentation segmentation = segment(cube, {.lights = lights, .method = method});
        const Region& brightest =
            *std::max_element(segmentation.lights.begin(), segmentation.lights.end(),
                              [](const Region& a, const Region& b) { return a.flux.y < b.flux.y; });
        const double off_deg =
            std::acos(std::min(1.0, glm::dot(brightest.direction, test::direction_of(elevation, azimuth)))) * 180 /
            test::pi;
        EXPECT_LT(off_deg, 1) << "elevation " << elevation << ", azimuth " << azimuth << ", lights " << lights
                              << ", method " << int(method);
        worst = std::max(worst, off_deg);
      }
  }
  RecordProperty("worst_deg", std::to_string(worst));
}

TEST(Segment, NothingIsDefined) {
  for (const SegmentMethod method : methods)
    for (const SegmentWeights weights : all_weights) {
      const Segmentation nothing = segment(black_cube(8), {24, method, weights});
      EXPECT_THAT(nothing.lights, IsEmpty());
      EXPECT_THAT(nothing.dropped, SizeIs(6));
      EXPECT_EQ(nothing.total_flux, glm::dvec3(0));
      EXPECT_EQ(irradiance_error(irradiances(black_cube(8)), nothing), 0);
    }
}

TEST(Segment, ABlackFaceIsNoLight) {
  const CubeMap cube = made_cube(8, [](int face, int, int) { return face == 3 ? 0.0 : 1.0; });
  for (const SegmentMethod method : methods) {
    const Segmentation segmentation = segment(cube, {.lights = 20, .method = method});
    EXPECT_THAT(segmentation.lights, SizeIs(20));
    ASSERT_THAT(segmentation.dropped, SizeIs(1));
    EXPECT_EQ(segmentation.dropped[0].face, 3);
    EXPECT_EQ(segmentation.dropped[0].direction, glm::dvec3(0, -1, 0));
    expect_whole(cube, segmentation);
  }
}

TEST(Segment, OneTexelIsOneLight) {
  for (const int size : {1, 2, 9, 128})
    for (const SegmentMethod method : methods) {
      const int x = size / 3, y = size - 1;
      CubeMap cube = black_cube(size);
      for (std::size_t c = 0; c < 3; ++c) cube.flux[3 * cube.texel(4, x, y) + c] = 1e-30;
      const Segmentation segmentation = segment(cube, {.lights = 100, .method = method});
      ASSERT_THAT(segmentation.lights, SizeIs(1)) << size;
      EXPECT_EQ(segmentation.lights[0].rect, (Rect{x, y, x + 1, y + 1}));
      EXPECT_LT(glm::distance(segmentation.lights[0].direction, texel_direction(cube, 4, x, y)), 1e-15);
      expect_whole(cube, segmentation);
      EXPECT_LT(irradiance_error(irradiances(cube), segmentation), 1e-14);
    }
}

TEST(Segment, MoreLightsThanTexelsAreAsManyAsTexels) {
  for (const SegmentMethod method : methods) {
    const CubeMap cube = hashed_cube(3, 5, 2);
    const Segmentation segmentation = segment(cube, {.lights = 1000000, .method = method});
    EXPECT_THAT(segmentation.lights, SizeIs(54));
    expect_whole(cube, segmentation);
    EXPECT_LT(irradiance_error(irradiances(cube), segmentation), 1e-14);
  }
}

// Two texels of light at the ends of a row of a dark face. All cuts between them are as good, as are, for halving, all
// cuts across.
TEST(Segment, CutsInTheDarkAreInTheMiddle) {
  CubeMap cube = black_cube(16);
  for (const int x : {0, 15})
    for (std::size_t c = 0; c < 3; ++c) cube.flux[3 * cube.texel(0, x, 7) + c] = 1;
  const WeighedCube weighed(cube, SegmentWeights::solid_angle);
  EXPECT_EQ(best_cut(weighed, 0, {0, 0, 16, 16}, SegmentMethod::variance)->first, (Rect{0, 0, 8, 16}));
  EXPECT_EQ(best_cut(weighed, 0, {0, 0, 16, 16}, SegmentMethod::thesis)->first, (Rect{0, 0, 16, 8}));
  EXPECT_EQ(best_cut(weighed, 0, {0, 0, 3, 9}, SegmentMethod::variance)->first, (Rect{0, 0, 3, 4}))
      << "one texel lit: of the longer side";
  for (const SegmentMethod method : methods) {
    const Segmentation segmentation = segment(cube, {.lights = 6, .method = method});
    ASSERT_THAT(segmentation.lights, SizeIs(2));
    EXPECT_EQ(segmentation.lights[0].rect, (Rect{0, 7, 1, 8}));
    EXPECT_EQ(segmentation.lights[1].rect, (Rect{15, 7, 16, 8}));
  }
}

TEST(Segment, TheThresholdDropsAndTheNearestLightTakesTheFlux) {
  // Faces of 1, 2, 4, 8, 16 and 1000: of 1031, 1.5 % is 15.5. +z (16) stays.
  const double of[] = {1, 2, 4, 8, 16, 1000};
  const CubeMap cube = made_cube(4, [&](int face, int, int) { return of[face] / 16; });
  const Segmentation segmentation = segment(cube, {.lights = 6, .threshold = 0.015});
  EXPECT_THAT(segmentation.dropped, SizeIs(4));
  expect_whole(cube, segmentation);
  EXPECT_EQ(segmentation.lights.front().face, 4);
  EXPECT_GE(segmentation.lights.front().flux.y, 16);
  // Half of all is not more than half, but a region whose parts would both be dropped stays whole.
  EXPECT_THAT(
      segment(made_cube(4, [](int face, int, int) { return face == 0 ? 1.0 : 0.0; }), {.lights = 50, .threshold = 0.6})
          .lights,
      SizeIs(1));
}

TEST(Segment, LightOfOneColourIsKept) {
  CubeMap cube = hashed_cube(8, 3, 1);
  for (std::size_t i = 0; i < cube.flux.size(); ++i)
    if (i % 3 != 2) cube.flux[i] = 0;
  expect_whole(cube, segment(cube, {.lights = 24}));
  EXPECT_THAT(segment(cube, {.lights = 24}).lights, SizeIs(24));
}

TEST(Segment, HugeAndTinyLightIsCutAlike) {
  const CubeMap cube = hashed_cube(16, 2, 4);
  for (const double scale : {1e-60, 1e60})
    for (const SegmentMethod method : methods) {
      CubeMap scaled = cube;
      for (double& flux : scaled.flux) flux *= scale;
      const Segmentation a = segment(cube, {.method = method}), b = segment(scaled, {.method = method});
      ASSERT_EQ(a.lights.size(), b.lights.size());
      for (std::size_t i = 0; i < a.lights.size(); ++i) EXPECT_EQ(a.lights[i].rect, b.lights[i].rect);
    }
}

TEST(Segment, FewerThanSixAreRefused) {
  for (const int lights : {5, 0, -1})
    EXPECT_EQ(test::refusal_of([&] { segment(black_cube(2), {.lights = lights}); }),
              "q: is " + std::to_string(lights) + "; expected 6 or more, as a cube has 6 faces");
}

} // namespace nephroid::segment_test
