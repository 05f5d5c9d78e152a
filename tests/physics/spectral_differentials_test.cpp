// SPDX-License-Identifier: Apache-2.0
// Newton's prism over a receiver that its light grazes: splats stretched along the wavelength make one rainbow of 401
// lines, each colour where Snell puts it, and no light is made or lost at the receiver's edge.
#include "optics/fresnel.h"
#include "spectral/settings.h"
#include "tests/support/closed_form.h"

namespace nephroid::spectral_differentials_test {

using Columns = std::vector<std::array<double, 3>>; // XYZ

constexpr double prism_side = 0.1, drop = 0.1; // metres; the receiver is `drop` below the prism's middle
constexpr double incidence = 62 * degree, grazing = 2.5 * degree; // of 700 nm
constexpr int columns = 1024, rows = 15;

/// Everything happens in the plane z = 0; the light comes from beyond the receiver's left end. check::prism_path is
/// turned about z until 700 nm falls on the receiver at `grazing`.
class Newton {
public:
  Newton() : turn_(0) {
    p_ = empty_preset();
    preset::Material& flint = p_.scene.materials["flint"] = glass(1);
    flint.absorption = false;
    flint.dispersion.type = preset::Dispersion::Type::file;
    flint.dispersion.file = NEPHROID_SOURCE_DIR "/presets/materials/N-SF11.yml";
    p_.scene.materials["white"] = white();
    preset::Shape prism;
    prism.type = preset::Shape::Type::prism;
    prism.side = prism.height = prism_side;
    prism.apex_deg = 60;
    p_.scene.objects = {object("prism", prism, "flint"), object("receiver", quad(4, 1), "white", at({2.3, -drop, 0}))};
    see(0, 1);
    p_.scene.lights.resize(1);
    scene_ = scene::load_scene(p_);
    const glm::dvec2 out = way_out(index(700)).direction;
    turn_ = std::atan2(-out.y, out.x) - grazing;
    // The prism's axis from y to z, then turned.
    p_.scene.objects[0].transform = at({0, 0, 0}, {-90, 0, turn_ / degree});
    const check::PrismPath path = check::prism_path(prism_side, incidence, 1.7, -1);
    const glm::dvec2 from = turned({path.from_x, path.from_z}),
                     direction = turned({path.direction_x, path.direction_z});
    p_.scene.lights[0] = pencil({from.x, from.y, 0}, {direction.x, direction.y, 0}, 0.001);
    p_.scene.lights[0].spectrum = {};
    spectral::settings(p_).method = photons::Settings::Method::brute_force;
    spectral::settings(p_).photons_per_pass = 1 << 17;
    see(landing(index(560)), landing(index(700)));
  }

  preset::Preset& preset() { return p_; }
  double left() const { return left_; }
  double pixel() const { return pixel_; }

  /// n at a wavelength, linear between the 401.
  double index(double nm) const {
    const optics::Spectrum& n = glass_curve();
    const double at = std::clamp(nm - 380, 0.0, 399.999);
    const auto w = static_cast<std::size_t>(at);
    return n[w] + (at - static_cast<double>(w)) * (n[w + 1] - n[w]);
  }

  /// Where light meets the receiver.
  double landing(double n) const {
    const Way way = way_out(n);
    const glm::dvec2 from = turned(way.from), direction = turned(way.direction);
    return from.x - (from.y + drop) / direction.y * direction.x;
  }

  /// The camera looks straight down on the receiver, its columns from x = left on.
  void see(double left, double right) {
    left_ = left;
    pixel_ = (right - left) / columns;
    preset::Camera& camera = p_.scene.camera;
    camera.position = {(left + right) / 2, 2, 0};
    camera.target = {(left + right) / 2, -drop, 0};
    camera.up = {0, 0, -1};
    camera.fov_deg = 2 * std::atan(rows * pixel_ / 2 / (2 + drop)) / degree;
    camera.resolution = {columns, rows};
  }

  /// Flux times (xbar, ybar, zbar) in each column, by the closed form: what is not reflected at either face, each
  /// wavelength a tent of +-1 nm.
  Columns truth() const {
    const scene::Scene scene = scene::load_scene(p_);
    const optics::ColourMatching& eye = optics::cie_1931();
    Columns sums(columns, {0, 0, 0});
    constexpr int steps = 40;
    for (int w = 0; w < optics::wavelength_count; ++w) {
      const auto i = static_cast<std::size_t>(w);
      const double flux = scene.lights[0].power_w * scene.lights[0].spectrum[i] * transmittance(glass_curve()[i]);
      const auto column = [&](int k) { return (landing(index(379 + w + 2.0 * k / steps)) - left_) / pixel_; };
      for (int k = 0; k < steps; ++k) {
        const double t = 2 * (k + 0.5) / steps - 1, share = 2 * (1 - std::abs(t)) / steps;
        spread(column(k), column(k + 1), {flux * share * eye.x[i], flux * share * eye.y[i], flux * share * eye.z[i]},
               sums);
      }
    }
    return sums;
  }

  /// The same from a picture: a white receiver's radiance is irradiance / pi.
  Columns rendered(const job::Snapshot& snapshot) const {
    const job::Layer& picture = layer(snapshot, "caustic");
    Columns sums(columns, {0, 0, 0});
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
      const optics::Colour xyz = optics::linear_srgb_to_xyz({picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]});
      for (std::size_t c = 0; c < 3; ++c) sums[i / 3 % columns][c] += xyz[c] * std::numbers::pi * pixel_ * pixel_;
    }
    return sums;
  }

private:
  /// Adds evenly to the columns between two places.
  static void spread(double from, double to, const std::array<double, 3>& xyz, Columns& sums) {
    for (int i = std::max(0, static_cast<int>(from)); i < std::min(double(columns), to); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        sums[static_cast<std::size_t>(i)][c] +=
            xyz[c] * (std::min(to, i + 1.0) - std::max(from, double(i))) / (to - from);
  }

  struct Way {
    glm::dvec2 from, direction;
  };

  const optics::Spectrum& glass_curve() const {
    return std::find_if(scene_.materials.begin(), scene_.materials.end(),
                        [](const auto& m) { return m.name == "flint"; })
        ->n;
  }

  /// Behind the prism, before it is turned: the line through two landing places.
  static Way way_out(double n) {
    const double near = check::prism_path(prism_side, incidence, n, -1).landing_x,
                 far = check::prism_path(prism_side, incidence, n, -2).landing_x;
    return {{near, -1}, glm::normalize(glm::dvec2(far - near, -1))};
  }

  glm::dvec2 turned(const glm::dvec2& v) const {
    return {v.x * std::cos(turn_) - v.y * std::sin(turn_), v.x * std::sin(turn_) + v.y * std::cos(turn_)};
  }

  /// Of both faces. Inside, the angles at the faces add up to the apex.
  static double transmittance(double n) {
    const double second = 60 * degree - std::asin(std::sin(incidence) / n);
    return (1 - optics::fresnel_reflectance(std::cos(incidence), 1, n)) *
           (1 - optics::fresnel_reflectance(std::cos(second), n, 1));
  }

  preset::Preset p_;
  scene::Scene scene_;
  double turn_, left_ = 0, pixel_ = 1;
};

double sum_of(const Columns& all, std::size_t c) {
  double sum = 0;
  for (const auto& column : all) sum += column[c];
  return sum;
}

/// The share of columns that no light reaches.
double dark(const Columns& all) {
  return static_cast<double>(std::count_if(all.begin(), all.end(), [](const auto& column) { return column[1] <= 0; })) /
         columns;
}

/// Mean over columns of |difference| / truth, of Y.
double mean_error(const Columns& figure, const Columns& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) sum += std::abs(figure[i][1] - truth[i][1]) / truth[i][1];
  return sum / static_cast<double>(truth.size());
}

TEST(SpectralDifferentials, CloseTheGapsBetweenTheLinesOfARainbow) {
  Newton newton;
  spectral::settings(newton.preset()).jitter = false;
  const Columns lines = newton.rendered(render(newton.preset()));
  spectral::settings(newton.preset()).jitter = true;
  const Columns band = newton.rendered(render(newton.preset())), truth = newton.truth();
  record("columns without light: lines", dark(lines), 0, 1);
  record("columns without light: stretched", dark(band), 0, 0);
  record("mean error of a column: lines", mean_error(lines, truth), 0, 2);
  record("mean error of a column: stretched", mean_error(band, truth), 0, 0.05);
  EXPECT_GT(dark(lines), 0.4);
  EXPECT_EQ(dark(band), 0);
  EXPECT_GT(mean_error(lines, truth), 1);
  EXPECT_LT(mean_error(band, truth), 0.05);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(sum_of(band, c) / sum_of(truth, c), 1, 0.02) << c;
}

TEST(SpectralDifferentials, PutEachWavelengthWhereSnellPutsIt) {
  Newton newton;
  spectral::settings(newton.preset()).photons_per_pass = 1 << 14;
  double worst = 0;
  for (const double nm : {570.0, 600.0, 630.0, 660.0, 690.0}) {
    newton.preset().scene.lights[0].spectrum = line(nm);
    const Columns band = newton.rendered(render(newton.preset()));
    double centre = 0, low = columns, high = 0;
    for (int i = 0; i < columns; ++i) {
      const double y = band[static_cast<std::size_t>(i)][1];
      centre += y * (i + 0.5) / sum_of(band, 1);
      if (y > 0) low = std::min(low, double(i)), high = std::max(high, i + 1.0);
    }
    const auto column = [&](double wavelength) {
      return (newton.landing(newton.index(wavelength)) - newton.left()) / newton.pixel();
    };
    // A tent's centre of mass is its middle but for the curve's bend; its standard deviation is 1 / sqrt(6) nm, of 2^14
    // photons.
    EXPECT_NEAR(centre, column(nm), 0.25) << nm;
    EXPECT_NEAR(low, column(nm - 1), 2.5) << nm;
    EXPECT_NEAR(high, column(nm + 1), 2.5) << nm;
    worst = std::max(worst, std::abs(centre - column(nm)));
  }
  record("farthest of five wavelengths from its place, pixels", worst, 0, 0.25);
}

// Tiles of 2^12 photons for each of 32 clusters, swept over their parts of the rainbow.
TEST(SpectralDifferentials, SweepTilesOverARainbow) {
  Newton newton;
  spectral::settings(newton.preset()).method = photons::Settings::Method::optimal;
  spectral::settings(newton.preset()).threshold_deg = 0.05;
  spectral::settings(newton.preset()).photons_per_pass = 1 << 19;
  spectral::settings(newton.preset()).estimator = photons::Settings::Estimator::tiles;
  const Columns band = newton.rendered(render_as_it_is(newton.preset())), truth = newton.truth();
  record("mean error of a column: tiles", mean_error(band, truth), 0, 0.05);
  EXPECT_EQ(dark(band), 0);
  EXPECT_LT(mean_error(band, truth), 0.05);
  // What little blue is in view is in the first columns, where wide sweeps are off by a column.
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(sum_of(band, c) / sum_of(truth, c), 1, c < 2 ? 0.005 : 0.1) << c;
}

// 32 paths for the whole rainbow: without stretching it is as many lines. Where clusters are too coarse to be stretched
// as a whole, a photon still is a streak of its own wavelength.
TEST(SpectralDifferentials, SpreadWholeClusters) {
  Newton newton;
  spectral::settings(newton.preset()).method = photons::Settings::Method::optimal;
  spectral::settings(newton.preset()).photons_per_pass = 1 << 18;
  const Columns truth = newton.truth();
  for (const double threshold_deg : {0.05, 1.0}) {
    spectral::settings(newton.preset()).threshold_deg = threshold_deg;
    const Columns band = newton.rendered(render(newton.preset()));
    const std::string what = fmt::format("clusters of {} degrees", threshold_deg);
    record(what + ": mean error of a column", mean_error(band, truth), 0, 0.15);
    EXPECT_EQ(dark(band), 0) << what;
    EXPECT_LT(mean_error(band, truth), 0.15) << what;
    EXPECT_NEAR(sum_of(band, 1) / sum_of(truth, 1), 1, 0.03) << what;
  }
}

// The receiver ends where 640 nm falls. Beyond is nothing: a streak across the edge would lose its part beyond it, or
// show it in mid air.
TEST(SpectralDifferentials, KeepTheLightAtTheEdgeOfAReceiver) {
  Newton newton;
  spectral::settings(newton.preset()).method = photons::Settings::Method::optimal;
  spectral::settings(newton.preset()).threshold_deg = 0.05;
  const Columns truth = newton.truth();
  const double edge = newton.landing(newton.index(640));
  newton.preset().scene.objects[1].shape->size = {edge - 0.3, 1, 1};
  newton.preset().scene.objects[1].transform.translate = {(edge + 0.3) / 2, -drop, 0};
  const int last = static_cast<int>((edge - newton.left()) / newton.pixel());
  const Columns band = newton.rendered(render(newton.preset()));
  EXPECT_NEAR(sum_of(band, 1) / sum_of(Columns(truth.begin(), truth.begin() + last + 1), 1), 1, 0.02);
  for (int i = last + 1; i < columns; ++i)
    EXPECT_EQ(band[static_cast<std::size_t>(i)][1], 0) << i << " beyond " << last;
}

// A strip between the camera and the receiver hides columns 400 to 600, wherever the photons are whose streaks lie
// there.
TEST(SpectralDifferentials, AreHiddenByWhatStandsBeforeThem) {
  Newton newton;
  const double half_way = (2 - drop) / 2,
               middle = newton.left() + columns / 2 * newton.pixel(); // the camera is 2 + drop above the receiver
  const double from = middle + (400 - columns / 2) * newton.pixel() / 2,
               to = middle + (600 - columns / 2) * newton.pixel() / 2;
  newton.preset().scene.objects.push_back(
      object("strip", quad(to - from, 1), "white", at({(from + to) / 2, half_way, 0})));
  const Columns band = newton.rendered(render(newton.preset())), truth = newton.truth();
  double seen = 0, expected = 0;
  for (std::size_t i = 0; i < columns; ++i) {
    if (i > 400 && i < 599) {
      EXPECT_EQ(band[i][1], 0) << i;
    } else if (i < 399 || i > 600) {
      EXPECT_GT(band[i][1], 0) << i;
      seen += band[i][1];
      expected += truth[i][1];
    }
  }
  EXPECT_NEAR(seen / expected, 1, 0.02);
}

TEST(SpectralDifferentials, AreLeftOutWhereNothingDispersesAndWithoutJitter) {
  Newton newton;
  EXPECT_EQ(plan_of(newton.preset()).defines.at("NEPHROID_DIFFERENTIALS"), "1");
  spectral::settings(newton.preset()).jitter = false;
  EXPECT_EQ(plan_of(newton.preset()).defines.at("NEPHROID_DIFFERENTIALS"), "0");
  spectral::settings(newton.preset()).jitter = true;
  newton.preset().scene.materials["flint"] = glass(1.7);
  EXPECT_EQ(plan_of(newton.preset()).defines.at("NEPHROID_DIFFERENTIALS"), "0");
}

} // namespace nephroid::spectral_differentials_test
