// SPDX-License-Identifier: Apache-2.0
// What the panel "Spectra" shows of a preset: curves on the 401 wavelengths, u(lambda) and iterations a cluster,
// made anew where what they hang on changed; and edits of the rows of a light's spectrum (light_edits.cpp). No Dear
// ImGui.
#pragma once
#include "optics/wavelength.h"
#include "photons/effort/importance.h"
#include "preset/preset.h"
#include "scene/scene.h"
#include "ui/widgets/rows.h"

namespace nephroid::ui {

/// What u(lambda) and clusters hang on of where a loaded scene's things are. It takes meshes and rays, so it comes with
/// a run (SceneFacts); panels do the rest.
struct SeenByGlass {
  std::vector<std::string> materials;     ///< names of Scene::materials, in whose order the shares are
  std::vector<scene::Light> surroundings; ///< the sun of a sky, the environment where it is a light
  photons::ImportanceGeometry importance_geometry;
  photons::Settings settings;             ///< the preset's,
  std::vector<std::vector<int>> clusters; ///< what a run groups by them
  bool operator==(const SeenByGlass&) const = default;

  /// Traces rays only where the preset's effort asks for them.
  static std::shared_ptr<const SeenByGlass> of(const preset::Preset& preset, const scene::Scene& scene,
                                               const scene::Bvh& bvh);
};

struct LightCurve {
  optics::Spectrum spectrum{}; ///< sums to 1; all 0 where there is an error
  double largest = 0;          ///< value of it
  std::string error;           ///< why it has none, a sentence for a person
};

struct ReflectanceCurve {
  std::string material;
  optics::Spectrum reflectance{};
  std::array<double, 3> srgb{}; ///< 0..1, encoded: its colour under D65
};

struct ClusterWork {
  std::vector<int> wavelengths; ///< indices, rising
  double importance = 0;        ///< 0..1
  std::int64_t iterations = 0;
};

struct Spectra {
  std::vector<LightCurve> lights;             ///< one a light of the preset
  std::vector<ReflectanceCurve> reflectances; ///< one a material that objects use and that has one
  photons::WavelengthImportance importance;   ///< by the preset's effort; all 0 where why_no_u is not empty
  std::string why_no_u;                       ///< why there is none, a sentence for a person
  std::vector<ClusterWork> clusters;          ///< empty where there are none; ordered by their smallest wavelength
  std::array<int, optics::wavelength_count> cluster_of{}; ///< index into clusters; -1: of none
  std::vector<std::string> materials;                     ///< every one: what Surrounding::material points into

  std::int64_t passes = 0;           ///< N: of the preset's stop, or preset::default_passes
  std::int64_t iterations() const;   ///< the sum over clusters
  std::int64_t brute_force() const;  ///< 401 N
  std::int64_t equal_effort() const; ///< N for each cluster
};

class SpectraMaker {
public:
  /// The spectra of a preset; nothing is made anew where neither it nor `seen` changed. seen: null before a run has
  /// brought it. No Error leaves it: what is wrong is said in the result. Files are read where a material that names
  /// one changed.
  const Spectra& update(const preset::Preset& preset, const std::shared_ptr<const SeenByGlass>& seen);
  const Spectra& spectra() const { return spectra_; }
  /// How often anything was made anew, for tests.
  std::uint64_t updates() const { return updates_; }

private:
  void make_lights(const preset::Scene& now);
  void make_materials(const preset::Preset& now);
  void make_groups(const preset::Preset& now);
  bool is_of_this_scene(const photons::Settings& settings) const;
  void make_importance(const preset::Preset& now);
  void make_clusters(const preset::Preset& now);

  std::optional<preset::Preset> preset_; ///< what spectra_ is of,
  std::shared_ptr<const SeenByGlass> seen_;
  Spectra spectra_;
  scene::Scene outline_;                 ///< materials, which objects are of which, and lights; no triangles
  std::string materials_error_;          ///< why outline_ has no materials; empty where it has them
  std::vector<std::vector<int>> groups_; ///< the clusters of outline_, also of wavelengths that no light has
  std::string groups_error_;             ///< why there are none
  std::uint64_t updates_ = 0;
};

/// Every curve as CSV: wavelength_nm, a column a light (sums to 1), luminosity, a column a reflectance, u, cluster,
/// iterations.
std::string to_csv(const Spectra& spectra);
/// The preset's colour of a whole wavelength: what the eye makes of it, as bright as the display can show without the
/// colours that it has not, fading towards the ends as the eye does. sRGB encoded, 0..1.
std::array<double, 3> wavelength_colour(int index);

/// (nm, relative power)
using PowerRow = Row;

/// Whether its rows can be dragged: lines and tables.
bool has_rows(const preset::LightSpectrum& spectrum);
/// Its largest power; 1 where that is 0 or there are no rows.
double largest_power(const preset::LightSpectrum& spectrum);

/// The spectrum as a table with a row every 20 nm of 380..780, relative to the largest. What has no power, or is wrong,
/// becomes rows of power 1.
preset::LightSpectrum as_table(const preset::LightSpectrum& spectrum);

/// The rows by rising wavelength, as ui/widgets/rows.h expects them.
preset::LightSpectrum sorted(preset::LightSpectrum spectrum);
/// A table has two rows at least, lines one.
RowRules row_rules(const preset::LightSpectrum& spectrum);
/// A row in figures that a person reads: to 0.1 nm, the power to 4 figures.
PowerRow readable(const PowerRow& row);
/// Between those rows that are farthest apart within 380..780 nm, with the power that a table has there; a line with
/// half the largest.
PowerRow in_widest_gap(const preset::LightSpectrum& spectrum);

} // namespace nephroid::ui
