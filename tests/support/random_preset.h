// SPDX-License-Identifier: Apache-2.0
// Random presets: every field that means something gets a random legal value, by a visitor over the descriptions.
#pragma once
#include "preset/describe.h"
#include "preset/settings_type.h"
#include "spectral/describe_settings.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace nephroid::test {

class Randomizer {
public:
  explicit Randomizer(std::uint64_t seed) : random_(seed) {}

  template <class E>
  void type(const preset::Field&, E& value)
  {
    choose(value);
  }
  template <class T>
  void field(const preset::Field& f, T& value)
  {
    fill(f, value);
  }
  void engine(const preset::Field&, preset::Settings&) {} // the first
  void settings(preset::Settings& settings) { describe(*this, settings.as<spectral::Settings>()); }
  void settings(std::optional<preset::Settings>& recipe)
  {
    recipe.reset();
    if (random_() % 2) settings(recipe.emplace());
  }

private:
  template <class T>
  using Rows = std::vector<std::array<T, 2>>;

  template <class E>
  void choose(E& value)
  {
    const auto& all = preset::Choices<E>::all;
    value = all[random_() % std::size(all)].value;
  }

  /// Spread over the whole range with all bits of the mantissa in use, sometimes at an end.
  double number(const preset::Bounds& bounds)
  {
    const double low = std::max(bounds.low, -1e12), high = std::min(bounds.high, 1e12);
    if (random_() % 8 == 0 && !bounds.without_low) return low;
    if (random_() % 8 == 0 && !bounds.without_high) return high;
    const double x = std::uniform_real_distribution<double>(low, high)(random_);
    const double small = std::ldexp(x, -static_cast<int>(random_() % 60));
    return bounds.contain(small) ? small : bounds.contain(x) ? x : 0.5 * (low + high);
  }

  void fill(const preset::Field& f, double& value) { value = number(f.bounds); }
  void fill(const preset::Field&, bool& value) { value = random_() % 2; }
  void fill(const preset::Field&, std::uint64_t& value) { value = random_(); }
  void fill(const preset::Field& f, int& value)
  {
    value = std::uniform_int_distribution<int>(static_cast<int>(f.bounds.low), static_cast<int>(f.bounds.high))(random_);
  }
  template <preset::Enumeration E>
  void fill(const preset::Field&, E& value)
  {
    choose(value);
  }
  void fill(const preset::Field&, std::string& value)
  {
    static const char* parts[] = {"glass", "\"", "\\", "/", "~", " ", "ü", "光", "1.5", "."};
    value.clear();
    for (std::size_t i = 0; i < 1 + random_() % 5; ++i) value += parts[random_() % std::size(parts)];
  }
  template <class T, std::size_t N>
  void fill(const preset::Field& f, std::array<T, N>& value)
  {
    for (T& x : value) fill(f, x);
  }
  std::size_t count(const preset::Count& c) { return c.low + random_() % 3; }
  void fill(const preset::Field& f, std::vector<double>& value)
  {
    value.resize(count(f.count));
    for (double& x : value) x = number(f.bounds);
  }
  void fill(const preset::Field& f, Rows<double>& value)
  {
    value.resize(count(f.count));
    for (auto& row : value) row = {number(f.columns.first.bounds), number(f.columns.second.bounds)};
  }
  template <preset::Described S>
  void fill(const preset::Field&, S& s)
  {
    describe(*this, s);
  }
  template <preset::Described S>
  void fill(const preset::Field& f, std::vector<S>& list)
  {
    list.resize(count(f.count));
    for (S& s : list) describe(*this, s);
  }
  template <preset::Described S>
  void fill(const preset::Field& f, std::map<std::string, S>& map)
  {
    map.clear();
    for (std::size_t i = 0; i < 2 + random_() % 3; ++i) {
      std::string name;
      fill(f, name);
      map[name] = S{}; // a name that came before starts anew
      describe(*this, map[name]);
    }
  }
  template <class T>
  void fill(const preset::Field& f, std::optional<T>& value)
  {
    value.reset();
    if (random_() % 2) fill(f, value.emplace());
  }

  std::mt19937_64 random_;
};

/// What several fields must agree on is put right, the rest is random.
inline preset::Preset random_preset(std::uint64_t seed)
{
  using namespace preset;
  Preset p;
  Randomizer randomizer(seed);
  describe(randomizer, p);
  p.source = "random.json";
  for (auto& [name, m] : p.scene.materials) {
    Dispersion& d = m.dispersion;
    d.c_um2.resize(d.b.size(), 0.01);
    for (auto* table : {&d.table, &m.reflectance.table})
      for (std::size_t i = 0; i < table->size(); ++i) (*table)[i][0] = 400.0 + static_cast<double>(i) / 3;
  }
  for (Object& o : p.scene.objects) {
    o.material = p.scene.materials.begin()->first;
    if (o.mesh.has_value() == o.shape.has_value()) o.mesh = "a.obj", o.shape.reset();
    for (double& s : o.transform.scale) s = std::abs(s) < 1e-6 ? 1 : s;
  }
  for (Light& l : p.scene.lights) {
    for (std::size_t i = 0; i < l.spectrum.table.size(); ++i) l.spectrum.table[i] = {500.0 + static_cast<double>(i), 0.1};
    if (l.type == Light::Type::area) l.direction = {0.1, -1, 1.0 / 3}, l.up = {0, 0.2, 1};
    if (l.type != Light::Type::point) l.direction[1] += l.direction == Vec3{0, 0, 0} ? 1 : 0;
  }
  const auto agree = [](Settings& settings) {
    auto& s = settings.as<spectral::Settings>();
    if (s.effort == spectral::Settings::Effort::random) s.estimator = spectral::Settings::Estimator::sppm;
    if (s.effort == spectral::Settings::Effort::variance) s.estimator = spectral::Settings::Estimator::automatic;
  };
  agree(p.settings);
  if (p.reference && p.reference->settings) agree(*p.reference->settings);
  if (spectral::Settings& s = spectral::settings(p); s.relight) { // what layers cannot keep
    s.estimator = spectral::Settings::Estimator::splat;
    s.effort = spectral::Settings::Effort::power;
    s.differentials = s.indirect = false;
    if (p.scene.environment) p.scene.environment->lights = false;
  }
  const bool estimates = p.measure.estimate && spectral::settings(p).estimator != spectral::Settings::Estimator::sppm;
  if (!estimates && !p.reference) p.stop.error.reset();                               // nothing would measure it
  if (p.reference && p.reference->type == Reference::Type::file) p.animation.reset(); // a picture is of one frame
  if (p.animation) {                                                                  // fields are those of frame 0
    p.animation->tracks.clear();
    p.animation->tracks.push_back({"scene.camera.fov_deg", Track::Interpolation::smooth, {{3, {p.scene.camera.fov_deg}}, {7, {50.0 / 3}}}});
  }
  p.scene.camera.target = {0, 0.1, 1.0 / 3};
  p.scene.camera.position = {3, 2, 1e-5};
  p.scene.camera.up = {0, 1, 0};
  return p;
}

} // namespace nephroid::test
