// SPDX-License-Identifier: Apache-2.0
// Strict in what it reads: a curve with a wrong row in it would be believed.
#include "measure/run_files.h"

#include "base/counted.h"
#include "base/files.h"
#include "base/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace nephroid::measure {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view fixed_columns[] = {"seconds", "wall_seconds", "step", "work"};
constexpr std::string_view fixed_header = "seconds,wall_seconds,step,work";
/// Years of measurements; a larger file is something else.
constexpr std::uintmax_t max_bytes = std::uintmax_t(256) << 20;

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

/// A cell as a message may show it: short, on one line, without control characters.
std::string quoted(std::string_view cell) {
  std::string shown(cell.substr(0, 40));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < 0x20 || c >= 0x7f; }, '?');
  return fmt::format("'{}{}'", shown, cell.size() > 40 ? "..." : "");
}

template <class Number>
Number number(std::string_view cell, std::string_view column, const Location& place) {
  const auto value = number_in<Number>(cell);
  if (!value) throw bad_input(place, fmt::format("{} {} is no number", column, quoted(cell)));
  return *value;
}

/// A time in seconds: finite, not negative.
double seconds(std::string_view cell, std::string_view column, const Location& place) {
  const double value = number<double>(cell, column, place);
  if (!std::isfinite(value) || value < 0)
    throw bad_input(place, fmt::format("{} is {}", column, cell), "expected seconds from 0");
  return value;
}

/// psnr_db falls below 0 where a picture is far off, so only NaN is refused: the file has an empty cell for it.
double error_value(std::string_view cell, std::string_view column, const Location& place) {
  if (cell.empty()) return std::nan("");
  const double value = number<double>(cell, column, place);
  if (std::isnan(value))
    throw bad_input(place, fmt::format("{} is {}", column, cell), "an undefined error is an empty cell");
  return value;
}

bool is_column_name(std::string_view name) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789_";
  return !name.empty() && name.find_first_not_of(letters) == std::string_view::npos;
}

std::vector<std::string> columns_of(std::string_view line, const Location& place) {
  const std::vector<std::string_view> cells = cells_of(line);
  const std::string expected = fmt::format("expected '{}', then a column a metric", fixed_header);
  if (cells.size() < std::size(fixed_columns) ||
      !std::equal(std::begin(fixed_columns), std::end(fixed_columns), cells.begin()))
    throw bad_input(place, "this is no history of a run", expected);
  std::vector<std::string> columns;
  for (std::size_t i = std::size(fixed_columns); i < cells.size(); ++i) {
    if (!is_column_name(cells[i]))
      throw bad_input(place, fmt::format("column {} has the name {}", i + 1, quoted(cells[i])),
                      "expected a metric's name");
    if (std::find(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(i), cells[i]) !=
        cells.begin() + static_cast<std::ptrdiff_t>(i))
      throw bad_input(place, fmt::format("two columns have the name {}", quoted(cells[i])));
    columns.emplace_back(cells[i]);
  }
  return columns;
}

job::HistoryRow row_of(std::string_view line, const std::vector<std::string>& columns, const Location& place) {
  const std::vector<std::string_view> cells = cells_of(line);
  const std::size_t expected = std::size(fixed_columns) + columns.size();
  if (cells.size() != expected)
    throw bad_input(place, "the row has " + counted(cells.size(), "cell"), fmt::format("expected {}", expected));
  job::HistoryRow row;
  row.seconds = seconds(cells[0], fixed_columns[0], place);
  row.wall_seconds = seconds(cells[1], fixed_columns[1], place);
  row.step = number<std::int64_t>(cells[2], fixed_columns[2], place);
  row.work = number<std::uint64_t>(cells[3], fixed_columns[3], place);
  for (std::size_t i = 0; i < columns.size(); ++i)
    row.errors.push_back(error_value(cells[std::size(fixed_columns) + i], columns[i], place));
  return row;
}

std::string text_of(const fs::path& file) {
  std::error_code ignored; // read_file says what is wrong with a file that has no size
  const std::uintmax_t bytes = fs::is_regular_file(file, ignored) ? fs::file_size(file, ignored) : 0;
  if (!ignored && bytes > max_bytes)
    throw bad_input(file.string(), fmt::format("has {} MiB", bytes >> 20),
                    fmt::format("no history has more than {}", max_bytes >> 20));
  return read_file(file);
}

using Json = nlohmann::ordered_json;
using Type = RunDocument::Type;

Json parsed(const fs::path& file) {
  if (!is_there(file)) throw bad_input(file.string(), "is missing", "expected the files of a finished run");
  const std::string text = read_file(file);
  if (text.empty()) throw bad_input(file.string(), "is empty", {}, "run it again");
  const auto refuse_depth = [&](int depth, Json::parse_event_t, const Json&) {
    constexpr int max_depth = 64; // what walks through a value calls itself at every level
    if (depth > max_depth) throw bad_input(file.string(), fmt::format("is nested deeper than {} levels", max_depth));
    return true;
  };
  Json json = Json::parse(text, refuse_depth, false);
  if (json.is_discarded()) throw bad_input(file.string(), "is cut or no JSON", {}, "run it again");
  if (!json.is_object()) throw bad_input(file.string(), "is no object");
  return json;
}

/// What is wrong with a value; null where it is of the type.
const char* complaint(const Json& value, Type type) {
  const std::pair<bool, const char*> kinds[] = {{value.is_string(), "is no text"},
                                                {value.is_number(), "is no number"},
                                                {value.is_number_unsigned(), "is no whole number from 0"},
                                                {value.is_boolean(), "is neither true nor false"},
                                                {value.is_array(), "is no list"},
                                                {value.is_object(), "is no object"},
                                                {value.is_object(), "is no object"}}; // in the order of Type
  const auto& [is_right, wrong] = kinds[static_cast<std::size_t>(type)];
  return is_right ? nullptr : wrong;
}

} // namespace

std::string to_csv(const job::History& history) {
  std::string csv(fixed_header);
  for (const std::string& column : history.columns) csv += "," + column;
  csv += '\n';
  for (const job::HistoryRow& row : history.rows) { // {} is the shortest text that reads back as the same bits
    fmt::format_to(std::back_inserter(csv), "{},{},{},{}", row.seconds, row.wall_seconds, row.step, row.work);
    for (const double error : row.errors)
      if (std::isnan(error))
        csv += ',';
      else
        fmt::format_to(std::back_inserter(csv), ",{}", error);
    csv += '\n';
  }
  return csv;
}

job::History read_history(const std::filesystem::path& file) {
  const std::string text = text_of(file);
  if (text.empty()) throw bad_input(file.string(), "the file is empty", fmt::format("expected '{},...'", fixed_header));
  job::History history;
  std::string_view rest = text;
  for (std::size_t line = 1; !rest.empty(); ++line) {
    const Location place(file.string(), line);
    const std::size_t end = rest.find('\n');
    const std::string_view row = rest.substr(0, end);
    if (line == 1)
      history.columns = columns_of(row, place);
    else
      history.rows.push_back(row_of(row, history.columns, place));
    // A cut number is a number as well, so the last line's end is looked for, after what may show a better reason.
    if (end == std::string_view::npos)
      throw bad_input(place, "the file is cut in this line", "every line ends with a line feed");
    const std::size_t count = history.rows.size();
    if (count > 1 && history.rows[count - 1].seconds < history.rows[count - 2].seconds)
      throw bad_input(place, fmt::format("seconds fall from {} to {}", history.rows[count - 2].seconds,
                                         history.rows[count - 1].seconds));
    rest.remove_prefix(end + 1);
  }
  return history;
}

RunDocument::RunDocument(const fs::path& file) : place_(file.string() + "#"), json_(parsed(file)) {}

const Json& RunDocument::at(const std::string& pointer, Type type) const {
  if (!has(pointer)) throw bad_input(place_ + pointer, "is missing");
  const Json& value = json_.at(Json::json_pointer(pointer));
  if (const char* wrong = complaint(value, type)) throw bad_input(place_ + pointer, wrong);
  if (type == Type::numbers)
    for (const auto& [key, number] : value.items())
      if (!number.is_null() && !number.is_number())
        throw bad_input(fmt::format("{}{}/{}", place_, pointer, key), "is no number");
  return value;
}

job::History read_run_history(const fs::path& folder) {
  job::History history = read_history(folder / "history.csv");
  if (!is_there(folder / "run.json")) return history;
  const RunDocument run(folder / "run.json");
  if (run.has("/error_column")) history.error_column = run.at("/error_column", Type::text);
  if (!run.has("/reference")) return history;
  run.at("/reference/origin", Type::text);
  if (!run.has("/reference/noise_floor")) return history;
  const Json& floors = run.at("/reference/noise_floor", Type::numbers);
  for (const std::string& column : history.columns)
    history.noise_floor.push_back(floors.contains(column) && floors[column].is_number() ? floors[column].get<double>()
                                                                                        : std::nan(""));
  return history;
}

} // namespace nephroid::measure
