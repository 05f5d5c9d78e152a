// SPDX-License-Identifier: Apache-2.0
// The XML of a Mitsuba scene and of the files that it includes, and the values in it. Names of version 0.6 are those
// since version 2: "toWorld" is "to_world". What is no such value is bad_input at FILE:LINE.
#pragma once
#include "base/location.h"

#include <glm/glm.hpp>
#include <pugixml.hpp>

#include <list>
#include <map>
#include <set>
#include <vector>

namespace nephroid::formats {

using pugi::xml_node;

std::string mitsuba_name(const std::string& name);

class MitsubaFile {
public:
  /// Reads the scene and all that it includes: names are looked up in each <path>, beside the scene, beside the file
  /// that has the name, in the current folder. Throws bad_input for a file that is not there or includes itself.
  explicit MitsubaFile(const std::filesystem::path& scene);

  /// What the scene has, in the order of the files.
  const std::vector<xml_node>& nodes() const { return nodes_; }
  Location at(xml_node node) const;
  /// The file that a node names, or where it is missed.
  std::filesystem::path find(xml_node node, const std::string& name) const;

  /// Follows a <ref>, whether what it names stands above it or below. Throws bad_input where nothing has its id.
  xml_node meant(xml_node node) const;
  /// The first child with this tag, own or by reference; name: its attribute, or anything.
  xml_node object(xml_node parent, const std::string& tag, const std::string& name = {}) const;
  /// All children with this tag, own or by reference.
  std::vector<xml_node> objects(xml_node parent, const std::string& tag) const;

  /// An attribute with its $names replaced.
  std::string attribute(xml_node node, const char* key) const;
  /// "value", or another attribute, as numbers; as one number or as three; else `standard`.
  std::vector<double> numbers(xml_node node, const char* key = "value") const;
  double number_of(xml_node node, double standard, const char* key = "value") const;
  glm::dvec3 vector_of(xml_node node, double standard, const char* key = "value") const;

  /// The child with this attribute "name", own or by reference, and what it holds.
  xml_node child(xml_node parent, const std::string& name) const;
  /// The children that are values and that child() was never asked for.
  std::vector<xml_node> unasked(xml_node parent) const;
  double number(xml_node parent, const std::string& name, double standard) const;
  bool flag(xml_node parent, const std::string& name) const { return text(parent, name, "false") == "true"; }
  std::string text(xml_node parent, const std::string& name, const std::string& standard) const;
  glm::dvec3 point(xml_node parent, const std::string& name, const glm::dvec3& standard) const;
  /// Throws bad_input where it has no inverse.
  glm::dmat4 to_world(xml_node parent, const char* name = "to_world") const;

private:
  struct Document {
    std::filesystem::path file;
    std::string text;
    pugi::xml_document xml;
  };

  void load(const std::filesystem::path& file, xml_node by);
  void take(xml_node node);
  void take_ids(xml_node node);
  const Document& document_of(xml_node node) const;
  glm::dmat4 step_of(xml_node step) const;

  std::list<Document> documents_;
  std::vector<std::filesystem::path> open_;    ///< the files that are being read, each included by the one before
  std::vector<std::filesystem::path> folders_; ///< those of <path>, the last one first
  std::vector<xml_node> nodes_;
  std::map<std::string, xml_node> ids_;
  std::map<std::string, std::string> aliases_; ///< ids by other names
  std::map<std::string, std::string> defaults_;
  mutable std::set<std::size_t> asked_; ///< hashes of what child() found
};

} // namespace nephroid::formats
