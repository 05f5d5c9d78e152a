// SPDX-License-Identifier: Apache-2.0
#include "preset/differences.h"

#include "base/files.h"
#include "preset/animation.h"
#include "preset/describe.h"
#include "preset/document.h"
#include "preset/walks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <system_error>

namespace nephroid::preset {
namespace fs = std::filesystem;
namespace {

using Path = std::vector<std::string>;

struct Edit {
  Path path;
  Json value;
};

/// The edits that make one preset, as JSON, of another.
class Comparison {
public:
  /// by_set: edits as --set takes them, where a path may lead into a list and no key may hold what parts paths. Else as
  /// a child file has them, where a list is replaced as a whole.
  explicit Comparison(bool by_set) : by_set_(by_set) {}

  /// before, after: complete. raw: before as its file has it, where a word may stand for an object and much is left
  /// out; may be null.
  std::vector<Edit> edits(const Json& before, const Json& after, const Json& raw) {
    edits_.clear();
    compare(before, after, &raw);
    return std::move(edits_);
  }

private:
  void compare(const Json& before, const Json& after, const Json* raw) {
    if (before == after) return;
    if (before.is_object() && after.is_object() && can_enter(before, after, raw))
      compare_objects(before, after, raw);
    else if (by_set_ && can_enter_list(before, after, raw))
      for (std::size_t i = 0; i < after.size(); ++i) enter(std::to_string(i), before[i], after[i], &(*raw)[i]);
    else
      edits_.push_back({path_, after});
  }

  void compare_objects(const Json& before, const Json& after, const Json* raw) {
    for (const auto& [key, value] : after.items()) {
      const Json* inside = raw && raw->contains(key) ? &(*raw)[key] : nullptr;
      enter(key, before.contains(key) ? before[key] : Json(), value, inside);
    }
    for (const auto& [key, value] : before.items())
      if (!after.contains(key)) enter(key, value, nullptr, nullptr);
  }

  void enter(const std::string& key, const Json& before, const Json& after, const Json* raw) {
    path_.push_back(key);
    compare(before, after, raw);
    path_.pop_back();
  }

  /// Fields of an object can be given one by one where the file has the object, or may have it with those fields alone.
  bool can_enter(const Json& before, const Json& after, const Json* raw) const {
    if (before.value("type", Json()) != after.value("type", Json())) return false;
    if (raw ? !raw->is_object() : after.contains("type")) return false;
    if (!by_set_) return true;
    const auto unsayable = [&](const Json& a, const Json& b) {
      const auto items = a.items();
      return std::any_of(items.begin(), items.end(), [&](const auto& item) {
        return !is_sayable(item.key()) && (!b.contains(item.key()) || b[item.key()] != item.value());
      });
    };
    return !unsayable(after, before) && !unsayable(before, after);
  }

  static bool is_sayable(const std::string& key) {
    const bool bracketed = key.find('[') != std::string::npos && key.back() == ']';
    return !key.empty() && !bracketed &&
           std::ranges::none_of(key, [](unsigned char c) { return c == '.' || c == '=' || c < 0x20 || c == 0x7f; });
  }

  static bool can_enter_list(const Json& before, const Json& after, const Json* raw) {
    const bool lists = before.is_array() && after.is_array() && raw && raw->is_array();
    return lists && before.size() == after.size() && raw->size() == after.size() && !after.empty() &&
           after.front().is_object();
  }

  bool by_set_;
  Path path_;
  std::vector<Edit> edits_;
};

/// A preset and the document that it was read from.
struct Read {
  Document document;
  Json sweep = {}; ///< that the document has and the preset has not; null: none
  Preset preset = {};
};

/// From the text of a file.
Read read_without_sweep(const std::string& text, const fs::path& file) {
  Read read{parse_document(text, file.string())};
  read.sweep = read.document.take("sweep");
  read.preset = parse_preset(text, file.string(), !read.sweep.is_null() ? Overrides{"sweep=null"} : Overrides{});
  return read;
}

std::string override_of(const Edit& edit) {
  std::string key;
  for (const std::string& part : edit.path) key += (key.empty() ? "" : ".") + part;
  // A word stands for itself unless it could be read as something else.
  if (edit.value.is_string()) {
    const std::string word = edit.value.get<std::string>();
    const bool plain =
        !word.empty() && std::ranges::all_of(word, [](unsigned char c) { return c >= 0x20 && c != 0x7f; });
    if (plain && word.find_first_of("{[\"") != 0 && !Json::accept(with_json_numbers(word))) return key + "=" + word;
  }
  return key + "=" + edit.value.dump();
}

bool is_same(Preset a, const Preset& b) {
  a.source = b.source;
  return a == b;
}

fs::path absolute_path(const fs::path& file) {
  std::error_code ignored;
  const fs::path absolute = fs::absolute(file, ignored);
  return absolute.empty() ? file : absolute.lexically_normal();
}

constexpr const char* save_first = "save the preset first, then copy the command line";

/// The name that means from folder `to` the preset file that `parent` means from `from`.
std::string parent_from(const std::string& parent, const fs::path& from, const fs::path& to) {
  const fs::path meant = find_preset(parent, from, "parent");
  std::error_code error;
  try {
    if (fs::equivalent(find_preset(parent, to, "parent"), meant, error)) return parent;
  } catch (const Error&) {
    // it means nothing there
  }
  if (const std::string shipped = shipped_name(meant); !shipped.empty()) return shipped;
  const fs::path relative = fs::relative(meant, to.empty() ? fs::path(".") : to, error);
  return error || relative.empty() ? absolute_path(meant).string() : relative.generic_string();
}

Json nameless(const Preset& preset) {
  Json json = as_json(preset);
  for (const char* own : {"name", "description"}) json.erase(own);
  return json;
}

/// What a child file of this parent has to say.
Json child_of(const Preset& preset, const std::string& parent, const fs::path& file, const Json& sweep) {
  const Read base = read_without_sweep(Json{{"parent", parent}}.dump(), file);
  Preset inherited = base.preset;
  if (preset.animation) try { // what its tracks say of the parent's fields need not be said again
      inherited.animation = preset.animation;
      inherited = at_start(inherited);
      inherited.animation = base.preset.animation;
    } catch (const Error&) {
      inherited = base.preset; // a track leads to what the parent has not
    }
  Json child{{"parent", parent}};
  // The parent's own name and description are not inherited; without a name it is the file's.
  if (preset.name != stem_of(file)) child["name"] = preset.name;
  if (!preset.description.empty()) child["description"] = preset.description;
  if (base.sweep != sweep) child["sweep"] = sweep;
  for (const Edit& edit : Comparison(false).edits(nameless(inherited), nameless(preset), base.document.value())) {
    Json* slot = &child;
    for (const std::string& key : edit.path) slot = &(*slot)[key];
    *slot = edit.value;
  }
  return child;
}

} // namespace

std::string own_parent(const fs::path& file) {
  try {
    const Json value = parse_json(read_file(file), file.string());
    const auto parent = value.is_object() ? value.find("parent") : value.end();
    return parent != value.end() && parent->is_string() ? parent->get<std::string>() : std::string();
  } catch (const Error&) {
    return {};
  }
}

std::string shipped_name(const fs::path& file) {
  std::error_code unknown;
  const fs::path presets = presets_folder_if_any(),
                 inside = presets.empty() ? presets : fs::relative(file, presets, unknown);
  if (unknown || inside.empty() || *inside.begin() == ".." || inside.extension() != ".json") return {};
  return fs::path(inside).replace_extension().generic_string();
}

Recipe recipe_of(const Preset& preset) {
  std::error_code ignored;
  if (preset.source.empty() || !fs::is_regular_file(preset.source, ignored))
    throw bad_input(preset.source.empty() ? preset.name : preset.source, "the preset is in no file", {}, save_first);
  const std::string shipped = shipped_name(preset.source);
  Recipe recipe{shipped.empty() ? absolute_path(preset.source).string() : shipped, {}};
  const Read on_disk = read_without_sweep(read_file(preset.source), preset.source);
  if (!on_disk.sweep.is_null()) recipe.overrides.emplace_back("sweep=null");
  for (const Edit& edit : Comparison(true).edits(as_json(on_disk.preset), as_json(preset), on_disk.document.value()))
    recipe.overrides.push_back(override_of(edit));
  std::string why;
  try {
    if (is_same(read_preset(recipe.name, recipe.overrides), preset)) return recipe;
    why = "a field cannot be set alone";
  } catch (const Error& error) {
    why = error.line();
  }
  throw bad_input(preset.source, fmt::format("what was changed cannot be said by --set ({})", why), {}, save_first);
}

std::string shell_word(const std::string& word) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) || std::string_view("_-./=,:+@%").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string command_line(const Preset& preset) {
  constexpr std::size_t limit = 4000; // a terminal takes 4095 bytes a line
  const Recipe recipe = recipe_of(preset);
  std::string line = "nephroid run " + shell_word(recipe.name);
  for (const std::string& text : recipe.overrides) line += " --set " + shell_word(text);
  if (line.size() > limit)
    throw bad_input(preset.source, fmt::format("what was changed makes a command line of {} characters", line.size()),
                    fmt::format("expected at most {}", limit), save_first);
  return line;
}

Preset moved_to_file(Preset preset, const fs::path& file) {
  const fs::path from = fs::path(preset.source).parent_path(), to = file.parent_path();
  if (from != to) preset = moved_to(std::move(preset), to);
  preset.source = file.string();
  return preset;
}

std::vector<Difference> differences(const Preset& before, const Preset& after) {
  const Json a = nameless(before), b = nameless(moved_to_file(after, before.source));
  std::vector<Difference> all;
  for (const Edit& edit : Comparison(true).edits(a, b, a)) {
    std::string path;
    Json::json_pointer at;
    for (const std::string& key : edit.path) {
      path += (path.empty() ? "" : ".") + key;
      at /= key;
    }
    const auto text = [&](const Json& json) { return json.contains(at) ? json[at].dump() : std::string("none"); };
    all.push_back({path, text(a), text(b)});
  }
  return all;
}

FileText file_text(const Preset& preset, const std::string& parent, const fs::path& file, const Sweep& sweep) {
  const Preset moved = moved_to_file(preset, file);
  const Json sweep_json = to_json(sweep);
  Json all = as_json(moved);
  if (!sweep.empty()) all["sweep"] = sweep_json;
  FileText whole{pretty(all)};
  if (parent.empty()) return whole;
  std::string why;
  try {
    const std::string name = parent_from(parent, fs::path(preset.source).parent_path(), file.parent_path());
    FileText child{pretty(child_of(moved, name, file, sweep_json)), true};
    if (const WithSweep read = parse_with_sweep(child.json, file.string());
        is_same(read.preset, moved) && read.sweep == sweep &&
        is_same(parse_first_run(child.json, file.string()), parse_first_run(whole.json, file.string())))
      return child;
    why = "what was changed cannot be said over it";
  } catch (const Error& error) {
    why = error.line();
  }
  whole.note = fmt::format("{} is saved whole, without its parent '{}': {}", file.string(), parent, why);
  return whole;
}

} // namespace nephroid::preset
