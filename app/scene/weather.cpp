// SPDX-License-Identifier: Apache-2.0
#include "scene/weather.h"

#include "base/error.h"
#include "base/files.h"
#include "base/numbers.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

namespace nephroid::scene {
namespace {

/// The fields of a line between commas, without blanks about them.
std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t end = line.find(',');
    std::string_view field = line.substr(0, end);
    while (!field.empty() && field.front() == ' ') field.remove_prefix(1);
    while (!field.empty() && (field.back() == ' ' || field.back() == '\r')) field.remove_suffix(1);
    fields.push_back(field);
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

/// A line of the file, for messages.
class Line {
public:
  Line(const std::filesystem::path& file, int number, std::string_view text)
      : file_(file.string()), number_(number), fields_(fields_of(text)) {}

  double operator[](std::size_t field) const {
    const auto value = field < fields_.size() ? number_in<double>(fields_[field]) : std::nullopt;
    if (!value)
      refuse(field < fields_.size() ? fmt::format("field {} is \"{}\"", field + 1, fields_[field])
                                    : fmt::format("has {} fields", fields_.size()),
             "expected an EPW file's numbers");
    return *value;
  }
  [[noreturn]] void refuse(const std::string& what, const std::string& expected) const {
    throw bad_input(Location(file_), fmt::format("line {}: {}", number_, what), expected);
  }
  std::string_view text(std::size_t field) const { return field < fields_.size() ? fields_[field] : ""; }

private:
  std::string file_;
  int number_;
  std::vector<std::string_view> fields_;
};

constexpr int header_lines = 8, hours_of_day = 24;

/// W/m^2; 9999 stands for nothing.
std::optional<double> measured(const Line& line, std::size_t field) {
  const double value = line[field];
  if (value >= 9999) return std::nullopt;
  if (value < 0) line.refuse(fmt::format("field {} is {}", field + 1, value), "expected W/m^2, or 9999 for nothing");
  return value;
}

} // namespace

Weather read_weather(const std::filesystem::path& file) {
  const std::string content = read_file(file);
  Weather weather;
  std::string_view rest = content;
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = rest.find('\n');
    const Line line(file, number, rest.substr(0, end));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (number == 1) {
      if (line.text(0) != "LOCATION") line.refuse("does not begin with LOCATION", "expected an EPW file");
      weather.place = std::string(line.text(1));
      weather.latitude_deg = line[6], weather.longitude_deg = line[7], weather.utc_offset_h = line[8];
    }
    if (number == header_lines && line[2] != 1)
      line.refuse(fmt::format("says that an hour has {} parts", line.text(2)), "expected whole hours");
    if (number <= header_lines || line.text(0).empty()) continue;
    const double hour = line[3];
    const int last = weather.hours.empty() ? 0 : static_cast<int>(std::ceil(weather.hours.back().hour));
    if (hour != last % hours_of_day + 1)
      line.refuse(fmt::format("is of hour {} after hour {}", hour, last), "expected the hours 1 to 24 of each day");
    if (!(line[1] >= 1 && line[1] <= 12 && line[2] >= 1 && line[2] <= 31))
      line.refuse(fmt::format("is of day {} of month {}", line.text(2), line.text(1)), "expected a day of the year");
    weather.hours.push_back(
        {static_cast<int>(line[1]), static_cast<int>(line[2]), hour - 0.5, measured(line, 14), measured(line, 15)});
  }
  if (weather.hours.empty() || weather.hours.back().hour != hours_of_day - 0.5)
    throw bad_input(Location(file.string()), fmt::format("ends after {} hours, within a day", weather.hours.size()),
                    "expected whole days: is the file cut?");
  return weather;
}

} // namespace nephroid::scene
