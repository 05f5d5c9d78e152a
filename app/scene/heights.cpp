// SPDX-License-Identifier: Apache-2.0
// Boxes whose top is a height over a grid: water with waves, and the relief of a picture.
//
// Waves are linear: a sum of cosines, each at its own speed. Their heights are those of a sea that the wind has blown
// over for a fetch (JONSWAP: Hasselmann et al. 1973, "Measurements of wind-wave growth and swell decay during the Joint
// North Sea Wave Project"), in water of a depth (TMA: Bouws et al. 1985, "Similarity of the wind wave spectrum in
// finite depth water"), about the wind's direction as cos^2.
#include "scene/heights.h"

#include "base/parallel.h"
#include "scatter/texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace nephroid::scene {
namespace {

constexpr double pi = std::numbers::pi;

/// Heights over a box's top and their slopes, row by row from -z, each from -x.
struct Grid {
  int columns = 0, rows = 0; ///< squares
  std::vector<float> height, slope_x, slope_z;

  Grid(const preset::Vec3& size, int along_longer) {
    const double longer = std::max(size[0], size[2]);
    columns = std::max(1, static_cast<int>(std::lround(along_longer * size[0] / longer)));
    rows = std::max(1, static_cast<int>(std::lround(along_longer * size[2] / longer)));
    for (std::vector<float>* values : {&height, &slope_x, &slope_z}) values->assign(stride() * (rows + 1), 0);
  }
  std::size_t stride() const { return static_cast<std::size_t>(columns) + 1; }
};

/// The box under the heights: the top's vertices are smooth, those of sides and bottom are flat.
Mesh box_under(const Grid& grid, const preset::Vec3& size) {
  const auto columns = static_cast<std::uint32_t>(grid.columns), rows = static_cast<std::uint32_t>(grid.rows),
             stride = columns + 1;
  const auto x = [&](std::uint32_t i) { return (static_cast<double>(i) / columns - 0.5) * size[0]; };
  const auto z = [&](std::uint32_t j) { return (static_cast<double>(j) / rows - 0.5) * size[2]; };
  const double top = size[1] / 2;
  Mesh mesh;
  mesh.positions.resize(grid.height.size());
  mesh.normals.resize(grid.height.size());
  mesh.triangles.resize(std::size_t{2} * columns * rows);
  mesh.texcoords.resize(mesh.triangles.size());
  for_blocks(rows + 1, [&](std::size_t row) {
    const auto j = static_cast<std::uint32_t>(row);
    for (std::uint32_t i = 0; i <= columns; ++i) {
      const std::size_t at = std::size_t{j} * stride + i;
      mesh.positions[at] = glm::dvec3(x(i), top + grid.height[at], z(j));
      mesh.normals[at] = glm::normalize(glm::vec3(-grid.slope_x[at], 1, -grid.slope_z[at]));
    }
    if (j == rows) return;
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * stride + i, b = a + stride; // b is nearer to +z
      const std::size_t at = 2 * (std::size_t{j} * columns + i);
      mesh.triangles[at] = {a, b, b + 1};
      mesh.triangles[at + 1] = {a, b + 1, a + 1};
      const glm::vec2 low(static_cast<float>(i) / columns, 1 - static_cast<float>(j + 1) / rows),
          high(static_cast<float>(i + 1) / columns, 1 - static_cast<float>(j) / rows);
      mesh.texcoords[at] = {{{low.x, high.y}, low, {high.x, low.y}}};
      mesh.texcoords[at + 1] = {{{low.x, high.y}, {high.x, low.y}, high}};
    }
  });
  // A side goes along its edge of the top, counter-clockwise as seen from above, and down to the bottom.
  std::vector<std::uint32_t> rim;
  const auto side = [&](std::uint32_t count, const glm::vec3& normal, const auto& vertex) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t i = 0; i <= count; ++i) {
      const glm::vec3 high = mesh.positions[vertex(i)];
      mesh.positions.push_back(high);
      mesh.positions.emplace_back(high.x, static_cast<float>(-size[1] / 2), high.z);
      mesh.normals.insert(mesh.normals.end(), 2, normal);
      if (i < count) rim.push_back(first + 2 * i + 1);
    }
    const auto texcoord = [&](std::uint32_t i, bool is_high) {
      return glm::vec2(static_cast<float>(i) / count, is_high ? 1 : 0);
    };
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t a = first + 2 * i;
      mesh.triangles.emplace_back(a, a + 1, a + 3);
      mesh.texcoords.push_back({texcoord(i, true), texcoord(i, false), texcoord(i + 1, false)});
      mesh.triangles.emplace_back(a, a + 3, a + 2);
      mesh.texcoords.push_back({texcoord(i, true), texcoord(i + 1, false), texcoord(i + 1, true)});
    }
  };
  side(columns, {0, 0, 1}, [&](std::uint32_t i) { return rows * stride + i; });
  side(rows, {1, 0, 0}, [&](std::uint32_t i) { return (rows - i) * stride + columns; });
  side(columns, {0, 0, -1}, [&](std::uint32_t i) { return columns - i; });
  side(rows, {-1, 0, 0}, [&](std::uint32_t i) { return i * stride; });
  // The bottom is a fan about its middle: its edges are those of the sides.
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.emplace_back(0.0f, static_cast<float>(-size[1] / 2), 0.0f);
  for (const std::uint32_t below : rim) mesh.positions.push_back(mesh.positions[below]);
  mesh.normals.insert(mesh.normals.end(), rim.size() + 1, glm::vec3(0, -1, 0));
  const auto texcoord = [&](std::uint32_t vertex) { // as on the bottom of a box
    const glm::vec3& p = mesh.positions[vertex];
    return glm::vec2(p.x / size[0] + 0.5, p.z / size[2] + 0.5);
  };
  const auto corners = static_cast<std::uint32_t>(rim.size());
  for (std::uint32_t i = 0; i < corners; ++i) {
    const std::uint32_t a = first + 1 + i, b = first + 1 + (i + 1) % corners;
    mesh.triangles.emplace_back(first, b, a);
    mesh.texcoords.push_back({texcoord(first), texcoord(b), texcoord(a)});
  }
  return mesh;
}

struct Wave {
  glm::dvec2 k{0};      ///< along x and z, rad/m
  double frequency = 0; ///< rad/s
  double amplitude = 0; ///< m
  double phase = 0;
};

constexpr double gravity = 9.81;         ///< m/s^2
constexpr double tension = 0.0728 / 998; ///< water's surface tension over its density at 20 degrees, m^3/s^2

/// Speed of the phase of a wave of wave number k in water of this depth, times k.
double frequency_of(double k, double depth) {
  return std::sqrt((gravity * k + tension * k * k * k) * std::tanh(k * depth));
}

/// The wave number to a frequency, by halving: frequency_of rises.
double wave_number_of(double frequency, double depth) {
  double low = 0, high = 1;
  while (frequency_of(high, depth) < frequency) high *= 2;
  for (int step = 0; step < 60; ++step) {
    const double middle = (low + high) / 2;
    (frequency_of(middle, depth) < frequency ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// JONSWAP's spectrum of heights over frequency, m^2 s, with TMA's factor of the depth.
class Sea {
public:
  Sea(double wind, double fetch, double depth) : wind_(wind), depth_(depth) {
    peak_ = 22 * std::cbrt(gravity * gravity / (wind * fetch));
    alpha_ = 0.076 * std::pow(wind * wind / (fetch * gravity), 0.22);
  }
  double peak() const { return peak_; }
  double operator()(double frequency) const {
    const double ratio = frequency / peak_, width = ratio <= 1 ? 0.07 : 0.09;
    const double jonswap = alpha_ * gravity * gravity / std::pow(frequency, 5) * std::exp(-1.25 / std::pow(ratio, 4)) *
                           std::pow(3.3, std::exp(-std::pow((ratio - 1) / width, 2) / 2));
    // Kitaigorodskii's factor as Thompson and Vincent (1983) approximate it.
    const double shallow = frequency * std::sqrt(depth_ / gravity);
    const double factor = shallow <= 1   ? shallow * shallow / 2
                          : shallow <= 2 ? 1 - (2 - shallow) * (2 - shallow) / 2
                                         : 1;
    return jonswap * factor;
  }

  /// Where the mean square of the slopes of the waves from `low` on reaches what is seen on the sea in this wind (Cox
  /// and Munk 1954, "Measurement of the roughness of the sea surface from photographs of the sun's glitter"): beyond,
  /// the spectrum of heights has more than there is.
  double end(double low) const {
    const double most = 0.003 + 0.00512 * wind_, ratio = 1.02;
    double sum = 0, frequency = low;
    while (sum < most && frequency < 100 * peak_) {
      const double middle = frequency * std::sqrt(ratio), k = wave_number_of(middle, depth_);
      sum += k * k * (*this)(middle)*frequency * (ratio - 1);
      frequency *= ratio;
    }
    return frequency;
  }

private:
  double wind_, depth_, peak_ = 1, alpha_ = 0;
};

/// shortest: the wavelength below which there is none, m.
std::vector<Wave> waves_of(const preset::Shape& water, double depth, double shortest, const std::string& label,
                           std::vector<std::string>& warnings) {
  constexpr int frequencies = 32, directions = 6;
  std::vector<Wave> waves;
  if (water.wind_m_s == 0) return waves;
  const Sea sea(water.wind_m_s, water.fetch_m, depth);
  // Bins of one ratio from below the peak to where the slopes end, each with one frequency of its own a direction.
  const double low = 0.6 * sea.peak(), high = std::min(sea.end(low), frequency_of(2 * pi / shortest, depth));
  if (high < sea.peak())
    warnings.push_back(
        fmt::format("{}: the longest waves of this wind are {:.2g} m long, shorter than 4 of its squares: "
                    "take more segments, or a longer fetch_m",
                    label, 2 * pi / wave_number_of(sea.peak(), depth)));
  if (!(high > low)) return waves;
  const double wind = water.wind_deg * pi / 180;
  std::mt19937_64 random(water.seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (int f = 0; f < frequencies; ++f)
    for (int d = 0; d < directions; ++d) {
      const auto at = [&](double i) { return low * std::pow(high / low, i / frequencies); };
      Wave wave;
      wave.frequency = at(f + uniform());
      // cos^2 is even in its own cumulative (a + sin(a) cos(a)) / pi, which is inverted by halving.
      const double part = (d + uniform()) / directions;
      double left = -pi / 2, right = pi / 2;
      for (int step = 0; step < 50; ++step) {
        const double a = (left + right) / 2;
        ((a + std::sin(a) * std::cos(a)) / pi + 0.5 < part ? left : right) = a;
      }
      const double direction = wind + left, k = wave_number_of(wave.frequency, depth);
      wave.k = k * glm::dvec2(std::cos(direction), -std::sin(direction));
      wave.amplitude = std::sqrt(2 * sea(wave.frequency) * (at(f + 1) - at(f)) / directions);
      wave.phase = 2 * pi * uniform();
      waves.push_back(wave);
    }
  return waves;
}

/// The sums over the waves, each of which is a product of a factor along x and one along z.
void raise(Grid& grid, const std::vector<Wave>& waves, const preset::Shape& water, double metres) {
  const std::size_t stride = grid.stride(), count = waves.size();
  std::vector<float> cosines(count * stride), sines(count * stride);
  for_blocks(count, [&](std::size_t w) {
    for (std::size_t i = 0; i < stride; ++i) {
      const double x = (static_cast<double>(i) / grid.columns - 0.5) * water.size[0] * metres, angle = waves[w].k.x * x;
      cosines[w * stride + i] = static_cast<float>(std::cos(angle));
      sines[w * stride + i] = static_cast<float>(std::sin(angle));
    }
  });
  for_blocks(static_cast<std::size_t>(grid.rows) + 1, [&](std::size_t j) {
    const double z = (static_cast<double>(j) / grid.rows - 0.5) * water.size[2] * metres;
    float *height = grid.height.data() + j * stride, *slope_x = grid.slope_x.data() + j * stride,
          *slope_z = grid.slope_z.data() + j * stride;
    for (std::size_t w = 0; w < count; ++w) {
      const Wave& wave = waves[w];
      const double angle = wave.k.y * z - wave.frequency * water.time_s + wave.phase;
      const auto c = static_cast<float>(wave.amplitude * std::cos(angle)),
                 s = static_cast<float>(wave.amplitude * std::sin(angle)), kx = static_cast<float>(wave.k.x),
                 kz = static_cast<float>(wave.k.y);
      const float *cosine = cosines.data() + w * stride, *sine = sines.data() + w * stride;
      for (std::size_t i = 0; i < stride; ++i) {
        const float rising = s * cosine[i] + c * sine[i]; // minus the derivative by the angle
        height[i] += c * cosine[i] - s * sine[i];
        slope_x[i] -= kx * rising;
        slope_z[i] -= kz * rising;
      }
    }
    for (std::size_t i = 0; i < stride; ++i) height[i] /= static_cast<float>(metres);
  });
}

Mesh make_water(const preset::Shape& water, double metres_per_unit, const Location& where, const std::string& label,
                std::vector<std::string>& warnings) {
  Grid grid(water.size, water.segments);
  const double square = std::max(water.size[0] / grid.columns, water.size[2] / grid.rows) * metres_per_unit;
  const auto waves = waves_of(water, water.size[1] * metres_per_unit, 4 * square, label, warnings);
  raise(grid, waves, water, metres_per_unit);
  const double lowest = *std::ranges::min_element(grid.height);
  if (!(-lowest < water.size[1]))
    throw bad_input(where / "size" / 1,
                    fmt::format("is {:g}, and the waves' lowest trough is {:.3g} below rest", water.size[1], -lowest),
                    "expected water that is deeper than its waves", "take less wind_m_s or fetch_m, or deeper water");
  return box_under(grid, water.size);
}

Mesh make_relief(const preset::Shape& relief, const FileFinder& finder, const Location& where, const std::string& label,
                 std::vector<std::string>& warnings) {
  preset::Texture texture;
  texture.file = relief.picture;
  texture.wrap = preset::Texture::Wrap::clamp;
  const scatter::Texture picture =
      scatter::make_texture(texture, scatter::Texels::numbers, finder, where / "picture", label, warnings);
  Grid grid(relief.size, relief.segments);
  const auto texel = [&](int x, int y) {
    x = std::clamp(x, 0, picture.width - 1);
    y = std::clamp(y, 0, picture.height - 1);
    return (*picture.rgb)[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                               static_cast<std::size_t>(x)) +
                          1] /
           65535.0;
  };
  const auto height_at = [&](double u, double v) { // from the picture's top left corner
    const double x = u * picture.width - 0.5, y = v * picture.height - 0.5, fx = x - std::floor(x),
                 fy = y - std::floor(y);
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    return relief.height * std::lerp(std::lerp(texel(i, j), texel(i + 1, j), fx),
                                     std::lerp(texel(i, j + 1), texel(i + 1, j + 1), fx), fy);
  };
  for_blocks(static_cast<std::size_t>(grid.rows) + 1, [&](std::size_t j) {
    for (std::size_t i = 0; i < grid.stride(); ++i) {
      const double u = static_cast<double>(i) / grid.columns, v = static_cast<double>(j) / grid.rows,
                   du = 0.5 / grid.columns, dv = 0.5 / grid.rows;
      const std::size_t at = j * grid.stride() + i;
      grid.height[at] = static_cast<float>(height_at(u, v));
      grid.slope_x[at] = static_cast<float>((height_at(u + du, v) - height_at(u - du, v)) / (2 * du * relief.size[0]));
      grid.slope_z[at] = static_cast<float>((height_at(u, v + dv) - height_at(u, v - dv)) / (2 * dv * relief.size[2]));
    }
  });
  return box_under(grid, relief.size);
}

} // namespace

Mesh make_heights(const preset::Shape& shape, double metres_per_unit, const FileFinder& finder, const Location& where,
                  const std::string& label, std::vector<std::string>& warnings) {
  Mesh mesh = shape.type == preset::Shape::Type::water ? make_water(shape, metres_per_unit, where, label, warnings)
                                                       : make_relief(shape, finder, where, label, warnings);
  if (shape.inwards) turn_round(mesh);
  return mesh;
}

} // namespace nephroid::scene
