// SPDX-License-Identifier: Apache-2.0
// Reads the YAML files of the refractiveindex.info database as they are: one of formulas 1-9, or tables of n, k or
// both, or a constant, and any of these for n beside a table for k. Oddities of the database are read: rows out of
// order, wavelengths given twice (their mean counts), one row, blank rows, negative n or k, few coefficients.
#include "optics/dispersion_file.h"

#include "base/error.h"
#include "base/files.h"
#include "base/lower_case.h"
#include "base/nearest.h"
#include "base/numbers.h"
#include "optics/tables.h"
#include "optics/zemax_glass.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

namespace nephroid::optics {
namespace {

/// "FILE:LINE" of a place in the text; lines count from 0 in yaml-cpp and from 1 for people.
Location place(const std::string& file, int line) { return {file, static_cast<std::size_t>(line + 1)}; }
Location place(const std::string& file, const YAML::Node& node) { return place(file, node.Mark().line); }

/// The beginning of a text that a file may have of any length.
std::string in_quotes(std::string_view text) { return fmt::format("\"{}\"", text.substr(0, 40)); }

std::vector<std::string_view> words(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  std::vector<std::string_view> result;
  while (true) {
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return result;
    text.remove_prefix(begin);
    const std::size_t end = std::min(text.find_first_of(blanks), text.size());
    result.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
}

double number(std::string_view word, const Location& where) {
  const auto value = typed_number<double>(word);
  if (!value || !std::isfinite(*value))
    throw bad_input(where, in_quotes(word) + " is no number", "expected a finite number such as 1.5168 or 2.86E-06");
  return *value;
}

std::vector<double> numbers(std::string_view text, const Location& where) {
  std::vector<double> result;
  for (std::string_view word : words(text)) result.push_back(number(word, where));
  return result;
}

/// The text of a block's key. Throws where it is missing or is not text.
YAML::Node text_of(const YAML::Node& block, const char* key, const std::string& file) {
  const YAML::Node node = block[key];
  if (!node.IsDefined()) throw bad_input(place(file, block), fmt::format("the entry has no \"{}\"", key));
  if (!node.IsScalar())
    throw bad_input(place(file, node), fmt::format("\"{}\" is not text", key), "expected numbers separated by blanks");
  return node;
}

/// The first coefficient of the group that this one is in, and how many the group has. They count from 1; the first
/// of a group is a factor, without which the others mean nothing.
struct Group {
  std::size_t first = 0, size = 1;
};
Group group_of(int formula, std::size_t number) {
  const auto pair_from = [&](std::size_t first) { return Group{number - (number - first) % 2, 2}; };
  if (number == 1 || formula == 7) return {number, 1};
  switch (formula) {
  case 4: return number < 6 ? Group{2, 4} : number < 10 ? Group{6, 4} : pair_from(10);
  case 8: return number < 4 ? Group{2, 2} : Group{4, 1};
  case 9: return number < 4 ? Group{2, 2} : Group{4, 3};
  default: return pair_from(2);
  }
}

Curve formula_curve(const YAML::Node& block, int formula, const std::string& file) {
  const YAML::Node range_node = text_of(block, "wavelength_range", file), values = text_of(block, "coefficients", file);
  const std::vector<double> range = numbers(range_node.Scalar(), place(file, range_node));
  if (range.size() != 2 || !(range[0] > 0) || !(range[1] >= range[0]))
    throw bad_input(place(file, range_node), "the wavelength range is " + in_quotes(range_node.Scalar()),
                    "expected two numbers in micrometres, the lower first, above 0");

  std::vector<double> coefficients = numbers(values.Scalar(), place(file, values));
  const auto most = static_cast<std::size_t>(most_coefficients(formula));
  if (coefficients.empty()) throw bad_input(place(file, values), "there are no coefficients", "expected at least one");
  if (most > 0 && coefficients.size() > most)
    throw bad_input(place(file, values), fmt::format("formula {} has {} coefficients", formula, coefficients.size()),
                    fmt::format("expected at most {}", most));

  const std::size_t count = coefficients.size();
  const bool may_be_constant = formula == 3 || formula == 5 || formula == 7; // polynomials
  if (count == 1 && !may_be_constant)
    throw bad_input(place(file, values), fmt::format("formula {} has 1 coefficient", formula),
                    "expected the terms after it, too: without them n is the same at all wavelengths",
                    "where that is meant, the type is \"constant\"");
  if (const Group group = group_of(formula, count);
      count + 1 < group.first + group.size && coefficients[group.first - 1] != 0)
    throw bad_input(place(file, values), fmt::format("formula {} has {} coefficients", formula, count),
                    fmt::format("expected number {}, too, which belongs to the {} of number {}", count + 1,
                                coefficients[group.first - 1], group.first));

  const auto value = [formula, c = std::move(coefficients)](double nm) {
    return index_by_formula(formula, c, nm / 1000);
  };
  return {value, range[0] * 1000, range[1] * 1000, true};
}

/// A table's rows of `columns` numbers, wavelengths still in micrometres.
std::vector<std::vector<double>> table_rows(const YAML::Node& block, std::size_t columns, const std::string& file) {
  const YAML::Node data = text_of(block, "data", file);
  std::vector<std::vector<double>> rows;
  // "data: |" starts the text on the line after its own.
  int line = data.Mark().line + 1;
  std::string_view rest = data.Scalar();
  while (!rest.empty()) {
    const std::size_t end = rest.find('\n');
    const Location where = place(file, line++);
    std::vector<double> row = numbers(rest.substr(0, end), where);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (row.empty()) continue;
    if (row.size() != columns)
      throw bad_input(where, fmt::format("the row has {} numbers", row.size()),
                      fmt::format("expected {}: the wavelength in micrometres{}", columns,
                                  columns == 3 ? ", n and k" : " and the value"));
    if (!(row[0] > 0))
      throw bad_input(where, fmt::format("the wavelength is {} um", row[0]), "expected a wavelength above 0");
    rows.push_back(std::move(row));
  }
  if (rows.empty()) throw bad_input(place(file, data), "the table is empty", "expected at least one row of numbers");
  return rows;
}

Curve table_curve(const std::vector<std::vector<double>>& rows, std::size_t column, const Location& where) {
  std::vector<Row> pairs;
  for (const auto& row : rows) pairs.push_back({row[0] * 1000, row[column]});
  return curve_of(LinearTable(sorted_rows(pairs, Duplicates::mean, where)));
}

/// The first entry that gives n and the first that gives k count: one file has n by a formula and in a table.
void keep_first(std::optional<Curve>& kept, Curve curve) {
  if (!kept) kept = std::move(curve);
}

Curve constant_curve(const YAML::Node& block, const std::string& file) {
  const YAML::Node value = text_of(block, "value", file);
  const double n = number(value.Scalar(), place(file, value));
  return {[n](double) { return n; }, 0, std::numeric_limits<double>::infinity(), true};
}

/// "formula 3" gives 3; 0 for anything else.
int formula_number(const std::string& type) {
  const std::vector<std::string_view> parts = words(type);
  if (parts.size() != 2 || parts[0] != "formula" || parts[1].size() != 1) return 0;
  const int number = parts[1][0] - '0';
  return number >= 1 && number <= formula_count ? number : 0;
}

void read_block(const YAML::Node& block, DispersionCurve& curve, const std::string& file) {
  if (!block.IsMap())
    throw bad_input(place(file, block), "the entry is not a map", "expected \"- type: ...\" and its data");
  const YAML::Node type_node = text_of(block, "type", file);
  const std::string& type = type_node.Scalar();
  if (const int formula = formula_number(type)) return keep_first(curve.n, formula_curve(block, formula, file));
  if (type == "constant") return keep_first(curve.n, constant_curve(block, file));
  if (type == "tabulated nk") {
    const auto rows = table_rows(block, 3, file);
    keep_first(curve.n, table_curve(rows, 1, place(file, block)));
    return keep_first(curve.k, table_curve(rows, 2, place(file, block)));
  }
  if (type == "tabulated n") return keep_first(curve.n, table_curve(table_rows(block, 2, file), 1, place(file, block)));
  if (type == "tabulated k") return keep_first(curve.k, table_curve(table_rows(block, 2, file), 1, place(file, block)));

  static const std::vector<std::string> known{"formula 1",    "formula 2",   "formula 3",  "formula 4", "formula 5",
                                              "formula 6",    "formula 7",   "formula 8",  "formula 9", "constant",
                                              "tabulated nk", "tabulated n", "tabulated k"};
  const std::string near = nearest(type, known);
  throw bad_input(place(file, type_node), "the type is " + in_quotes(type),
                  "expected formula 1 to 9, tabulated n, nk or k, or constant",
                  near.empty() ? std::string{} : fmt::format("did you mean \"{}\"?", near));
}

} // namespace

DispersionCurve parse_dispersion(const std::string& yaml, const std::filesystem::path& source) {
  if (lower_case(source.extension().string()) == ".agf") return parse_zemax_glass(yaml, source);
  const std::string file = source.string();
  const auto foreign = [&] {
    return bad_input(file, "this is no refractiveindex.info file",
                     "expected a YAML map with a DATA list, or a glass of Zemax (.agf)",
                     "a table of n goes into the preset: {\"type\": \"table\", \"table\": [[nm, n], ...]}");
  };
  DispersionCurve curve;
  curve.name = source.stem().string();
  curve.source = file;
  try {
    const YAML::Node root = YAML::Load(yaml);
    if (!root.IsMap()) throw foreign();
    const YAML::Node data = root["DATA"];
    if (std::count_if(root.begin(), root.end(), [](const auto& entry) { return entry.first.Scalar() == "DATA"; }) > 1)
      throw bad_input(file, "DATA is given twice", "expected one list", "check that the file is not doubled");
    if (!data.IsDefined()) throw bad_input(file, "there is no DATA", "expected a DATA list with formulas or tables");
    if (!data.IsSequence() || data.size() == 0)
      throw bad_input(place(file, data), "DATA is not a list with entries",
                      "expected a list of \"- type: ...\" entries");
    for (const YAML::Node& block : data) read_block(block, curve, file);
  } catch (const YAML::Exception& error) {
    if (yaml.find("DATA:") == std::string::npos) throw foreign();
    throw bad_input(place(file, error.mark.line), "broken YAML: " + error.msg,
                    "expected a file of the refractiveindex.info database");
  }
  return curve;
}

DispersionCurve load_dispersion(const std::filesystem::path& file) { return parse_dispersion(read_file(file), file); }

} // namespace nephroid::optics
