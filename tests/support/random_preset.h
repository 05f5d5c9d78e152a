// SPDX-License-Identifier: Apache-2.0
// Random presets: every field that means something gets a random legal value, by the descriptions.
#pragma once
#include "photons/describe_settings.h"
#include "preset/describe.h"
#include "preset/meters.h"
#include "spectral/settings.h"
#include "tests/support/test.h"

namespace nephroid::test {

class Randomizer {
public:
  explicit Randomizer(std::uint64_t seed) : random_(seed) {}

  void fill_object(const preset::Value& object) {
    std::vector<preset::Member> members = object.members();
    for (std::size_t i = 0; i < members.size(); ++i) {
      const preset::Member member = members[i];
      if (member.role == preset::Role::engine || !member.value.exists()) continue; // the first engine
      if (member.role == preset::Role::recipe && member.field.name != "spectral") continue;
      fill(member.field, member.value);
      if (member.role == preset::Role::type) members = object.members();
    }
  }

private:
  /// Spread over the whole range with all bits of the mantissa in use, sometimes at an end.
  double number(const preset::Bounds& bounds) {
    const double low = std::max(bounds.low, -1e12), high = std::min(bounds.high, 1e12);
    if (random_() % 8 == 0 && !bounds.without_low) return low;
    if (random_() % 8 == 0 && !bounds.without_high) return high;
    const double x = std::uniform_real_distribution<double>(low, high)(random_);
    const double small = std::ldexp(x, -static_cast<int>(random_() % 60));
    return bounds.contain(small) ? small : bounds.contain(x) ? x : 0.5 * (low + high);
  }

  std::string text() {
    static const char* parts[] = {"glass", "\"", "\\", "/", "~", " ", "ü", "光", "1.5", "."};
    std::string value;
    for (std::size_t i = 0; i < 1 + random_() % 5; ++i) value += parts[random_() % std::size(parts)];
    return value;
  }

  void fill(const preset::Field& f, const preset::Value& value) {
    using preset::Kind;
    switch (value.kind()) {
    case Kind::boolean: value.as<bool>() = random_() % 2; break;
    case Kind::integer:
      if (value.is<int>())
        value.as<int>() = std::uniform_int_distribution<int>(static_cast<int>(f.bounds.low),
                                                             static_cast<int>(f.bounds.high))(random_);
      else
        value.as<std::uint64_t>() = random_();
      break;
    case Kind::number: value.as<double>() = number(f.bounds); break;
    case Kind::text: value.as<std::string>() = text(); break;
    case Kind::word: value.choose(random_() % value.type().words.size()); break;
    case Kind::object: fill_object(value); break;
    case Kind::map:
      value.resize(0);
      for (std::size_t i = 0; i < 2 + random_() % 3; ++i) fill_object(value.add(text()));
      break;
    default:
      value.resize(value.kind() == Kind::optional ? random_() % 2 : f.count.low + random_() % 3);
      for (std::size_t i = 0; i < value.count(); ++i)
        if (value.kind() == Kind::table)
          for (std::size_t k = 0; k < 2; ++k) value[i][k].as<double>() = number(f.columns[k].bounds);
        else
          fill(f, value[i]);
    }
  }

  std::mt19937_64 random_;
};

/// What several fields must agree on is put right, the rest is random.
inline preset::Preset random_preset(std::uint64_t seed) {
  using namespace preset;
  Preset p;
  Randomizer randomizer(seed);
  randomizer.fill_object(Value(p));
  p.source = "random.json";
  for (auto& [name, m] : p.scene.materials) {
    Coating none, &coating = m.coating ? *m.coating : none;
    for (Dispersion* d : {&m.dispersion, &coating.dispersion}) d->c_um2.resize(d->b.size(), 0.01);
    const auto rise = [](auto& table) {
      for (std::size_t i = 0; i < table.size(); ++i) table[i][0] = 400.0 + static_cast<double>(i) / 3;
    };
    for (auto* table : {&m.dispersion.table, &coating.dispersion.table, &m.reflectance.table, &m.tint.table})
      rise(*table);
    for (Pane& pane : m.panes) {
      pane.dispersion.c_um2.resize(pane.dispersion.b.size(), 0.01);
      rise(pane.dispersion.table);
      for (Reflectance* r : {&pane.tint, &pane.transmittance, &pane.front_reflectance, &pane.back_reflectance})
        rise(r->table);
      for (auto* films : {&pane.front_films, &pane.back_films})
        for (Coating& film : *films) {
          film.dispersion.c_um2.resize(film.dispersion.b.size(), 0.01);
          rise(film.dispersion.table);
        }
    }
  }
  for (Object& o : p.scene.objects) {
    o.material = p.scene.materials.begin()->first;
    if (o.mesh.has_value() == o.shape.has_value()) o.mesh = "a.obj", o.shape.reset();
    if (o.shape) o.states.clear();
    if (o.shape) o.shape->gap = 0;
    for (double& s : o.transform.scale) s = std::abs(s) < 1e-6 ? 1 : s;
  }
  Camera& camera = p.scene.camera;
  if (camera.projection == Camera::Projection::perspective) camera.height.reset();
  if (camera.aperture > 0) camera.focus_distance = std::max(camera.aperture, 1e-6);
  for (Light& l : p.scene.lights) {
    for (std::size_t i = 0; i < l.spectrum.table.size(); ++i)
      l.spectrum.table[i] = {500.0 + static_cast<double>(i), 0.1};
    if (l.type == Light::Type::area || l.photometry) l.direction = {0.1, -1, 1.0 / 3}, l.up = {0, 0.2, 1};
    if (is_directed(l)) l.direction[1] += l.direction == Vec3{0, 0, 0} ? 1 : 0;
    if (l.type != Light::Type::mesh) continue;
    if (p.scene.objects.empty()) p.scene.objects.emplace_back().shape.emplace();
    Object& shining = p.scene.objects.front();
    if (shining.name.empty()) shining.name = "it shines";
    shining.material = p.scene.materials.begin()->first;
    l.object = shining.name;
  }
  for (std::size_t i = 0; i < p.scene.meters.size(); ++i) {
    Meter& meter = p.scene.meters[i];
    meter.name = fmt::format("meter {}", i);
    if (meter.type == Meter::Type::goniometer) {
      meter.direction = {0.1, -1, 1.0 / 3}, meter.up = Vec3{0, 0.2, 1};
      meter.unit = Meter::Unit::watts_per_steradian;
    } else if (preset::is_intensity(meter.unit))
      meter.unit = Meter::Unit::suns;
    if (meter.type != Meter::Type::surface && meter.type != Meter::Type::goniometer) meter.normal = {0.1, -1, 1.0 / 3};
    if (meter.type == Meter::Type::plane) meter.up = Vec3{0, 0.2, 1};
    if (meter.facing) meter.facing = {0.1, 1.0 / 3, 1};
    if (meter.within) meter.within = Box{{-1, -2, -3}, {1, 1.0 / 3, 1}};
    if (meter.threshold) meter.threshold = meter.type == Meter::Type::goniometer ? "20 cd" : "2500 W/m^2";
    if (meter.type != Meter::Type::surface) continue;
    if (p.scene.objects.empty()) {
      p.scene.objects.emplace_back().shape.emplace();
      p.scene.objects.back().material = p.scene.materials.begin()->first;
    }
    if (p.scene.objects.front().name.empty()) p.scene.objects.front().name = "it is measured";
    meter.object = p.scene.objects.front().name;
  }
  if (p.scene.lights.empty()) p.display.white_balance = Display::WhiteBalance::d65;
  if (auto& e = p.scene.environment; e && e->place) {
    e->place->date = "2026-06-21", e->sun_direction.reset();
    if (e->place->time_zone) e->place->time_zone = "Asia/Kolkata", e->place->utc_offset_h.reset();
  }
  if (auto& e = p.scene.environment; e && !e->place && e->type == preset::Environment::Type::sky)
    e->sun_direction = {0.1, 1, 1.0 / 3};
  const auto agree = [](Settings& settings) {
    auto& s = settings.as<photons::Settings>();
    if (s.effort == photons::Settings::Effort::random) s.estimator = photons::Settings::Estimator::sppm;
    if (s.effort == photons::Settings::Effort::variance) s.estimator = photons::Settings::Estimator::automatic;
    if (s.estimator == photons::Settings::Estimator::tiles) s.jitter = s.low_discrepancy = true;
  };
  agree(p.settings);
  if (p.reference && p.reference->settings) agree(*p.reference->settings);
  if (photons::Settings& s = spectral::settings(p); s.relight) { // what layers cannot keep
    s.estimator = photons::Settings::Estimator::splat;
    s.effort = photons::Settings::Effort::power;
    s.indirect = false;
    if (p.scene.environment) p.scene.environment->lights = false;
  }
  const bool estimates = p.measure.estimate && spectral::settings(p).estimator != photons::Settings::Estimator::sppm;
  if (!estimates && !p.reference) p.stop.error.reset(); // nothing would measure it
  if (p.reference && p.reference->type == Reference::Type::file) {
    p.animation.reset();              // a picture is of one frame
    if (!p.white) p.white.emplace(1); // and has a white of its own
  }
  if (p.animation) { // fields are those of frame 0
    p.animation->tracks.clear();
    p.animation->tracks.push_back(
        {"scene.camera.fov_deg", Track::Interpolation::smooth, {{3, {p.scene.camera.fov_deg}}, {7, {50.0 / 3}}}});
  }
  p.scene.camera.target = {0, 0.1, 1.0 / 3};
  p.scene.camera.position = {3, 2, 1e-5};
  p.scene.camera.up = {0, 1, 0};
  return p;
}

} // namespace nephroid::test
