// SPDX-License-Identifier: Apache-2.0
// The only file that includes libqrencode.
#include "inverse/pictures/target.h"

#include <fmt/format.h>
#include <qrencode.h>

#include <algorithm>

namespace nephroid::inverse {
namespace {

constexpr int quiet = 4; ///< modules around a code

using Code = std::unique_ptr<QRcode, decltype(&QRcode_free)>;

Code encoded(const std::string& text, int version, QRecLevel level) {
  return {QRcode_encodeString(text.c_str(), version, level, QR_MODE_8, 1), QRcode_free};
}

Code strongest(const std::string& text, const Location& where) {
  Code code = encoded(text, 0, QR_ECLEVEL_L);
  if (!code)
    throw bad_input(where, fmt::format("has {} bytes, more than any QR code holds", text.size()),
                    "expected at most 2953");
  for (const QRecLevel level : {QR_ECLEVEL_H, QR_ECLEVEL_Q, QR_ECLEVEL_M})
    if (Code stronger = encoded(text, code->version, level); stronger && stronger->version == code->version)
      return stronger;
  return code;
}

} // namespace

std::vector<double> qr_cells(const std::string& text, const glm::ivec2& cells, const Location& where) {
  const Code code = strongest(text, where);
  const int across = code->width + 2 * quiet, module = std::min(cells.x, cells.y) / across;
  if (module < 1)
    throw bad_input(
        where,
        fmt::format("needs a QR code of version {}, {} modules with its quiet zone, and the receiver has {} x {} cells",
                    code->version, across, cells.x, cells.y),
        fmt::format("expected at least {} cells across and down, better {}", across, 2 * across),
        "choose more cells or a shorter text");
  const glm::ivec2 corner = (cells - across * module) / 2;
  std::vector<double> lit(index_at(0, cells.y, cells.x));
  for (int y = 0; y < across * module; ++y)
    for (int x = 0; x < across * module; ++x) {
      const int u = x / module - quiet, v = y / module - quiet;
      const bool inside = u >= 0 && v >= 0 && u < code->width && v < code->width;
      const bool dark = inside && (code->data[v * code->width + u] & 1); // bit 0 is the colour, 1 is dark
      lit[index_at(corner.x + x, corner.y + y, cells.x)] = dark ? 0 : 1;
    }
  return lit;
}

} // namespace nephroid::inverse
