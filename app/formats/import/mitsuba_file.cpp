// SPDX-License-Identifier: Apache-2.0
#include "formats/import/mitsuba_file.h"

#include "base/error.h"
#include "base/files.h"
#include "formats/import/description.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace nephroid::formats {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t max_files = 1000;

std::size_t line_of(const std::string& text, std::ptrdiff_t offset) {
  const auto end = text.begin() + std::clamp<std::ptrdiff_t>(offset, 0, std::ssize(text));
  return 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n'));
}

} // namespace

std::string mitsuba_name(const std::string& name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool upper = name[i] >= 'A' && name[i] <= 'Z';
    if (upper && i > 0 && name[i - 1] >= 'a' && name[i - 1] <= 'z') text += '_';
    text += upper ? static_cast<char>(name[i] - 'A' + 'a') : name[i];
  }
  return text;
}

MitsubaFile::MitsubaFile(const fs::path& scene) { load(scene, {}); }

void MitsubaFile::load(const fs::path& file, xml_node by) {
  const fs::path whole = fs::absolute(file).lexically_normal();
  if (std::ranges::count(open_, whole) > 0)
    throw bad_input(at(by), "the file " + file.string() + " includes itself", {}, "take this <include> out");
  if (documents_.size() >= max_files)
    throw bad_input(at(by), fmt::format("the scene has more than {} files", max_files));
  Document& document = documents_.emplace_back();
  document.file = file;
  document.text = read_file(file);
  const auto result = document.xml.load_buffer(document.text.data(), document.text.size());
  if (!result)
    throw bad_input(Location(file.string(), line_of(document.text, result.offset)),
                    std::string("its XML is broken: ") + result.description(), "expected a Mitsuba scene",
                    "check that the file is whole");
  const xml_node root = document.xml.document_element();
  for (xml_node more = root.next_sibling(); more; more = more.next_sibling())
    if (more.type() == pugi::node_element)
      throw bad_input(at(more), "a second <" + std::string(more.name()) + "> begins behind the scene's end",
                      "expected one scene", "check that the file is not doubled");
  open_.push_back(whole);
  if (std::string_view(root.name()) == "scene")
    for (const xml_node node : root.children()) take(node);
  else if (by) // a file that is included may be one object
    take(root);
  else
    throw bad_input(file.string(), "is no Mitsuba scene: it has no <scene>", "expected a Mitsuba scene");
  open_.pop_back();
}

void MitsubaFile::take(xml_node node) {
  if (node.type() != pugi::node_element) return;
  const std::string_view kind = node.name();
  take_ids(node);
  if (kind == "default") {
    defaults_.try_emplace(node.attribute("name").value(), attribute(node, "value"));
  } else if (kind == "include") {
    const fs::path file = find(node, attribute(node, "filename"));
    if (!is_there(file)) throw bad_input(at(node), "the file " + file.string() + " is not there", {}, "put it there");
    load(file, node);
  } else if (kind == "path") {
    const fs::path folder = find(node, attribute(node, "value"));
    if (!fs::is_directory(folder)) throw bad_input(at(node), "the folder " + folder.string() + " is not there");
    folders_.insert(folders_.begin(), folder);
  } else if (kind == "alias") {
    aliases_.try_emplace(attribute(node, "as"), attribute(node, "id"));
  } else
    nodes_.push_back(node);
}

void MitsubaFile::take_ids(xml_node node) {
  // No recursion: a file may nest as deep as it likes.
  for (xml_node here = node; here;) {
    const std::string_view kind = here.name();
    if (here.attribute("id") && kind != "ref" && kind != "alias") {
      const auto [known, is_new] = ids_.try_emplace(attribute(here, "id"), here);
      if (!is_new && known->second != here)
        throw bad_input(at(here), "the id \"" + known->first + "\" is given twice",
                        "expected another than in line " + std::to_string(at(known->second).line));
    }
    if (here.first_child()) {
      here = here.first_child();
      continue;
    }
    while (here != node && !here.next_sibling()) here = here.parent();
    here = here == node ? xml_node() : here.next_sibling();
  }
}

fs::path MitsubaFile::find(xml_node node, const std::string& name) const {
  const fs::path beside_scene = documents_.front().file.parent_path(), beside = document_of(node).file.parent_path();
  std::vector<fs::path> folders = folders_;
  folders.insert(folders.end(), {beside_scene, beside, fs::path()});
  for (const fs::path& folder : folders)
    if (!name.empty() && is_there(folder / name)) return folder / name;
  return beside_scene / name;
}

xml_node MitsubaFile::meant(xml_node node) const {
  for (int step = 0; std::string_view(node.name()) == "ref"; ++step) {
    std::string id = attribute(node, "id");
    for (std::size_t i = 0; i < aliases_.size() && aliases_.contains(id); ++i) id = aliases_.at(id);
    const auto found = ids_.find(id);
    if (found == ids_.end())
      throw bad_input(at(node), "nothing has the id \"" + id + "\"", "expected an id of the scene");
    // What holds the reference cannot be in itself.
    for (xml_node holder = node.parent(); holder; holder = holder.parent())
      if (holder == found->second || step > 100) throw bad_input(at(node), "\"" + id + "\" refers to itself");
    node = found->second;
  }
  return node;
}

std::vector<xml_node> MitsubaFile::objects(xml_node parent, const std::string& tag) const {
  std::vector<xml_node> objects_of_tag;
  for (const xml_node node : parent.children())
    if (const xml_node object = meant(node); object.name() == tag) objects_of_tag.push_back(object);
  return objects_of_tag;
}

xml_node MitsubaFile::object(xml_node parent, const std::string& tag, const std::string& name) const {
  for (const xml_node node : parent.children())
    if (name.empty() || mitsuba_name(node.attribute("name").value()) == name)
      if (const xml_node object = meant(node); object.name() == tag) return object;
  return {};
}

const MitsubaFile::Document& MitsubaFile::document_of(xml_node node) const {
  const auto found = std::ranges::find_if(documents_, [&](const Document& d) { return d.xml.root() == node.root(); });
  return found == documents_.end() ? documents_.front() : *found;
}

Location MitsubaFile::at(xml_node node) const {
  const Document& document = document_of(node);
  return {document.file.string(), line_of(document.text, node.offset_debug())};
}

std::string MitsubaFile::attribute(xml_node node, const char* key) const {
  std::string text = node.attribute(key).value();
  for (std::size_t from = text.find('$'); from != std::string::npos; from = text.find('$', from)) {
    std::size_t to = from + 1;
    while (to < text.size() && (std::isalnum(static_cast<unsigned char>(text[to])) || text[to] == '_')) ++to;
    const auto found = defaults_.find(text.substr(from + 1, to - from - 1));
    if (found == defaults_.end())
      throw bad_input(at(node), text.substr(from, to - from) + " has no value", "expected a <default>");
    text.replace(from, to - from, found->second);
    from += found->second.size();
  }
  return text;
}

std::vector<double> MitsubaFile::numbers(xml_node node, const char* key) const {
  std::string text = attribute(node, key);
  std::ranges::replace(text, ',', ' ');
  std::vector<double> values;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const auto value = scene_number(word);
    if (!value) throw bad_input(at(node), fmt::format("\"{}\" is no number", text), "expected numbers");
    values.push_back(*value);
  }
  return values;
}

double MitsubaFile::number_of(xml_node node, double standard, const char* key) const {
  if (!node.attribute(key)) return standard;
  const auto values = numbers(node, key);
  if (values.size() != 1) throw bad_input(at(node), fmt::format("\"{}\" is no number", key), "expected one number");
  return values[0];
}

glm::dvec3 MitsubaFile::vector_of(xml_node node, double standard, const char* key) const {
  if (!node.attribute(key))
    return {number_of(node, standard, "x"), number_of(node, standard, "y"), number_of(node, standard, "z")};
  const auto v = numbers(node, key);
  if (v.size() == 1) return glm::dvec3(v[0]);
  if (v.size() != 3) throw bad_input(at(node), fmt::format("\"{}\" has {} numbers", key, v.size()), "expected three");
  return {v[0], v[1], v[2]};
}

xml_node MitsubaFile::child(xml_node parent, const std::string& name) const {
  const xml_node found =
      parent.find_child([&](xml_node node) { return mitsuba_name(node.attribute("name").value()) == name; });
  if (found) asked_.insert(found.hash_value());
  return meant(found);
}

std::vector<xml_node> MitsubaFile::unasked(xml_node parent) const {
  static const std::set<std::string_view> values{"float", "integer",  "boolean",   "string",  "rgb",   "srgb",
                                                 "color", "spectrum", "blackbody", "texture", "point", "vector"};
  std::vector<xml_node> nodes;
  for (const xml_node node : parent.children())
    if (node.attribute("name") && values.contains(node.name()) && !asked_.contains(node.hash_value()))
      nodes.push_back(node);
  return nodes;
}

double MitsubaFile::number(xml_node parent, const std::string& name, double standard) const {
  return number_of(child(parent, name), standard);
}

std::string MitsubaFile::text(xml_node parent, const std::string& name, const std::string& standard) const {
  const xml_node node = child(parent, name);
  return node ? attribute(node, "value") : standard;
}

glm::dvec3 MitsubaFile::point(xml_node parent, const std::string& name, const glm::dvec3& standard) const {
  const xml_node node = child(parent, name);
  return node ? vector_of(node, 0) : standard;
}

glm::dmat4 MitsubaFile::to_world(xml_node parent, const char* name) const {
  glm::dmat4 all(1);
  for (const xml_node step : child(parent, name).children())
    if (step.type() == pugi::node_element) all = step_of(step) * all;
  require_inverse(all, at(child(parent, name) ? child(parent, name) : parent));
  return all;
}

glm::dmat4 MitsubaFile::step_of(xml_node step) const {
  const std::string kind = mitsuba_name(step.name());
  const glm::dmat4 one(1);
  if (kind == "translate") return glm::translate(one, vector_of(step, 0));
  if (kind == "scale") return glm::scale(one, vector_of(step, 1));
  if (kind == "rotate") return rotated(one, number_of(step, 0, "angle"), vector_of(step, 0), at(step));
  if (kind == "lookat" || kind == "look_at")
    return look_at(vector_of(step, 0, "origin"), vector_of(step, 0, "target"),
                   step.attribute("up") ? vector_of(step, 0, "up") : glm::dvec3(0, 1, 0), at(step));
  if (kind != "matrix")
    throw bad_input(at(step), "<" + kind + "> is no transform", "expected translate, rotate, scale, matrix or lookat");
  const auto v = numbers(step, "value");
  if (v.size() == 16) return glm::transpose(glm::make_mat4(v.data()));
  if (v.size() == 9) return glm::dmat4(glm::transpose(glm::make_mat3(v.data())));
  throw bad_input(at(step), fmt::format("the matrix has {} numbers", v.size()), "expected 16 or 9");
}

} // namespace nephroid::formats
