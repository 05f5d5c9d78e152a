// SPDX-License-Identifier: Apache-2.0
// Extreme cases as rows of a table: what is extreme, what came out, what is right and how that is known. Where the environment variable
// NEPHROID_EXTREMES_TABLE names a file, every case appends its row to it: docs/extremes.md is made of these.
#pragma once
#include "base/error.h"
#include "preset/preset.h"
#include "preset/read.h"
#include "tests/support/closed_form.h"
#include "tests/support/presets.h"
#include "tests/support/render.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace nephroid::test {

/// What a case gave, what would have been right, and whether it was.
struct Outcome {
  std::string gave, right;
  bool good = true;
};

inline Outcome near(double gave, double right, double tolerance)
{
  return {fmt::format("{:.7g}", gave), fmt::format("{:.7g} &plusmn; {:.1g}", right, tolerance), std::abs(gave - right) <= tolerance};
}
/// Of `count` independent photons of equal power.
inline Outcome share(double gave, double right, double count)
{
  return near(gave, right, sigmas * std::sqrt(std::max(right * (1 - right), 1 / count) / count));
}
inline Outcome at_most(double gave, double most)
{
  return {fmt::format("{:.2g}", gave), fmt::format("at most {:.2g}", most), gave <= most};
}
inline Outcome exactly(double gave, double right) { return {fmt::format("{:.7g}", gave), fmt::format("{:.7g}", right), gave == right}; }
inline Outcome says(const std::string& gave, const std::string& right) { return {"\"" + gave + "\"", "that line", gave == right}; }

/// The call is refused as bad input, with exactly this line.
template <class Call>
Outcome refused(const Call& call, const std::string& line)
{
  try {
    call();
  } catch (const Error& error) {
    return {"refused: `" + error.line() + "`", "refused", error.kind() == ErrorKind::bad_input && error.line() == line};
  }
  return {"no refusal", "refused: `" + line + "`", false};
}
/// A preset of this JSON, called p.json, is refused when it is read.
inline Outcome refused_json(const std::string& fields, const std::string& line)
{
  return refused([&] { preset::parse_preset(R"({"engine":"spectral",)" + fields + "}", "p.json"); }, "p.json#" + line);
}
inline Outcome both(const Outcome& a, const Outcome& b) { return {a.gave + "; " + b.gave, a.right + "; " + b.right, a.good && b.good}; }

struct Extreme {
  std::string name;  ///< of the test: letters, digits
  std::string what;  ///< is extreme
  std::string truth; ///< how the right answer is known
  std::function<Outcome()> run;
};
inline void PrintTo(const Extreme& extreme, std::ostream* stream) { *stream << extreme.what; }

inline void expect_right(const Extreme& extreme)
{
  const Outcome outcome = extreme.run();
  testing::Test::RecordProperty("what", extreme.what);
  testing::Test::RecordProperty("gave", outcome.gave);
  EXPECT_TRUE(outcome.good) << extreme.what << " gave " << outcome.gave << "; right is " << outcome.right << ": " << extreme.truth;
  if (const char* file = std::getenv("NEPHROID_EXTREMES_TABLE"))
    std::ofstream(file, std::ios::app) << fmt::format("| {} | {} | {} | {} |\n", extreme.what, outcome.gave, outcome.right, extreme.truth);
}

/// A floor far below, white, and a camera that does not matter: for cases that the energy balance decides.
inline preset::Preset over_floor(int photons)
{
  preset::Preset p = empty_preset(16);
  p.scene.materials["white"] = white();
  p.scene.objects.push_back(object("floor", quad(1e4, 1e4), "white", at({0, -1, 0})));
  p.scene.camera.position = {0, 5, 0};
  p.scene.camera.up = {0, 0, -1};
  p.spectral.photons_per_pass = photons;
  p.spectral.max_surfaces = 200;
  return p;
}

/// Share of the emitted power that ends on a diffuse surface after glass or a mirror. Photons refused by the film or by the balance count
/// as a wrong result.
inline double deposited(const preset::Preset& p)
{
  const job::EnergyBalance e = render(p).energy;
  EXPECT_EQ(e.refused_contributions, 0u);
  EXPECT_NEAR(e.deposited_w + e.missed_w + e.absorbed_w + e.escaped_w + e.lost_w, e.emitted_w, 1e-9 * e.emitted_w);
  return e.deposited_w / e.emitted_w;
}

/// The largest difference of two pictures' numbers, as a share of the largest number.
inline double largest_difference(const std::vector<float>& a, const std::vector<float>& b, double factor = 1)
{
  if (a.size() != b.size()) return INFINITY;
  double difference = 0, largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference = std::max(difference, std::abs(factor * double(a[i]) - double(b[i])));
    largest = std::max(largest, std::abs(double(b[i])));
  }
  return difference / largest;
}

} // namespace nephroid::test
