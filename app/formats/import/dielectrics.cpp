// SPDX-License-Identifier: Apache-2.0
#include "formats/import/dielectrics.h"

#include "base/files.h"
#include "optics/dispersion_file.h"
#include "optics/fresnel.h"
#include "scatter/spectra.h"
#include "scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::formats {
namespace {

constexpr std::size_t most_pairs = 1u << 26; ///< of dielectrics that are looked at for nesting

bool is_air(double n) { return alike(n, 1); }

optics::DispersionCurve curve_of(const preset::Dispersion& dispersion) {
  return scatter::make_curve(dispersion, FileFinder(), "dispersion");
}

/// factor times n, or over it.
preset::Dispersion changed(const preset::Dispersion& dispersion, double factor, bool inverted) {
  if (factor == 1 && !inverted) return dispersion;
  const auto change = [&](double n) { return inverted ? factor / n : factor * n; };
  preset::Dispersion result;
  if (dispersion.type == preset::Dispersion::Type::constant) {
    result.n = change(dispersion.n);
    return result;
  }
  result.type = preset::Dispersion::Type::table;
  const optics::DispersionCurve curve = curve_of(dispersion);
  for (int nm = optics::first_nm; nm <= optics::last_nm; nm += 10)
    result.table.push_back({static_cast<double>(nm), change(curve.sample(nm).n.value_or(1))});
  return result;
}

/// A dielectric where it stands.
class Body {
public:
  Body(Description& d, DescribedShape& from) : shape(from), glass(d.dielectrics.at(from.material)) {
    to_world_ = shape.to_world;
    if (shape.mesh.empty())
      to_world_ *= glm::dmat4(glm::dmat3(shape.radius));
    else
      mesh_ = &d.meshes.at(shape.mesh);
    inside = middle_index(glass.inside);
    outside = glass.outside;
    if (shape.inside_out) std::swap(inside, outside);
  }

  void find_bounds() {
    const std::vector<glm::vec3> corners = mesh_ ? mesh_->positions : cube().positions;
    bounds = {glm::dvec3(1e300), glm::dvec3(-1e300)};
    for (const glm::vec3& p : corners) {
      const glm::dvec3 q = to_world_ * glm::dvec4(glm::dvec3(p), 1);
      bounds.low = glm::min(bounds.low, q);
      bounds.high = glm::max(bounds.high, q);
    }
    const glm::dvec3 size = bounds.high - bounds.low;
    volume = size.x * size.y * size.z;
  }

  bool meets(const Body& other) const {
    return glm::all(glm::lessThanEqual(bounds.low, other.bounds.high)) &&
           glm::all(glm::lessThanEqual(other.bounds.low, bounds.high));
  }
  /// Most of the other's surface is in it.
  bool encloses(const Body& other) const {
    if (!meets(other) || volume < other.volume) return false;
    const std::vector<glm::vec3>& points = other.mesh_ ? other.mesh_->positions : cube().positions;
    constexpr std::size_t samples = 12;
    const glm::dmat4 to_here = glm::inverse(to_world_) * other.to_world_;
    const double shrink = other.mesh_ ? 1 : 1 / std::numbers::sqrt3; // a cube's corners on the unit sphere
    std::size_t within = 0, seen = 0;
    for (std::size_t i = 0; i < points.size(); i += points.size() / samples + 1, ++seen) {
      const glm::dvec3 p = to_here * glm::dvec4(shrink * glm::dvec3(points[i]), 1);
      within += mesh_ ? std::abs(winding_of(p)) > 0.5 : glm::length(p) < 1;
    }
    return 4 * within > 3 * seen;
  }

  DescribedShape& shape;
  const DescribedGlass& glass;
  scene::Bounds bounds; ///< by find_bounds(), as the volume
  double volume = 0;
  double inside = 1, outside = 1; ///< as the file has them
  double own = 1;                 ///< as the preset has it

private:
  double winding_of(const glm::dvec3& p) const {
    return scene::winding_number(*mesh_, 0, static_cast<std::uint32_t>(mesh_->triangles.size()), p);
  }

  const scene::Mesh* mesh_ = nullptr;
  glm::dmat4 to_world_;
};

class Settlement {
public:
  explicit Settlement(Description& d) : d_(d) {}

  void settle() {
    for (DescribedShape& shape : d_.shapes) // a pane has no inside
      if (const auto glass = d_.dielectrics.find(shape.material);
          glass != d_.dielectrics.end() && glass->second.is_thin)
        shape.inside_out = false;
    std::vector<Body> bodies;
    for (DescribedShape& shape : d_.shapes)
      if (d_.dielectrics.contains(shape.material) && !shape.glow) bodies.emplace_back(d_, shape);
    const bool few = bodies.size() * bodies.size() <= most_pairs;
    if (!few) d_.note("there are too many dielectrics to see which lies in which: each is as if in air");
    // What is around others is settled before them.
    std::vector<Body*> order;
    for (Body& body : bodies) {
      if (few) body.find_bounds();
      order.push_back(&body);
    }
    std::ranges::stable_sort(order, std::greater(), &Body::volume);
    for (std::size_t i = 0; i < order.size(); ++i) {
      Body* around = nullptr;
      for (std::size_t j = few ? i : 0; j-- > 0 && !around;)
        if (is_around(*order[j], *order[i])) around = order[j];
      settle(*order[i], around);
    }
  }

private:
  /// A liquid touches its glass from within and is not enclosed by the solid; the file's index says so.
  static bool is_around(const Body& outer, const Body& inner) {
    if (outer.glass.is_thin) return false;
    if (outer.encloses(inner)) return true;
    if (!outer.meets(inner)) return false;
    return inner.glass.is_ratio ? inner.inside / inner.outside < 1 && outer.own > 1
                                : !is_air(inner.outside) && alike(outer.inside, inner.outside);
  }

  void settle(Body& body, const Body* around) {
    const DescribedGlass& glass = body.glass;
    const double ratio = body.inside / body.outside;
    if (glass.is_ratio) {
      body.own = around ? around->own * ratio : ratio;
      if (around && !is_air(around->own))
        d_.note(body.shape.where,
                fmt::format("its eta is a ratio, and it lies in n = {:.4g}: n = {:.4g} inside", around->own, body.own));
    } else if (is_air(body.outside) || (is_air(body.inside) && around)) {
      body.own = is_air(body.inside) ? 1 : ratio;
      if (around && is_air(body.outside) && !is_air(body.inside))
        d_.note(body.shape.where, fmt::format("the file has it in air, and it lies in n = {:.4g}: its own n = {:.4g} "
                                              "counts",
                                              around->own, body.own));
    } else if (around && alike(around->inside, body.outside)) {
      body.own = body.inside;
      if (!body.glass.is_thin && !around->encloses(body)) reach_into(body.shape);
    } else {
      body.own = ratio;
      d_.note(body.shape.where, fmt::format("in the file it is in n = {:.4g}, which is nowhere in the scene: the ratio "
                                            "{:.4g} is its n, in air",
                                            body.outside, body.own));
    }
    if (around) body.shape.priority = around->shape.priority + 1;
    body.shape.material = material_of(body);
  }

  /// A liquid that just touches its glass.
  void reach_into(DescribedShape& shape) {
    if (shape.mesh.empty()) {
      shape.radius *= 1 + reach;
      return;
    }
    std::string& key = reaching_[shape.mesh];
    if (key.empty()) {
      scene::Mesh mesh = d_.meshes.at(shape.mesh);
      reach_out(mesh);
      key = d_.own_mesh(shape.name, std::move(mesh));
    }
    shape.mesh = key;
  }

  /// The key of the material that this body needs; the same for all that need the same.
  std::string material_of(const Body& body) {
    const std::string& name = body.shape.material;
    const auto [known, is_new] = keys_.try_emplace({name, body.own, body.shape.inside_out});
    if (!is_new) return known->second;
    std::string key = name;
    for (int n = 2; d_.materials.contains(key); ++n) key = fmt::format("{} {}", name, n);
    preset::Material& material = d_.materials[key];
    material.type = preset::Material::Type::dielectric;
    material.dispersion = dispersion_of(body);
    material.thin = body.glass.is_thin;
    material.roughness = body.glass.roughness;
    if (body.glass.tint) material.tint = reflectance_of(*body.glass.tint);
    material.tint_texture = body.glass.tint_texture;
    material.roughness_texture = body.glass.roughness_texture;
    if (const auto& absorption = body.glass.absorption; absorption && !absorption->is_black()) {
      if (body.shape.inside_out)
        d_.note(body.shape.where, "the medium around it is left out");
      else {
        const std::string file = d_.own_file(key, ".yml");
        d_.files[file] = absorbing_glass_file(material.dispersion, values_of(*absorption),
                                              "n as the scene's dielectric, k as its medium has it");
        material.dispersion = {};
        material.dispersion.type = preset::Dispersion::Type::file;
        material.dispersion.file = file;
      }
    }
    return known->second = key;
  }

  static preset::Dispersion dispersion_of(const Body& body) {
    const double n = middle_index(body.glass.inside);
    return body.shape.inside_out ? changed(body.glass.inside, body.own * n, true)
                                 : changed(body.glass.inside, body.own / n, false);
  }

  Description& d_;
  std::map<std::string, std::string> reaching_; ///< by the keys of the meshes that they were
  std::map<std::tuple<std::string, double, bool>, std::string> keys_;
};

} // namespace

double middle_index(const preset::Dispersion& dispersion) {
  return dispersion.type == preset::Dispersion::Type::constant
             ? dispersion.n
             : curve_of(dispersion).sample(optics::line_d_nm).n.value_or(1);
}

void settle_dielectrics(Description& description) {
  join_interfaces(description);
  Settlement(description).settle();
}

std::string absorbing_glass_file(const preset::Dispersion& clear, const optics::Spectrum& absorption,
                                 const std::string& comments) {
  using Type = preset::Dispersion::Type;
  std::string text = fmt::format("COMMENTS: |\n    {}\nDATA:\n", comments);
  if (clear.type == Type::constant || clear.type == Type::cauchy) {
    const std::string n = clear.type == Type::cauchy && clear.coefficients.size() == 2
                              ? fmt::format("{} {} -2", clear.coefficients[0], clear.coefficients[1])
                              : fmt::format("{}", middle_index(clear));
    text += fmt::format("  - type: formula 5\n    wavelength_range: 0.38 0.78\n    coefficients: {}\n", n);
  } else {
    text += "  - type: tabulated n\n    data: |\n";
    const optics::DispersionCurve curve = curve_of(clear);
    for (int nm = optics::first_nm; nm <= optics::last_nm; nm += 10)
      text += fmt::format("        {:.2f} {:.9g}\n", nm * 1e-3, curve.sample(nm).n.value_or(1));
  }
  text += "  - type: tabulated k\n    data: |\n";
  for (int nm = optics::first_nm; nm <= optics::last_nm; nm += 10)
    text +=
        fmt::format("        {:.2f} {:.6g}\n", nm * 1e-3,
                    absorption[static_cast<std::size_t>(nm - optics::first_nm)] * nm * 1e-9 / (4 * std::numbers::pi));
  return text;
}

namespace {

/// Beyond the ends of a file's rows a spectrum is 0; an index goes on as it ends.
optics::Spectrum with_held_ends(optics::Spectrum values) {
  const auto is_given = [](double value) { return value > 0; };
  const auto first = std::ranges::find_if(values, is_given);
  if (first == values.end()) return values;
  std::fill(values.begin(), first, *first);
  const auto last = std::find_if(values.rbegin(), values.rend(), is_given);
  std::fill(values.rbegin(), last, *last);
  return values;
}

} // namespace

std::optional<preset::Material> metal_of(Description& description, const std::string& name,
                                         const optics::Spectrum& file_n, const optics::Spectrum& file_k) {
  const optics::Spectrum n = with_held_ends(file_n), k = with_held_ends(file_k);
  if (*std::ranges::min_element(n) <= 0) return std::nullopt;
  std::string text =
      "COMMENTS: |\n    n and k as the scene's metal has them\nDATA:\n  - type: tabulated nk\n    data: |\n";
  for (int nm = optics::first_nm; nm <= optics::last_nm; nm += 10) {
    const auto w = static_cast<std::size_t>(nm - optics::first_nm);
    text += fmt::format("        {:.2f} {:.9g} {:.9g}\n", nm * 1e-3, n[w], k[w]);
  }
  const std::string file = description.own_file(name, ".yml");
  description.files[file] = text;
  return metal_of(file);
}

preset::Material metal_of(const std::string& file) {
  preset::Material metal;
  metal.type = preset::Material::Type::conductor;
  metal.metal = file;
  return metal;
}

preset::Material mirror_of(Description& description, const preset::Material& conductor, const DescribedColour& factor) {
  const auto own = description.files.find(conductor.metal);
  const optics::DispersionCurve curve = own == description.files.end()
                                            ? scatter::load_dispersion(conductor.metal)
                                            : optics::parse_dispersion(own->second, conductor.metal);
  if (own != description.files.end()) description.files.erase(own);
  const optics::Spectrum n = sample_n(curve, optics::Extrapolation::hold),
                         k = sample_k(curve, optics::Extrapolation::hold);
  DescribedColour colour;
  colour.spectrum = values_of(factor);
  for (std::size_t w = 0; w < n.size(); ++w) (*colour.spectrum)[w] *= optics::conductor_reflectance(1, 1, {n[w], k[w]});
  preset::Material mirror;
  mirror.type = preset::Material::Type::mirror;
  mirror.reflectance = reflectance_of(colour);
  return mirror;
}

std::optional<preset::Material> metal_of_element(std::string_view element) {
  static const std::map<std::string_view, const char*> shipped{
      {"Au", "gold"}, {"Ag", "silver"}, {"Cu", "copper"}, {"Al", "aluminium"}, {"CuZn", "brass"}};
  const auto metal = shipped.find(element);
  if (metal == shipped.end()) return std::nullopt;
  return metal_of(metal->second);
}

} // namespace nephroid::formats
