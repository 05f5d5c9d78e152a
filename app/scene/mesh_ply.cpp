// SPDX-License-Identifier: Apache-2.0
// PLY, by the elements and types that its header declares (Turk 1994, "The PLY polygon file format"): vertices, faces
// and strips of triangles. Nothing is believed of what it promises: memory grows with what comes.
#include "base/numbers.h"
#include "scene/mesh_parts.h"
#include "scene/mesh_raw.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <stdexcept>

namespace nephroid::scene {
namespace {

template <class Number>
double read_as(const char* from, bool reversed) {
  std::array<char, sizeof(Number)> bytes{};
  std::memcpy(bytes.data(), from, sizeof bytes);
  if (reversed) std::reverse(bytes.begin(), bytes.end());
  return static_cast<double>(std::bit_cast<Number>(bytes));
}

struct Type {
  std::string_view name, other_name;
  std::size_t bytes;
  double (*read)(const char*, bool reversed);
};

constexpr Type types[] = {{"char", "int8", 1, read_as<std::int8_t>},    {"uchar", "uint8", 1, read_as<std::uint8_t>},
                          {"short", "int16", 2, read_as<std::int16_t>}, {"ushort", "uint16", 2, read_as<std::uint16_t>},
                          {"int", "int32", 4, read_as<std::int32_t>},   {"uint", "uint32", 4, read_as<std::uint32_t>},
                          {"float", "float32", 4, read_as<float>},      {"double", "float64", 8, read_as<double>}};

struct Property {
  const Type* count = nullptr; ///< of a list: the type of its length
  const Type* type = nullptr;
  /// Of a vertex: 0 to 2 its position, 3 to 5 its normal, 6 and 7 its u, v. Of a face or strip: 0, its corners, and 1,
  /// u, v of each.
  int place = -1;
};

enum class Kind { vertex, face, strip, other };

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
  Kind kind = Kind::other;
};

class PlyReader {
public:
  explicit PlyReader(std::string_view bytes) : rest_(bytes) { read_header(); }

  RawMesh read() {
    for (const Element& element : elements_) {
      if (element.properties.empty()) continue;
      for (std::uint64_t i = 0; i < element.count; ++i) {
        if (read_item(element)) {
          take(element, i);
          continue;
        }
        throw std::runtime_error(fmt::format("the file ends in element {} '{}' of the {} that its header declares; it "
                                             "is cut",
                                             i, printable(element.name), element.count));
      }
    }
    // Faces may stand before the vertices that they name.
    for (std::size_t i = 0, begin = 0; i < ends_.size(); begin = ends_[i++]) add_list(begin, ends_[i], i);
    if (!has_normals_) mesh_.normals.clear();
    return std::move(mesh_);
  }

private:
  static const Type* type_of(std::string_view name) {
    for (const Type& type : types)
      if (type.name == name || type.other_name == name) return &type;
    throw std::runtime_error(fmt::format("the PLY header has the unknown type '{}'", printable(name)));
  }

  void read_header() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      std::string_view line = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      const std::string_view word = next_word(line);
      if (word == "end_header") return;
      if (word == "format") read_format(next_word(line));
      if (word == "element") read_element(line);
      if (word == "property") read_property(line);
    }
    throw std::runtime_error("the PLY header has no end_header");
  }

  void read_format(std::string_view format) {
    is_text_ = format == "ascii";
    is_reversed_ = format == "binary_big_endian";
    if (!is_text_ && !is_reversed_ && format != "binary_little_endian")
      throw std::runtime_error(fmt::format("the PLY header has the unknown format '{}'", printable(format)));
  }

  void read_element(std::string_view line) {
    const std::string_view name = next_word(line), count = next_word(line);
    const auto number = number_in<std::uint64_t>(count);
    if (!number)
      throw std::runtime_error(
          fmt::format("the PLY header declares '{}' elements '{}'", printable(count), printable(name)));
    elements_.push_back({std::string(name),
                         *number,
                         {},
                         name == "vertex"      ? Kind::vertex
                         : name == "face"      ? Kind::face
                         : name == "tristrips" ? Kind::strip
                                               : Kind::other});
  }

  void read_property(std::string_view line) {
    if (elements_.empty()) throw std::runtime_error("the PLY header has a property before any element");
    Element& element = elements_.back();
    Property property;
    std::string_view type = next_word(line);
    if (type == "list") {
      property.count = type_of(next_word(line));
      type = next_word(line);
    }
    property.type = type_of(type);
    const std::string_view name = next_word(line);
    constexpr std::array<std::string_view, 12> numbers{"x", "y", "z", "nx", "ny",        "nz",
                                                       "u", "v", "s", "t",  "texture_u", "texture_v"};
    if (element.kind == Kind::vertex && property.count == nullptr)
      if (const auto found = std::ranges::find(numbers, name); found != numbers.end()) {
        const auto place = static_cast<int>(found - numbers.begin());
        property.place = place < 8 ? place : 6 + place % 2;
        has_normals_ |= property.place > 2 && property.place < 6;
        has_texcoords_ |= property.place >= 6;
      }
    if ((element.kind == Kind::face || element.kind == Kind::strip) && property.count != nullptr &&
        (name == "vertex_indices" || name == "vertex_index"))
      property.place = 0;
    if (element.kind == Kind::face && property.count != nullptr && name == "texcoord") {
      property.place = 1;
      has_texcoords_ = true;
    }
    element.properties.push_back(property);
  }

  /// The next number of this type; false where there is none. is_texcoord: what is no number is none of a surface.
  bool read_number(const Type& type, double& number, bool is_texcoord = false) {
    if (is_text_) {
      const std::string_view word = next_word(rest_);
      if (word.empty()) return false;
      number = is_texcoord ? typed_number<double>(word).value_or(0) : coordinate_of(word, 0);
      return true;
    }
    if (rest_.size() < type.bytes) return false;
    number = type.read(rest_.data(), is_reversed_ == (std::endian::native == std::endian::little));
    rest_.remove_prefix(type.bytes);
    return true;
  }

  bool skip_number(const Type& type) {
    if (is_text_) return !next_word(rest_).empty();
    if (rest_.size() < type.bytes) return false;
    rest_.remove_prefix(type.bytes);
    return true;
  }

  /// Into vertex_ or corners_.
  bool read_item(const Element& element) {
    vertex_ = {};
    for (const Property& property : element.properties) {
      double length = 1;
      if (property.count != nullptr &&
          (!read_number(*property.count, length) || !(length >= 0) || length > static_cast<double>(rest_.size())))
        return false;
      for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(length); ++i) {
        double number = 0;
        const bool is_texcoord = property.place == (element.kind == Kind::vertex ? std::max(property.place, 6) : 1);
        if (property.place < 0 ? !skip_number(*property.type) : !read_number(*property.type, number, is_texcoord))
          return false;
        if (property.place < 0) continue;
        if (element.kind == Kind::vertex)
          vertex_[static_cast<std::size_t>(property.place)] = number;
        else
          (property.place == 0 ? corners_ : corner_texcoords_).push_back(number);
      }
    }
    return true;
  }

  void take(const Element& element, std::uint64_t index) {
    if (element.kind == Kind::vertex) {
      for (std::size_t i = 0; i < 3; ++i)
        if (!std::isfinite(static_cast<float>(vertex_[i])))
          throw std::runtime_error(fmt::format("vertex {} has a coordinate that is not a finite number", index));
      if (mesh_.positions.size() >= 3 * max_triangles) throw std::runtime_error("too many vertices");
      mesh_.positions.emplace_back(vertex_[0], vertex_[1], vertex_[2]);
      if (has_normals_) mesh_.normals.push_back(direction_of({vertex_[3], vertex_[4], vertex_[5]}));
      if (has_texcoords_) vertex_texcoords_.push_back(texcoord_of(vertex_[6], vertex_[7]));
    } else if (element.kind != Kind::other) {
      ends_.push_back(corners_.size());
      texcoord_ends_.push_back(corner_texcoords_.size());
      is_strip_.push_back(element.kind == Kind::strip);
    }
  }

  /// What is no number, or too large for one, is 0: a texture must not spoil a mesh.
  static glm::vec2 texcoord_of(double u, double v) {
    const glm::vec2 place(u, v);
    return std::isfinite(place.x) && std::isfinite(place.y) ? place : glm::vec2(0);
  }

  void add(std::span<const std::uint32_t> polygon, std::size_t index) {
    if (!has_texcoords_) return add_polygon(mesh_, polygon);
    const std::size_t first = index > 0 ? texcoord_ends_[index - 1] : 0;
    const bool by_corner = texcoord_ends_[index] - first == 2 * polygon.size();
    polygon_texcoords_.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i)
      polygon_texcoords_.push_back(
          by_corner ? texcoord_of(corner_texcoords_[first + 2 * i], corner_texcoords_[first + 2 * i + 1])
                    : vertex_texcoords_[polygon[i]]);
    add_polygon(mesh_, polygon, polygon_texcoords_);
  }

  void add_list(std::size_t begin, std::size_t end, std::size_t index) {
    const std::string what = fmt::format("{} {}", is_strip_[index] ? "strip" : "face", index);
    polygon_.clear();
    bool turned = false;
    for (std::size_t i = begin; i < end; ++i) {
      if (is_strip_[index] && corners_[i] < 0) { // the next strip begins
        polygon_.clear();
        turned = false;
        continue;
      }
      polygon_.push_back(vertex_of(corners_[i], mesh_, what));
      if (!is_strip_[index] || polygon_.size() < 3) continue;
      add(turned ? std::array{polygon_[1], polygon_[0], polygon_[2]}
                 : std::array{polygon_[0], polygon_[1], polygon_[2]},
          index);
      turned = !turned;
      polygon_.erase(polygon_.begin());
    }
    if (!is_strip_[index]) add(polygon_, index);
  }

  std::string_view rest_;
  std::vector<Element> elements_;
  bool is_text_ = true, is_reversed_ = false, has_normals_ = false, has_texcoords_ = false;
  std::array<double, 8> vertex_{};
  std::vector<glm::vec2> vertex_texcoords_;
  std::vector<double> corners_;            ///< of all faces and strips
  std::vector<std::size_t> ends_;          ///< of each in corners_
  std::vector<double> corner_texcoords_;   ///< of all faces that have them
  std::vector<std::size_t> texcoord_ends_; ///< of each face and strip in corner_texcoords_
  std::vector<bool> is_strip_;
  std::vector<std::uint32_t> polygon_;
  std::vector<glm::vec2> polygon_texcoords_;
  RawMesh mesh_;
};

} // namespace

RawMesh read_ply(std::string_view bytes) { return PlyReader(bytes).read(); }

} // namespace nephroid::scene
