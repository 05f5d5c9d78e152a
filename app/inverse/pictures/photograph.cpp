// SPDX-License-Identifier: Apache-2.0
// A picture file, read some rows at a time: 20000 x 12000 pixels take no more memory than a small picture.
#include "inverse/pictures/target.h"

#include "image/image.h"
#include "optics/colour.h"

#include <fmt/format.h>
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

/// Where the pixels of a file lie on the receiver.
struct FileRaster {
  bool transposed = false;
  glm::dvec2 half{0};                      ///< half the size of what is seen of the picture, millimetres
  std::vector<CellCoverage> columns, rows; ///< what the file's cover; transposed: its columns cover rows of cells
};

FileRaster place_of(const Layout& layout, const Picture& picture, const image::Band& band) {
  image::PixelOrder order = picture.mirror ? image::mirrored(band.order) : band.order;
  const int quarters = static_cast<int>(std::lround(picture.turn_deg / 90)) % 4;
  for (int i = 0; i < (quarters + 4) % 4; ++i) order = image::turned_left(order);
  FileRaster place;
  place.transposed = order.transposed;
  const int across = order.transposed ? 1 : 0, down = 1 - across; // the axes of the receiver along columns and rows
  const glm::ivec2 file(band.rows.width, band.height);
  glm::dvec2 pixel(1);                                                                        // on the receiver
  if (band.pixel_aspect > 0.01 && band.pixel_aspect < 100) pixel[across] = band.pixel_aspect; // else nonsense
  const glm::dvec2 size = pixel * glm::dvec2(file[across], file[down]);
  const glm::dvec2 largest = layout.receiver / size;
  pixel *= picture.fit == Picture::Fit::cover ? std::max(largest.x, largest.y) : std::min(largest.x, largest.y);
  place.half = glm::min(pixel * glm::dvec2(file[across], file[down]), layout.receiver) / 2.0;
  pixel /= layout.cell();
  place.columns = covered_by(file.x, order.columns_back, pixel[across], layout.cells[across]);
  place.rows = covered_by(file.y, order.rows_back, pixel[down], layout.cells[down]);
  return place;
}

/// Luminance of linear sRGB, over the ground where it is transparent.
class Luminance {
public:
  explicit Luminance(const Picture& picture) : invert_(picture.invert), ground_(picture.ground) {
    for (std::size_t i = 0; invert_ && i < negatives_.size(); ++i) {
      const double root = static_cast<double>(i) / static_cast<double>(negatives_.size() - 1);
      negatives_[i] = image::decoded_srgb(1 - optics::srgb_encode(root * root));
    }
  }

  std::vector<double> of(const image::Image& rows, const std::string& name) const {
    const image::Rgb rgb = image::rgb_of(rows, name);
    std::vector<double> values(rgb.values.size() / 3);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const float* const colour = &rgb.values[3 * i];
      const double alpha = rgb.alpha.empty() ? 1 : double(rgb.alpha[i]);
      double value = 0.2126 * double(colour[0]) + 0.7152 * double(colour[1]) + 0.0722 * double(colour[2]);
      if (!std::isfinite(value) || value < 0 || !(alpha >= 0 && alpha <= 1))
        throw bad_input(name, "has a pixel that is negative or not a number", "expected a picture of light");
      if (invert_) value = negative(rows.integers || alpha == 0 ? value : value / alpha);
      if (rows.integers || invert_) value *= alpha;
      values[i] = value + (1 - alpha) * ground_;
    }
    return values;
  }

private:
  /// As picture editors invert: what is left to 1 of the encoded value. What is brighter than white counts as white.
  double negative(double luminance) const {
    return negatives_[static_cast<std::size_t>(
        std::lround(std::sqrt(std::clamp(luminance, 0.0, 1.0)) * static_cast<double>(negatives_.size() - 1)))];
  }

  bool invert_;
  double ground_;
  std::vector<double> negatives_ = std::vector<double>(65536); ///< by the root of the luminance
};

/// From 0 at the edge to 1 at `width` and further from it, as smooth as a cosine.
double fade(double from_edge, double width) {
  return width > 0 ? 0.5 - 0.5 * std::cos(glm::pi<double>() * std::clamp(from_edge / width, 0.0, 1.0)) : 1;
}

} // namespace

Target photograph(const std::filesystem::path& file, const Picture& picture, const Layout& layout,
                  std::vector<std::string>& notes) {
  const Luminance luminance(picture);
  Target target(layout.cell_count());
  std::optional<FileRaster> place;
  double low = std::numeric_limits<double>::infinity(), high = 0;
  std::vector<double> along; // a row of the file, a value a cell
  image::read_bands(file, [&](const image::Band& band) {
    const int width = band.rows.width;
    if (!place) {
      place = place_of(layout, picture, band);
      for (const std::string& note : band.rows.notes)
        notes.push_back(fmt::format("picture {}: {}", file.filename().string(), note));
    }
    const bool transposed = place->transposed;
    const std::vector<double> values = luminance.of(band.rows, file.string());
    for (int v = 0; v < band.rows.height; ++v) {
      const CellCoverage& down = place->rows[static_cast<std::size_t>(band.first) + static_cast<std::size_t>(v)];
      if (down.parts.empty()) continue;
      along.assign(static_cast<std::size_t>(transposed ? layout.cells.y : layout.cells.x), 0);
      for (int u = 0; u < width; ++u) {
        const CellCoverage& covered = place->columns[static_cast<std::size_t>(u)];
        if (covered.parts.empty()) continue;
        const double value = values[index_at(u, v, width)];
        low = std::min(low, value);
        high = std::max(high, value);
        const double toned = picture.tone == 1 ? value : std::pow(value, picture.tone);
        for (std::size_t i = 0; i < covered.parts.size(); ++i)
          along[static_cast<std::size_t>(covered.first) + i] += covered.parts[i] * toned;
      }
      for (std::size_t k = 0; k < down.parts.size(); ++k)
        for (std::size_t i = 0; i < along.size(); ++i) {
          const int across = down.first + static_cast<int>(k), cell = static_cast<int>(i);
          target[transposed ? index_at(across, cell, layout.cells.x) : index_at(cell, across, layout.cells.x)] +=
              down.parts[k] * along[i];
        }
    }
  });
  if (high == 0)
    throw bad_input(file.string(), "is black all over or transparent", "expected a picture with some light in it",
                    "set the picture's 'ground' to 1 to lay it on white, or 'invert' to have a negative of it");
  if (low == high)
    throw bad_input(file.string(), "is one grey all over", "expected a picture with an outline",
                    "choose another 'ground' where it is transparent; for a disc of light use a drawing");
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
