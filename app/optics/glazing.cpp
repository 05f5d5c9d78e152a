// SPDX-License-Identifier: Apache-2.0
#include "optics/glazing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace nephroid::optics {
namespace {

using Complex = std::complex<double>;

enum class Polarisation { across, in_plane };

/// Two layers one behind the other, with all that goes to and fro between both.
GlazingParts behind(const GlazingParts& a, const GlazingParts& b) {
  const double all = 1 - a.back * b.front;
  if (!(all > 0)) return {0, a.front, b.back};
  return {a.passes * b.passes / all, a.front + a.passes * a.passes * b.front / all,
          b.back + b.passes * b.passes * a.back / all};
}

/// An index of refraction, n - i k in what follows, and the cosine in it.
struct Medium {
  Complex n, cosine;
};

Medium medium(Complex n, double sine_in_air) {
  const Complex sine = sine_in_air / n;
  return {n, std::sqrt(1.0 - sine * sine)};
}

/// The ratio of the magnetic to the electric field along the face.
Complex admittance(const Medium& m, Polarisation p) {
  return p == Polarisation::across ? m.n * m.cosine : m.n / m.cosine;
}

/// What a face with films reflects: the fields at its front, (B, C), are the films' matrices times (1, its back's
/// admittance). passes: what goes on is of the size of the admittance's real part.
struct Face {
  double reflects, passes;
};
Face face(const Medium& front, std::span<const Film* const> films, const Medium& back, Polarisation p, double sine,
          std::size_t wavelength, double nm) {
  constexpr double opaque = 20; // exp(-2 x 20) of the light comes through the film
  double passes = 1;
  Complex b = 1, c = admittance(back, p);
  for (auto film = films.rbegin(); film != films.rend(); ++film) {
    const Medium layer = medium({(*film)->n[wavelength], -(*film)->k[wavelength]}, sine);
    const Complex phase = 2 * std::numbers::pi * layer.n * (*film)->thickness_nm / nm * layer.cosine,
                  y = admittance(layer, p);
    if (std::abs(phase.imag()) > opaque) {
      b = 1, c = y, passes = 0;
      continue;
    }
    const Complex cos = std::cos(phase), sin = Complex(0, 1) * std::sin(phase);
    const Complex b_before = b;
    b = cos * b + sin / y * c;
    c = sin * y * b_before + cos * c;
  }
  const Complex y = admittance(front, p);
  return {std::norm((y * b - c) / (y * b + c)),
          passes * 4 * y.real() * admittance(back, p).real() / std::norm(y * b + c)};
}

GlazingParts parts_of(const GlassPane& pane, double cosine, Polarisation p, std::size_t wavelength, double nm) {
  if (!(cosine > 0)) return {0, 1, 1};
  const double sine = std::sqrt((1 - cosine) * (1 + cosine));
  const Medium air = medium(1, sine), glass = medium(pane.n[wavelength], sine);
  const auto of_face = [&](const std::vector<Film>& films, bool is_back) {
    std::vector<const Film*> inwards; // from the air into the glass
    for (const Film& film : films) inwards.push_back(&film);
    if (is_back) std::ranges::reverse(inwards);
    const Face in = face(air, inwards, glass, p, sine, wavelength, nm);
    std::ranges::reverse(inwards);
    const GlazingParts parts{in.passes, in.reflects, face(glass, inwards, air, p, sine, wavelength, nm).reflects};
    return is_back ? GlazingParts{parts.passes, parts.back, parts.front} : parts;
  };
  const double passes = std::pow(pane.passes[wavelength], 1 / glass.cosine.real());
  return behind(behind(of_face(pane.front, false), {passes, 0, 0}), of_face(pane.back, true));
}

/// An uncoated pane of a transmittance t and reflectance r has the faces' reflectance f and leaves the part p inside:
/// t = (1 - f)^2 p / (1 - f^2 p^2) and r = f (1 + p t). The second gives p, and the first then a quadratic equation for
/// f.
GlassPane uncoated(double t, double r) {
  const double b = t * t - r * r + 2 * r + 1, a = 2 * (2 - r);
  const double f = std::clamp((b - std::sqrt(std::max(b * b - 2 * a * r, 0.0))) / a, 0.0, 0.9);
  GlassPane pane;
  pane.n.fill((1 + std::sqrt(f)) / (1 - std::sqrt(f)));
  pane.passes.fill(f * t > 1e-12 ? std::clamp((r - f) / (f * t), 0.0, 1.0) : std::min(t, 1.0));
  return pane;
}

/// Of LBNL's regressions: sums of four powers of the cosine.
double polynomial(const std::array<double, 5>& a, double x) {
  return a[0] + x * (a[1] + x * (a[2] + x * (a[3] + x * a[4])));
}

GlazingParts coated(double t, double front, double back, double cosine) {
  static constexpr std::array<double, 5> clear_t{-0.0015, 3.355, -3.840, 1.460, 0.0288},
      clear_sum{0.999, -0.563, 2.043, -2.532, 1.054}, bronze_t{-0.002, 2.813, -2.341, -0.05725, 0.599},
      bronze_sum{0.997, -1.868, 6.513, -7.862, 3.225};
  const auto& of_t = t > 0.645 ? clear_t : bronze_t;
  const auto& of_sum = t > 0.645 ? clear_sum : bronze_sum; // of the transmittance and the reflectance
  const auto rise = [&](double c) { return polynomial(of_sum, c) - polynomial(of_t, c); };
  const double fall = std::clamp(polynomial(of_t, cosine) / polynomial(of_t, 1), 0.0, 1.0),
               grows = cosine > 0 ? std::clamp((rise(cosine) - rise(1)) / (1 - rise(1)), 0.0, 1.0) : 1;
  const auto reflected = [&](double straight) { return straight + (1 - straight) * grows; };
  const double r_front = reflected(front), r_back = reflected(back);
  return {std::min(t * fall, 1 - std::max(r_front, r_back)), r_front, r_back};
}

GlazingParts parts_of(const MeasuredPane& pane, double cosine, Polarisation p, std::size_t w, double nm) {
  const double t = pane.transmittance[w], front = pane.front[w], back = pane.back[w];
  return pane.coated ? coated(t, front, back, cosine) : parts_of(uncoated(t, (front + back) / 2), cosine, p, w, nm);
}

} // namespace

GlazingParts glazing_parts(std::span<const Pane> panes, double cosine, std::size_t wavelength, SpectralRange range) {
  GlazingParts mean{0, 0, 0};
  for (const Polarisation p : {Polarisation::across, Polarisation::in_plane}) {
    GlazingParts all;
    for (const Pane& pane : panes)
      all = behind(
          all, std::visit(
                   [&](const auto& kind) { return parts_of(kind, cosine, p, wavelength, cells(range).nm[wavelength]); },
                   pane));
    mean = {mean.passes + all.passes / 2, mean.front + all.front / 2, mean.back + all.back / 2};
  }
  return mean;
}

} // namespace nephroid::optics
