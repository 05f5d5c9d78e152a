// SPDX-License-Identifier: Apache-2.0
#include "photons/smoothing.h"

#include "base/parallel.h"
#include "base/summed_area.h"
#include "photons/mixture.h"
#include "photons/pixel_surfaces.h"
#include "tracing/world.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <utility>

namespace nephroid::photons {
namespace {

/// Steps by which kernels are balanced at the border of a surface.
constexpr int balancing_steps = 3;

/// How far a kernel may reach, and the radius around a pixel of its noise's mean, in pixels.
constexpr int reach = 6, noise_radius = 7;
constexpr std::size_t block_rows = 64, block_pixels = 1 << 12;

/// Two pixels are on one nearly flat part where their normals are within 25 degrees, and their way 30 of the surface.
constexpr float least_cosine = 0.9f, most_rise = 0.5f;

/// Glass or a mirror is curved about pixels where neighbours show places most_pull times as far apart as a flat one.
constexpr float most_pull = 2;
constexpr int pull_reach = 2;

/// The radius around a pixel of the mean of the bias of spread light, in pixels.
constexpr int bias_radius = 12;

struct Offset {
  int x, y;
  int distance2() const { return x * x + y * y; }
};

/// The pixels within reach, nearest first.
struct Reach {
  std::vector<Offset> offsets;
  std::vector<std::uint32_t> ring_ends; ///< for each ring of pixels equally far away, one past its last
};

const Reach& within_reach() {
  static const Reach sorted = [] {
    Reach within;
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x)
        if (x * x + y * y <= reach * reach) within.offsets.push_back({x, y});
    std::ranges::stable_sort(within.offsets, {}, &Offset::distance2);
    for (std::size_t end = 1; end <= within.offsets.size(); ++end)
      if (end == within.offsets.size() || within.offsets[end].distance2() > within.offsets[end - 1].distance2())
        within.ring_ends.push_back(static_cast<std::uint32_t>(end));
    return within;
  }();
  return sorted;
}

/// Calls work(i, j) for each pair of pixels that touch at a side, and with `diagonal` also at a corner.
template <class Work>
void for_neighbours(int width, int height, bool diagonal, const Work& work) {
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  for (std::size_t y = 0; y < rows; ++y)
    for (std::size_t x = 0; x < columns; ++x) {
      const std::size_t i = y * columns + x;
      if (x + 1 < columns) work(i, i + 1);
      if (y + 1 < rows) work(i, i + columns);
      if (diagonal && x + 1 < columns && y + 1 < rows) work(i, i + columns + 1), work(i + 1, i + columns);
    }
}

/// Whether a mirror or glass shows neighbours places of one object that it has pulled apart.
bool are_pulled_apart(const PixelSurfaces& a, const PixelSurfaces& b) {
  if (a.first.object != b.first.object || a.last.object != b.last.object || a.first.object == a.last.object)
    return false;
  const glm::vec3 way = b.last.position - a.last.position;
  return glm::length(way - glm::dot(way, a.way) * a.way) > most_pull * std::max(a.spacing, b.spacing);
}

/// For each pixel, whether places are pulled apart within pull_reach of it.
std::vector<bool> are_near_pulled(const std::vector<PixelSurfaces>& pixels, int width, int height) {
  std::vector<double> pulled(pixels.size());
  for_neighbours(width, height, false, [&](std::size_t i, std::size_t j) {
    if (are_pulled_apart(pixels[i], pixels[j])) pulled[i] = pulled[j] = 1;
  });
  const SummedArea sums(width, height, [&](std::size_t i) { return pulled[i]; });
  std::vector<bool> near(pixels.size());
  for (std::size_t i = 0; i < near.size(); ++i)
    near[i] = sums.sum(static_cast<int>(i) % width, static_cast<int>(i) / width, pull_reach) > 0;
  return near;
}

/// Adds to the draw of what is spread how far light was moved. With r what spreading has changed of the picture and q
/// what it has of the draw, r + q and r - q are what it has changed of two halves with noise of their own, so that
/// around a pixel
///
///   M = sum of (r + q)(r - q)                    is that of the squares of the bias, give or take
///   S^(1/2), S = sum of ((r + q)(r - q))^2,      and
///   g^2 = M / (sum of r^2) / (1 + S / M^2)       the share of r^2 that it is, as far as it stands out,
///
/// and g r a draw of the bias: r is the bias and the noise that was taken away, which is no error of what is spread.
void add_bias(std::span<const float> rgb, std::span<const float> error_draw, std::span<const float> rgb_spread,
              std::vector<float>& draw_spread, int width, int height) {
  // r^2 + factor q^2, summed over R, G and B.
  const auto changed = [&](std::size_t i, double factor) {
    double sum = 0;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
      const double r = static_cast<double>(rgb_spread[c]) - rgb[c],
                   q = static_cast<double>(draw_spread[c]) - error_draw[c];
      sum += r * r + factor * q * q;
    }
    return sum;
  };
  const SummedArea change(width, height, [&](std::size_t i) { return changed(i, 0); });
  const SummedArea product(width, height, [&](std::size_t i) { return changed(i, -1); });
  const SummedArea square(width, height, [&](std::size_t i) { return std::pow(changed(i, -1), 2); });
  for (std::size_t i = 0; i < rgb.size() / 3; ++i) {
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    const double bias2 = product.sum(x, y, bias_radius), change2 = change.sum(x, y, bias_radius);
    if (bias2 <= 0 || change2 <= 0) continue;
    const double scatter2 = std::max(square.sum(x, y, bias_radius), 0.0);
    const auto g = static_cast<float>(std::sqrt(std::min(bias2 / change2 / (1 + scatter2 / (bias2 * bias2)), 1.0)));
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) draw_spread[c] += g * (rgb_spread[c] - rgb[c]);
  }
}

/// How much of each pixel's light is better spread, 0..1. Spreading changes the picture m = truth + noise to m + r, and
/// with a share s of the light to m + s r. The square of its error then grows by
///
///   s^2 E[r^2] + 2 s E[r noise],    smallest at    s = -E[r noise] / E[r^2].
///
/// The halves m + d and m - d of the film, each spread by its own kernels, change by r_a and r_b. One half's noise is
/// not in the other, so E[r_a d] and -E[r_b d] estimate E[r noise], with twice the noise of m: q = (r_a - r_b) / 2
/// gives E[r noise] = E[q d]. This includes that kernels follow the noise. Means are taken around the pixel, over R, G
/// and B. The square of an error is divided by the light there, so that every photon counts alike; but a pixel that
/// changes by more than that light counts no more than one that changes by it, or a bright spot would decide for a
/// whole square about it.
std::vector<float> worthwhile_shares(std::span<const float> rgb, std::span<const float> error_draw,
                                     std::span<const float> rgb_spread, std::span<const float> a_spread,
                                     std::span<const float> b_spread, std::span<const double> light, int width,
                                     int height) {
  const double dark = least_light(light);
  const SummedArea lights(width, height, [&](std::size_t i) { return light[i]; });
  std::vector<double> changes(light.size()), gains(light.size());
  for (std::size_t i = 0; i < light.size(); ++i) {
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
      const double d = error_draw[c], q = (static_cast<double>(a_spread[c]) - b_spread[c]) / 2 - d;
      changes[i] += std::pow(static_cast<double>(rgb_spread[c]) - rgb[c], 2);
      gains[i] -= q * d;
    }
    const double near = dark + lights.mean(static_cast<int>(i) % width, static_cast<int>(i) / width, noise_radius),
                 weight = 1 / std::max(near, changes[i] / near);
    changes[i] *= weight;
    gains[i] *= weight;
  }
  const SummedArea change(width, height, [&](std::size_t i) { return changes[i]; });
  const SummedArea gain(width, height, [&](std::size_t i) { return gains[i]; });
  const SummedArea worth(width, height, [&](std::size_t i) {
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    const double changed = change.sum(x, y, bias_radius);
    return changed > 0 ? std::clamp(gain.sum(x, y, bias_radius) / changed, 0.0, 1.0) : 0;
  });
  // A share that jumped would be seen as a line.
  std::vector<float> share(light.size());
  for (std::size_t i = 0; i < share.size(); ++i)
    share[i] = static_cast<float>(worth.mean(static_cast<int>(i) % width, static_cast<int>(i) / width, noise_radius));
  return share;
}

/// What a pixel shows, as far as it matters for spreading light over it.
struct PixelSight {
  PixelSurfaces::Surface surface; ///< the diffuse one at the end of a ray, or the first of glass or a mirror
  int first = -1;                 ///< object that the ray meets first; -1: none, or a texture or a lamp is seen
  bool at_edge = false;           ///< whether a neighbour shows something else, whose light the pixel may hold
};

/// The pixels that light may be spread over.
struct SpreadDomain {
  int width, height;
  std::span<const Smoothing::Level> level; ///< [pixel]
  std::vector<std::size_t> steps = {}; ///< [of the pixels within reach]: what to add to a pixel's number, modulo 2^64
  SpreadDomain(int columns, int rows, std::span<const Smoothing::Level> levels)
      : width(columns), height(rows), level(levels) {
    for (const Offset& o : within_reach().offsets)
      steps.push_back(static_cast<std::size_t>(std::ptrdiff_t{o.y} * width + o.x));
  }
};

/// Where a pixel's light goes, by how each pixel is favoured. The outermost ring gets less: no kernel jumps.
struct Kernel {
  std::uint32_t inside = 0,
                end = 0;  ///< numbers of the pixels before the outermost ring, and with it
  double ring_weight = 1; ///< weight of a pixel of that ring, 0..1
  double scale = 1;       ///< factor that makes the sum of all weights 1
};

bool are_level(const PixelSight& a, const PixelSight& b) {
  if (a.first != b.first || a.surface.object != b.surface.object || a.at_edge != b.at_edge || a.first < 0) return false;
  const glm::vec3 &n = a.surface.normal, &m = b.surface.normal, way = b.surface.position - a.surface.position;
  return glm::dot(n, m) > least_cosine && std::abs(glm::dot(way, n + m)) <= 2 * most_rise * glm::length(way);
}

/// Calls work(j) for each pixel j that pixel i may give light to, among the numbers begin..end-1 within reach.
template <class Work>
void for_level(const SpreadDomain& at, std::size_t i, std::uint32_t begin, std::uint32_t end, const Work& work) {
  constexpr std::uint32_t bits = 64;
  for (std::uint32_t word = begin / bits; word * bits < end; ++word) {
    std::uint64_t level = at.level[i][word];
    if (begin > word * bits) level &= ~std::uint64_t{0} << (begin - word * bits);
    if (end - word * bits < bits) level &= (std::uint64_t{1} << (end - word * bits)) - 1;
    for (; level != 0; level &= level - 1)
      work(i + at.steps[word * bits + static_cast<std::uint32_t>(std::countr_zero(level))]);
  }
}

/// Finds each [pixel]'s kernel: it holds `wanted` of `light`, or reaches as far as any may.
std::vector<Kernel> find_kernels(const SpreadDomain& at, std::span<const double> light, std::span<const double> wanted,
                                 std::span<const double> favour) {
  std::vector<Kernel> kernels(light.size());
  for_ranges(kernels.size(), block_pixels, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      Kernel kernel;
      double inside = 0, ring = 0, favours = 0, ring_favours = 0;
      for (const std::uint32_t end : within_reach().ring_ends) {
        if (kernel.end > 0 && inside + ring >= wanted[i]) break;
        inside += std::exchange(ring, 0);
        favours += std::exchange(ring_favours, 0);
        kernel.inside = kernel.end;
        for_level(at, i, std::exchange(kernel.end, end), end,
                  [&](std::size_t j) { ring += light[j], ring_favours += favour[j]; });
      }
      if (kernel.inside > 0 && ring > 0) kernel.ring_weight = std::clamp((wanted[i] - inside) / ring, 0.0, 1.0);
      kernel.scale = 1 / (favours + kernel.ring_weight * ring_favours);
      kernels[i] = kernel;
    }
  });
  return kernels;
}

/// Calls give(i, j, part) with the part of its light that each `needed(i)` gives to j, on every core with its own j.
template <class Needed, class Give>
void give_parts(const SpreadDomain& at, std::span<const Kernel> kernels, std::span<const double> favour,
                const Needed& needed, const Give& give) {
  // A block of rows collects from all pixels within reach of it, in their order: the same bits on any number of cores.
  for_ranges(static_cast<std::size_t>(at.height), block_rows, [&](std::size_t, Range rows) {
    const std::size_t width = static_cast<std::size_t>(at.width), first = rows.begin * width, end = rows.end * width;
    const std::size_t from = (rows.begin - std::min<std::size_t>(rows.begin, reach)) * width;
    const std::size_t to = std::min<std::size_t>(rows.end + reach, static_cast<std::size_t>(at.height)) * width;
    for (std::size_t i = from; i < to; ++i) {
      if (!needed(i)) continue;
      const Kernel& kernel = kernels[i];
      const auto give_to = [&](std::uint32_t begin, std::uint32_t past, double weight) {
        for_level(at, i, begin, past, [&](std::size_t j) {
          if (j >= first && j < end) give(i, j, weight * favour[j]);
        });
      };
      give_to(0, kernel.inside, kernel.scale);
      give_to(kernel.inside, kernel.end, kernel.scale * kernel.ring_weight);
    }
  });
}

/// The kernels spread `share` of each pixel's value; the rest stays.
void spread_shares(const SpreadDomain& at, std::span<const Kernel> kernels, std::span<const double> favour,
                   std::span<const float> share, std::vector<float>& rgb) {
  using Colour = std::array<float, 4>; // four numbers are added as fast as one
  std::vector<Colour> given(at.level.size()), kept(at.level.size());
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    given[i / 3][i % 3] = share[i / 3] * rgb[i];
    kept[i / 3][i % 3] = (1 - share[i / 3]) * rgb[i];
  }
  give_parts(
      at, kernels, favour, [&](std::size_t i) { return given[i] != Colour{}; },
      [&](std::size_t i, std::size_t j, double part) {
        for (std::size_t c = 0; c < 4; ++c) kept[j][c] += static_cast<float>(part) * given[i][c];
      });
  for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = kept[i / 3][i % 3];
}

} // namespace

std::vector<double> light_of(std::span<const float> rgb) {
  std::vector<double> light(rgb.size() / 3);
  for (std::size_t i = 0; i < rgb.size(); ++i) light[i / 3] += std::max(static_cast<double>(rgb[i]), 0.0) / 3;
  return light;
}

std::vector<double> portions(std::span<const double> light, std::span<const float> error_draw, int width, int height) {
  const SummedArea lights(width, height, [&](std::size_t i) { return light[i]; });
  const SummedArea variances(width, height, [&](std::size_t i) {
    const double r = error_draw[3 * i], g = error_draw[3 * i + 1], b = error_draw[3 * i + 2];
    return (r * r + g * g + b * b) / 3;
  });
  std::vector<double> portion(light.size());
  for (std::size_t i = 0; i < portion.size(); ++i) {
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    const double near = lights.mean(x, y, noise_radius);
    portion[i] = near > 0 ? std::max(variances.mean(x, y, noise_radius), 0.0) / near : 0;
  }
  return portion;
}

std::shared_ptr<const Smoothing::View> Smoothing::view_of(const scene::Scene& scene, const scene::Bvh& bvh) {
  scene::Scene seen = scene;
  seen.environment.reset(); // the largest part of a scene, and no ray needs it
  return std::make_shared<const View>(View{std::move(seen), bvh});
}

Smoothing::Smoothing(std::shared_ptr<const View> view, int width, int height, Spread spread, FindTexture find_texture)
    : width_(width), height_(height), spread_(spread), view_(std::move(view)), find_texture_(std::move(find_texture)) {}

Smoothing::Smoothing(std::shared_ptr<const View> view, int width, int height, Spread spread)
    : width_(width), height_(height), spread_(spread), view_(std::move(view)), has_textures_(false) {}

void Smoothing::find_surfaces() {
  if (!view_) return;
  const std::shared_ptr<const View> view = std::move(view_);
  scene::Camera camera = view->scene.camera;
  camera.width = width_;
  camera.height = height_;
  std::vector<PixelSight> seen(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  std::vector<PixelSurfaces> pixels(seen.size());
  for_ranges(pixels.size(), 1 << 10, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      pixels[i] =
          surfaces_of_pixel(view->scene, view->bvh, camera, static_cast<int>(i) % width_, static_cast<int>(i) / width_);
  });
  if (find_texture_) texture_ = find_texture_();
  const std::vector<bool> pulled = are_near_pulled(pixels, width_, height_);
  const auto is_so = [&](int object, bool (*is)(const scatter::Material&)) {
    return object >= 0 && is(material_of(view->scene, view->scene.objects[static_cast<std::size_t>(object)]));
  };
  std::vector<bool> knows_texture(seen.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const auto& [first, last, way, spacing] = pixels[i];
    // What a rough surface shows has no outlines and no texture left, but for its own.
    const bool is_rough = is_so(first.object, scatter::is_rough), is_blurred = is_rough && first.object != last.object;
    knows_texture[i] =
        (!texture_.empty() || !has_textures_) && !is_blurred && is_so(last.object, scatter::is_light_times_texture);
    const bool has_detail = (is_so(last.object, scatter::has_pictures) && !is_rough && !knows_texture[i]) ||
                            is_so(first.object, scatter::has_rough_texture) ||
                            is_so(first.object, scatter::has_tint_texture);
    seen[i] = {pulled[i] || is_rough ? first : last, has_detail ? -1 : first.object};
  }
  std::vector<bool> is_lamp(view->scene.objects.size());
  for (const scene::Light& light : view->scene.lights)
    if (light.object >= 0) is_lamp[static_cast<std::size_t>(light.object)] = true;
  const auto shows_lamp = [&](std::size_t i) {
    const int object = pixels[i].last.object;
    return object >= 0 && is_lamp[static_cast<std::size_t>(object)];
  };
  std::vector<bool> near_lamp(seen.size());
  for_neighbours(width_, height_, true, [&](std::size_t i, std::size_t j) {
    if (shows_lamp(i) || shows_lamp(j)) near_lamp[i] = near_lamp[j] = true;
  });
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (near_lamp[i]) seen[i].first = -1, lamps_.push_back(i);
  for_neighbours(width_, height_, true, [&](std::size_t i, std::size_t j) {
    if (seen[i].first == seen[j].first && seen[i].surface.object == seen[j].surface.object) return;
    seen[i].at_edge = seen[j].at_edge = true;
  });
  // Blocks reach beyond what shows a texture: light without one is about as strong there if it has the mean texture.
  for (std::size_t c = 0; c < 3 && !texture_.empty(); ++c) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < knows_texture.size(); ++i)
      if (knows_texture[i]) sum += texture_[3 * i + c], ++count;
    for (std::size_t i = 0; i < knows_texture.size(); ++i)
      if (!knows_texture[i]) texture_[3 * i + c] = count > 0 ? static_cast<float>(sum / count) : 1;
  }
  level_.resize(seen.size());
  for_ranges(seen.size(), 1 << 12, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      for (std::size_t number = 0; number < within_reach().offsets.size(); ++number) {
        const Offset& o = within_reach().offsets[number];
        const int x = static_cast<int>(i) % width_ + o.x, y = static_cast<int>(i) / width_ + o.y;
        if (x < 0 || x >= width_ || y < 0 || y >= height_) continue;
        const std::size_t j =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
        if (j == i || are_level(seen[i], seen[j])) level_[i][number / 64] |= std::uint64_t{1} << (number % 64);
      }
  });
}

std::uint64_t Smoothing::bytes(const scene::Scene& scene, const scene::Bvh& bvh) {
  constexpr std::uint64_t pulled_apart = 2 * sizeof(double); // marks, and their summed area
  return tracing::tree_bytes(bvh) + tracing::mesh_bytes(scene) +
         (sizeof(PixelSurfaces) + sizeof(PixelSight) + sizeof(Level) + pulled_apart) * scene.camera.pixels();
}

void Smoothing::take_textures_out(std::vector<float>& values) {
  find_surfaces();
  if (!texture_.empty()) std::ranges::transform(values, texture_, values.begin(), std::divides());
}

void Smoothing::put_textures_in(std::vector<float>& values) const {
  if (!texture_.empty()) std::ranges::transform(values, texture_, values.begin(), std::multiplies());
}

void Smoothing::spread(std::vector<float>& rgb, std::vector<float>& error_draw, std::span<const float> known,
                       double noise) {
  if (error_draw.empty()) return;
  std::vector<float> known_light(known.begin(), known.end());
  for (std::vector<float>* values : {&rgb, &error_draw, &known_light}) take_textures_out(*values);
  spread_light(rgb, error_draw, known_light, noise);
  for (std::vector<float>* values : {&rgb, &error_draw}) put_textures_in(*values);
}

void Smoothing::spread_light(std::vector<float>& rgb, std::vector<float>& error_draw, std::span<const float> known,
                             double noise) {
  if (error_draw.empty()) return;
  find_surfaces();
  const auto keep_lamps = [&](const std::vector<float>& from, std::vector<float>& to) {
    for (const std::size_t i : lamps_)
      for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) to[c] = from.empty() ? 0 : from[c];
  };
  const std::vector<float> rgb_before = rgb, draw_before = error_draw;
  keep_lamps({}, rgb);
  keep_lamps({}, error_draw);
  const std::vector<double> light = light_of(rgb);
  std::vector<double> wanted = portions(light, error_draw, width_, height_);
  for (double& portion : wanted) portion /= noise * noise; // n portions have the noise 1 / sqrt(n)

  const SpreadDomain at{width_, height_, level_};
  // In even light a pixel at the border of a part takes less than it gives, and one a kernel away from there takes
  // more. Sinkhorn and Knopp (1967) even that out, a step after the other, and still every pixel gives away what it
  // has.
  const std::vector<double> even(level_.size(), 1);
  std::vector<double> favour = even;
  for (int step = 0; step < balancing_steps; ++step) {
    std::vector<double> taken(level_.size());
    give_parts(
        at, find_kernels(at, light, wanted, favour), favour, [](std::size_t) { return true; },
        [&](std::size_t, std::size_t j, double part) { taken[j] += part; });
    std::transform(favour.begin(), favour.end(), taken.begin(), favour.begin(), std::divides());
  }
  const std::vector<Kernel> kernels = find_kernels(at, light, wanted, favour);

  std::vector<float> share(level_.size(), 1);
  const auto spread_by = [&](const std::vector<Kernel>& by, std::vector<float> picture) {
    spread_shares(at, by, favour, share, picture);
    return picture;
  };
  std::vector<float> rgb_spread = spread_by(kernels, rgb);
  if (spread_ == Spread::where_it_helps) {
    std::vector<float> a = rgb, b = rgb;
    std::ranges::transform(rgb, error_draw, a.begin(), std::plus());
    std::ranges::transform(rgb, error_draw, b.begin(), std::minus());
    share = worthwhile_shares(rgb, error_draw, rgb_spread, spread_by(find_kernels(at, light_of(a), wanted, favour), a),
                              spread_by(find_kernels(at, light_of(b), wanted, favour), b), light, width_, height_);
    rgb_spread = spread_by(kernels, rgb);
  }
  std::vector<float> draw_spread = spread_by(kernels, error_draw);
  if (!known.empty()) mix(rgb, error_draw, {known, {}}, light, width_, height_, rgb_spread, draw_spread);
  add_bias(rgb, error_draw, rgb_spread, draw_spread, width_, height_);
  keep_lamps(rgb_before, rgb_spread);
  keep_lamps(draw_before, draw_spread);
  rgb = std::move(rgb_spread);
  error_draw = std::move(draw_spread);
}

} // namespace nephroid::photons
