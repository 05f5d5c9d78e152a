// SPDX-License-Identifier: Apache-2.0
// Wavefront OBJ, all groups as one: v, vn, vt and f; what else a file has moves no triangle.
#include "base/numbers.h"
#include "scene/mesh_parts.h"
#include "scene/mesh_raw.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace nephroid::scene {
namespace {

constexpr std::uint32_t none = ~0u;

class ObjReader {
public:
  RawMesh read(std::string text) {
    join_lines(text);
    std::string_view rest = text;
    if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3); // a byte order mark
    while (!rest.empty()) {
      ++line_;
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      read_line(rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    if (mesh_.triangles.empty() && has_surfaces_)
      throw std::runtime_error("it has free-form surfaces (surf) alone, and no triangles");
    if (!has_normals_) mesh_.normals.clear();
    if (!has_texcoords_) mesh_.texcoords.clear();
    return std::move(mesh_);
  }

private:
  /// A line that ends in a backslash goes on in the next one.
  static void join_lines(std::string& text) {
    for (std::size_t at = text.find('\\'); at != std::string::npos; at = text.find('\\', at + 1)) {
      const std::size_t end = text.compare(at + 1, 2, "\r\n") == 0 ? 3 : text.compare(at + 1, 1, "\n") == 0 ? 2 : 0;
      std::fill_n(text.begin() + static_cast<std::ptrdiff_t>(at), end, ' ');
    }
  }

  void read_line(std::string_view line) {
    const std::string_view word = next_word(line);
    if (word == "v")
      add_vertex(line);
    else if (word == "vn")
      normals_.push_back(direction_of(three(line)));
    else if (word == "vt")
      add_texcoord(line);
    else if (word == "f")
      add_face(line);
    else if (word == "surf")
      has_surfaces_ = true;
  }

  glm::dvec3 three(std::string_view& line) const {
    glm::dvec3 numbers;
    for (int i = 0; i < 3; ++i) numbers[i] = coordinate_of(next_word(line), line_);
    return numbers;
  }

  void add_vertex(std::string_view line) {
    glm::dvec3 place = three(line);
    const std::string_view weight = next_word(line);
    // A fourth number alone divides the others; more of them are a colour.
    if (!weight.empty() && !weight.starts_with('#') && next_word(line).empty()) {
      const double w = coordinate_of(weight, line_);
      if (w == 0) throw std::runtime_error(fmt::format("line {}: a vertex has the weight 0", line_));
      place /= w;
    }
    if (mesh_.positions.size() >= 3 * max_triangles) throw std::runtime_error("too many vertices");
    mesh_.positions.push_back(place);
    mesh_.normals.emplace_back(0);
    uses_.push_back({none, none});
    places_.push_back(static_cast<std::uint32_t>(mesh_.positions.size() - 1));
  }

  /// What is missing or no number is 0: a texture must not spoil a mesh.
  void add_texcoord(std::string_view line) {
    glm::vec2& texcoord = texcoords_.emplace_back(0);
    for (int axis = 0; axis < 2; ++axis)
      if (const auto number = typed_number<float>(next_word(line)); number && std::isfinite(*number))
        texcoord[axis] = *number;
  }

  /// (0, 0) where there is none of this index.
  glm::vec2 texcoord_at(std::string_view word) {
    const auto number = typed_number<std::int64_t>(word);
    const std::int64_t count = static_cast<std::int64_t>(texcoords_.size()), found = !number       ? -1
                                                                                     : *number < 0 ? count + *number
                                                                                                   : *number - 1;
    if (found < 0 || found >= count) return glm::vec2(0);
    has_texcoords_ = true;
    return texcoords_[static_cast<std::size_t>(found)];
  }

  /// From 1, or from the last one backwards.
  std::size_t index(std::string_view word, std::size_t count, const char* what) const {
    const auto number = typed_number<std::int64_t>(word);
    if (!number)
      throw std::runtime_error(fmt::format("line {}: '{}' is no index of a {}", line_, printable(word), what));
    const std::int64_t last = static_cast<std::int64_t>(count), found = *number < 0 ? last + *number : *number - 1;
    if (*number == 0 || found < 0 || found >= last)
      throw std::runtime_error(fmt::format("line {}: the index {} of a {} is out of range: there are {}, from 1", line_,
                                           *number, what, count));
    return static_cast<std::size_t>(found);
  }

  void add_face(std::string_view line) {
    corners_.clear();
    corner_texcoords_.clear();
    for (std::string_view word = next_word(line); !word.empty() && !word.starts_with('#'); word = next_word(line)) {
      const std::size_t first = std::min(word.find('/'), word.size()), last = word.rfind('/');
      const std::size_t vertex = index(word.substr(0, first), places_.size(), "vertex");
      const bool has_normal = last != std::string_view::npos && last != first && last + 1 < word.size();
      corners_.push_back(
          has_normal ? with_normal(places_[vertex],
                                   static_cast<std::uint32_t>(index(word.substr(last + 1), normals_.size(), "normal")))
                     : places_[vertex]);
      const std::string_view rest = word.substr(std::min(first + 1, word.size())),
                             texcoord = rest.substr(0, rest.find('/'));
      corner_texcoords_.push_back(texcoord_at(texcoord));
    }
    if (texcoords_.empty()) return add_polygon(mesh_, corners_);
    mesh_.texcoords.resize(mesh_.triangles.size()); // those before the first vt have none
    add_polygon(mesh_, corners_, corner_texcoords_);
  }

  /// The vertex itself for its first normal; one at the same place for each other.
  std::uint32_t with_normal(std::uint32_t vertex, std::uint32_t normal) {
    has_normals_ = true;
    for (; uses_[vertex].normal != normal; vertex = uses_[vertex].next) {
      if (uses_[vertex].normal == none) { // nobody has used it with a normal
        uses_[vertex].normal = normal;
        mesh_.normals[vertex] = normals_[normal];
        break;
      }
      if (uses_[vertex].next != none) continue;
      uses_[vertex].next = static_cast<std::uint32_t>(mesh_.positions.size());
      mesh_.positions.push_back(glm::dvec3(mesh_.positions[vertex]));
      mesh_.normals.emplace_back(0);
      uses_.push_back({none, none});
    }
    return vertex;
  }

  struct Use {
    std::uint32_t normal; ///< index of normals_
    std::uint32_t next;   ///< a vertex at the same place with another one
  };

  RawMesh mesh_;
  std::vector<std::uint32_t> places_; ///< the file's vertices among mesh_'s
  std::vector<glm::vec3> normals_;    ///< the file's
  std::vector<glm::vec2> texcoords_;  ///< the file's
  std::vector<Use> uses_;             ///< of each vertex of mesh_
  std::vector<std::uint32_t> corners_;
  std::vector<glm::vec2> corner_texcoords_;
  std::size_t line_ = 0;
  bool has_normals_ = false, has_texcoords_ = false, has_surfaces_ = false;
};

} // namespace

RawMesh read_obj(std::string text) { return ObjReader().read(std::move(text)); }

} // namespace nephroid::scene
