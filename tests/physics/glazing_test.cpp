// SPDX-License-Identifier: Apache-2.0
// What passes a glazing, comes back from it and is lost in it, from both sides and by wavelength, against the formulas
// on the host; and a real pane of glass, with a thickness, beside it.
#include "base/counted.h"
#include "optics/glazing.h"
#include "spectral/settings.h"
#include "tests/support/closed_form.h"

namespace nephroid::glazing_test {

constexpr int photons = 1 << 15;

/// Parts of a pencil's light.
struct Parts {
  double passes, reflects, lost;
};

/// A floor below the surface takes what passes; what comes back leaves the scene.
Parts parts(preset::Object surface, const preset::Material& material, double theta, double nm) {
  preset::Preset p = empty_preset(16);
  p.scene.materials["panes"] = material;
  p.scene.materials["white"] = white();
  surface.material = "panes";
  p.scene.objects = {std::move(surface), object("floor", quad(1000, 1000), "white", at({0, -1, 0}))};
  p.scene.lights = {check::inclined_pencil(theta, nm)};
  spectral::settings(p).photons_per_pass = photons;
  spectral::settings(p).indirect = false;
  const photons::EnergyBalance e = photons::energy_of(render(p));
  return {e.deposited_w / e.emitted_w, e.escaped_w / e.emitted_w, e.absorbed_w / e.emitted_w};
}

preset::Material glazing(std::vector<preset::Pane> panes) {
  preset::Material material;
  material.type = preset::Material::Type::glazing;
  material.panes = std::move(panes);
  return material;
}

preset::Pane clear(double n, double passes = 1) {
  preset::Pane pane;
  pane.dispersion = {};
  pane.dispersion.n = n;
  pane.tint.value = passes;
  return pane;
}

preset::Object window(bool shows_its_front) {
  preset::Shape shape = quad(40, 40);
  shape.inwards = !shows_its_front;
  return object("window", shape, "panes");
}

double stokes(double n, double theta, double faces) {
  const double t = std::asin(std::sin(theta) / n);
  const auto of = [&](double r) { return (1 - r) / (1 + (faces - 1) * r) / 2; };
  if (theta == 0) return 2 * of(std::pow((n - 1) / (n + 1), 2));
  return of(std::pow(std::sin(theta - t) / std::sin(theta + t), 2)) +
         of(std::pow(std::tan(theta - t) / std::tan(theta + t), 2));
}

// The table's straight lines between angles are off by up to .0006 of the light.
constexpr double table_error = 7e-4;

TEST(Glazing, ClearPanesPassWhatFresnelSays) {
  for (const int panes : {1, 2, 3})
    for (const double theta_deg : {0.0, 60.0, 80.0}) {
      const double theta = theta_deg * degree, truth = stokes(1.5, theta, 2 * panes);
      const Parts at =
          parts(window(true), glazing(std::vector(static_cast<std::size_t>(panes), clear(1.5))), theta, 550);
      expect_share(fmt::format("glazing: {} clear, what passes at {} degrees", counted(panes, "pane"), theta_deg),
                   at.passes, truth, photons, table_error);
      EXPECT_NEAR(at.passes + at.reflects, 1, 1e-5);
    }
}

// The index that is found from the data is of both faces.
TEST(Glazing, UnlikeFacesHaveACoating) {
  preset::Pane pane;
  pane.type = preset::Pane::Type::measured;
  pane.transmittance.value = 0.6;
  pane.front_reflectance.value = 0.05;
  pane.back_reflectance.value = 0.3;
  const auto load = [&] { parts(window(true), glazing({pane}), 0, 550); };
  load();
  pane.coated = false;
  EXPECT_THAT(test::refusal_of(load), HasSubstr("the faces reflect 0.05 and 0.3 at 380 nm"));
}

// A coating that reflects red and lets blue pass, in front of glass that keeps a part: each wavelength has its own
// parts, though all go the way that chance gives to their mean.
TEST(Glazing, EachWavelengthAndSideHasItsOwnParts) {
  preset::Pane coated;
  coated.type = preset::Pane::Type::measured;
  const auto table = [](double blue, double red) {
    return preset::Reflectance{preset::Reflectance::Type::table, 0, {}, {{400, blue}, {700, red}}};
  };
  coated.transmittance = table(0.7, 0.3);
  coated.front_reflectance = table(0.1, 0.6);
  coated.back_reflectance = table(0.2, 0.4);
  const preset::Material material = glazing({coated, clear(1.6, 0.8)});
  optics::MeasuredPane first;
  const optics::Spectrum along = optics::spectrum_of([](double nm) { return std::clamp((nm - 400) / 300, 0.0, 1.0); });
  optics::GlassPane second;
  second.n.fill(1.6);
  second.passes.fill(0.8);
  for (std::size_t w = 0; w < along.size(); ++w) {
    first.transmittance[w] = 0.7 - 0.4 * along[w];
    first.front[w] = 0.1 + 0.5 * along[w];
    first.back[w] = 0.2 + 0.2 * along[w];
  }
  const std::vector<optics::Pane> panes{first, second};
  for (const double nm : {420.0, 550.0, 680.0})
    for (const double theta_deg : {0.0, 50.0, 75.0})
      for (const bool front : {true, false}) {
        const double theta = theta_deg * degree;
        const optics::GlazingParts truth = optics::glazing_parts(
            panes, std::cos(theta), static_cast<std::size_t>(nm) - optics::first_nm, optics::SpectralRange::visible);
        const Parts at = parts(window(front), material, theta, nm);
        const std::string where = fmt::format("at {} nm and {} degrees, {}", nm, theta_deg, front ? "front" : "back");
        // A photon may stand for four times its power.
        expect_share("glazing: what passes " + where, at.passes, truth.passes, photons / 16.0, table_error);
        expect_share("glazing: what comes back " + where, at.reflects, front ? truth.front : truth.back, photons / 16.0,
                     table_error);
        EXPECT_NEAR(at.passes + at.reflects + at.lost, 1, 1e-5);
      }
}

// Plates of glass with two faces each and a thickness pass as much as a unit of panes without one. Little slanted: the
// faces of bodies send on unpolarised light, and panes keep the polarisation between them.
TEST(Glazing, IsAsPlatesOfGlass) {
  for (const double theta_deg : {0.0, 20.0}) {
    const double theta = theta_deg * degree;
    const Parts plate = parts(object("plate", box(400, 0.02, 400), "panes", at({0, -0.01, 0})), glass(1.5), theta, 550),
                pane = parts(window(true), glazing({clear(1.5)}), theta, 550);
    expect_share(fmt::format("glazing: what passes at {} degrees, beside a plate of glass", theta_deg), pane.passes,
                 plate.passes, photons / 2.0, table_error);
  }
}

} // namespace nephroid::glazing_test
