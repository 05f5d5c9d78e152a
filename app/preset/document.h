// SPDX-License-Identifier: Apache-2.0
// A preset as JSON before its fields are read: files with their parents merged, --set applied. Private to preset/.
#pragma once
#include "preset/json_text.h"
#include "preset/origins.h"
#include "preset/read.h"

#include <nlohmann/json.hpp>

namespace nephroid::preset {

/// The last component wins: an object is merged into an object, anything else replaces what was there
/// (docs/presets.md).
class Document {
public:
  Document(Json value, Origin origin) : value_(std::move(value)), origins_(std::move(origin)) {}

  const Json& value() const { return value_; }
  const Origins& origins() const { return origins_; }
  /// For messages: "FILE#/pointer" or "--set a.b=c".
  Location where(const std::string& pointer) const { return origins_.where(pointer); }

  /// A child's values over this one. Where this and set() change the engine, what the new one does not know goes first
  /// (change_engine.h).
  void merge(const Json& over, const Origin& origin);
  /// Puts a value at a path of keys and list indices, making the objects on the way. Throws bad_input at origin where
  /// the path leads through a plain value or beyond the end of a list.
  void set(const std::vector<std::string>& path, Json value, const Origin& origin);
  /// Takes a key of the root out and returns its value, null where it is not there.
  Json take(const std::string& key);

  /// What went with a change of the engine: "child.json#/engine: left out ...".
  const std::vector<std::string>& notes() const { return notes_; }

private:
  void change_engine(const Json& engine, const Origin& origin);
  void replace(Json& slot, const Json& value, const std::string& pointer, const Origins::Shared& origin);
  void merge(Json& into, const Json& over, const std::string& pointer, const Origins::Shared& origin);

  Json value_;
  Origins origins_;
  std::vector<std::string> notes_;
};

/// "a.b.0.c" as its keys; empty where one of them is.
std::vector<std::string> split_path(std::string_view path);

/// Applies one "a.b.0.c=value".
void apply_override(Document& document, const std::string& text);

/// A file with its chain of parents. Throws bad_input as read.h says, with every file's own name.
Document load_document(const std::filesystem::path& file);
/// The same from text; source stands for its file.
Document parse_document(const std::string& text, const std::string& source);

/// The file that a person means by name: beside `folder`, then in presets/, each also with ".json" behind it.
/// Throws bad_input at where.
std::filesystem::path find_preset(const std::string& name, const std::filesystem::path& folder, const Location& where);

inline constexpr std::size_t max_runs = 10000;

/// One run: the document with this run's values in place, and the part of its name that says which they are.
struct SweptDocument {
  Document document;
  std::string suffix; ///< ",threshold_deg=0.1,seed=2", unique within the sweep; empty where there is no sweep
};

/// Takes "sweep" out of the document. A key that an override sets is not swept. Throws bad_input where it is no object
/// of non-empty lists, has over max_runs runs, or one key holds another.
std::vector<SweptDocument> expand_sweep(Document document, const std::vector<std::string>& overrides);

/// The same as data: takes "sweep" out of the document and says which keys are swept.
Sweep take_sweep(Document& document, const std::vector<std::string>& overrides);
/// The same with the first value of each swept key in its place.
Document first_run(Document document, const std::vector<std::string>& overrides);
/// As a preset's "sweep"; null without one.
Json to_json(const Sweep& sweep);

} // namespace nephroid::preset
