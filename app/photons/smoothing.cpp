// SPDX-License-Identifier: Apache-2.0
#include "photons/smoothing.h"

#include "base/parallel.h"
#include "base/summed_area.h"
#include "photons/mixture.h"
#include "photons/pixel_surfaces.h"
#include "tracing/world.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nephroid::photons {
namespace {

/// Steps by which kernels are balanced at the border of a surface.
constexpr int balancing_steps = 3;

/// The radius around a pixel of its noise's mean, in pixels.
constexpr int noise_radius = 7;

/// Two pixels are on one nearly flat part where their normals are within 25 degrees, and their way 30 of the surface.
constexpr float least_cosine = 0.9f, most_rise = 0.5f;

/// Glass or a mirror is curved about pixels where neighbours show places most_pull times as far apart as a flat one.
constexpr float most_pull = 2;
constexpr int pull_reach = 2;

/// The radius around a pixel of the mean of the bias of spread light, in pixels.
constexpr int bias_radius = 12;

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

std::vector<double> portions(std::span<const double> light, std::span<const float> error_draw,
                             const KindsOfPixels& kinds) {
  const auto lights = kinds.sums([&](std::size_t i) { return light[i]; });
  const auto variances = kinds.sums([&](std::size_t i) {
    const double r = error_draw[3 * i], g = error_draw[3 * i + 1], b = error_draw[3 * i + 2];
    return (r * r + g * g + b * b) / 3;
  });
  std::vector<double> portion(light.size());
  for_items(portion.size(), [&](std::size_t i) {
    const double near = lights.mean(i, noise_radius);
    portion[i] = near > 0 ? std::max(variances.mean(i, noise_radius), 0.0) / near : 0;
  });
  return portion;
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
                                     std::span<const float> b_spread, std::span<const double> light,
                                     const KindsOfPixels& kinds) {
  const double dark = least_light(light);
  const auto lights = kinds.sums([&](std::size_t i) { return light[i]; });
  std::vector<double> changes(light.size()), gains(light.size());
  for_items(light.size(), [&](std::size_t i) {
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
      const double d = error_draw[c], q = (static_cast<double>(a_spread[c]) - b_spread[c]) / 2 - d;
      changes[i] += std::pow(static_cast<double>(rgb_spread[c]) - rgb[c], 2);
      gains[i] -= q * d;
    }
    const double near = dark + lights.mean(i, noise_radius), weight = 1 / std::max(near, changes[i] / near);
    changes[i] *= weight;
    gains[i] *= weight;
  });
  const auto change = kinds.sums([&](std::size_t i) { return changes[i]; });
  const auto gain = kinds.sums([&](std::size_t i) { return gains[i]; });
  const auto worth = kinds.sums([&](std::size_t i) {
    const double changed = change.mean(i, bias_radius);
    return changed > 0 ? std::clamp(gain.mean(i, bias_radius) / changed, 0.0, 1.0) : 0;
  });
  // A share that jumped would be seen as a line.
  std::vector<float> share(light.size());
  for_items(share.size(), [&](std::size_t i) { share[i] = static_cast<float>(worth.mean(i, noise_radius)); });
  return share;
}

/// What a pixel shows, as far as it matters for spreading light over it.
struct PixelSight {
  PixelSurfaces::Surface surface; ///< the diffuse one at the end of a ray, or the first of glass or a mirror
  int first = -1;                 ///< object that the ray meets first; -1: none, or a texture or a lamp is seen
  bool at_edge = false;           ///< whether a neighbour shows something else, whose light the pixel may hold
  bool is_beside = false;         ///< whether nothing is seen in its middle, and the surface is a neighbour's
};

bool are_level(const PixelSight& a, const PixelSight& b) {
  if (a.first != b.first || a.surface.object != b.surface.object || a.at_edge != b.at_edge ||
      a.is_beside != b.is_beside || a.first < 0)
    return false;
  const glm::vec3 &n = a.surface.normal, &m = b.surface.normal, way = b.surface.position - a.surface.position;
  return glm::dot(n, m) > least_cosine && std::abs(glm::dot(way, n + m)) <= 2 * most_rise * glm::length(way);
}

/// The kernels spread `share` of each pixel's value; the rest stays.
void spread_shares(const SpreadDomain& domain, const SpreadKernels& kernels, const Plane& favour,
                   std::span<const float> share, std::vector<float>& rgb) {
  std::array<Plane, 3> given;
  for (std::size_t c = 0; c < 3; ++c) given[c] = domain.plane([&](std::size_t i) { return share[i] * rgb[3 * i + c]; });
  const std::array<Plane, 3> collected = domain.collect(kernels, given);
  for_items(share.size(), [&](std::size_t i) {
    for (std::size_t c = 0; c < 3; ++c) rgb[3 * i + c] = (1 - share[i]) * rgb[3 * i + c] + favour[i] * collected[c][i];
  });
}

} // namespace

std::vector<double> light_of(std::span<const float> rgb) {
  std::vector<double> light(rgb.size() / 3);
  for_items(light.size(), [&](std::size_t i) {
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) light[i] += std::max(static_cast<double>(rgb[c]), 0.0) / 3;
  });
  return light;
}

std::vector<double> portions(std::span<const double> light, std::span<const float> error_draw, int width, int height) {
  return portions(light, error_draw, KindsOfPixels(width, height));
}

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
  for_items(rgb.size() / 3, [&](std::size_t i) {
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    const double bias2 = product.sum(x, y, bias_radius), change2 = change.sum(x, y, bias_radius);
    if (bias2 <= 0 || change2 <= 0) return;
    const double scatter2 = std::max(square.sum(x, y, bias_radius), 0.0);
    const auto g = static_cast<float>(std::sqrt(std::min(bias2 / change2 / (1 + scatter2 / (bias2 * bias2)), 1.0)));
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) draw_spread[c] += g * (rgb_spread[c] - rgb[c]);
  });
}

std::shared_ptr<const Smoothing::View> Smoothing::view_of(const scene::Scene& scene, const scene::Bvh& bvh) {
  scene::Scene seen = scene;
  seen.environment.reset(); // the largest part of a scene, and no ray needs it
  return std::make_shared<const View>(View{std::move(seen), bvh});
}

Smoothing::Smoothing(std::shared_ptr<const View> view, int width, int height, Spread spread, FindTexture find_texture)
    : width_(width), height_(height), spread_(spread), view_(std::move(view)), find_texture_(std::move(find_texture)),
      kinds_(width, height) {}

Smoothing::Smoothing(std::shared_ptr<const View> view, int width, int height, Spread spread)
    : width_(width), height_(height), spread_(spread), view_(std::move(view)), has_textures_(false),
      kinds_(width, height) {}

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
  // Pixels beside an object, with nothing in their middle, hold a little of its light, too.
  const auto show_surface_of = [&](std::size_t i, std::size_t j) {
    if (pixels[i].first.object >= 0 || near_lamp[i] || seen[i].first >= 0 || seen[j].first < 0 || seen[j].is_beside)
      return;
    seen[i] = seen[j];
    seen[i].is_beside = true;
  };
  for (const bool diagonal : {false, true})
    for_neighbours(width_, height_, diagonal, [&](std::size_t i, std::size_t j) {
      show_surface_of(i, j);
      show_surface_of(j, i);
    });
  // Blocks reach beyond what shows a texture: light without one is about as strong there if it has the mean texture.
  for (std::size_t c = 0; c < 3 && !texture_.empty(); ++c) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < knows_texture.size(); ++i)
      if (knows_texture[i]) sum += texture_[3 * i + c], ++count;
    for (std::size_t i = 0; i < knows_texture.size(); ++i)
      if (!knows_texture[i]) texture_[3 * i + c] = count > 0 ? static_cast<float>(sum / count) : 1;
  }
  const auto is_matt_object = [&](int object) {
    return object < 0 || is_matt(material_of(view->scene, view->scene.objects[static_cast<std::size_t>(object)]).type);
  };
  kinds_ = KindsOfPixels(width_, height_,
                         [&](std::size_t i) { return seen[i].at_edge || !is_matt_object(pixels[i].first.object); });
  domain_ = SpreadDomain(width_, height_, [&](std::size_t i, std::size_t j) { return are_level(seen[i], seen[j]); });
}

std::uint64_t Smoothing::bytes(const scene::Scene& scene, const scene::Bvh& bvh) {
  constexpr std::uint64_t pulled_apart = 2 * sizeof(double), // marks, and their summed area
      kinds = sizeof(std::uint8_t) + sizeof(double);
  return tracing::tree_bytes(bvh) + tracing::mesh_bytes(scene) +
         (sizeof(PixelSurfaces) + sizeof(PixelSight) + SpreadDomain::bytes_per_pixel() + pulled_apart + kinds) *
             scene.camera.pixels();
}

void Smoothing::take_textures_out(std::vector<float>& values) {
  find_surfaces();
  for_items(std::min(values.size(), texture_.size()), [&](std::size_t i) { values[i] /= texture_[i]; });
}

void Smoothing::put_textures_in(std::vector<float>& values) const {
  for_items(std::min(values.size(), texture_.size()), [&](std::size_t i) { values[i] *= texture_[i]; });
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
  const std::vector<double> portion = portions(light, error_draw, kinds_);
  // n portions have the noise 1 / sqrt(n).
  const Plane wanted = domain_.plane([&](std::size_t i) { return portion[i] / (noise * noise); });
  const auto kernels_of = [&](std::span<const double> of) {
    return domain_.kernels_of(domain_.plane([&](std::size_t i) { return of[i]; }), wanted);
  };
  SpreadKernels kernels = kernels_of(light);
  const std::array<Plane, 1> even = {domain_.plane([](std::size_t) { return 1; })};
  // In even light a pixel at the border of a part takes less than it gives, and one a kernel away from there takes
  // more. Sinkhorn and Knopp (1967) even that out, a step after the other, and still every pixel gives away what it
  // has.
  Plane favour = even[0];
  for (int step = 0; step < balancing_steps; ++step) {
    domain_.scale(kernels, favour);
    const Plane taken = domain_.collect(kernels, even)[0];
    favour = domain_.plane([&](std::size_t i) { return 1 / taken[i]; });
  }
  domain_.scale(kernels, favour);

  std::vector<float> share(light.size(), 1);
  const auto spread_by = [&](const SpreadKernels& by, std::vector<float> picture) {
    spread_shares(domain_, by, favour, share, picture);
    return picture;
  };
  const auto spread_half = [&](const std::vector<float>& half) {
    SpreadKernels own = kernels_of(light_of(half));
    domain_.scale(own, favour);
    return spread_by(own, half);
  };
  std::vector<float> rgb_spread = spread_by(kernels, rgb);
  if (spread_ == Spread::where_it_helps) {
    std::vector<float> a = rgb, b = rgb;
    for_items(rgb.size(), [&](std::size_t i) { a[i] += error_draw[i], b[i] -= error_draw[i]; });
    share = worthwhile_shares(rgb, error_draw, rgb_spread, spread_half(a), spread_half(b), light, kinds_);
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
