// SPDX-License-Identifier: Apache-2.0
#include "optics/zemax_glass.h"

#include "base/error.h"
#include "base/numbers.h"
#include "base/plain_text.h"
#include "optics/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

namespace nephroid::optics {
namespace {

struct Formula {
  int number = 0; ///< of refractiveindex.info; 0: none
  std::vector<double> coefficients;
};

/// A constant, then a term with each of these exponents.
Formula power_series(int number, const std::vector<double>& c, std::initializer_list<double> exponents) {
  Formula formula{number, {c[0]}};
  std::size_t next = 1;
  for (const double exponent : exponents) {
    formula.coefficients.push_back(c[next++]);
    formula.coefficients.push_back(exponent);
  }
  return formula;
}

/// Zemax's formula, of which refractiveindex.info has the terms in one of its own. c: ten coefficients.
Formula formula_of(int kind, const std::vector<double>& c) {
  switch (kind) {
  case 1: return power_series(3, c, {2, -2, -4, -6, -8}); // Schott
  case 2:                                                 // Sellmeier 1, 3 and 5
  case 6:
  case 11: {
    Formula formula{2, c};
    formula.coefficients.resize(kind == 2 ? 6 : kind == 6 ? 8 : 10);
    formula.coefficients.insert(formula.coefficients.begin(), 0);
    return formula;
  }
  case 3: return {7, {c.begin(), c.begin() + 6}};                       // Herzberger
  case 4: return {4, {1 + c[0], c[1], 2, c[2], 2, c[3], 0, c[4], 2}};   // Sellmeier 2
  case 5: return power_series(5, c, {-1, -3.5});                        // Conrady
  case 7: return {4, {c[0], c[1], 0, c[2], 1, 0, 0, 0, 0, -c[3], 2}};   // Handbook of Optics 1
  case 8: return {4, {c[0], c[1], 2, c[2], 1, 0, 0, 0, 0, -c[3], 2}};   // Handbook of Optics 2
  case 9: return {4, {c[0], c[1], 2, c[2], 1, c[3], 2, c[4], 1}};       // Sellmeier 4
  case 10: return power_series(3, c, {2, -2, -4, -6, -8, -10, -12});    // Extended
  case 12: return power_series(3, c, {2, -2, -4, -6, -8, 4, 6});        // Extended 2
  case 13: return power_series(3, c, {2, 4, -2, -4, -6, -8, -10, -12}); // Extended 3
  default: return {};
  }
}

/// Of a line's words from the one with this number on, at least `least`.
std::vector<double> numbers(const std::vector<std::string>& words, std::size_t from, std::size_t least,
                            const Location& where) {
  std::vector<double> values;
  for (std::size_t i = from; i < words.size(); ++i) {
    const auto value = typed_number<double>(words[i]);
    if (!value || !std::isfinite(*value)) break; // some lines end in words
    values.push_back(*value);
  }
  if (values.size() < least)
    throw bad_input(where, fmt::format("{} is followed by {} numbers", words[0], values.size()),
                    fmt::format("expected at least {}", least));
  return values;
}

std::string several(const std::vector<std::string>& names) {
  constexpr std::size_t most = 12;
  std::string text = names[0];
  for (std::size_t i = 1; i < std::min(names.size(), most); ++i) text += ", " + names[i];
  if (names.size() > most) text += fmt::format(" and {} more", names.size() - most);
  return text;
}

} // namespace

DispersionCurve parse_zemax_glass(const std::string& text, const std::filesystem::path& source) {
  const std::string file = source.string();
  std::vector<std::string> names;
  std::vector<double> coefficients, range;
  std::vector<Row> k;
  double kind = 0, n_d = 0;
  Location name_line = file;
  std::istringstream lines(plain_text(text));
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) {
    const Location where{file, ++count};
    std::istringstream of_line(line);
    std::vector<std::string> words;
    for (std::string word; of_line >> word;) words.push_back(word);
    if (words.empty()) continue;
    if (words[0] == "NM") { // name, formula, number of the glass, n_d, ...
      if (words.size() < 3) throw bad_input(where, "the glass has no name and formula", "expected NM NAME NUMBER ...");
      names.push_back(words[1]);
      kind = numbers(words, 2, 1, where)[0];
      if (const auto value = words.size() > 4 ? typed_number<double>(words[4]) : std::nullopt) n_d = *value;
      name_line = where;
    }
    if (names.empty()) continue;
    if (words[0] == "CD") coefficients = numbers(words, 1, 1, where);
    if (words[0] == "LD") range = numbers(words, 1, 2, where);
    if (words[0] == "IT" && words.size() > 3) { // micrometres, transmittance, millimetres
      const std::vector<double> it = numbers(words, 1, 3, where);
      constexpr double least = 5e-4; // 0.000 is below
      if (it[1] > 1 || !(it[0] > 0) || !(it[2] > 0)) continue;
      k.push_back({it[0] * 1000, -std::log(std::max(it[1], least)) / it[2] * it[0] * 1e-3 / (4 * std::numbers::pi)});
    }
  }
  if (names.empty())
    throw bad_input(file, "has no glass: no line begins with NM", "expected a glass catalogue of Zemax (.agf)");
  if (names.size() > 1)
    throw bad_input(file, fmt::format("has {} glasses: {}", names.size(), several(names)), "expected one",
                    "copy the lines of yours, from its NM up to the next NM, into a file of its own (.agf)");
  coefficients.resize(std::max<std::size_t>(coefficients.size(), 10));
  const Formula formula = formula_of(static_cast<int>(std::clamp(kind, 0.0, 99.0)), coefficients);
  if (formula.number == 0)
    throw bad_input(name_line, fmt::format("the formula of {} is {}", names[0], kind), "expected 1 to 13");
  if (range.size() < 2 || !(range[0] > 0) || !(range[1] >= range[0]))
    throw bad_input(file, "has no line LD with the range of its formula", "expected LD and two wavelengths in um");
  DispersionCurve curve;
  curve.name = names[0];
  curve.source = file;
  curve.n = Curve{[formula](double nm) { return index_by_formula(formula.number, formula.coefficients, nm / 1000); },
                  range[0] * 1000, range[1] * 1000, true};
  if (!k.empty()) curve.k = curve_of(LinearTable(sorted_rows(k, Duplicates::mean, file)));
  if (const double by_formula = curve.n->value(line_d_nm);
      n_d > 1 && curve.n->low_nm <= line_d_nm && curve.n->high_nm >= line_d_nm && !(std::abs(by_formula - n_d) < 1e-3))
    throw bad_input(
        name_line,
        fmt::format("the formula of {} gives n_d = {:.5f}, and its line NM says {}", names[0], by_formula, n_d), {},
        "check its coefficients (CD)");
  return curve;
}

} // namespace nephroid::optics
