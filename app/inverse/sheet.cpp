// SPDX-License-Identifier: Apache-2.0
#include "inverse/sheet.h"

#include "image/image.h"
#include "optics/colour.h"

#include <algorithm>
#include <numeric>

namespace nephroid::inverse {
namespace {

/// Fills a rectangle of pixels, each by the cell that it shows.
void paste(const job::Picture& from, job::Picture& into, int left, int top, int width, int height) {
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int u = x * from.width / width, v = y * from.height / height;
      std::copy_n(&from.rgb[3 * index_at(u, v, from.width)], 3, &into.rgb[3 * index_at(left + x, top + y, into.width)]);
    }
}

/// Pictures of one size in columns and rows, each below a line of words, with the room that is left between them.
struct SlotGrid {
  glm::ivec2 counts, slot, size; ///< size: that of the picture in a slot, in pixels
  int line = 0;                  ///< height of the words' line; 0: there is no room for words

  glm::ivec2 corner(const glm::ivec2& at) const { return at * slot + (slot - size - glm::ivec2(0, line)) / 2; }
};

SlotGrid grid_of(const glm::ivec2& counts, const glm::dvec2& shape, const glm::ivec2& sheet) {
  constexpr int least_line = 12, least_slot = 80; // pixels in which words can be read
  SlotGrid grid{counts, sheet / counts, {}};
  const int gap = std::max(1, std::min(grid.slot.x, grid.slot.y) / 32);
  if (const int line = std::clamp(grid.slot.y / 12, least_line, 28);
      grid.slot.x >= least_slot && grid.slot.y >= 4 * line)
    grid.line = line;
  const glm::dvec2 room = glm::dvec2(grid.slot - gap) - glm::dvec2(0, grid.line);
  const double scale = std::max(0.0, std::min(room.x / shape.x, room.y / shape.y));
  grid.size = glm::ivec2(scale * shape);
  return grid;
}

/// White words, at the left of the box and in its middle, as large as fits.
void write(const std::string& words, job::Picture& into, const glm::ivec2& corner, const glm::ivec2& box) {
  constexpr int least = 7; // pixels of a letter
  if (box.y == 0 || words.empty()) return;
  try {
    const auto height = [](const glm::ivec2& room) { return room.y * 6 / 10; };
    image::Image text = image::text_picture(words, height(box), "sheet");
    if (text.width > box.x) {
      const int smaller = height(box) * box.x / text.width;
      if (smaller < least) return;
      text = image::text_picture(words, smaller, "sheet");
    }
    const int top = corner.y + std::max(0, box.y - text.height) / 2;
    for (int y = 0; y < std::min(text.height, box.y); ++y)
      for (int x = 0; x < std::min(text.width, box.x); ++x) {
        float* const pixel = &into.rgb[3 * index_at(corner.x + x, top + y, into.width)];
        for (int c = 0; c < 3; ++c) pixel[c] = std::max(pixel[c], text.data[index_at(x, y, text.width)]);
      }
  } catch (const Error&) { // without the font the pictures are all there is
  }
}

} // namespace

std::shared_ptr<const job::Picture> grey_picture(std::span<const double> values, double scale, const glm::ivec2& size) {
  auto picture = std::make_shared<job::Picture>();
  picture->width = size.x;
  picture->height = size.y;
  for (const double value : values) picture->rgb.insert(picture->rgb.end(), 3, static_cast<float>(scale * value));
  return picture;
}

std::shared_ptr<const job::Picture> received_picture(std::span<const double> light, double most, const Layout& layout) {
  const double sum = std::accumulate(light.begin(), light.end(), 0.0);
  return grey_picture(light, sum > 0 ? 1 / (sum * most) : 0, layout.cells);
}

std::shared_ptr<const job::Picture> coloured_picture(std::span<const glm::dvec3> xyz, double most,
                                                     const Layout& layout) {
  double sum = 0;
  for (const glm::dvec3& colour : xyz) sum += colour.y;
  auto picture = std::make_shared<job::Picture>();
  picture->width = layout.cells.x;
  picture->height = layout.cells.y;
  for (const glm::dvec3& colour : xyz)
    for (const double value : optics::xyz_to_linear_srgb({colour.x, colour.y, colour.z}))
      picture->rgb.push_back(static_cast<float>(sum > 0 ? value / (sum * most) : 0));
  return picture;
}

std::shared_ptr<const job::Picture> difference_picture(const job::Picture& wanted, const job::Picture& received) {
  auto picture = std::make_shared<job::Picture>(wanted);
  for (std::size_t i = 0; i < wanted.rgb.size(); i += 3) {
    const float* const rgb = received.rgb.data() + i;
    const float over = 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2] - wanted.rgb[i]; // luminance
    picture->rgb[i] = std::max(over, 0.0f);
    picture->rgb[i + 1] = 0;
    picture->rgb[i + 2] = std::max(-over, 0.0f);
  }
  return picture;
}

std::shared_ptr<const job::Picture> slopes_picture(std::span<const glm::dvec2> slopes, std::span<const double> heights,
                                                   const Layout& layout) {
  auto picture = std::make_shared<job::Picture>();
  picture->width = layout.facets.x;
  picture->height = layout.facets.y;
  for (std::size_t i = 0; i < slopes.size(); ++i)
    for (const double value : {slopes[i].x, slopes[i].y, heights[i]}) picture->rgb.push_back(static_cast<float>(value));
  return picture;
}

std::shared_ptr<const job::Picture> sheet(const std::vector<std::vector<Captioned>>& lists, const glm::dvec2& shape,
                                          int width, int height) {
  auto picture = std::make_shared<job::Picture>();
  picture->width = width;
  picture->height = height;
  picture->rgb.assign(3 * index_at(0, height, width), 0.02f); // a grey that parts black pictures
  const glm::ivec2 counts(lists.size(), lists.front().size());
  const auto grid_with = [&](int across, int down) { return grid_of({across, down}, shape, {width, height}); };
  const SlotGrid upright = grid_with(counts.x, counts.y), lying = grid_with(counts.y, counts.x);
  const bool lies = lying.size.x > upright.size.x;
  SlotGrid grid = lies ? lying : upright;
  const SlotGrid square = grid_with(2, (counts.y + 1) / 2); // one list in a row would leave a square sheet empty
  const bool wraps = counts.x == 1 && square.size.x > grid.size.x;
  if (wraps) grid = square;
  for (int list = 0; list < counts.x; ++list)
    for (int item = 0; item < counts.y; ++item) {
      const Captioned& shown = lists[static_cast<std::size_t>(list)][static_cast<std::size_t>(item)];
      const glm::ivec2 corner = grid.corner(wraps  ? glm::ivec2(item % 2, item / 2)
                                            : lies ? glm::ivec2(item, list)
                                                   : glm::ivec2(list, item));
      paste(*shown.picture, *picture, corner.x, corner.y + grid.line, grid.size.x, grid.size.y);
      write(shown.words, *picture, corner, {grid.size.x, grid.line});
    }
  return picture;
}

} // namespace nephroid::inverse
