// SPDX-License-Identifier: Apache-2.0
#include "scatter/material.h"

#include "preset/choices.h"
#include "scatter/kind.h"
#include "scatter/spectra.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ranges>

namespace nephroid::scatter {

const Kind& kind_of(preset::Material::Type type) {
#define NEPHROID_MATERIAL_KIND(word, NAME, lobes) &kinds::word,
  static constexpr const Kind* all[] = {MATERIALS(NEPHROID_MATERIAL_KIND)};
#undef NEPHROID_MATERIAL_KIND
  return *all[static_cast<std::size_t>(type)];
}

bool disperses(const Material& material) {
  return is_refractive(material.type) && std::ranges::any_of(material.n, [&](double n) { return n != material.n[0]; });
}

bool bends(const Material& material) {
  return is_coated(material) ||
         (is_refractive(material.type) && std::ranges::any_of(material.n, [](double n) { return n != 1; }));
}

bool is_tinted(const Material& material) {
  return is_refractive(material.type) && (is_textured(material) || !loss_at_surface(material).empty());
}

void Loading::warn(const std::string& note) const { warnings.push_back(fmt::format("{}: {}", owner, note)); }

void Loading::curve(const preset::Dispersion& dispersion, const Location& field,
                    const std::function<void(const optics::DispersionCurve&, optics::Extrapolation)>& sample) const {
  const optics::DispersionCurve data = make_curve(dispersion, finder, field);
  const optics::Extrapolation outside = outside_policy(dispersion.outside);
  at(field, [&] { return sample(data, outside), 0; });
  if (const std::string note = optics::outside_note(data, outside, range); !note.empty()) warn(note);
}

void Loading::known_from(const std::string& field, double low_nm, double high_nm) const {
  const optics::Spectrum& nm = optics::cells(range).nm;
  if (low_nm > nm.front() || high_nm < nm.back())
    warn(fmt::format("its {} is known from {:g} to {:g} nm alone; beyond, the values at the ends are taken", field,
                     low_nm, high_nm));
}

optics::Spectrum Loading::spectrum(const preset::Reflectance& reflectance, const char* field) const {
  using Type = preset::Reflectance::Type;
  if (range != optics::SpectralRange::visible && reflectance.type == Type::patch)
    known_from(field, optics::first_nm, optics::last_nm);
  if (range != optics::SpectralRange::visible && reflectance.type == Type::table) {
    const auto [low, high] =
        std::ranges::minmax(reflectance.table, {}, [](const std::array<double, 2>& row) { return row[0]; });
    known_from(field, low[0], high[0]);
  }
  return make_reflectance(reflectance, where / field, range);
}

std::shared_ptr<const Texture> Loading::picture(const std::optional<preset::Texture>& texture, Texels texels,
                                                const char* field) const {
  if (texture && texels == Texels::colours && range != optics::SpectralRange::visible)
    warn(fmt::format("the colours of its {} are known from {} alone; beyond, the values at the ends are taken", field,
                     text_of(optics::SpectralRange::visible)));
  return texture
             ? std::make_shared<const Texture>(make_texture(*texture, texels, finder, where / field, owner, warnings))
             : nullptr;
}

void Loading::roughness(Material& material) const {
  material.alpha = from.roughness * from.roughness;
  if (!from.roughness_texture) return;
  if (!is_rough(material))
    throw bad_input(where / "roughness_texture", "multiplies a roughness of 0", "expected a roughness above 0",
                    "set the roughness to 1 for that of the picture");
  material.roughness_texture = picture(from.roughness_texture, Texels::numbers, "roughness_texture");
}

void Loading::metal(Material& material) const {
  preset::Dispersion metal;
  metal.type = preset::Dispersion::Type::file;
  metal.file = from.metal;
  const Location field = where / "metal";
  curve(metal, field, [&](const optics::DispersionCurve& data, optics::Extrapolation outside) {
    if (!data.k)
      throw bad_input(field, fmt::format("{} has no k", data.name), "expected a metal's n and k",
                      "take gold, silver, copper, aluminium, brass, or a file of refractiveindex.info");
    material.n = optics::sample_n(data, outside, range);
    material.k = optics::sample_k(data, outside, range);
  });
  if (const double most = std::ranges::max(material.k); most < 0.01)
    warn(fmt::format("its k is at most {:.2g}, which is no metal's: a conductor absorbs what a "
                     "dielectric lets through",
                     most));
}

void Loading::coat_index(Material& material) const {
  const Location field = where / "dispersion";
  curve(from.dispersion, field, [&](const optics::DispersionCurve& data, optics::Extrapolation outside) {
    material.coat_n = data.sample(588, outside).n.value_or(0);
  });
  if (!(material.coat_n >= 1 && material.coat_n <= 4))
    throw bad_input(field, fmt::format("is {:.3g} at 588 nm", material.coat_n), "expected 1 to 4 for a coat",
                    "varnish and plastic have about 1.5");
}

Material make_material(const std::string& name, const preset::Material& material, const FileFinder& finder,
                       const Location& where, std::vector<std::string>& warnings, optics::SpectralRange range) {
  Material made;
  made.name = name;
  made.type = material.type;
  made.range = range;
  kind_of(material.type).load({material, finder, where, range, fmt::format("material '{}'", name), warnings}, made);
  return made;
}

GltfSurface gltf_surface(const Material& material) { return kind_of(material.type).gltf(material); }

GltfSurface gltf_metal(const Material& material) {
  return {.base_colour = material.reflectance, .metallic = 1, .roughness = std::sqrt(material.alpha)};
}

void describe_reflectance(preset::Fields& v, preset::Material& m) {
  v.field("reflectance", "Part of the light that is reflected: a number, a ColorChecker patch or an object.",
          m.reflectance);
}

void describe_texture(preset::Fields& v, preset::Material& m) {
  v.field("texture", "What the reflectance is multiplied by: a picture file or an object.", m.texture);
}

void describe_metal(preset::Fields& v, preset::Material& m) {
  v.field("metal", "gold, silver, copper, aluminium, brass, or a YAML file of refractiveindex.info with n and k.",
          m.metal, {.text = preset::Text::file, .names = preset::Names::metal});
}

void describe_coat_index(preset::Fields& v, preset::Material& m) {
  v.field("dispersion", "The coat's index of refraction, in air at 588 nm: a number, a file or an object.",
          m.dispersion);
}

void describe_tint(preset::Fields& v, preset::Material& m) {
  v.field("tint",
          "Part of the light that passes a surface or varnish, each time: a number, a ColorChecker patch or an object.",
          m.tint);
}

void describe_roughness(preset::Fields& v, preset::Material& m) {
  v.field("roughness", "0 is polished; GGX with alpha = roughness^2.", m.roughness, {.bounds = preset::within(0, 1)});
}

void describe_roughness_texture(preset::Fields& v, preset::Material& m) {
  v.field("roughness_texture",
          "What the roughness is multiplied by: green of a picture file or an object. Integers are plain numbers.",
          m.roughness_texture);
}

} // namespace nephroid::scatter

namespace nephroid::preset {

std::string_view sentence_of(Material::Type type) { return scatter::kind_of(type).sentence; }

void describe(Fields& v, Material& m) {
  v.about("Material", "What a surface does with light.");
  v.type("type", "What kind of surface.", m.type);
  scatter::kind_of(m.type).describe(v, m);
}

} // namespace nephroid::preset
