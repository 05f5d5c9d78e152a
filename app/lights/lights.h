// SPDX-License-Identifier: Apache-2.0
// What a light can do on the host. Each is a file of this folder with a class that is a Model, by the list in
// kernels/lights/light_types.h; everybody else asks here, or by LIGHT_HAS_* (preset::has). kernels/lights is the same
// on the device.
#pragma once
#include "kernels/lights/light_types.h"
#include "preset/describe.h"
#include "scene/scene.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nephroid::lights {

/// What a light is loaded with. scene: with its objects, and the lights before this one, which share their files.
/// where: FILE#/scene/lights/INDEX. warnings: what a file says and is not obeyed.
struct Loading {
  const scene::Scene& scene;
  const FileFinder& finder;
  Location where;
  std::vector<std::string>& warnings;
};

/// The triangles or the ellipsoids of a mesh that shines, as the device has them.
struct Surfaces {
  std::vector<shared::DevicePrimitive> primitives;
  std::size_t first = 0; ///< in the table of triangles
};

/// What glTF can say of a light: KHR_lights_punctual.
struct Punctual {
  const char* type;
  double intensity;                 ///< W sr^-1, or W m^-2 of a directional one
  std::optional<double> half_angle; ///< of a spot, in radians
};

class Model {
public:
  Model() = default;
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;
  virtual ~Model() = default;

  /// Its fields of the preset beyond type and spectrum.
  virtual void describe(preset::Fields& v, preset::Light& light) const = 0;
  /// What is loaded beyond type and spectrum. Throws bad_input below `where`, and at a file.
  virtual void load(const preset::Light& from, const Loading& loading, scene::Light& light) const = 0;
  /// Its row, but for its table.
  virtual void set_row(const scene::Light& light, shared::DeviceLight& row) const = 0;
  /// Its numbers in lamp_tables; the row says how to read them.
  virtual std::vector<float> table(const scene::Light&, const Surfaces&, shared::DeviceLight&) const { return {}; }
  /// Whether its light comes from different places: of a surface, of a disc far away, of the sky.
  virtual bool has_places(const shared::DeviceLight&) const { return false; }
  /// Where kernels have it shine from, for two numbers in [0, 1); of no meaning for light from far away.
  virtual glm::dvec3 place(const shared::DeviceLight&, const float* /*table*/, const Surfaces&,
                           std::array<float, 2>) const {
    return glm::dvec3(0);
  }
  /// Places all over what shines, scene coordinates; none of light from far away.
  virtual std::vector<glm::dvec3> extent(const scene::Scene&, const scene::Light& light) const {
    return {light.position};
  }
  /// False where it sends nothing to a sphere. True in doubt.
  virtual bool reaches(const scene::Light&, const scene::Sphere&) const { return true; }
  /// The power in W that it sends towards spheres. It counts twice where they overlap.
  virtual double towards_w(const scene::Light& light, const std::vector<scene::Sphere>& spheres,
                           double metres_per_unit) const;
  /// W m^-2 at a distance in metres, where it shines.
  virtual double irradiance(const scene::Light& light, double metres) const;
  /// Nothing: glTF has no such light.
  virtual std::optional<Punctual> punctual(const scene::Light& light) const;
  /// What glTF then lacks, as a note; empty: nothing.
  virtual std::string_view left_out(const scene::Light&) const { return {}; }
};

#define NEPHROID_LIGHT_MODEL(word, NAME, Row, has, sentence) const Model& word();
ALL_LIGHTS(NEPHROID_LIGHT_MODEL)
#undef NEPHROID_LIGHT_MODEL

/// LIGHT_*.
int type_of(const scene::Light& light);
/// type: LIGHT_*.
const Model& model(int type);
inline const Model& model(const scene::Light& light) { return model(type_of(light)); }

/// The type and what the model says.
shared::DeviceLight row_of(const scene::Light& light);

/// Whether it is light from far away.
bool is_parallel(const shared::DeviceLight& row);
inline bool has_places(const shared::DeviceLight& row) { return model(row.type).has_places(row); }
inline bool has_places(const scene::Light& light) { return has_places(row_of(light)); }

/// As the function of that name in kernels/lights/spot.h.
bool is_narrow(const shared::DeviceLight& row);

// What the files of this folder share.

/// What spheres fill as seen from a point, and of parallel light, in square metres. Both count twice where they
/// overlap.
double steradians_of(const std::vector<scene::Sphere>& spheres, const glm::dvec3& from);
double shadow_m2(const std::vector<scene::Sphere>& spheres, double metres_per_unit);

/// Model::towards_w of a surface, whose light is brightest straight on: P / pi a steradian.
double surface_towards_w(const scene::Light& light, const std::vector<scene::Sphere>& spheres);

inline constexpr std::string_view no_pattern = "glTF has no photometry and no lamps with pictures: those shine evenly";

void describe_power(preset::Fields& v, preset::Light& light);
void describe_position(preset::Fields& v, preset::Light& light);
void describe_direction(preset::Fields& v, preset::Light& light);

/// Power, position and what encloses it.
void load_position(const preset::Light& from, const Loading& loading, scene::Light& light);

glm::dvec3 vector(const shared::float4& v);

/// choose and place_in_bin of kernels: the bin of a number, and the place in it.
std::pair<std::size_t, double> bin_of(const float* cdf, std::size_t count, float number);

} // namespace nephroid::lights
