// SPDX-License-Identifier: Apache-2.0
// Extreme cases as rows of a table: what is extreme, what came out, what is right and how that is known. Where the
// environment variable NEPHROID_EXTREMES_TABLE names a file, every case appends its row to it:
// docs/notebook/extremes.md sums them up.
#pragma once
#include "preset/read.h"
#include "spectral/settings.h"
#include "tests/support/closed_form.h"

namespace nephroid::test {

/// What a case gave, what would have been right, and whether it was.
struct Outcome {
  std::string gave, right;
  bool good = true;
};

inline Outcome near(double gave, double right, double tolerance) {
  return {fmt::format("{:.7g}", gave), fmt::format("{:.7g} &plusmn; {:.1g}", right, tolerance),
          std::abs(gave - right) <= tolerance};
}
/// A share of `count` independent photons of equal power.
inline Outcome share(double gave, double right, double count) {
  return near(gave, right, sigmas * std::sqrt(std::max(right * (1 - right), 1 / count) / count));
}
inline Outcome at_most(double gave, double most) {
  return {fmt::format("{:.2g}", gave), fmt::format("at most {:.2g}", most), gave <= most};
}
inline Outcome exactly(double gave, double right) {
  return {fmt::format("{:.7g}", gave), fmt::format("{:.7g}", right), gave == right};
}
inline Outcome says(const std::string& gave, const std::string& right) {
  return {"\"" + gave + "\"", "that line", gave == right};
}

/// The call is refused as bad input, with exactly this line.
template <class Call>
Outcome refused(const Call& call, const std::string& line) {
  try {
    call();
  } catch (const Error& error) {
    return {"refused: `" + error.line() + "`", "refused", error.kind() == ErrorKind::bad_input && error.line() == line};
  }
  return {"no refusal", "refused: `" + line + "`", false};
}
/// A preset of this JSON, called p.json, is refused when it is read.
inline Outcome refused_json(const std::string& fields, const std::string& line) {
  return refused([&] { preset::parse_preset(R"({"engine":"spectral",)" + fields + "}", "p.json"); }, "p.json#" + line);
}
inline Outcome both(const Outcome& a, const Outcome& b) {
  return {a.gave + "; " + b.gave, a.right + "; " + b.right, a.good && b.good};
}

struct Extreme {
  std::string name;  ///< the test's name: letters, digits
  std::string what;  ///< is extreme
  std::string truth; ///< how the right answer is known
  std::function<Outcome()> run;
};
inline void PrintTo(const Extreme& extreme, std::ostream* stream) { *stream << extreme.what; }

inline void expect_right(const Extreme& extreme) {
  const Outcome outcome = extreme.run();
  testing::Test::RecordProperty("what", extreme.what);
  testing::Test::RecordProperty("gave", outcome.gave);
  EXPECT_TRUE(outcome.good) << extreme.what << " gave " << outcome.gave << "; right is " << outcome.right << ": "
                            << extreme.truth;
  if (const char* file = std::getenv("NEPHROID_EXTREMES_TABLE"))
    std::ofstream(file, std::ios::app) << fmt::format("| {} | {} | {} | {} |\n", extreme.what, outcome.gave,
                                                      outcome.right, extreme.truth);
}

/// A floor far below, white, and a camera that does not matter: for cases that the energy balance decides.
inline preset::Preset over_floor(int photons) {
  preset::Preset p = empty_preset(16);
  p.scene.materials["white"] = white();
  p.scene.objects.push_back(object("floor", quad(1e4, 1e4), "white", at({0, -1, 0})));
  p.scene.camera.position = {0, 5, 0};
  p.scene.camera.up = {0, 0, -1};
  spectral::settings(p).photons_per_pass = photons;
  spectral::settings(p).max_surfaces = 200;
  return p;
}

/// Share of the emitted power that ends on a diffuse surface after glass or a mirror. Photons refused by the film or by
/// the balance count as a wrong result.
inline double deposited(const preset::Preset& p) {
  const photons::EnergyBalance e = photons::energy_of(render(p));
  EXPECT_EQ(e.refused_contributions, 0u);
  EXPECT_NEAR(e.deposited_w + e.missed_w + e.absorbed_w + e.escaped_w + e.lost_w, e.emitted_w, 1e-9 * e.emitted_w);
  return e.deposited_w / e.emitted_w;
}

/// The largest difference of two pictures' numbers, as a share of the largest number.
inline double largest_difference(const std::vector<float>& a, const std::vector<float>& b, double factor = 1) {
  if (a.size() != b.size()) return INFINITY;
  double difference = 0, largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference = std::max(difference, std::abs(factor * double(a[i]) - double(b[i])));
    largest = std::max(largest, std::abs(double(b[i])));
  }
  return difference / largest;
}

inline preset::Shape sphere(double radius) { return check::ball(radius); }

/// A white floor under a lamp of 1 W, seen from above; the picture is 1 m of it.
inline preset::Preset lit_floor(int pixels = 16) {
  preset::Preset p = empty_preset(pixels);
  p.source = "p.json";
  p.scene.materials["white"] = white();
  p.scene.objects = {object("floor", quad(10, 10), "white")};
  p.scene.lights.resize(1);
  p.scene.lights[0].spectrum = line(550);
  p.scene.lights[0].position = {0.1, 1, -0.2};
  Screen screen{.pixels = pixels};
  screen.fill(p.scene.camera, 2);
  spectral::settings(p).direct = true;
  spectral::settings(p).pixel_samples = 16;
  p.stop.passes = 16;
  return p;
}

/// The same with a glass ball in the light, so that there is a caustic.
inline preset::Preset ball_over_lit_floor() {
  preset::Preset p = lit_floor();
  p.scene.materials["glass"] = glass(1.5);
  p.scene.objects.push_back(object("ball", sphere(0.1), "glass", at({0.3, 0.4, 0.2})));
  p.stop.passes = 4;
  return p;
}

inline double mean_y(const job::Snapshot& snapshot, const std::string& name) {
  EXPECT_EQ(photons::energy_of(snapshot).refused_contributions, 0u);
  const std::vector<double> y = luminance(layer(snapshot, name));
  return std::accumulate(y.begin(), y.end(), 0.0) / static_cast<double>(y.size());
}

/// The mean irradiance on the picture in W/m^2, by its layer.
inline double mean_irradiance(const preset::Preset& p, const std::string& name = "direct") {
  return mean_y(render(p), name) * M_PI / optics::to_xyz(optics::light_lines(p.scene.lights[0].spectrum.table))[1] *
         p.white.value_or(1);
}

/// I cos / d^2 of a point, mean over 1 m of floor.
inline double irradiance_of_point(const preset::Vec3& light, double intensity, double side = 1) {
  constexpr int n = 400;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double x = ((i + 0.5) / n - 0.5) * side - light[0], z = ((k + 0.5) / n - 0.5) * side - light[2],
                   y = light[1];
      sum += y / std::pow(x * x + y * y + z * z, 1.5);
    }
  return intensity * sum / (n * n);
}

inline Outcome share_of_one(double gave, double right, double tolerance) { return near(gave / right, 1, tolerance); }

using check::mirror;

/// Loading warns with exactly this line.
inline Outcome warns(const preset::Preset& p, const std::string& line) {
  std::string lines;
  for (const std::string& warning : scene::load_scene(p).warnings) lines += (lines.empty() ? "" : " / ") + warning;
  return says(lines, line);
}

inline Outcome black(const preset::Preset& p) {
  const job::Snapshot snapshot = render(p);
  double largest = 0;
  for (const float v : snapshot.picture->rgb)
    largest = std::max(largest, std::isfinite(v) ? std::abs(double(v)) : INFINITY);
  return exactly(largest, 0);
}

} // namespace nephroid::test
