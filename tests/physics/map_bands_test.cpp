// SPDX-License-Identifier: Apache-2.0
// Which wavelengths meet in a photon map. A photon and the path from the eye that gathers it have to be of one wavelength, or a prism
// before the camera shows one line's light where another line's image is.
#include "optics/fresnel.h"
#include "tests/support/closed_form.h"
#include "tests/support/passes.h"

namespace nephroid::map_bands_test {

struct Line {
  double nm, n, share; ///< the prism's n; of the lamp's power
  double sppm_scatter; ///< standard deviation over 30 seeds of what sppm makes of radiance(), over it; the means were .999 and 1.001
};
constexpr std::array<Line, 2> lines{{{450, 2.0, 0.2, 0.0203}, {620, 1.3, 0.8, 0.0097}}};

constexpr double apex = 22 * degree, side = 0.1, screen_x = -1;

struct Place {
  double x, z;
};

/// Where a path meets the prism, on the middle of its right side, and where it leaves, on the left side: the way between is at right angles
/// to the right side.
Place entry() { return {side / 2 * std::sin(apex / 2), 0}; }
Place normal_of_entry() { return {std::cos(apex / 2), std::sin(apex / 2)}; }
Place exit_place()
{
  const double inside = side / 2 * std::tan(apex);
  return {entry().x - inside * normal_of_entry().x, entry().z - inside * normal_of_entry().z};
}

/// Where the plane x = screen_x is met by a path of that index of refraction. It meets the left side at the apex angle and leaves at b,
/// sin(b) = n sin(apex), from the normal (-cos(apex / 2), 0, sin(apex / 2)) towards the base, (-sin(apex / 2), 0, -cos(apex / 2)).
double landing_z(double n)
{
  const double b = std::asin(n * std::sin(apex));
  const double along_x = -std::cos(apex / 2) * std::cos(b) - std::sin(apex / 2) * std::sin(b),
               along_z = std::sin(apex / 2) * std::cos(b) - std::cos(apex / 2) * std::sin(b);
  const Place from = exit_place();
  return from.z + (screen_x - from.x) * along_z / along_x;
}

/// The radiance of the stripe in a line over the lamp's irradiance in all: the light falls at 45 degrees, so E = cos(45 degrees) share, and
/// two faces of the prism let it through.
double radiance(const Line& line)
{
  return std::cos(45 * degree) * line.share / M_PI * (1 - optics::fresnel_reflectance(1, 1, line.n)) *
         (1 - optics::fresnel_reflectance(std::cos(apex), line.n, 1));
}

/// A white stripe along the prism's edge, where light of `line` lands that comes through the prism from the camera. Before it stands a pane
/// of n = 1, which makes a caustic of parallel light of two lines, and the camera looks at its image in the one.
preset::Preset stripe_through_a_prism(const Line& line)
{
  preset::Preset p = empty_preset(32);
  preset::Material& flint = p.scene.materials["flint"] = glass(1);
  flint.dispersion.type = preset::Dispersion::Type::table;
  flint.dispersion.table = {{lines[0].nm, lines[0].n}, {lines[1].nm, lines[1].n}};
  p.scene.materials["nothing"] = glass(1);
  p.scene.materials["white"] = white();
  preset::Shape prism;
  prism.type = preset::Shape::Type::prism;
  prism.apex_deg = apex / degree;
  prism.side = prism.height = side;
  const double z = landing_z(line.n);
  p.scene.objects = {object("prism", prism, "flint"), object("pane", box(0.005, 0.1, 0.15), "nothing", at({screen_x + 0.01, 0, z})),
                     object("stripe", quad(0.2, 0.1), "white", at({screen_x, 0, z}, {0, 0, 90}))};
  preset::Light& lamp = p.scene.lights.emplace_back(parallel_light({-1, -1, 0}));
  lamp.spectrum.table = {{lines[0].nm, lines[0].share}, {lines[1].nm, lines[1].share}};
  p.scene.camera.position = {entry().x + normal_of_entry().x, 0, entry().z + normal_of_entry().z};
  p.scene.camera.target = {entry().x, 0, entry().z};
  p.scene.camera.fov_deg = 0.5;
  spectral::settings(p).threshold_deg = 80; // one cluster
  spectral::settings(p).sppm.radius = 0.015;
  spectral::settings(p).photons_per_pass = 1 << 13;
  p.stop.passes = 192;
  return p;
}

/// The mean radiance of the layer "caustic" in each line, from X and Z.
std::vector<double> radiance_in_lines(const job::Snapshot& snapshot)
{
  const std::vector<float>& rgb = layer(snapshot, "caustic").rgb;
  optics::Colour mean{};
  for (std::size_t i = 0; i < rgb.size(); ++i) mean[i % 3] += rgb[i] / (static_cast<double>(rgb.size()) / 3);
  const optics::Colour xyz = optics::linear_srgb_to_xyz(mean);
  const auto colour = [](const Line& l) { return optics::to_xyz(optics::light_lines(line(l.nm).table)); };
  const optics::Colour a = colour(lines[0]), b = colour(lines[1]);
  const double determinant = a[0] * b[2] - b[0] * a[2];
  return {(xyz[0] * b[2] - b[0] * xyz[2]) / determinant, (a[0] * xyz[2] - xyz[0] * a[2]) / determinant};
}

struct Way {
  const char* name;
  spectral::Settings::Estimator estimator;
  spectral::Settings::Method method;
};

class MapBands : public testing::TestWithParam<Way> {};

// Each image has the light of its own line, and nothing of the other, whose paths pass the stripe by. One wavelength a path and pass, or a
// cluster for each, of which the eye's paths are dealt unequal parts. All of a pass of sppm has one wavelength, by steps of the golden
// ratio, and the radius shrinks from pass to pass: they are not independent, and how far its figure may be off is known from other seeds.
TEST_P(MapBands, AStripeHasOneImageForEachLine)
{
  for (std::size_t i = 0; i < lines.size(); ++i) {
    preset::Preset p = stripe_through_a_prism(lines[i]);
    spectral::settings(p).estimator = GetParam().estimator;
    spectral::settings(p).method = GetParam().method;
    const std::vector<Estimate> figures = render_passes(p, radiance_in_lines);
    const double truth = radiance(lines[i]);
    const bool hang_together = GetParam().estimator == spectral::Settings::Estimator::sppm;
    const double error = hang_together ? tolerance_over_seeds(lines[i].sppm_scatter, 30) : tolerance(figures[i]) / truth + 1e-3;
    expect_truth(fmt::format("stripe through a prism, {} nm, {}: radiance over its truth", lines[i].nm, GetParam().name),
                 figures[i].mean / truth, 1, error);
    EXPECT_LE(error, 0.13) << "such a check would see too little";
    EXPECT_NEAR(figures[1 - i].mean / truth, 0, 1e-4) << "light of " << lines[1 - i].nm << " nm";
  }
}

INSTANTIATE_TEST_SUITE_P(, MapBands,
                         testing::Values(Way{"automatic", spectral::Settings::Estimator::automatic, spectral::Settings::Method::optimal},
                                         Way{"sppm", spectral::Settings::Estimator::sppm, spectral::Settings::Method::optimal},
                                         Way{"clusters", spectral::Settings::Estimator::automatic,
                                             spectral::Settings::Method::brute_force}),
                         [](const auto& way) { return std::string(way.param.name); });

} // namespace nephroid::map_bands_test
