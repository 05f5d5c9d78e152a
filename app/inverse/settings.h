// SPDX-License-Identifier: Apache-2.0
// The settings of engine 3: the section "inverse" of a preset. Lengths are millimetres, in which workshops work.
#pragma once
#include "preset/preset.h"

namespace nephroid::inverse {

/// Constants of the thesis' pipeline: the section "inverse.thesis". The thesis prints draws, cycles, moves, cooling,
/// corrections, patience and worth; temperature, steps, limits and directions are ours.
struct Thesis {
  enum class Sampling { exact, rejection };
  enum class Adjust { convergence, each };
  Sampling sampling = Sampling::exact;
  int directions = 128; ///< directions across and down that a facet's light is tried in
  int draws = 32;       ///< draws of every facet; a cost is their mean
  Adjust adjust = Adjust::convergence;
  int cycles = 10, moves = 10;  ///< cycles of an annealing, and moves of a cycle
  double temperature = 0.005;   ///< temperature of the first cycle, in cost
  double cooling = 0.5;         ///< factor from cycle to cycle
  double size_step = 0.02;      ///< largest change in a move of the convergence, or of a picture's size
  double size_limit = 0.1;      ///< largest change of that in all
  double shift_step = 0.01;     ///< in parts of the receiver
  double shift_limit = 0.05;    ///< the same
  double distance_step = 0.01;  ///< in parts of the distance
  double distance_limit = 0.05; ///< the same
  double extension_step = 0.1;  ///< largest change in a move of k, which is 0..1
  double overshoot_step = 0.1;  ///< largest change in a move of o, which is 0..1
  int corrections = 50;         ///< how many corrections at most
  int patience = 5;             ///< corrections without a gain, after which no more follow
  double worth = 1e-5;          ///< a smaller gain of cost counts as none
  double ratio_limit = 2;       ///< a cell's correction is between this and its inverse
  bool operator==(const Thesis&) const = default;
};

/// A grey picture that fills a receiver. Sizes are in parts of the receiver's shorter side, places are about its
/// middle. JSON: a string (a picture file) or an object with "type".
struct Picture {
  enum class Type { file, disc, ring, cross, bars, star, gradient, face, text, qr };
  enum class Fit { contain, cover };
  Type type = Type::disc;
  std::string file;                   ///< file: its luminance, fitted into the receiver
  Fit fit = Fit::contain;             ///< file: how large it is
  bool mirror = false;                ///< file: left and right are exchanged, before it is turned
  bool invert = false;                ///< file: a negative, but for what is transparent
  double ground = 0;                  ///< file: luminance of what is behind transparent pixels; white is 1
  double tone = 1;                    ///< file: exponent on its luminance, whose maximum is 1
  std::array<double, 2> levels{0, 1}; ///< file: what becomes 0 and what becomes 1, after the tone
  double vignette = 0;                ///< file: width of its soft edge, in parts of half its shorter side
  std::string text;                   ///< text and qr
  double radius = 0.3;                ///< disc and face; ring and star: the outer one
  double inner = 0.15;                ///< ring and star: the inner radius
  double length = 0.7;                ///< cross and bars; text: its width
  double width = 0.15;                ///< cross and bars; bars are as far apart as they are wide
  int count = 3;                      ///< bars; star: how many points it has
  double turn_deg = 0;                ///< counterclockwise; file: a multiple of 90
  double background = 0;              ///< brightness where nothing is drawn; the drawing has 1
  bool operator==(const Picture&) const = default;
};

/// What falls on the front.
struct Light {
  enum class Type { parallel, point, area, mesh, sun };
  enum class Shape { disc, rectangle };
  Type type = Type::parallel;
  double tilt_deg = 0;                   ///< parallel: between the light and the front's normal
  double turn_deg = 0;                   ///< parallel: the side to which tilted light goes, counterclockwise from +x
  double distance_mm = 1000;             ///< of a lamp, or of a mesh's origin, from the front
  std::array<double, 2> offset_mm{0, 0}; ///< the same, beside the middle of the object
  Shape shape = Shape::disc;             ///< area: parallel to the front
  std::array<double, 2> size_mm{10, 10}; ///< area: width and height
  std::string file;                      ///< mesh: in millimetres; x is to the right, y up, z away from the object
  preset::PlaceAndTime place{};          ///< sun: where and when it is seen
  /// With a spectrum, luminance counts and the judge sees colours. Without one, the light is a wavelength or a band.
  std::optional<preset::LightSpectrum> spectrum{};
  bool operator==(const Light&) const = default;
};

/// A wanted luminous intensity over directions, far from the object: the section "inverse.far". Its angles are those of
/// a direction's projections: to the right of and above the axis, which goes along the light through the middle.
struct Intensity {
  enum class Type { rectangle, ellipse, batwing, cutoff, picture, luminaire };
  Type type = Type::rectangle;
  std::array<double, 2> size_deg{40, 20}; ///< all but luminaire: width and height
  double edge_deg = 0;                    ///< shapes: how wide the edge is over which it falls to 0
  double rise_deg = 15;                   ///< cutoff: of the cut right of the axis
  Picture picture;                        ///< picture: fills the size
  std::string file;                       ///< luminaire: IES or EULUMDAT
  std::optional<double> candela{};        ///< its largest; without: as bright as the lamp makes it
  std::optional<double> lumens{};         ///< of the lamp, into all directions
  bool operator==(const Intensity&) const = default;
};

struct Receiver {
  double distance_mm = 100;              ///< from the facets
  std::array<double, 2> offset_mm{0, 0}; ///< the receiver's middle, from the object's; not thesis
  Picture picture;
  double weight = 1;            ///< weight of its squared differences beside the other receivers'
  std::optional<Light> light{}; ///< what it is seen in; without, Settings::light. Only assign has it
  bool operator==(const Receiver&) const = default;
};

/// Whether their light comes the same way: all lights have the spectrum of Settings::light.
inline bool is_same_but_spectrum(Light a, const Light& b) {
  a.spectrum = b.spectrum;
  return a == b;
}

struct Settings {
  enum class Kind { glass, mirror };
  enum class Method { assign, thesis, lens };
  enum class Heights { flat, free };
  enum class Outline { rectangle, round };
  Kind kind = Kind::glass; ///< what turns the light: see bending.h
  Method method = Method::assign;
  std::array<double, 2> size_mm{100, 100};  ///< the object's width and height
  Outline outline = Outline::rectangle;     ///< the object's outline within size_mm
  double thickness_mm = 10;                 ///< from the middle of the relief to the flat front
  std::optional<double> stock_mm{};         ///< the sheet that holds the object, relief and all; not with thickness_mm
  Heights heights = Heights::flat;          ///< where the facets' middles are
  std::optional<double> min_thickness_mm{}; ///< the object is nowhere thinner
  std::optional<double> max_relief_mm{};    ///< from the lowest corner of a facet to the highest
  std::optional<double> max_slope_deg{};    ///< between a facet and the front
  std::optional<double> tool_radius_mm{};   ///< radius of the cutter that mills the facets
  std::optional<double> layer_mm{};         ///< thickness of a printer's layers, which lie along the front
  double draft_deg = 0;                     ///< least angle between a wall and straight up
  double smoothing_normals = 0;             ///< alpha_N of the thesis' (6.1): weight of facets unlike their neighbours
  double smoothing_pictures = 1;            ///< alpha_P: weight of the pictures' error
  std::array<int, 2> facets{128, 128};      ///< across and down
  std::optional<double> mesh_error{}; ///< method lens: how far triangles send light from where the surface does, cells
  preset::Dispersion index{};         ///< the object's index, in air
  double wavelength_nm = 550;         ///< at which the index is taken, without light.spectrum
  double band_nm = 0;                 ///< width of the light's band about it
  bool diffraction = true;            ///< whether facets spread light as waves; a lens has none
  Light light;
  double front_azimuth_deg = 180;  ///< where the front looks, for a light of type sun: 0 is north, 90 east
  double front_elevation_deg = 0;  ///< above the horizon: 0 is an upright pane, 90 a plate that lies with its front up
  std::optional<double> sun_deg{}; ///< diameter of the light's disc; without: of the sun its own, of other light 0
  double scatter_deg = 0;          ///< standard deviation of the directions that a rough surface gives one ray
  std::optional<std::array<double, 2>> receiver_mm{}; ///< size of every receiver; without: the object's
  std::array<int, 2> cells{64, 64};                   ///< cells of every receiver, across and down
  int frames = 0;                                     ///< pictures between a receiver and the next one
  bool tolerances = false;                            ///< whether objects with errors are judged, too
  std::vector<Receiver> receivers{1};                 ///< the nearest first
  std::optional<Intensity> far{};                     ///< in place of the receivers
  bool step = false;                                  ///< whether object.step is written
  Thesis thesis{};                                    ///< constants of the method thesis
  bool operator==(const Settings&) const = default;
};

const preset::SettingsType& settings_type();

inline Settings& settings(preset::Preset& preset) { return preset.settings.as<Settings>(); }
inline const Settings& settings(const preset::Preset& preset) { return preset.settings.as<Settings>(); }

} // namespace nephroid::inverse
