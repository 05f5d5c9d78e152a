// SPDX-License-Identifier: Apache-2.0
// Settings of an engine made from its struct's description: settings_type<S>() is how an engine tells the preset what its section holds.
// Included where an engine describes its settings and nowhere else.
#pragma once
#include "preset/file_names.h"
#include "preset/outline_visitor.h"
#include "preset/reader_visitor.h"
#include "preset/schema_visitor.h"
#include "preset/settings.h"
#include "preset/writer.h"

#include <any>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid::preset {

/// Where a JSON pointer's value came from, for messages.
using Where = std::function<Place(const std::string& pointer)>;

struct SettingsType {
  std::string_view name;     ///< of the engine: the word in "engine" and the key of the section
  std::string_view sentence; ///< what the engine is for
  /// What one field cannot say alone, of a preset with these settings. Throws bad_input at where(pointer) of the first contradiction.
  void (*check)(const Preset& preset, const Where& where);

  std::any (*make)();
  bool (*equal)(const std::any& a, const std::any& b);
  void (*read)(const Document& document, const Json& json, const std::string& pointer, std::any& settings);
  Json (*write)(const std::any& settings);
  Json (*schema)(Json& definitions, Presence presence);
  Json (*fresh)();                                      ///< by default
  std::vector<Outline> (*fields)(const Json& settings); ///< as data
  void (*name_files)(std::any& settings, const FileNames::Rename& rename);
};

template <Described S>
constexpr SettingsType settings_type(std::string_view name, std::string_view sentence, void (*check)(const Preset&, const Where&))
{
  return {.name = name,
          .sentence = sentence,
          .check = check,
          .make = [] { return std::any(S{}); },
          .equal = [](const std::any& a, const std::any& b) { return std::any_cast<const S&>(a) == std::any_cast<const S&>(b); },
          .read = [](const Document& document, const Json& json, const std::string& pointer,
                     std::any& settings) { Reader::read(document, json, pointer, std::any_cast<S&>(settings)); },
          .write = [](const std::any& settings) { return Writer::json(std::any_cast<const S&>(settings)); },
          .schema = [](Json& definitions, Presence presence) { return Properties::reference<S>(definitions, presence); },
          .fresh = fresh<S>,
          .fields = fields_of<S>,
          .name_files =
              [](std::any& settings, const FileNames::Rename& rename) {
                FileNames names(rename);
                describe(names, std::any_cast<S&>(settings));
              }};
}

} // namespace nephroid::preset
