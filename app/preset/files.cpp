// SPDX-License-Identifier: Apache-2.0
#include "preset/files.h"

#include "base/error.h"
#include "base/files.h"
#include "preset/describe.h"
#include "preset/read.h"
#include "preset/walks.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <system_error>

namespace nephroid::preset {
namespace fs = std::filesystem;
namespace {

/// Absolute and without links, so that two ways to the same file compare equal.
std::optional<fs::path> file_meant(const fs::path& folder, const std::string& name)
{
  try {
    return fs::canonical(FileFinder(folder).find(name, ""));
  } catch (const Error&) {
    return std::nullopt; // whoever reads the file will say so
  } catch (const fs::filesystem_error&) {
    return std::nullopt;
  }
}

using VisitName = std::function<void(const std::string& pointer, std::string& name)>;

void visit_files(const Value& value, const Field& field, const std::string& pointer, const VisitName& visit)
{
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

bool same_folder(const fs::path& a, const fs::path& b)
{
  std::error_code ignored;
  const auto here = [](const fs::path& p) { return p.empty() ? fs::path(".") : p; };
  return a == b || fs::equivalent(here(a), here(b), ignored);
}

} // namespace

std::string name_from(const fs::path& folder, const std::string& name, const fs::path& own_folder)
{
  if (fs::path(name).is_absolute() || same_folder(folder, own_folder)) return name;
  const auto meant = file_meant(own_folder, name);
  return meant && file_meant(folder, name) != meant ? meant->string() : name;
}

std::string name_given(const Origin& main, const std::string& name, const Origin& origin)
{
  std::error_code ignored;
  const bool is_here = origin.is_typed && fs::is_regular_file(name, ignored);
  return name_from(main.folder, name, is_here ? fs::path() : origin.folder);
}

Preset with_file_names(Preset preset, const std::function<std::string(const std::string& name)>& renamed)
{
  visit_files(Value(preset), {}, "", [&](const std::string&, std::string& name) { name = renamed(name); });
  return preset;
}

Preset moved_to(Preset preset, const fs::path& folder)
{
  const fs::path from = fs::path(preset.source).parent_path();
  return with_file_names(std::move(preset), [&](const std::string& name) { return name_from(folder, name, from); });
}

std::vector<std::pair<std::string, std::string>> file_names(const Preset& preset)
{
  std::vector<std::pair<std::string, std::string>> names;
  visit_files(value_of(preset), {}, "", [&](const std::string& pointer, const std::string& name) { names.emplace_back(pointer, name); });
  return names;
}

std::vector<fs::path> files_of(const Preset& preset)
{
  std::vector<fs::path> files;
  if (!preset.source.empty()) files.emplace_back(preset.source);
  const fs::path folder = fs::path(preset.source).parent_path();
  for (const auto& [pointer, name] : file_names(preset))
    if (const auto file = file_meant(folder, name)) files.push_back(*file);
  return files;
}

std::string to_json(const Preset& preset) { return pretty(as_json(value_of(preset))); }

std::string to_json(const Preset& preset, const std::filesystem::path& folder) { return to_json(moved_to(preset, folder)); }

} // namespace nephroid::preset
