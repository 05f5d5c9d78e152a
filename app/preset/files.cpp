// SPDX-License-Identifier: Apache-2.0
// Preset files: finding them, reading their text, following their parents; and the names of files that a preset holds.
#include "base/files.h"
#include "base/nearest.h"
#include "preset/describe.h"
#include "preset/document.h"
#include "preset/read.h"
#include "preset/walks.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace nephroid::preset {
namespace fs = std::filesystem;
namespace {

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_directory(path, ignored);
}

std::string nearest_shipped(const std::string& name) {
  std::vector<std::string> known;
  if (!presets_folder_if_any().empty())
    for (const ShippedPreset& preset : shipped_presets()) known.push_back(preset.name);
  const std::string found = nearest(name, known);
  return found.empty() ? "see `nephroid presets`" : fmt::format("did you mean '{}'?", found);
}

std::string read_text(const fs::path& file) {
  std::error_code ignored;
  if (const auto size = fs::file_size(file, ignored); !ignored && size > max_file_bytes)
    throw bad_input(file.string(), fmt::format("is {} bytes long", size),
                    fmt::format("expected at most {}", max_file_bytes));
  if (is_file(file) && !fs::is_regular_file(file, ignored)) // reading might never end
    throw bad_input(file.string(), "is not a regular file", "expected a preset in JSON");
  return read_file(file);
}

/// The same file has the same identity, whatever path led to it.
fs::path identity(const fs::path& file) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(file, error);
  return error ? file : canonical;
}

/// file is what messages call it; chain: the files that are being read, each the parent of the one before.
Document document_from(const std::string& text, const fs::path& file, std::vector<fs::path> chain) {
  const std::string name = file.string();
  if (std::all_of(text.begin(), text.end(), [](char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }))
    throw bad_input(name, "is empty", "expected a preset: one JSON object");
  Json value;
  try {
    value = parse_json(text, name);
  } catch (const Error&) {
    if (const std::size_t first = text.find_first_not_of("\xef\xbb\xbf \t\r\n");
        first == text.npos || text[first] == '{' || text[first] == '[')
      throw;
    throw bad_input(name, "is no preset", "expected JSON, which begins with {",
                    "`nephroid import` takes scenes of other programs, a preset's object a mesh");
  }
  if (!value.is_object()) throw bad_input({name, ""}, "is " + shown(value), "expected a preset: one JSON object");
  if (value.contains("$schema")) { // for editors; says nothing about the run
    if (!value["$schema"].is_string())
      throw bad_input(Location(name) / "$schema", "is " + shown(value["$schema"]), "expected a string");
    value.erase("$schema");
  }
  const Origin origin{name, true, file.parent_path()};
  if (!value.contains("parent")) return Document(std::move(value), origin);

  const Location where = Location(name) / "parent";
  if (!value["parent"].is_string())
    throw bad_input(where, "is " + shown(value["parent"]), "expected a path or the name of a shipped preset");
  const fs::path parent = find_preset(value["parent"].get<std::string>(), origin.folder, where);
  value.erase("parent");
  chain.push_back(file);
  if (const auto again =
          std::find_if(chain.begin(), chain.end(), [&](const fs::path& f) { return identity(f) == identity(parent); });
      again != chain.end()) {
    std::string circle;
    for (auto f = again; f != chain.end(); ++f) circle += f->string() + " -> ";
    throw bad_input(where, "parents go round in a circle: " + circle + parent.string());
  }
  Document document = document_from(read_text(parent), parent, std::move(chain));
  for (const char* own : {"name", "description"}) document.take(own); // a child is not called what its parent is called
  document.merge(value, origin);
  return document;
}

/// Absolute and without links, so that two ways to the same file compare equal.
std::optional<fs::path> file_meant(const fs::path& folder, const std::string& name) {
  try {
    return fs::canonical(FileFinder(folder).find(name, ""));
  } catch (const Error&) {
    return std::nullopt; // whoever reads the file will say so
  } catch (const fs::filesystem_error&) {
    return std::nullopt;
  }
}

using VisitName = std::function<void(const std::string& pointer, std::string& name)>;

void visit_files(const Value& value, const Field& field, const std::string& pointer, const VisitName& visit) {
  if (value.kind() == Kind::text && field.text == Text::file) visit(pointer, value.as<std::string>());
  if (value.kind() == Kind::object) {
    for (const Member& member : value.members())
      if (member.value.exists()) visit_files(member.value, member.field, child(pointer, member.field.name), visit);
  } else if (value.kind() == Kind::optional) {
    if (value.count() > 0) visit_files(value[0], field, pointer, visit);
  } else if (value.kind() == Kind::list || value.kind() == Kind::map)
    for (std::size_t i = 0; i < value.count(); ++i)
      visit_files(value[i], field, value.kind() == Kind::map ? child(pointer, value.key(i)) : child(pointer, i), visit);
}

bool same_folder(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  const auto here = [](const fs::path& p) { return p.empty() ? fs::path(".") : p; };
  return a == b || fs::equivalent(here(a), here(b), ignored);
}

} // namespace

std::string stem_of(const fs::path& file) {
  const fs::path stem = file.stem();
  return (stem.extension() == ".nephroid" ? stem.stem() : stem).string();
}

fs::path find_preset(const std::string& name, const fs::path& folder, const Location& where) {
  if (name.empty() || name.find('\0') != std::string::npos)
    throw bad_input(where, "the name of a preset is empty or holds a NUL");
  std::vector<fs::path> folders{folder};
  if (fs::path shipped = presets_folder_if_any(); !shipped.empty() && fs::path(name).is_relative())
    folders.push_back(std::move(shipped));
  for (const fs::path& f : folders)
    for (const char* extension : {"", ".json"})
      if (const fs::path candidate = f / (name + extension); is_file(candidate)) return candidate;
  std::error_code ignored;
  if (fs::is_directory(folder / name, ignored))
    throw bad_input(where, fmt::format("{} is a folder", in_quotes(name)), "expected a file");
  throw bad_input(where, fmt::format("there is no preset {}", in_quotes(name)),
                  "expected a file or the name of a shipped preset", nearest_shipped(name));
}

Document load_document(const fs::path& file) { return document_from(read_text(file), file, {}); }

Document parse_document(const std::string& text, const std::string& source) { return document_from(text, source, {}); }

std::vector<ShippedPreset> shipped_presets() {
  const fs::path folder = presets_folder();
  std::vector<ShippedPreset> presets;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path relative = entry.path().lexically_relative(folder);
    if (!entry.is_regular_file() || relative.extension() != ".json" || relative == "schema.json") continue;
    const Json value = parse_json(read_text(entry.path()), entry.path().string());
    const auto description = value.find("description");
    presets.push_back({fs::path(relative).replace_extension().generic_string(),
                       description != value.end() && description->is_string() ? description->get<std::string>() : "",
                       entry.path()});
  }
  std::sort(presets.begin(), presets.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return presets;
}

std::string name_from(const fs::path& folder, const std::string& name, const fs::path& own_folder) {
  if (fs::path(name).is_absolute() || same_folder(folder, own_folder)) return name;
  const auto meant = file_meant(own_folder, name);
  return meant && file_meant(folder, name) != meant ? meant->string() : name;
}

std::string name_given(const Origin& main, const std::string& name, const Origin& origin) {
  std::error_code ignored;
  const bool is_here = origin.is_typed && fs::is_regular_file(name, ignored);
  return name_from(main.folder, name, is_here ? fs::path() : origin.folder);
}

Preset with_file_names(Preset preset, const std::function<std::string(const std::string& name)>& renamed) {
  visit_files(Value(preset), {}, "", [&](const std::string&, std::string& name) { name = renamed(name); });
  return preset;
}

Preset moved_to(Preset preset, const fs::path& folder) {
  const fs::path from = fs::path(preset.source).parent_path();
  return with_file_names(std::move(preset), [&](const std::string& name) { return name_from(folder, name, from); });
}

std::vector<std::pair<std::string, std::string>> file_names(const Preset& preset) {
  std::vector<std::pair<std::string, std::string>> names;
  visit_files(value_of(preset), {}, "",
              [&](const std::string& pointer, const std::string& name) { names.emplace_back(pointer, name); });
  return names;
}

std::vector<fs::path> files_of(const Preset& preset) {
  std::vector<fs::path> files;
  if (!preset.source.empty()) files.emplace_back(preset.source);
  const fs::path folder = fs::path(preset.source).parent_path();
  for (const auto& [pointer, name] : file_names(preset))
    if (const auto file = file_meant(folder, name)) files.push_back(*file);
  return files;
}

Json as_json(const Preset& preset) { return as_json(value_of(preset)); }

std::string to_json(const Preset& preset) { return pretty(as_json(preset)); }

std::string to_json(const Preset& preset, const std::filesystem::path& folder) {
  return to_json(moved_to(preset, folder));
}

} // namespace nephroid::preset
