// SPDX-License-Identifier: Apache-2.0
// A picture file, read some rows at a time: 20000 x 12000 pixels take no more memory than a small picture.
#include "inverse/pictures/target.h"

#include "image/image.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::inverse {
namespace {

/// The cells along one axis that a pixel covers, and how much of each: parts[i] of cell first + i.
struct CellCoverage {
  int first = 0;
  std::vector<double> parts;
};

/// What each pixel covers, in the order of the file, which lies in the middle of the cells. `pixel`: its side in cells.
std::vector<CellCoverage> covered_by(int pixels, bool backwards, double pixel, int cells) {
  std::vector<CellCoverage> all;
  for (int i = 0; i < pixels; ++i) {
    const double low = (backwards ? pixels - 1 - i : i) * pixel + (cells - pixels * pixel) / 2, high = low + pixel;
    CellCoverage covered{std::max(0, static_cast<int>(std::floor(low))), {}};
    for (int c = covered.first; c < cells && c < high; ++c)
      covered.parts.push_back(std::max(0.0, std::min(high, c + 1.0) - std::max(low, static_cast<double>(c))));
    all.push_back(std::move(covered));
  }
  return all;
}

/// Where the pixels of a file lie on the receiver. Exif's orientations 5 to 8 have the file's rows upright.
struct FileRaster {
  bool turned = false;
  glm::dvec2 half{0};                      ///< half the whole picture's size, millimetres
  std::vector<CellCoverage> columns, rows; ///< what the file's cover; turned: its columns cover rows of cells
};

FileRaster place_of(const Layout& layout, const glm::ivec2& file, int orientation) {
  FileRaster place;
  place.turned = orientation >= 5;
  const glm::dvec2 upright = place.turned ? glm::dvec2(file.y, file.x) : glm::dvec2(file);
  const double millimetres = std::min(layout.receiver.x / upright.x, layout.receiver.y / upright.y);
  const glm::dvec2 pixel = millimetres / layout.cell();
  place.half = upright * millimetres / 2.0;
  const auto is = [&](std::initializer_list<int> list) {
    return std::find(list.begin(), list.end(), orientation) != list.end();
  };
  const bool columns_back = is({2, 3, 7, 8}), rows_back = is({3, 4, 6, 7});
  place.columns = covered_by(file.x, columns_back, pixel[place.turned ? 1 : 0], layout.cells[place.turned ? 1 : 0]);
  place.rows = covered_by(file.y, rows_back, pixel[place.turned ? 0 : 1], layout.cells[place.turned ? 0 : 1]);
  return place;
}

/// Luminance of linear sRGB. Integers are encoded and hide what is transparent; floats are multiplied by their alpha.
class Luminance {
public:
  Luminance() {
    for (std::size_t i = 0; i < decoded_.size(); ++i)
      decoded_[i] =
          static_cast<float>(image::decoded_srgb(static_cast<double>(i) / static_cast<double>(decoded_.size() - 1)));
  }

  std::vector<double> of(const image::Image& rows, const std::string& name) const {
    const image::Rgb rgb = image::rgb_of(rows, name);
    const std::size_t stride = rows.channels.size();
    const auto alpha =
        static_cast<std::size_t>(std::find(rows.channels.begin(), rows.channels.end(), "A") - rows.channels.begin());
    std::vector<double> values(rgb.values.size() / 3);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto linear = [&](std::size_t channel) {
        const float value = rgb.values[3 * i + channel];
        return rows.integers ? decoded(value) : static_cast<double>(value);
      };
      values[i] = 0.2126 * linear(0) + 0.7152 * linear(1) + 0.0722 * linear(2);
      if (rows.integers && alpha < stride) values[i] *= rows.data[i * stride + alpha];
      if (!std::isfinite(values[i]) || values[i] < 0)
        throw bad_input(name, "has a pixel that is negative or not a number", "expected a picture of light");
    }
    return values;
  }

private:
  /// Files have 8 or 16 bits; some have more, whose values lie between two of the table.
  double decoded(float value) const {
    return decoded_[static_cast<std::size_t>(std::lround(value * static_cast<float>(decoded_.size() - 1)))];
  }

  std::vector<float> decoded_ = std::vector<float>(65536);
};

/// From 0 at the edge to 1 at `width` and further from it, as smooth as a cosine.
double fade(double from_edge, double width) {
  return width > 0 ? 0.5 - 0.5 * std::cos(glm::pi<double>() * std::clamp(from_edge / width, 0.0, 1.0)) : 1;
}

} // namespace

Target photograph(const std::filesystem::path& file, const Picture& picture, const Layout& layout) {
  const Luminance luminance;
  Target target(layout.cell_count());
  std::optional<FileRaster> place;
  double low = std::numeric_limits<double>::infinity(), high = 0;
  std::vector<double> along; // a row of the file, a value a cell
  image::read_bands(file, [&](const image::Band& band) {
    const int width = band.rows.width;
    if (!place) place = place_of(layout, {width, band.height}, band.orientation);
    const bool turned = place->turned;
    const std::vector<double> values = luminance.of(band.rows, file.string());
    for (int v = 0; v < band.rows.height; ++v) {
      along.assign(static_cast<std::size_t>(turned ? layout.cells.y : layout.cells.x), 0);
      for (int u = 0; u < width; ++u) {
        const double value = values[index_at(u, v, width)];
        low = std::min(low, value);
        high = std::max(high, value);
        const double toned = picture.tone == 1 ? value : std::pow(value, picture.tone);
        const CellCoverage& covered = place->columns[static_cast<std::size_t>(u)];
        for (std::size_t i = 0; i < covered.parts.size(); ++i)
          along[static_cast<std::size_t>(covered.first) + i] += covered.parts[i] * toned;
      }
      const CellCoverage& covered = place->rows[static_cast<std::size_t>(band.first) + static_cast<std::size_t>(v)];
      for (std::size_t k = 0; k < covered.parts.size(); ++k)
        for (std::size_t i = 0; i < along.size(); ++i) {
          const int across = covered.first + static_cast<int>(k), cell = static_cast<int>(i);
          target[turned ? index_at(across, cell, layout.cells.x) : index_at(cell, across, layout.cells.x)] +=
              covered.parts[k] * along[i];
        }
    }
  });
  if (high == 0)
    throw bad_input(file.string(), "is black all over or transparent", "expected a picture with some light in it");
  if (low == high)
    throw bad_input(file.string(), "is one grey all over", "expected a picture with an outline",
                    "for a disc of light use a drawing");
  const auto [black, white] = picture.levels;
  const double most = std::pow(high, picture.tone), edge = picture.vignette * std::min(place->half.x, place->half.y);
  for (std::size_t c = 0; c < target.size(); ++c) {
    const glm::dvec2 from_edge = place->half - glm::abs(layout.middle_of_cell(c));
    target[c] = std::clamp((target[c] / most - black) / (white - black), 0.0, 1.0) * fade(from_edge.x, edge) *
                fade(from_edge.y, edge);
  }
  return target;
}

} // namespace nephroid::inverse
