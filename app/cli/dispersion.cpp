// SPDX-License-Identifier: Apache-2.0
// `nephroid dispersion`: n and k of dispersion files at wavelengths. A file that fails is reported and the others go
// on.
#include "base/error.h"
#include "base/json_output.h"
#include "cli/dispersion_input.h"
#include "cli/verb.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <memory>

namespace nephroid::cli {
namespace {

using Json = nlohmann::ordered_json;

struct DispersionOptions {
  std::vector<std::string> files;
  std::vector<double> nm;
  std::string outside;
  bool json = false;
};

/// Fraunhofer's lines e, d, F and C (Hg, He, H, H), at which glass catalogues give n and the Abbe number, and the ends
/// of the grid.
const std::vector<double> usual_nm{optics::first_nm,  optics::line_f_nm, optics::line_e_nm,
                                   optics::line_d_nm, optics::line_c_nm, optics::last_nm};

Json or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json to_json(const std::string& file, const optics::DispersionCurve& curve,
             const std::vector<optics::IndexSample>& samples) {
  const auto [low, high] = curve.range_nm();
  Json rows = Json::array();
  for (const optics::IndexSample& s : samples)
    rows.push_back({{"nm", s.nm}, {"n", or_null(s.n)}, {"k", or_null(s.k)}, {"extrapolated", s.extrapolated}});
  return {{"file", file}, {"name", curve.name}, {"range_nm", {low, or_null(high)}}, {"samples", std::move(rows)}};
}

void print_text(const optics::DispersionCurve& curve, const std::vector<optics::IndexSample>& samples) {
  const auto cell = [](const std::optional<double>& value, const char* format) {
    return value ? fmt::format(fmt::runtime(format), *value) : std::string("-");
  };
  const auto [low, high] = curve.range_nm();
  fmt::print("{} ({}), {} {:.6g}..{:.6g} nm\n", curve.name, curve.source,
             !curve.n           ? "k"
             : curve.n->formula ? "formula"
                                : "table",
             low, high);
  fmt::print("{:>10} {:>10} {:>11}\n", "nm", "n", "k");
  for (const optics::IndexSample& s : samples)
    fmt::print("{:>10.8g} {:>10} {:>11}{}\n", s.nm, cell(s.n, "{:.6f}"), cell(s.k, "{:.4e}"),
               s.extrapolated ? "  outside the range" : "");
  if (const std::optional<double> abbe = optics::abbe_number(curve)) fmt::print("Abbe number V_d {:.2f}\n", *abbe);
}

/// Says on standard error where a formula has no value; the sample is null there.
void note_missing(const std::string& file, const optics::DispersionCurve& curve,
                  const std::vector<optics::IndexSample>& samples) {
  if (!curve.n) return;
  for (const optics::IndexSample& s : samples)
    if (!s.n) fmt::print(stderr, "nephroid: {}: the formula gives no finite n at {:.8g} nm\n", file, s.nm);
}

void print_file(const std::string& file, const DispersionOptions& options) {
  const optics::DispersionCurve curve = scatter::load_dispersion(file);
  std::vector<optics::IndexSample> samples;
  for (double nm : options.nm.empty() ? usual_nm : options.nm)
    samples.push_back(curve.sample(nm, outside_policy(options.outside)));
  note_missing(file, curve, samples);
  options.json ? fmt::print("{}\n", json_text(to_json(file, curve, samples))) : print_text(curve, samples);
}

void print_dispersion(const DispersionOptions& options, Session& session) {
  for (double nm : options.nm)
    if (!std::isfinite(nm) || !(nm > 0))
      throw bad_input("--nm", fmt::format("the wavelength is {} nm", nm), "expected a number above 0");
  for (const std::string& file : options.files) {
    try {
      print_file(file, options);
    } catch (const Error& error) {
      session.exit_code = static_cast<int>(ErrorKind::bad_input);
      if (options.json)
        fmt::print("{}\n", json_text({{"file", file}, {"error", error.line()}}));
      else
        fmt::print(stderr, "nephroid: {}\n", error.line());
    }
  }
}

} // namespace

void add_dispersion(CLI::App& program, Session& session) {
  const auto options = std::make_shared<DispersionOptions>();
  Verb verb(program, "dispersion", "Index of refraction n and extinction coefficient k of dispersion files",
            {{"nephroid dispersion N-BK7 N-SF66", "two glasses at the usual lines"},
             {"nephroid dispersion N-SF66 --nm 486.13,656.27", ""}});
  verb.option("FILE", options->files,
              {.says = "Files of refractiveindex.info or Zemax (.agf), or shipped materials by name (N-BK7)",
               .required = true});
  verb.option("--nm", options->nm,
              {.type = "L",
               .says = "Wavelength in nm; may be repeated; default: lines F, e, d, C, and 380 and 780 nm",
               .separator = ','});
  add_outside_option(verb, options->outside);
  verb.flag("--json", options->json, "One JSON line a file");
  verb.work([options, &session] { print_dispersion(*options, session); });
}

} // namespace nephroid::cli
