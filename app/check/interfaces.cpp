// SPDX-License-Identifier: Apache-2.0
// kernels/scatter/fresnel.h against optics/fresnel.h in double precision, and nested media (kernels/tracing/media.h).
#include "check/check.h"
#include "check/device_arrays.h"
#include "optics/fresnel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace nephroid::check {
namespace {

using std::numbers::pi;

// A division may be off by 2.5 units in the last place and a square root by 3. So sin_t = n_i / n_t sin_i may be off by
// 6 of 2^-24, or 4e-7, and 1 - sin_t^2 by twice that. Tolerances below are about twice what follows.
constexpr float indices[] = {1, 1.0001f, 1.33f, 1.5f, 1.9f, 2.42f, 4};

std::vector<float4> through(const compute::Context& context, const char* kernel, const std::vector<float4>& in,
                            std::size_t outputs_each) {
  const compute::Buffer<float4> out(context, "out", in.size() * outputs_each);
  run_kernel(context, kernel, in.size(), {{"in", compute::Buffer(context, "in", in)}, {"out", out}});
  return out.read();
}

/// Every pair of indices at angles from 0 to 89.9999 degrees.
std::vector<float4> interfaces() {
  std::vector<float4> in;
  for (const float near : indices)
    for (const float far : indices) {
      for (int k = 0; k < 900; ++k) in.push_back({static_cast<float>(std::cos(k * pi / 1800)), near, far, 0});
      for (const float grazing : {1e-3f, 1e-4f, 2e-6f}) in.push_back({grazing, near, far, 0});
    }
  return in;
}

/// R changes with cos_t by the order of n_i / n_t + n_t / n_i, and cos_t has the error of its square over 2 cos_t.
/// Errors are in units of that. critical_angle checks what is closer to the critical angle than cos_t = 0.01.
Result reflectance(const compute::Context& context, std::uint64_t) {
  const std::vector<float4> in = interfaces(), out = through(context, "interfaces", in, 1);
  double worst = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const double cos_i = in[i].x, n_i = in[i].y, n_t = in[i].z;
    const auto cos_t = optics::refracted_cosine(cos_i, n_i, n_t);
    if (!cos_t || *cos_t < 0.01) continue;
    const double condition = (n_i / n_t + n_t / n_i) / *cos_t;
    worst = worse(worst, std::abs(out[i].y - optics::fresnel_reflectance(cos_i, n_i, n_t)) / condition);
  }
  return judged(worst, 4e-6, "",
                fmt::format("Fresnel's R at {} interfaces, n from 1 to 4, 0 to 89.9999 degrees, over its condition, "
                            "against double precision",
                            in.size()));
}

/// Metals from n + i k = 0.05 + 2 i to 4 + 8 i, and glass. The square root of what is far smaller than its terms costs
/// digits where k is small.
Result metal_reflectance(const compute::Context& context, std::uint64_t) {
  std::vector<float4> in;
  for (const float n : {0.05f, 0.3f, 1.0f, 1.5f, 4.0f})
    for (const float k : {0.0f, 0.5f, 2.0f, 8.0f})
      for (int angle = 0; angle < 900; ++angle) {
        const float cosine = static_cast<float>(std::cos(angle * pi / 1800));
        if (k > 0 || n * n > 1 - cosine * cosine) in.push_back({cosine, n, k, 0}); // no total reflection
      }
  const std::vector<float4> out = through(context, "conductors", in, 1);
  double worst = 0;
  for (std::size_t i = 0; i < in.size(); ++i)
    worst = worse(worst, out[i].x - optics::conductor_reflectance(in[i].x, 1, {in[i].y, in[i].z}));
  return judged(worst, 2e-5, "", fmt::format("R of {} metals and angles, against complex arithmetic", in.size()));
}

/// Errors are over the condition of Fresnel's R, and over the layer's thickness, by which its phase rounds.
Result coated_interfaces(const compute::Context& context, std::uint64_t) {
  std::vector<float4> in;
  for (const float near : indices)
    for (const float far : indices)
      for (const float layer : {1.0f, 1.38f, 2.35f})
        for (const float thickness : {0.0f, 0.18f, 0.25f, 3.7f})
          for (int k = 0; k < 90; ++k) {
            in.push_back({static_cast<float>(std::cos(k * pi / 180)), near, far, layer});
            in.push_back({thickness, 0, 0, 0});
          }
  // Two items go in for each that comes out.
  const compute::Buffer<float4> result(context, "out", in.size() / 2);
  run_kernel(context, "coatings", in.size() / 2, {{"in", compute::Buffer(context, "in", in)}, {"out", result}});
  const std::vector<float4> out = result.read();
  double worst = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double cos_i = in[2 * i].x, n_i = in[2 * i].y, n_t = in[2 * i].z, layer = in[2 * i].w,
                 thickness = in[2 * i + 1].x, sine = n_i * std::sqrt(1 - cos_i * cos_i) / layer;
    const auto cos_t = optics::refracted_cosine(cos_i, n_i, n_t);
    const double cos_layer = std::sqrt(std::abs(1 - sine * sine));
    if (!cos_t || *cos_t < 0.01 || cos_layer < 0.01) continue; // critical angles
    const double condition =
        (n_i / n_t + n_t / n_i + n_i / layer + layer / n_i) / std::min(*cos_t, cos_layer) * (1 + 10 * thickness);
    worst = worse(worst, (out[i].x - optics::coated_reflectance(cos_i, n_i, layer, n_t, thickness)) / condition);
  }
  return judged(
      worst, 4e-6, "",
      fmt::format("R of {} interfaces with a layer, over its condition, against complex arithmetic", out.size()));
}

/// Checks n_i sin(theta_i) = n_t sin(theta_t) and unit length. The reflected direction has the opposite normal part.
Result refraction(const compute::Context& context, std::uint64_t) {
  std::vector<float4> in;
  for (const float near : indices)
    for (const float far : indices)
      for (int k = 0; k < 500; ++k) {
        const double theta = pi / 2 * k / 500, phi = k;
        in.push_back({static_cast<float>(std::sin(theta) * std::cos(phi)),
                      static_cast<float>(std::sin(theta) * std::sin(phi)), static_cast<float>(-std::cos(theta)),
                      near / far});
      }
  const std::vector<float4> out = through(context, "directions", in, 2);
  double worst = 0;
  const auto compare = [&worst](double error) { worst = worse(worst, std::abs(error)); };
  for (std::size_t i = 0; i < in.size(); ++i) {
    const float4 &d = in[i], &r = out[2 * i], &t = out[2 * i + 1];
    compare(double(r.x) - d.x), compare(double(r.y) - d.y), compare(double(r.z) + d.z);
    if (t.w < 0) continue;
    // The longer of the two tangential parts is at most 1, so this is an absolute error of a unit vector.
    compare((double(t.x) - double(d.w) * d.x) / std::max(1.0f, d.w));
    compare((double(t.y) - double(d.w) * d.y) / std::max(1.0f, d.w));
    compare(double(t.x) * t.x + double(t.y) * t.y + double(t.z) * t.z - 1);
    if (t.z > 0) worst = 2;
  }
  return judged(worst, 2e-6, "",
                fmt::format("components of {} reflected and refracted directions, n from 1 to 4, against Snell's law",
                            in.size()));
}

/// Neighbouring floats as cosines. The figure is how far from the critical angle the kernel decides otherwise.
Result critical_angle(const compute::Context& context, std::uint64_t) {
  std::vector<float4> in;
  for (const float n : {1.1f, 1.33f, 1.5f, 2.42f, 4.0f}) {
    float cosine = static_cast<float>(std::cos(std::asin(1 / double(n))));
    for (int k = 0; k < 50; ++k) cosine = std::nextafter(cosine, 0.0f);
    for (int k = 0; k < 100; ++k, cosine = std::nextafter(cosine, 1.0f)) in.push_back({cosine, n, 1, 0});
  }
  const std::vector<float4> out = through(context, "interfaces", in, 1);
  double worst = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const double beyond = std::acos(double(in[i].x)) - std::asin(1 / double(in[i].y));
    if ((out[i].x < 0) != (beyond > 0)) worst = std::max(worst, std::abs(beyond));
  }
  return judged(worst, 2e-6, "radians",
                fmt::format("total reflection of {} cosines, float after float, about five critical angles: the "
                            "farthest one decided wrongly",
                            in.size()));
}

/// At tan(theta) = n, p-polarised light is not reflected; of the other, ((n^2 - 1) / (n^2 + 1))^2 is.
Result brewster(const compute::Context& context, std::uint64_t) {
  std::vector<float4> in;
  for (int k = 1; k <= 300; ++k)
    in.push_back({static_cast<float>(1 / std::hypot(1, 1 + 0.01 * k)), 1, static_cast<float>(1 + 0.01 * k), 0});
  const std::vector<float4> out = through(context, "interfaces", in, 1);
  double worst = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const double n2 = double(in[i].z) * in[i].z, s = (n2 - 1) / (n2 + 1);
    worst = worse(worst, std::abs(out[i].y - s * s / 2));
  }
  return judged(
      worst, 2e-6, "",
      fmt::format("R at Brewster's angle of {} glasses, n from 1.01 to 4, against ((n^2 - 1) / (n^2 + 1))^2 / 2",
                  in.size()));
}

/// The object whose medium counts: of those entered and not left, that of highest priority; of equals, the last.
int medium(const std::vector<int>& entered, const std::vector<shared::DeviceObject>& objects) {
  int best = -1;
  for (const int object : entered)
    if (best < 0 ||
        objects[static_cast<std::size_t>(object)].priority >= objects[static_cast<std::size_t>(best)].priority)
      best = object;
  return best;
}

Result nested_media(const compute::Context& context, std::uint64_t seed) {
  constexpr int object_count = 12, steps_each = 64;
  constexpr std::size_t walks = 512;
  std::mt19937_64 random(seed);
  std::vector<shared::DeviceObject> objects(object_count);
  for (shared::DeviceObject& object : objects) object.priority = static_cast<int>(random() % 3);
  std::vector<int> steps, truth;
  for (std::size_t walk = 0; walk < walks; ++walk) {
    std::vector<int> entered;
    for (int s = 0; s < steps_each; ++s) {
      const int object = static_cast<int>(random() % object_count);
      const bool enters = random() % 2;
      steps.push_back(enters ? object : ~object);
      if (enters && entered.size() == MEDIA_DEPTH) {
        truth.push_back(-2);
        continue;
      }
      const auto last = std::find(entered.rbegin(), entered.rend(), object);
      if (enters)
        entered.push_back(object);
      else if (last != entered.rend())
        entered.erase(std::next(last).base());
      truth.push_back(medium(entered, objects));
    }
  }
  const compute::Buffer<int> out(context, "mediums", steps.size());
  run_kernel(context, "media_walks", walks,
             {{"objects", compute::Buffer(context, "objects", objects)},
              {"steps", compute::Buffer(context, "steps", steps)},
              {"mediums", out},
              {"steps_each", steps_each}});
  const std::vector<int> got = out.read();
  double wrong = 0;
  for (std::size_t i = 0; i < got.size(); ++i) wrong += got[i] != truth[i];
  return judged(
      wrong, 0, "steps",
      fmt::format("of {} random steps into and out of {} nested objects, those after which the medium is another",
                  steps.size(), object_count));
}

} // namespace

Checks interface_checks() {
  return {{"interface: Fresnel's reflectance", reflectance},
          {"interface: a metal's reflectance", metal_reflectance},
          {"interface: a coating's reflectance", coated_interfaces},
          {"interface: Snell's directions", refraction},
          {"interface: critical angle", critical_angle},
          {"interface: Brewster's angle", brewster},
          {"media: nested dielectrics", nested_media}};
}

} // namespace nephroid::check
