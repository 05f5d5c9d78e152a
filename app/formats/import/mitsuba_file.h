// SPDX-License-Identifier: Apache-2.0
// The XML of a Mitsuba scene and of the files that it includes, and the values in it. Names of version 0.6 are those
// since version 2: "toWorld" is "to_world". What is no such value is bad_input at FILE:LINE.
#pragma once
#include "base/location.h"

#include <glm/glm.hpp>
#include <pugixml.hpp>

#include <list>
#include <map>
#include <vector>

namespace nephroid::formats {

using pugi::xml_node;

std::string mitsuba_name(const std::string& name);

class MitsubaFile {
public:
  /// The <scene> of one more file.
  xml_node load(const std::filesystem::path& file);
  Location at(xml_node node) const;
  std::filesystem::path beside(xml_node node, const std::string& file) const {
    return document_of(node).file.parent_path() / file;
  }

  /// Gives a $name its value, unless it has one.
  void set_default(xml_node node);
  /// An attribute with its $names replaced.
  std::string attribute(xml_node node, const char* key) const;
  /// "value", or another attribute, as one number or as three; else `standard`.
  double number_of(xml_node node, double standard, const char* key = "value") const;
  glm::dvec3 vector_of(xml_node node, double standard, const char* key = "value") const;

  /// The child with this attribute "name", and what it holds.
  static xml_node child(xml_node parent, const std::string& name);
  double number(xml_node parent, const std::string& name, double standard) const;
  std::string text(xml_node parent, const std::string& name, const std::string& standard) const;
  glm::dvec3 point(xml_node parent, const std::string& name, const glm::dvec3& standard) const;
  glm::dmat4 to_world(xml_node parent) const;

private:
  struct Document {
    std::filesystem::path file;
    std::string text;
    pugi::xml_document xml;
  };

  const Document& document_of(xml_node node) const;
  std::vector<double> numbers(xml_node node, const char* key) const;
  glm::dmat4 step_of(xml_node node) const;

  std::list<Document> documents_;
  std::map<std::string, std::string> defaults_;
};

} // namespace nephroid::formats
