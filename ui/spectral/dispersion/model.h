// SPDX-License-Identifier: Apache-2.0
// What the panel "Dispersion" shows, kept as long as the fields it comes from stay as they are: one dielectric's curve,
// its clusters by every method and what they mean; and what a person does to it: control points are moved, added and
// removed, a curve becomes control points. No Dear ImGui here.
#pragma once
#include "base/location.h"
#include "optics/wavelength.h"
#include "photons/clusters/clusters.h"
#include "photons/settings.h"
#include "preset/field.h"
#include "preset/preset.h"
#include "ui/widgets/rows.h"

namespace nephroid::ui {

using ControlPoint = Row; ///< (nm, n)

/// In figures that a person can read in the preset, finer than a pixel.
ControlPoint readable_point(const ControlPoint& point);
/// A curve needs two of them.
inline constexpr RowRules point_rules{"control point", preset::index_bounds, 0.5, 2, readable_point};

/// By rising wavelength, as the functions below have them.
std::vector<ControlPoint> sorted_points(const preset::Dispersion& dispersion);
/// Control points, nothing else of `before` but its rule for wavelengths outside.
preset::Dispersion with_points(const preset::Dispersion& before, std::vector<ControlPoint> points);
ControlPoint snapped(ControlPoint point, ControlPoint step);

struct FittedPoints {
  std::vector<ControlPoint> points;
  double greatest_deviation = 0; ///< the largest error of n at the 401 wavelengths
};
/// Few control points whose monotone cubic comes to within `tolerance` of n, at most `most` (>= 2): from both ends on,
/// one more where the deviation is greatest.
FittedPoints fit_points(const optics::Spectrum& n, double tolerance = 1e-4, std::size_t most = 40);

struct GlassCurve {
  std::string error;               ///< why n is not known at all 401 wavelengths: one line; else empty
  std::string name;                ///< "N-SF66", "points"
  std::string note;                ///< what is said about wavelengths outside of the data; may be empty
  std::array<double, 2> data_nm{}; ///< the data's own range
  optics::Spectrum n{}, k{};       ///< where there is no error
  bool points = false, has_k = false;
  /// To be drawn: every nanometre of 380..780, and some beyond. NaN where there is no value. line_k is empty without k.
  std::vector<double> line_nm, line_n, line_k;
};
/// where: the field's FILE#/json/pointer, for messages. Whatever is wrong becomes the curve's error.
GlassCurve make_glass_curve(const preset::Dispersion& dispersion, const std::string& preset_source,
                            const Location& where);

/// How much the refraction angle differs inside a cluster: between the rays of its highest and its lowest n, which all
/// go the way of the mean. A cluster of one wavelength has none.
struct Spread {
  double mean_deg = 0;     ///< over the 401 wavelengths, each with its cluster's
  double greatest_deg = 0; ///< the largest of all clusters
};

struct ClusterFigures {
  photons::Clustering clustering;
  double saving = 1;       ///< 401 / clusters: how many times fewer paths than brute force
  Spread at_45;            ///< at an angle of incidence of 45 degrees
  Spread mean_over_angles; ///< the mean over 0..89 degrees of incidence, which is what the threshold alpha is about
};

/// n: the curve that was clustered.
ClusterFigures figures_of(photons::Clustering clustering, const optics::Spectrum& n);

class DispersionModel {
public:
  /// Makes anew what does not fit the preset any more; idle frames cost a comparison. Throws nothing. material: a
  /// dielectric of it.
  void update(const preset::Preset& preset, const std::string& material);

  const GlassCurve& curve() const { return *curve_; }
  /// Empty where there are clusters, else why not.
  const std::string& error() const { return error_; }
  /// In the order of photons::Settings::Method; only without an error().
  const ClusterFigures& figures(photons::ClusterMethod method) const {
    return figures_[static_cast<std::size_t>(method)];
  }
  /// The clusters of the curve by the preset's method, and the cluster of each wavelength.
  const ClusterFigures& chosen() const { return figures(method_); }
  const std::array<std::size_t, optics::wavelength_count>& cluster_of() const { return cluster_of_; }
  /// How many the run has: of all glasses that objects are made of, by brute force of step_nm neighbours, with
  /// differentials as they need them. Nothing where no object is made of glass, one of the curves has an error, or
  /// layers for another light absorb.
  std::optional<std::size_t> clusters_of_run() const { return clusters_of_run_; }

  /// How often each was made, for tests.
  int curves_made() const { return curves_made_; }
  int clusterings_made() const { return clusterings_made_; }

private:
  struct Glass {
    preset::Dispersion dispersion;
    std::string source;
    GlassCurve curve;
  };
  /// True where the material's curve was made anew.
  bool update_curve(const preset::Preset& preset, const std::string& material);
  void cluster();
  void combine(const preset::Preset& preset);

  std::map<std::string, Glass> glasses_; ///< by material
  preset::Preset preset_;                ///< what all is made for,
  std::string material_;                 ///< and the one that is shown
  double threshold_deg_ = 0;
  photons::ClusterMethod method_ = photons::ClusterMethod::optimal;

  const GlassCurve* curve_ = nullptr; ///< in glasses_
  std::string error_;
  std::array<ClusterFigures, 3> figures_;
  std::array<std::size_t, optics::wavelength_count> cluster_of_{};
  std::optional<std::size_t> clusters_of_run_;
  int curves_made_ = 0, clusterings_made_ = 0;
};

} // namespace nephroid::ui
