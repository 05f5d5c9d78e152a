// SPDX-License-Identifier: Apache-2.0
// A glTF 2.0 file as JSON with its binary chunk, and reading that JSON strictly: every wrong type and every index out
// of range is an error at its place.
#pragma once
#include "base/location.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace nephroid::formats {

using GltfJson = nlohmann::json;

struct GltfFile {
  std::filesystem::path file;
  GltfJson json;   ///< an object
  std::string bin; ///< the binary chunk of a .glb
  Location where() const { return {file.string(), std::string()}; }
};

/// Throws bad_input where it is no glTF 2.0, with what it is as far as that can be told, is cut, or has its triangles
/// compressed.
GltfFile read_gltf(const std::filesystem::path& file);

/// A value of the file, with its place.
class GltfValue {
public:
  GltfValue(const GltfJson& json, Location where) : json_(&json), where_(std::move(where)) {}

  const GltfJson& json() const { return *json_; }
  const Location& where() const { return where_; }
  bool has(const char* key) const { return json_->contains(key); }
  /// A member of an object, which is an object itself; an empty one if there is none.
  GltfValue object(const char* key) const;
  /// "extensions" / name, an empty object without it.
  GltfValue extension(const char* name) const { return object("extensions").object(name); }
  /// A list of objects; empty without it.
  std::vector<GltfValue> list(const char* key) const;
  /// An item of a list of objects. Throws if the list has no such index.
  GltfValue item(const char* key, std::size_t index) const;
  /// The item of root's list whose index this value has.
  GltfValue item(const char* key, const GltfValue& root, const char* list) const;

  double number(const char* key, double standard) const;
  /// Whole and not negative, below 2^32.
  std::uint64_t count(const char* key, std::uint64_t standard) const;
  std::string text(const char* key) const;               ///< empty without it
  std::vector<std::string> texts(const char* key) const; ///< a list; empty without it
  bool truth(const char* key, bool standard) const;
  /// An index into root's list, and a list of such.
  std::size_t index(const char* key, const GltfValue& root, const char* list) const;
  std::vector<std::size_t> indices(const char* key, const GltfValue& root, const char* list) const;
  std::vector<double> number_list(const char* key) const; ///< empty without it
  template <std::size_t N>
  std::array<double, N> numbers(const char* key, const std::array<double, N>& standard) const {
    std::array<double, N> values = standard;
    read_numbers(key, values.data(), N);
    return values;
  }

private:
  void read_numbers(const char* key, double* values, std::size_t count) const;
  std::size_t checked_index(const GltfJson& json, const Location& where, const GltfValue& root, const char* list) const;

  const GltfJson* json_;
  Location where_;
};

} // namespace nephroid::formats
