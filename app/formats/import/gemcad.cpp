// SPDX-License-Identifier: Apache-2.0
// GemCad's .asc: a stone by its facets. A record `a ANGLE DISTANCE INDEX ...` is a plane for each index: ANGLE degrees
// from the table's plane, above 0 on the crown and below on the pavilion, at DISTANCE from the centre, turned by
// INDEX / gear of a full turn. The stone is what all of them leave. GemCad's manual has the records; lengths have no
// unit.
#include "base/counted.h"
#include "base/error.h"
#include "formats/import/convex.h"
#include "formats/import/description.h"
#include "scene/scene.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string_view>
#include <utility>

namespace nephroid::formats {
namespace {

constexpr std::size_t most_facets = 1000;
constexpr double most_teeth = 100000; ///< of a gear
constexpr double stone_mm = 10;       ///< the longer side of the box about a stone, seen from above
constexpr double quartz = 1.54;       ///< GemCad's index of refraction for a new stone

/// A record `a`: facets of one angle and distance.
struct Tier {
  Location where;
  double angle_deg = 0, distance = 0;
  bool is_pavilion = false;
  std::vector<double> indices;
};

class GemcadFile {
public:
  GemcadFile(const std::filesystem::path& file, Description& into) : d_(into), file_(file.string()) {
    std::istringstream text(read_packed_file(file));
    std::size_t number = 0;
    for (std::string line; std::getline(text, line);) {
      if (number == 0 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);
      where_ = Location(file_, ++number);
      read(line);
    }
    if (skipped_ > 0)
      d_.note(first_skipped_, fmt::format("{} of no record that is known here {} left out", counted(skipped_, "line"),
                                          skipped_ == 1 ? "is" : "are"));
    if (tiers.empty())
      throw bad_input(file_, "has no facets", "expected GemCad's lines such as a 41.0 0.65 96 12 24",
                      "save the stone from GemCad as ASCII");
    if (gear_ == 0) throw bad_input(file_, "has no gear", "expected a line such as g 96 0.0");
    settle();
  }

  /// Radians, counterclockwise seen from the table; with a gear below 0 clockwise.
  double azimuth(double index) const { return 2 * std::numbers::pi * (index + offset_) / gear_; }

  std::vector<Tier> tiers;
  std::optional<double> index_of_refraction;
  Location refraction_where;

private:
  void read(const std::string& line) {
    std::istringstream in(line);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    if (words.empty() || words[0][0] == ';' || words[0][0] == '#') return;
    std::string key = words[0];
    // third programs write g96 for g 96
    if (key.size() > 1 && (key[0] == 'g' || key[0] == 'I') && scene_number(key.substr(1))) {
      words.insert(words.begin() + 1, key.substr(1));
      key.resize(1);
    }
    const bool is_record = key.size() == 1 && std::string_view("agyIHF").find(key[0]) != std::string_view::npos;
    const bool goes_on = is_open_ && ((name_follows_ && !is_record) || key == "n" || key == "G" || scene_number(key));
    if (goes_on) return read_indices(words, 0);
    is_open_ = false;
    if (key == "g")
      read_gear(words);
    else if (key == "I") {
      index_of_refraction = number(words, 1, "index of refraction");
      refraction_where = where_;
    } else if (key == "a")
      read_tier(words);
    else if (key != "y" && key != "H" && key != "F" && !key.starts_with("Gem")) {
      if (skipped_++ == 0) first_skipped_ = where_;
    }
  }

  double number(const std::vector<std::string>& words, std::size_t at, const char* what) const {
    if (words.size() <= at) throw bad_input(where_, fmt::format("its {} is missing", what), "expected a number");
    const auto value = scene_number(words[at]);
    if (!value) throw bad_input(where_, fmt::format("its {} \"{}\" is no number", what, words[at]));
    return *value;
  }

  void read_gear(const std::vector<std::string>& words) {
    gear_ = number(words, 1, "number of teeth");
    offset_ = words.size() > 2 ? number(words, 2, "gear's offset") : 0;
    if (gear_ == 0 || gear_ != std::round(gear_) || std::abs(gear_) > most_teeth)
      throw bad_input(
          where_, fmt::format("a gear of {:g} teeth", gear_),
          fmt::format("expected a whole number from 1 to {:g}, below 0 for one that is turned the other way",
                      most_teeth),
          "give the teeth of the index wheel, such as g 96 0.0");
  }

  void read_tier(const std::vector<std::string>& words) {
    Tier& tier = tiers.emplace_back();
    tier.where = where_;
    tier.angle_deg = number(words, 1, "angle");
    tier.distance = number(words, 2, "distance");
    if (std::abs(tier.angle_deg) > 90)
      throw bad_input(where_, fmt::format("an angle of {:g} degrees", tier.angle_deg), "expected -90 to 90");
    // A culet is written as -0 degrees or with a distance below 0.
    tier.is_pavilion = std::signbit(tier.angle_deg) || (tier.angle_deg == 0 && tier.distance < 0);
    if (tier.angle_deg == 0) tier.distance = std::abs(tier.distance);
    if (!(tier.distance > 0))
      throw bad_input(where_, fmt::format("a distance of {:g} leaves nothing of the stone", tier.distance),
                      "expected one above 0: the stone is about its centre");
    is_open_ = true;
    name_follows_ = false;
    read_indices(words, 3);
  }

  /// Indices and names of a tier, up to a remark; what is in a tier goes on in the next lines.
  void read_indices(const std::vector<std::string>& words, std::size_t at) {
    for (; at < words.size(); ++at) {
      if (std::exchange(name_follows_, false)) continue;
      if (words[at] == "G") return;
      name_follows_ = words[at] == "n";
      if (name_follows_) continue;
      tiers.back().indices.push_back(number(words, at, "index"));
      if (++facets_ > most_facets)
        throw bad_input(where_, fmt::format("the stone has more than {} facets", most_facets), {},
                        "leave out those that cut nothing");
    }
  }

  /// Checks the indices, now that the gear is known.
  void settle() {
    const double teeth = std::abs(gear_);
    for (Tier& tier : tiers) {
      if (tier.indices.empty() && tier.angle_deg == 0) tier.indices = {0};
      if (tier.indices.empty())
        throw bad_input(tier.where, "the facet has no index", fmt::format("expected numbers from 0 to {:g}", teeth));
      for (const double index : tier.indices)
        if (index < 0 || index > teeth)
          throw bad_input(tier.where, fmt::format("an index of {:g} on a gear of {:g} teeth", index, teeth),
                          fmt::format("expected 0 to {:g}", teeth), "correct it or the line g");
    }
  }

  Description& d_;
  std::string file_;
  Location where_, first_skipped_;
  double gear_ = 0, offset_ = 0; ///< teeth
  bool is_open_ = false, name_follows_ = false;
  std::size_t facets_ = 0, skipped_ = 0;
};

const char* side_of(const glm::dvec3& direction) {
  return direction.y > 0   ? "above: give it a table or a crown"
         : direction.y < 0 ? "below: give it a pavilion or a culet"
                           : "at its sides: give it a girdle";
}

/// The stone about its centre, table up, in the file's lengths.
ConvexBody stone_of(const GemcadFile& gem, Description& into) {
  std::vector<HalfSpace> planes;
  std::vector<std::size_t> tiers; ///< of the planes
  for (std::size_t i = 0; i < gem.tiers.size(); ++i) {
    const Tier& tier = gem.tiers[i];
    const double angle = glm::radians(std::abs(tier.angle_deg));
    for (const double index : tier.indices) {
      const double turn = gem.azimuth(index), up = std::cos(angle), out = std::sin(angle);
      planes.push_back({{out * std::cos(turn), tier.is_pavilion ? -up : up, -out * std::sin(turn)}, tier.distance});
      tiers.push_back(i);
    }
  }
  ConvexBody stone = [&] {
    try {
      return intersection(planes);
    } catch (const Error&) {
      throw bad_input(into.source, "the facets leave a stone that is too thin for its size", {},
                      "check their distances");
    }
  }();
  if (!stone.is_bounded())
    throw bad_input(into.source.string(),
                    fmt::format("the facets leave the stone open {}", side_of(stone.open_towards)));
  std::vector<std::size_t> unseen(gem.tiers.size());
  for (const std::size_t tier : tiers) ++unseen[tier];
  for (const ConvexBody::Face& face : stone.faces) --unseen[tiers[face.half_space]];
  for (std::size_t i = 0; i < unseen.size(); ++i)
    if (unseen[i] > 0)
      into.note(gem.tiers[i].where,
                fmt::format("{} of its {} {} nothing of the stone", unseen[i],
                            counted(gem.tiers[i].indices.size(), "facet"), unseen[i] == 1 ? "cuts" : "cut"));
  const auto is_table = [&](const ConvexBody::Face& face) { return planes[face.half_space].normal.y > 1 - 1e-6; };
  if (std::ranges::none_of(stone.faces, is_table))
    into.note("no facet is level above: the stone has no table. Is the file whole?");
  return stone;
}

DescribedShape shape_of(const char* name, const std::string& mesh, Description& into) {
  DescribedShape shape;
  shape.where = into.source.string();
  shape.name = shape.material = name;
  shape.mesh = mesh;
  return shape;
}

/// A white table that the stone stands a little above, a lamp aslant, grey surroundings that the stone reflects but
/// that light nothing, and a camera that sees stone and caustic.
void show(double width, Description& into) {
  const double a = 6 * width;
  into.materials["table"].reflectance.value = 0.8;
  into.shapes.push_back(
      shape_of("table", into.own_mesh("table", polygon({{-a, 0, a}, {a, 0, a}, {a, 0, -a}, {-a, 0, -a}})), into));
  preset::Light lamp;
  lamp.type = preset::Light::Type::spot;
  const glm::dvec3 target(0, 0.4 * width, 0), position(2 * width, 5 * width, -1.7 * width);
  lamp.position = scene::to_vec3(position);
  lamp.direction = scene::to_vec3(glm::normalize(target - position));
  lamp.half_angle_deg = 75;
  lamp.power_w = 0.1;
  into.lamps.push_back(lamp);
  DescribedSurroundings& surroundings = into.surroundings.emplace();
  surroundings.scale = 0.3;
  surroundings.lights = false;
  DescribedCamera& camera = into.camera.emplace();
  const glm::dvec3 eye(0, 2.4 * width, 3 * width), forward = glm::normalize(glm::dvec3(0, 0.25, 0.2) * width - eye),
                                                   right(1, 0, 0);
  camera.where = into.source.string();
  camera.to_world = {glm::dvec4(right, 0), glm::dvec4(glm::cross(right, forward), 0), glm::dvec4(forward, 0),
                     glm::dvec4(eye, 1)};
  into.fits_white = true;
}

} // namespace

void describe_gemcad(const std::filesystem::path& file, Description& into) {
  into.source = file;
  const GemcadFile gem(file, into);
  ConvexBody stone = stone_of(gem, into);
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : stone.corners) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const double scale = stone_mm / std::max(high.x - low.x, high.z - low.z);
  into.note(fmt::format("the file has no unit of length: the stone is {:g} mm across, {:.6g} times the file's lengths",
                        stone_mm, scale));
  if (!gem.index_of_refraction)
    into.note(fmt::format("the file has no index of refraction: {} of quartz takes its place", quartz));
  for (glm::dvec3& p : stone.corners) p *= scale;
  into.length = preset::Preset::Unit::mm;
  into.dielectrics["stone"] =
      gem.index_of_refraction ? glass_of(*gem.index_of_refraction, gem.refraction_where) : glass_of(quartz, {});
  DescribedShape& shape = into.shapes.emplace_back(shape_of("stone", into.own_mesh("stone", mesh_of(stone)), into));
  constexpr double gap = 0.15; // below the stone, in its widths
  shape.to_world = glm::translate(glm::dmat4(1), glm::dvec3(0, gap * stone_mm - scale * low.y, 0));
  show(stone_mm, into);
}

} // namespace nephroid::formats
