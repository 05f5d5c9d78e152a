// SPDX-License-Identifier: Apache-2.0
#include "ui/spectral/dispersion/model.h"

#include "base/files.h"
#include "optics/dispersion.h"
#include "photons/clusters/scene_clusters.h"
#include "scatter/spectra.h"
#include "scene/scene.h"
#include "spectral/settings.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <numbers>

namespace nephroid::ui {
namespace {

constexpr photons::ClusterMethod methods[] = {photons::ClusterMethod::optimal, photons::ClusterMethod::thesis,
                                              photons::ClusterMethod::brute_force};
constexpr double beyond_nm = 120;                    ///< how far the line goes on outside of the 401 wavelengths,
constexpr double lowest_nm = 100, highest_nm = 1500; ///< and how far at most where control points lie there
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Wavelengths to draw: every nanometre of the grid, every fifth beyond it. low, high: of the control points.
std::vector<double> wavelengths_of_line(double low_nm, double high_nm) {
  const double low = std::max(lowest_nm, std::min(low_nm, optics::first_nm - beyond_nm));
  const double high = std::min(highest_nm, std::max(high_nm, optics::last_nm + beyond_nm));
  std::vector<double> nm;
  for (int l = optics::first_nm - 5; l >= low; l -= 5) nm.push_back(l);
  std::reverse(nm.begin(), nm.end());
  for (int l = optics::first_nm; l <= optics::last_nm; ++l) nm.push_back(l);
  for (int l = optics::last_nm + 5; l <= high; l += 5) nm.push_back(l);
  return nm;
}

void make_lines(const optics::DispersionCurve& data, optics::Extrapolation outside, GlassCurve& glass_curve) {
  const auto ends = glass_curve.points ? glass_curve.data_nm : std::array<double, 2>{optics::first_nm, optics::last_nm};
  glass_curve.line_nm = wavelengths_of_line(ends[0], ends[1]);
  for (const double nm : glass_curve.line_nm) {
    const bool refused =
        outside == optics::Extrapolation::refuse && (nm < glass_curve.data_nm[0] || nm > glass_curve.data_nm[1]);
    const optics::IndexSample sample = refused ? optics::IndexSample{} : data.sample(nm, outside);
    glass_curve.line_n.push_back(sample.n.value_or(nan));
    if (data.k) glass_curve.line_k.push_back(sample.k.value_or(nan));
  }
}

/// theta2 = asin(sin theta1 / n) at theta1 = 45 degrees; 90 degrees beyond the critical angle.
double angle_at_45_deg(double n) {
  return std::asin(std::min(1.0, std::numbers::sqrt2 / 2 / n)) * 180 / std::numbers::pi;
}

/// angle: of refraction, as a function of n, falling.
template <class Angle>
Spread spread_of(const photons::Clustering& clustering, const optics::Spectrum& n, Angle angle) {
  Spread spread;
  for (const photons::Cluster& cluster : clustering.clusters) {
    const double highest = n[static_cast<std::size_t>(cluster.wavelengths.front())];
    const double lowest = n[static_cast<std::size_t>(cluster.wavelengths.back())];
    if (highest == lowest) continue;
    const double inside = std::max(0.0, angle(lowest) - angle(highest));
    spread.greatest_deg = std::max(spread.greatest_deg, inside);
    spread.mean_deg += inside * static_cast<double>(cluster.wavelengths.size()) / optics::wavelength_count;
  }
  return spread;
}

} // namespace

ControlPoint readable_point(const ControlPoint& point) {
  return {std::round(point[0] * 100) / 100, std::round(point[1] * 1e6) / 1e6};
}

std::vector<ControlPoint> sorted_points(const preset::Dispersion& dispersion) {
  if (dispersion.type != preset::Dispersion::Type::points) return {};
  return sorted_rows(dispersion.table);
}

preset::Dispersion with_points(const preset::Dispersion& before, std::vector<ControlPoint> points) {
  preset::Dispersion dispersion;
  dispersion.type = preset::Dispersion::Type::points;
  dispersion.table = std::move(points);
  dispersion.outside = before.outside;
  return dispersion;
}

ControlPoint snapped(ControlPoint point, ControlPoint step) {
  for (std::size_t i = 0; i < 2; ++i)
    if (step[i] > 0) point[i] = std::round(point[i] / step[i]) * step[i];
  return point;
}

FittedPoints fit_points(const optics::Spectrum& n, double tolerance, std::size_t most) {
  const auto point = [&](int index) {
    // Seven decimals are as much as any table has.
    const double value = std::round(n[static_cast<std::size_t>(index)] * 1e7) / 1e7;
    return ControlPoint{static_cast<double>(optics::wavelength_nm(index)),
                        std::clamp(value, preset::index_bounds.low, preset::index_bounds.high)};
  };
  FittedPoints fitted;
  fitted.points = {point(0), point(optics::wavelength_count - 1)};
  while (true) {
    const optics::Spectrum fitted_n =
        optics::sample_n(optics::control_points(fitted.points), optics::Extrapolation::hold);
    int worst = 0;
    fitted.greatest_deviation = 0;
    for (int i = 0; i < optics::wavelength_count; ++i) {
      const double deviation = std::fabs(fitted_n[static_cast<std::size_t>(i)] - n[static_cast<std::size_t>(i)]);
      if (deviation > fitted.greatest_deviation) fitted.greatest_deviation = deviation, worst = i;
    }
    if (fitted.greatest_deviation <= tolerance || fitted.points.size() >= std::max<std::size_t>(most, 2)) return fitted;
    if (!add_row(fitted.points, point(worst), point_rules)) return fitted; // it is a point already: nothing gets better
  }
}

ClusterFigures figures_of(photons::Clustering clustering, const optics::Spectrum& n) {
  ClusterFigures figures;
  figures.saving = static_cast<double>(optics::wavelength_count) / static_cast<double>(clustering.clusters.size());
  figures.at_45 = spread_of(clustering, n, angle_at_45_deg);
  figures.mean_over_angles =
      spread_of(clustering, n, [](double m) { return photons::refraction_integral_deg2(m) / photons::last_angle_deg; });
  figures.clustering = std::move(clustering);
  return figures;
}

GlassCurve make_glass_curve(const preset::Dispersion& dispersion, const std::string& preset_source,
                            const Location& where) {
  GlassCurve glass_curve;
  glass_curve.points = dispersion.type == preset::Dispersion::Type::points;
  try {
    const FileFinder finder(std::filesystem::path(preset_source).parent_path());
    const optics::DispersionCurve data = scatter::make_curve(dispersion, finder, where);
    const optics::Extrapolation outside = scatter::outside_policy(dispersion.outside);
    glass_curve.name = data.name;
    glass_curve.data_nm = data.range_nm();
    make_lines(data, outside, glass_curve); // also where it cannot be rendered: the person sees where it goes wrong
    glass_curve.note = optics::outside_note(data, outside);
    glass_curve.has_k = data.k.has_value();
    glass_curve.n = optics::sample_n(data, outside);
    glass_curve.k = optics::sample_k(data, outside);
  } catch (const std::exception& error) {
    glass_curve.error = error.what();
  }
  return glass_curve;
}

bool DispersionModel::update_curve(const preset::Preset& preset, const std::string& material) {
  const preset::Dispersion& dispersion = preset.scene.materials.at(material).dispersion;
  const auto found = glasses_.find(material);
  if (found != glasses_.end() && found->second.dispersion == dispersion && found->second.source == preset.source)
    return false;
  const Location where = Location(preset.source) / "scene" / "materials" / material / "dispersion";
  glasses_[material] = {dispersion, preset.source, make_glass_curve(dispersion, preset.source, where)};
  ++curves_made_;
  return true;
}

void DispersionModel::update(const preset::Preset& preset, const std::string& material) {
  if (material_ == material && preset_ == preset) return;
  const photons::Settings& settings = spectral::settings(preset);
  std::erase_if(glasses_, [&](const auto& glass) { return !preset.scene.materials.contains(glass.first); });
  bool changed = std::exchange(material_, material) != material;
  changed |= update_curve(preset, material);
  changed |= std::exchange(threshold_deg_, settings.threshold_deg) != settings.threshold_deg;
  curve_ = &glasses_.at(material).curve;
  if (changed) cluster();
  method_ = settings.method;
  if (error_.empty())
    for (std::size_t c = 0; c < chosen().clustering.clusters.size(); ++c)
      for (const int index : chosen().clustering.clusters[c].wavelengths)
        cluster_of_[static_cast<std::size_t>(index)] = c;
  combine(preset);
  preset_ = preset;
}

void DispersionModel::cluster() {
  error_ = curve_->error;
  if (!error_.empty()) return;
  try {
    for (const photons::ClusterMethod method : methods)
      figures_[static_cast<std::size_t>(method)] =
          figures_of(photons::cluster_wavelengths(curve_->n, threshold_deg_, method), curve_->n);
    ++clusterings_made_;
  } catch (const std::exception& error) {
    error_ = error.what();
  }
}

/// By the engine's own rule, which asks for each object's index of refraction only.
void DispersionModel::combine(const preset::Preset& preset) {
  clusters_of_run_.reset();
  const photons::Settings& settings = spectral::settings(preset);
  scene::Scene outline;
  for (const std::string& name : dielectrics(preset)) {
    if (std::ranges::count(preset.scene.objects, name, &preset::Object::material) == 0) continue;
    update_curve(preset, name);
    const GlassCurve& glass = glasses_.at(name).curve;
    if (!glass.error.empty() || (settings.relight && glass.has_k))
      return; // layers also hang on the lengths of paths in what absorbs
    outline.objects.emplace_back().material = static_cast<int>(outline.materials.size());
    scatter::Material& material = outline.materials.emplace_back();
    material.type = scatter::Material::Type::dielectric;
    material.n = glass.n;
  }
  if (outline.objects.empty() || !error_.empty()) return;
  clusters_of_run_ = photons::scene_clusters(settings, outline).size();
}

} // namespace nephroid::ui
