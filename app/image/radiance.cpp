// SPDX-License-Identifier: Apache-2.0
#include "image/radiance.h"

#include "base/bytes.h"
#include "base/files.h"
#include "base/numbers.h"
#include "image/seam.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <sstream>

namespace nephroid::image {
namespace {

/// The bytes of a file, one after the other.
class Bytes {
public:
  explicit Bytes(const std::filesystem::path& file) : source_(open_file(file)) {}
  unsigned char next() {
    if (at_ == piece_.size()) refill();
    return piece_[at_++];
  }
  std::string line() {
    constexpr std::size_t longest = 2048;
    std::string line;
    for (char c = static_cast<char>(next()); c != '\n'; c = static_cast<char>(next())) {
      if (line.size() == longest) throw Refused{"its header has a line without an end"};
      line.push_back(c);
    }
    if (line.ends_with('\r')) line.pop_back();
    return line;
  }

private:
  void refill() {
    constexpr std::uint64_t most = 1 << 16;
    piece_.resize(std::min(most, source_->left()));
    if (piece_.empty()) throw Refused{"its end is missing"};
    source_->read(std::as_writable_bytes(std::span(piece_)));
    at_ = 0;
  }
  std::unique_ptr<ByteSource> source_;
  std::vector<unsigned char> piece_;
  std::size_t at_ = 0;
};

/// What the header says of all pixels.
struct Header {
  std::array<double, 3> divisor{1, 1, 1};
  Band band{};
  int rows = 0, columns = 0;
};

/// As many numbers as asked for.
std::vector<double> numbers(const std::string& key, const std::string& value, std::size_t count) {
  std::istringstream words(value);
  std::vector<double> parsed;
  for (std::string word; words >> word;)
    if (const std::optional<double> number = typed_number<double>(word)) parsed.push_back(*number);
  if (parsed.size() != count || !std::ranges::all_of(parsed, [](double n) { return std::isfinite(n); }))
    throw Refused{fmt::format("its header says {}={}, and {} expected", key, value,
                              count == 1 ? "a number is" : fmt::format("{} numbers are", count))};
  return parsed;
}

void divide_by(Header& header, const std::string& key, const std::string& value) {
  std::vector<double> factors = numbers(key, value, key == "EXPOSURE" ? 1 : 3);
  factors.resize(3, factors[0]);
  for (std::size_t c = 0; c < 3; ++c) {
    header.divisor[c] *= factors[c];
    if (!(factors[c] > 0) || !std::isnormal(header.divisor[c]))
      throw Refused{fmt::format("its header says {}={}, by which nothing can be divided", key, value)};
  }
}

/// A line KEY=VALUE; others are comments and commands.
void take_line(Header& header, const std::string& line) {
  const std::size_t equals = line.find('=');
  if (equals == std::string::npos || line.starts_with('#')) return;
  const std::string key = line.substr(0, equals), value = line.substr(equals + 1);
  Image& rows = header.band.rows;
  if (key == "EXPOSURE" || key == "COLORCORR") divide_by(header, key, value);
  if (key == "PIXASPECT") header.band.pixel_aspect /= numbers(key, value, 1)[0]; // height over width
  if (key == "PRIMARIES") {
    const std::vector<double> eight = numbers(key, value, 8);
    std::ranges::transform(eight, rows.chromaticities.emplace().begin(),
                           [](double n) { return static_cast<float>(n); });
  }
  if (key == "GAMMA" && numbers(key, value, 1)[0] != 1)
    rows.notes.push_back(
        fmt::format("its header says GAMMA={}, which is not obeyed; its values are taken as linear", value));
}

void take_format(Header& header, const std::string& format) {
  if (format == "32-bit_rle_xyze")
    header.band.rows.chromaticities = {1, 0, 0, 1, 0, 0, 1 / 3.0f, 1 / 3.0f};
  else if (format != "32-bit_rle_rgbe")
    throw Refused{format.empty() ? "its header has no FORMAT"
                                 : fmt::format("its header says FORMAT={}, and 32-bit_rle_rgbe or 32-bit_rle_xyze "
                                               "is expected",
                                               format)};
}

/// "-Y 16 +X 32": first the axis across rows of the file, then that along them. Y goes up, X to the right.
void take_size(Header& header, const std::string& line) {
  std::istringstream words(line);
  std::string across, along;
  words >> across >> header.rows >> along >> header.columns;
  constexpr std::string_view axes[] = {"-Y+X", "-Y-X", "+Y-X", "+Y+X", "+X-Y", "-X-Y", "-X+Y", "+X+Y"}; // as Exif's
  const auto found = std::ranges::find(axes, across + along);
  if (!words || found == std::end(axes) || header.rows < 1 || header.columns < 1)
    throw Refused{fmt::format("its size is '{}', and one like '-Y 512 +X 1024' is expected", line)};
  constexpr int most_columns = 1 << 24; // a row is held in memory
  if (header.columns > most_columns)
    throw Refused{fmt::format("its rows have {} pixels, and at most {} are read", header.columns, most_columns)};
  header.band.order = pixel_order(static_cast<int>(found - std::begin(axes)) + 1);
}

Header read_header(Bytes& bytes) {
  constexpr int most_lines = 1000;
  Header header;
  std::string format;
  int lines = 0;
  for (std::string line = bytes.line(); !line.empty(); line = bytes.line()) {
    if (++lines > most_lines) throw Refused{"its header has no end"};
    if (line.starts_with("FORMAT=")) std::istringstream(line.substr(7)) >> format;
    take_line(header, line);
  }
  take_format(header, format);
  take_size(header, bytes.line());
  require_at_most(most_band_values_log2, header.columns, header.rows, 3);
  return header;
}

/// Four bytes a pixel: mantissas and their exponent.
using Pixel = std::array<unsigned char, 4>;

/// Channel after channel, each in runs of one byte and in stretches of bytes as they are.
void read_channels(Bytes& bytes, std::vector<Pixel>& row) {
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t x = 0; x < row.size();) {
      const unsigned char count = bytes.next();
      const bool run = count > 128;
      const std::size_t length = run ? count - 128 : count;
      if (length == 0 || length > row.size() - x) throw Refused{"a run of its pixels is longer than their row"};
      const unsigned char value = run ? bytes.next() : 0;
      for (const std::size_t end = x + length; x < end; ++x) row[x][c] = run ? value : bytes.next();
    }
}

/// Pixel after pixel; (1, 1, 1, n) repeats the one before n times, and the next such 256 n times.
void read_pixels(Bytes& bytes, Pixel first, std::vector<Pixel>& row) {
  int shift = 0;
  for (std::size_t x = 0; x < row.size();) {
    Pixel pixel = first;
    if (x > 0)
      for (unsigned char& byte : pixel) byte = bytes.next();
    if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
      row[x++] = pixel;
      shift = 0;
      continue;
    }
    const std::size_t length = shift < 24 ? std::size_t{pixel[3]} << shift : 0;
    if (x == 0 || length == 0 || length > row.size() - x)
      throw Refused{"a run of its pixels is longer than their row, or has none before it"};
    std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(x), length, row[x - 1]);
    x += length;
    shift += 8;
  }
}

void read_row(Bytes& bytes, std::vector<Pixel>& row) {
  Pixel first{};
  for (unsigned char& byte : first) byte = bytes.next();
  const std::size_t width = row.size();
  if (width < 8 || width > 0x7fff || first[0] != 2 || first[1] != 2 || first[2] >= 128)
    return read_pixels(bytes, first, row);
  if ((std::size_t{first[2]} << 8 | first[3]) != width) throw Refused{"a row of its pixels has another width"};
  read_channels(bytes, row);
}

/// What the mantissas of each channel are multiplied by, for each exponent.
using Scales = std::array<std::array<double, 256>, 3>;

Scales scales_of(const std::array<double, 3>& divisor) {
  constexpr int exponent_of_one = 136; // 128, and 8 for the bits of a mantissa
  Scales scales{};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t e = 1; e < 256; ++e)
      scales[c][e] = std::ldexp(1, static_cast<int>(e) - exponent_of_one) / divisor[c];
  return scales;
}

void add_row(const std::vector<Pixel>& row, const Scales& scales, std::vector<float>& values) {
  for (const Pixel& pixel : row)
    for (std::size_t c = 0; c < 3; ++c) values.push_back(static_cast<float>(pixel[c] * scales[c][pixel[3]]));
}

} // namespace

bool is_radiance(const std::filesystem::path& file) {
  const std::unique_ptr<ByteSource> source = open_file(file);
  std::array<char, 2> start{};
  if (source->left() < start.size()) return false;
  source->value(start);
  return start == std::array<char, 2>{'#', '?'};
}

void read_radiance(const std::filesystem::path& file, const std::function<void(const Band&)>& use) {
  Bytes bytes(file);
  Header header = read_header(bytes);
  Band& band = header.band;
  band.rows.width = header.columns;
  band.height = header.rows;
  band.rows.channels = {"R", "G", "B"};
  const int most = rows_of_band(header.columns, band.rows.channels.size());
  const Scales scales = scales_of(header.divisor);
  std::vector<Pixel> row(static_cast<std::size_t>(header.columns));
  for (; band.first < header.rows; band.first += band.rows.height) {
    band.rows.height = std::min(most, header.rows - band.first);
    band.rows.data.clear();
    for (int y = 0; y < band.rows.height; ++y) {
      read_row(bytes, row);
      add_row(row, scales, band.rows.data);
    }
    use(band);
  }
}

} // namespace nephroid::image
