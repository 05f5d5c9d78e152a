// SPDX-License-Identifier: Apache-2.0
// Light with a spectrum: the judge's colours against Snell's and Fresnel's laws and the CIE's functions, the
// footprint's luminance against the judge's, and how much of the judge's figures is noise.
#include "inverse/assign/footprint.h"
#include "inverse/bending.h"
#include "inverse/glass_view.h"
#include "inverse/judge.h"
#include "inverse/plan.h"
#include "inverse/sheet.h"
#include "optics/colour.h"
#include "optics/fresnel.h"
#include "optics/spectrum.h"
#include "preset/read.h"
#include "scatter/spectra.h"
#include "tests/inverse/searches.h"
#include "tests/support/render.h"
#include "tests/support/test.h"

namespace nephroid::colours_test {

using namespace inverse;

preset::Preset lit_by(const std::string& spectrum, const preset::Overrides& overrides = {}) {
  return preset::parse_preset(
      R"({"engine": "inverse", "inverse": {"index": "N-SF11", "light": {"type": "parallel", "spectrum": )" + spectrum +
          R"(}, "receivers": [{"distance_mm": 200, "picture": "ring"}]}})",
      "own.json", overrides);
}

double index_at_nm(double nm) {
  preset::Dispersion d;
  d.type = preset::Dispersion::Type::file;
  d.file = "N-SF11";
  return *scatter::make_curve(d, FileFinder(""), "glass").sample(nm).n;
}

/// One facet of a millimetre over cells of a millimetre, and that spectrum.
Layout one_facet(const std::string& spectrum, double distance = 200) {
  const Refraction refraction = make_refraction(lit_by(spectrum));
  return {.size = {1, 1},
          .thickness = 1,
          .facets = {1, 1},
          .n = refraction.n,
          .spectrum = refraction.spectrum,
          .receiver = {200, 200},
          .cells = {200, 200},
          .distances = {distance}};
}

Judge judged(const Layout& layout, const Solid& solid, std::uint64_t seed = 1,
             const std::vector<Target>& targets = {}) {
  Judge judge(test::shared_context(), layout, solid, seed, targets);
  while (!judge.finished()) judge.advance();
  return judge;
}

/// Behind a facet whose surface has this gradient: both sides let through what Fresnel says, and light is turned as
/// Snell says.
struct Behind {
  double slope, part;
};
Behind behind(double gradient, double n) {
  const double tilt = std::atan(gradient), out = std::asin(n * std::sin(tilt));
  return {std::tan(out - tilt),
          (1 - std::pow((n - 1) / (n + 1), 2)) * (1 - optics::fresnel_reflectance(std::cos(tilt), n, 1))};
}

// Three lines through a prism: each is at its own place, with its own colour and with what Fresnel leaves of its light.
TEST(Colours, APrismSendsEachWavelengthWhereSnellSays) {
  const std::array<double, 3> lines{440, 540, 660};
  Layout layout = one_facet(R"({"type": "lines", "table": [[440, 1], [540, 1], [660, 1]]})", 1000);
  layout.receiver = layout.cells = {800, 20};
  const glm::dvec2 slope(0.3, 0);
  const double gradient = glm::length(facet_gradient(slope, layout.n));
  const Judge judge = judged(layout, make_solid(layout, {slope}));
  const std::vector<glm::dvec3> seen = judge.colours(0);
  const optics::ColourMatching& eye = optics::cie_1931();
  double luminance = 0, sent = 0;
  for (const double nm : lines) luminance += eye.y[static_cast<std::size_t>(nm) - optics::first_nm];
  for (const double nm : lines) {
    const Behind is = behind(gradient, index_at_nm(nm));
    const auto w = static_cast<std::size_t>(nm) - optics::first_nm;
    const double place = layout.in_cells({is.slope * 1000, 0}).x;
    glm::dvec3 sum(0);
    double mean = 0;
    for (std::size_t c = 0; c < seen.size(); ++c) {
      const double x = static_cast<double>(c % 800) + 0.5;
      if (std::abs(x - place) > 1.5) continue;
      sum += seen[c];
      mean += seen[c].y * x;
    }
    EXPECT_NEAR(mean / sum.y, place, 0.1) << nm;
    const glm::dvec3 own = is.part / luminance * glm::dvec3(eye.x[w], eye.y[w], eye.z[w]);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(sum[i], own[i], 5e-3 * glm::length(own)) << nm; // of 2025 rays one has two lines' mean
    sent += own.y;
  }
  EXPECT_NEAR(judge.outcomes().sent, sent, 1e-4);
  EXPECT_NEAR(judge.outcomes().sent + judge.outcomes().reflected + judge.outcomes().lost, 1, 1e-6);
}

// All colours of daylight together are daylight's, whatever each ray has drawn; the rim towards the object's axis is
// red, the other blue.
TEST(Colours, AllOfThemTogetherAreTheLights) {
  const Layout layout = one_facet(R"("D65")");
  const Judge judge = judged(layout, make_solid(layout, {{0.3, 0}}));
  const std::vector<glm::dvec3> seen = judge.colours(0);
  glm::dvec3 sum(0), near(0), far(0);
  double middle = 0;
  for (const glm::dvec3& xyz : seen) sum += xyz;
  for (std::size_t c = 0; c < seen.size(); ++c) middle += seen[c].y * static_cast<double>(c % 200) / sum.y;
  for (std::size_t c = 0; c < seen.size(); ++c) (static_cast<double>(c % 200) < middle ? near : far) += seen[c];
  const double gradient = glm::length(facet_gradient({0.3, 0}, layout.n));
  const optics::Spectrum daylight = optics::illuminant("D65");
  optics::Spectrum through{};
  for (std::size_t i = 0; i < daylight.size(); ++i)
    through[i] = daylight[i] * behind(gradient, index_at_nm(optics::wavelength_nm(static_cast<int>(i)))).part;
  const optics::Colour all = optics::to_xyz(through);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(sum[i], all[static_cast<std::size_t>(i)] / optics::to_xyz(daylight)[1], 1e-4) << i;
  EXPECT_NEAR(judge.outcomes().sent + judge.outcomes().reflected + judge.outcomes().lost, 1, 1e-6);
  EXPECT_GT(near.x / near.z, 4 * far.x / far.z);
  const auto picture = coloured_picture(seen, 1, layout);
  double luminance = 0;
  for (std::size_t i = 0; i < picture->rgb.size(); i += 3)
    luminance += 0.2126 * picture->rgb[i] + 0.7152 * picture->rgb[i + 1] + 0.0722 * picture->rgb[i + 2];
  EXPECT_NEAR(luminance, 1, 1e-4);
}

// The search's footprint is of luminance: cell by cell as rays have it, for smooth spectra and for lamps with lines.
TEST(Colours, AFootprintIsTheLuminanceOfRays) {
  for (const char* spectrum :
       {R"("D65")", R"("F11")", R"({"type": "lines", "table": [[450, 1], [530, 1], [630, 1]]})"}) {
    const Layout layout = one_facet(spectrum, 100);
    const glm::dvec2 slope(0.15, 0.12);
    std::vector<double> rays = judged(layout, make_solid(layout, {slope})).light(0);
    const double all = std::accumulate(rays.begin(), rays.end(), 0.0);
    double norm = 0, squares = 0;
    for (double& value : rays) norm += std::pow(value /= all, 2);
    for_cells(layout, footprint(layout, 0, slope, 0), [&](std::size_t cell, double part) { rays[cell] -= part; });
    for (const double value : rays) squares += value * value;
    EXPECT_LT(std::sqrt(squares / norm), 0.03) << spectrum;
  }
}

/// Facets that send their light here and there, blurred.
Layout blurred() {
  return {.size = {50, 50}, .facets = {6, 6}, .cells = {24, 24}, .distances = {150}, .sun_radius = 0.01};
}
Solid scattered(const Layout& layout) {
  std::vector<glm::dvec2> slopes;
  for (int i = 0; i < 36; ++i) slopes.push_back(0.1 * glm::dvec2(std::sin(3 * i), std::cos(5 * i)));
  return make_solid(layout, slopes);
}

// What halves of the rays say of noise is what other rays say: pictures of other seeds are the root of 2 of it apart.
TEST(Colours, NoiseIsWhatOtherRaysSay) {
  const Layout layout = blurred();
  const Solid solid = scattered(layout);
  const std::vector<Target> even{Target(576, 1 / 576.0)};
  double apart = 0, noise = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const Judge a = judged(layout, solid, 2 * seed), b = judged(layout, solid, 2 * seed + 1);
    const double sum_a = std::accumulate(a.light(0).begin(), a.light(0).end(), 0.0),
                 sum_b = std::accumulate(b.light(0).begin(), b.light(0).end(), 0.0);
    for (std::size_t c = 0; c < 576; ++c) apart += 576 * std::pow(a.light(0)[c] / sum_a - b.light(0)[c] / sum_b, 2) / 4;
    noise += 2 * std::pow(a.noise(even)[0].rel_l2, 2) / 4;
  }
  EXPECT_NEAR(std::sqrt(noise / apart), 1, 0.15);
}

// Its own picture is nearly right, whose noise more rays lower; even light is wrong whatever the noise.
TEST(Colours, APictureThatIsNearlyRightGetsMoreRays) {
  const Layout layout = blurred();
  const Solid solid = scattered(layout);
  Target own = judged(layout, solid, 7).light(0);
  const double sum = std::accumulate(own.begin(), own.end(), 0.0);
  for (double& value : own) value /= sum;
  const std::vector<Target> right{own}, even{Target(576, 1 / 576.0)};
  const double two_rounds = judged(layout, solid, 1).noise(right)[0].rel_l2,
               four = judged(layout, solid, 1, right).noise(right)[0].rel_l2;
  EXPECT_LT(four, 0.85 * two_rounds);
  EXPECT_EQ(judged(layout, solid, 1, even).light(0), judged(layout, solid, 1).light(0));
}

TEST(Colours, AreSeenByTheSpectralEngineToo) {
  const auto view_of = [](const preset::Preset& preset) {
    const InversePlan plan = make_plan(preset);
    return preset::parse_preset(glass_view(plan.design->layout, plan.design->targets, preset), "view.json");
  };
  const preset::Preset white = view_of(lit_by(R"("F11")", {R"(inverse.receivers.0.picture={"type": "ring"})"}));
  EXPECT_EQ(white.scene.lights.at(0).spectrum.illuminant, "F11");
  EXPECT_THAT(white.scene.materials.at("glass").dispersion.file, HasSubstr("N-SF11"));
  preset::Preset grey = lit_by(R"("F11")", {R"(inverse.receivers.0.picture={"type": "ring"})"});
  settings(grey).light.spectrum.reset();
  EXPECT_NEAR(view_of(grey).scene.materials.at("glass").dispersion.n, index_at_nm(550), 1e-9);
  settings(grey).band_nm = 60;
  const preset::Preset band = view_of(grey);
  EXPECT_EQ(band.scene.lights.at(0).spectrum.table, (std::vector<std::array<double, 2>>{{520, 1}, {580, 1}}));
  EXPECT_THAT(band.scene.materials.at("glass").dispersion.file, HasSubstr("N-SF11"));
}

TEST(Colours, ThatCannotBeAreRefused) {
  const auto refusal = [](const std::string& spectrum, const preset::Overrides& overrides) {
    return test::refusal_of([&] { make_plan(lit_by(spectrum, overrides)); });
  };
  const std::string ring = R"(inverse.receivers.0.picture={"type": "ring"})";
  EXPECT_THAT(
      refusal(R"("D65")", {ring, "inverse.band_nm=100"}),
      HasSubstr(
          "inverse.band_nm=100: is 100 nm, and light.spectrum has the light's wavelengths; expected one of both"));
  EXPECT_THAT(refusal(R"("D66")", {ring}), AllOf(HasSubstr("D66"), HasSubstr("D65")));
  EXPECT_THAT(refusal(R"({"type": "lines", "table": [[900, 1]]})", {ring}),
              HasSubstr("own.json#/inverse/light/spectrum"));
  EXPECT_THAT(refusal(R"("D65")", {ring, R"(inverse.index={"type": "cauchy", "coefficients": [1.0005]})"}),
              HasSubstr("bends hardly any"));
}

} // namespace nephroid::colours_test
