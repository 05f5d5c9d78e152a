// SPDX-License-Identifier: Apache-2.0
#include "scene/photometry.h"

#include "base/error.h"
#include "base/files.h"
#include "base/lower_case.h"
#include "base/numbers.h"
#include "base/plain_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace nephroid::scene {
namespace {

namespace fs = std::filesystem;

/// The file's words, with the lines that they are in.
class Words {
public:
  Words(std::string file, std::string_view text, int line) : file_(std::move(file)), rest_(text), line_(line) {}

  /// Throws bad_input at the end of the file, and where there is no finite number. what: "the number of ...".
  double number(std::string_view what) {
    const std::string_view word = next(what);
    const std::optional<double> value = typed_number<double>(word);
    if (!value || !std::isfinite(*value))
      throw bad_input(where(), fmt::format("'{}' is {}", word.substr(0, 40), what), "expected a number");
    return *value;
  }
  int count(std::string_view what, int most) {
    const double value = number(what);
    if (!(value >= 1 && value <= most) || std::trunc(value) != value)
      throw bad_input(where(), fmt::format("{} is {}", what, value),
                      fmt::format("expected a whole number from 1 to {}", most));
    return static_cast<int>(value);
  }
  std::vector<double> numbers(int count, std::string_view what) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(number(what));
    return values;
  }
  /// Throws bad_input where a number follows: the counts are not the file's.
  void end() {
    if (rest_.find_first_not_of(between) != std::string_view::npos && typed_number<double>(next("the end")))
      throw bad_input(where(), "more numbers follow than the counts of angles say", {}, "get it again");
  }
  std::string where() const { return fmt::format("{}:{}", file_, line_); }

private:
  static constexpr std::string_view between = " \t\r\n,";

  std::string_view next(std::string_view what) {
    const std::size_t begin = std::min(rest_.find_first_not_of(between), rest_.size());
    line_ += static_cast<int>(std::count(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(begin), '\n'));
    rest_.remove_prefix(begin);
    if (rest_.empty()) throw bad_input(where(), fmt::format("the file ends before {}", what), {}, "get it again");
    const std::string_view word = rest_.substr(0, rest_.find_first_of(between));
    rest_.remove_prefix(word.size());
    return word;
  }

  std::string file_;
  std::string_view rest_;
  int line_;
};

/// Throws bad_input at `where` unless they rise within low..high.
void check_rising(const std::vector<double>& angles, double low, double high, std::string_view what,
                  const std::string& where) {
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (!(angles[i] >= low && angles[i] <= high))
      throw bad_input(where, fmt::format("{} {} is {} degrees", what, i, angles[i]),
                      fmt::format("expected {} to {}", low, high));
    if (i > 0 && !(angles[i] > angles[i - 1]))
      throw bad_input(where, fmt::format("{} {} is {} degrees after {}", what, i, angles[i], angles[i - 1]),
                      "expected angles that rise");
  }
}

/// Of types A and B.
void check_from_0_or_below(const std::vector<double>& angles, double most, std::string_view what,
                           const std::string& where) {
  check_rising(angles, -most, most, what, where);
  if (angles.size() < 2) throw bad_input(where, fmt::format("there is one {}", what), "expected two or more");
  if (angles.front() > 0)
    throw bad_input(where, fmt::format("the first {} is {} degrees", what, angles.front()), "expected 0 or less");
}

/// Intensities of each plane that the file has.
using Planes = std::map<double, std::vector<double>>;

/// 0..360, without 360.
double turned(double c_deg) {
  const double c = std::fmod(c_deg, 360.0), turned = c < 0 ? c + 360 : c;
  return turned < 360 ? turned : 0; // next to nothing below 0 rounds to 360
}

/// Adds the planes' mirror images at `sum` - c.
void mirror(Planes& planes, double sum) {
  const Planes given = planes;
  for (const auto& [c, values] : given) planes.try_emplace(turned(sum - c), values);
}

void check_light(const Photometry& p) {
  constexpr double most = 1e15;
  for (const double value : p.intensity)
    if (!(value >= 0 && value <= most))
      throw bad_input(p.file.string(), fmt::format("has an intensity of {}", value),
                      fmt::format("expected 0 to {}", most));
  if (std::ranges::none_of(p.intensity, [](double value) { return value > 0; }))
    throw bad_input(p.file.string(), "has no light in any direction");
}

/// The integral of the intensities over all directions, which are linear in gamma and C: by Simpson's rule in gamma.
double flux_of(const Photometry& p) {
  constexpr double degree = std::numbers::pi / 180;
  const std::size_t gammas = p.gamma_deg.size();
  double flux = 0;
  for (std::size_t plane = 1; plane < p.c_deg.size(); ++plane) {
    const double from = std::max(p.c_deg[plane - 1], 0.0), to = std::min(p.c_deg[plane], 360.0);
    if (!(from < to)) continue;
    const double middle = (from + to) / 2;
    for (std::size_t i = 1; i < gammas; ++i) {
      const double a = p.gamma_deg[i - 1], b = p.gamma_deg[i];
      const auto weighted = [&](double gamma) { return intensity(p, gamma, middle) * std::sin(gamma * degree); };
      flux += degree * (to - from) * degree * (b - a) / 6 * (weighted(a) + 4 * weighted((a + b) / 2) + weighted(b));
    }
  }
  return flux;
}

/// planes: those that the file has, at 0..360 without 360.
Photometry make_photometry(const fs::path& file, std::vector<double> gamma_deg, const Planes& planes) {
  Photometry result{file, std::move(gamma_deg), {}, {}};
  const auto add = [&](double c, const std::vector<double>& values) {
    result.c_deg.push_back(c);
    result.intensity.insert(result.intensity.end(), values.begin(), values.end());
  };
  const auto& [first, first_values] = *planes.begin();
  const auto& [last, last_values] = *planes.rbegin();
  if (first > 0) add(last - 360, last_values);
  for (const auto& [c, values] : planes) add(c, values);
  add(first + 360, first_values);
  check_light(result);
  result.lumens = flux_of(result);
  return result;
}

/// As planes C, in the steps in which kernels read them. given: of type A or B, its vertical angles as gamma and its
/// horizontal ones as C. What begins at 0 has its mirror image below.
Photometry turned_to_c(const Photometry& given, bool is_b) {
  check_light(given);
  const auto value = [&](double v, double h) {
    if (given.gamma_deg.front() == 0) v = std::abs(v);
    if (given.c_deg.front() == 0) h = std::abs(h);
    return h >= given.c_deg.front() && h <= given.c_deg.back() ? intensity(given, v, h) : 0;
  };
  constexpr double degree = std::numbers::pi / 180, fine = 1e9; // what is an end but for rounding is that end
  const auto degrees = [](double radians) { return std::round(radians / degree * fine) / fine; };
  Photometry result{given.file, {}, {}, {}};
  for (int i = 0; i <= 360; ++i) {
    result.gamma_deg.push_back(0.5 * i);
    result.c_deg.push_back(i);
  }
  for (const double c : result.c_deg)
    for (const double gamma : result.gamma_deg) {
      const double down = std::cos(gamma * degree), ahead = std::sin(gamma * degree) * std::cos(c * degree),
                   right = -std::sin(gamma * degree) * std::sin(c * degree);
      // The planes of type B turn about a horizontal axis, those of type A about the vertical one.
      result.intensity.push_back(is_b ? value(degrees(std::atan2(ahead, down)), degrees(std::asin(right)))
                                      : value(gamma - 90, degrees(std::atan2(right, ahead))));
    }
  result.lumens = flux_of(result);
  return result;
}

constexpr int most_angles = 10000;

/// text: what follows the line TILT=, which is line `line`.
Photometry read_ies(const fs::path& file, std::string_view text, int line, bool has_tilt) {
  Words words(file.string(), text, line);
  if (has_tilt) { // factors of the whole output
    words.number("the lamp's orientation");
    words.numbers(2 * words.count("the number of tilts", most_angles), "a tilt");
  }
  words.number("the number of lamps");
  words.number("the lumens of a lamp");
  const double multiplier = words.number("the multiplier of intensities");
  const int gammas = words.count("the number of vertical angles", most_angles),
            planes = words.count("the number of horizontal angles", most_angles);
  const int type = words.count("the photometric type", 3); // C, B, A
  words.numbers(4, "the luminaire's size");
  const double ballast = words.numbers(3, "the ballast's factor or the watts").front();
  std::vector<double> gamma_deg = words.numbers(gammas, "a vertical angle");
  std::vector<double> c_deg;
  if (type != 1) {
    check_from_0_or_below(gamma_deg, type == 2 ? 180 : 90, "vertical angle", words.where());
    c_deg = words.numbers(planes, "a horizontal angle");
    check_from_0_or_below(c_deg, type == 2 ? 90 : 180, "horizontal angle", words.where());
    Photometry given{file, std::move(gamma_deg), std::move(c_deg), words.numbers(gammas * planes, "an intensity")};
    for (double& value : given.intensity) value *= multiplier;
    words.end();
    Photometry made = turned_to_c(given, type == 2);
    made.lumens *= ballast;
    return made;
  }
  check_rising(gamma_deg, 0, 180, "vertical angle", words.where());
  c_deg = words.numbers(planes, "a horizontal angle");
  check_rising(c_deg, 0, 360, "horizontal angle", words.where());
  Planes values;
  for (const double c : c_deg) {
    std::vector<double> plane = words.numbers(gammas, "an intensity");
    for (double& value : plane) value *= multiplier;
    values.try_emplace(turned(c), std::move(plane));
  }
  words.end();
  const double first = c_deg.front(), last = c_deg.back();
  if (first == 90 && last == 270)
    mirror(values, 180);
  else if (first != 0)
    throw bad_input(words.where(), fmt::format("the first horizontal angle is {} degrees", first), "expected 0");
  else if (last == 90) {
    mirror(values, 180);
    mirror(values, 360);
  } else if (last == 180)
    mirror(values, 360);
  else if (last > 0 && !(last >= 270)) // all around, with or without the first plane again
    throw bad_input(words.where(), fmt::format("the last horizontal angle is {} degrees", last),
                    "expected 0, 90, 180 or 360");
  Photometry made = make_photometry(file, std::move(gamma_deg), values);
  made.lumens *= ballast;
  return made;
}

/// Without the ends of lines.
std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    while (line.ends_with('\r') || line.ends_with(' ') || line.ends_with('\t')) line.remove_suffix(1);
    while (line.starts_with(' ') || line.starts_with('\t')) line.remove_prefix(1);
    lines.push_back(line);
  }
  return lines;
}

/// EULUMDAT has one value a line, each in its place.
class Eulumdat {
public:
  Eulumdat(const fs::path& file, std::string_view text) : file_(file), lines_(lines_of(text)) {}

  Photometry read() {
    constexpr int most_sets = 20;
    const int symmetry = whole(3, "the symmetry", 0, 4), planes = whole(4, "the number of C planes", 1, most_angles),
              gammas = whole(6, "the number of intensities in a plane", 2, most_angles),
              sets = whole(26, "the number of lamp sets", 1, most_sets);
    const bool divides = symmetry == 4 ? planes % 4 == 0 : symmetry < 2 || planes % (symmetry == 3 ? 4 : 2) == 0;
    if (!divides)
      throw bad_input(at(4), fmt::format("there are {} C planes with the symmetry {}", planes, symmetry),
                      "expected planes that the symmetry maps to each other");
    const int first_angle = 26 + 6 * sets + 10 + 1;
    std::vector<double> c_deg = numbers(first_angle, planes, "the angle of a C plane"),
                        gamma_deg = numbers(first_angle + planes, gammas, "an angle gamma");
    check_rising(c_deg, 0, 360, "C plane", at(first_angle));
    check_rising(gamma_deg, 0, 180, "angle gamma", at(first_angle + planes));
    // The planes that the file has: all, one, C = 0 to 180, 270 by 0 to 90, or 0 to 90 degrees.
    const int first = symmetry == 3 ? 3 * planes / 4 : 0, count = symmetry == 0   ? planes
                                                                  : symmetry == 1 ? 1
                                                                  : symmetry == 4 ? planes / 4 + 1
                                                                                  : planes / 2 + 1;
    Planes values;
    for (int i = 0; i < count; ++i) {
      const double c = c_deg[static_cast<std::size_t>((first + i) % planes)];
      values.try_emplace(turned(c), numbers(first_angle + planes + gammas + i * gammas, gammas, "an intensity"));
    }
    if (symmetry == 3 || symmetry == 4) mirror(values, 180);
    if (symmetry == 2 || symmetry == 4) mirror(values, 360);
    Photometry made = make_photometry(file_, std::move(gamma_deg), values);
    made.lumens *= sets == 1 ? number(29, "the lumens of the lamps") / 1000 : 0; // it has cd for 1,000 lm
    return made;
  }

private:
  /// line: from 1.
  std::string at(int line) const { return fmt::format("{}:{}", file_.string(), line); }
  std::optional<double> value(int line) const {
    if (static_cast<std::size_t>(line) > lines_.size())
      throw bad_input(file_.string(), fmt::format("has {} lines", lines_.size()),
                      fmt::format("expected {} or more", line), "get it again");
    std::string text(lines_[static_cast<std::size_t>(line) - 1]);
    std::ranges::replace(text, ',', '.');
    return typed_number<double>(text);
  }
  double number(int line, std::string_view what) const {
    const std::optional<double> value = this->value(line);
    if (!value || !std::isfinite(*value))
      throw bad_input(at(line),
                      fmt::format("'{}' is {}", lines_[static_cast<std::size_t>(line) - 1].substr(0, 40), what),
                      "expected a number");
    return *value;
  }
  int whole(int line, std::string_view what, int low, int high) const {
    const double value = number(line, what);
    if (!(value >= low && value <= high) || std::trunc(value) != value)
      throw bad_input(at(line), fmt::format("{} is {}", what, value),
                      fmt::format("expected a whole number from {} to {}", low, high));
    return static_cast<int>(value);
  }
  std::vector<double> numbers(int line, int count, std::string_view what) const {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(number(line + i, what));
    return values;
  }

  fs::path file_;
  std::vector<std::string_view> lines_;
};

/// Whether the second to sixth lines are those of EULUMDAT.
bool looks_like_eulumdat(std::string_view text) {
  const std::vector<std::string_view> lines = lines_of(text.substr(0, 4096));
  if (lines.size() < 6) return false;
  const auto is_whole = [](std::string_view line) {
    return typed_number<int>(line.substr(0, line.find_first_of(",."))).has_value();
  };
  return is_whole(lines[1]) && is_whole(lines[2]) && is_whole(lines[3]) && is_whole(lines[5]);
}

/// What a line "TILT=..." says, in lower case; nothing of another line.
std::optional<std::string> tilt_of(std::string_view line) {
  std::string text = lower_case(std::string(line.substr(0, 200)));
  std::erase_if(text, [](unsigned char c) { return std::isspace(c) != 0; });
  return text.starts_with("tilt=") ? std::optional(text.substr(5)) : std::nullopt;
}

/// The commas between two digits as points.
std::string with_points(std::string text) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  for (std::size_t i = 1; i + 1 < text.size(); ++i)
    if (text[i] == ',' && is_digit(text[i - 1]) && is_digit(text[i + 1])) text[i] = '.';
  return text;
}

} // namespace

Photometry load_photometry(const fs::path& file) {
  constexpr std::uintmax_t most_bytes = std::uintmax_t{16} << 20;
  std::error_code ignored;
  if (const std::uintmax_t bytes = fs::file_size(file, ignored); !ignored && bytes > most_bytes)
    throw bad_input(file.string(), fmt::format("has {} MiB", bytes >> 20),
                    fmt::format("expected a photometric file, of at most {} MiB", most_bytes >> 20));
  const std::string text = plain_text(read_file(file));
  int line = 0;
  for (std::size_t begin = 0; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::optional<std::string> tilt = tilt_of(std::string_view(text).substr(begin, end - begin));
    begin = end + 1;
    if (!tilt) continue;
    if (tilt->empty())
      throw bad_input(fmt::format("{}:{}", file.string(), line + 1), "TILT= says nothing",
                      "expected NONE, INCLUDE or the name of a file");
    const auto read = [&](const std::string& numbers) { return read_ies(file, numbers, line + 1, *tilt == "include"); };
    const std::string numbers = text.substr(end);
    try {
      return read(numbers);
    } catch (const Error&) {
      // Some programs write 600,00 for 600.00. As commas part numbers, the counts are then wrong.
      if (const std::string dotted = with_points(numbers); dotted != numbers) try {
          return read(dotted);
        } catch (const Error&) {
        }
      throw;
    }
  }
  if (looks_like_eulumdat(text)) return Eulumdat(file, text).read();
  throw bad_input(file.string(), "is no photometric file",
                  "expected IES (LM-63), which has a line TILT=, or EULUMDAT (.ldt)");
}

double intensity(const Photometry& p, double gamma_deg, double c_deg) {
  if (gamma_deg < p.gamma_deg.front() || gamma_deg > p.gamma_deg.back()) return 0;
  // The interval and the place in it; a single angle is one.
  const auto place = [](const std::vector<double>& angles, double angle) {
    const auto after = std::ranges::upper_bound(angles, angle);
    const std::size_t high = std::min(static_cast<std::size_t>(after - angles.begin()), angles.size() - 1),
                      low = high > 0 ? high - 1 : 0;
    return std::pair(low, high > low ? (angle - angles[low]) / (angles[high] - angles[low]) : 0.0);
  };
  const auto [row, across] = place(p.c_deg, c_deg);
  const auto column = place(p.gamma_deg, gamma_deg);
  const std::size_t gammas = p.gamma_deg.size(), next = std::min(column.first + 1, gammas - 1);
  const auto in_plane = [&](std::size_t plane) {
    return std::lerp(p.intensity[plane * gammas + column.first], p.intensity[plane * gammas + next], column.second);
  };
  return std::lerp(in_plane(row), in_plane(row + 1), across);
}

} // namespace nephroid::scene
