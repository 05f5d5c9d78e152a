// SPDX-License-Identifier: Apache-2.0
// Values go into the preset as JSON, as those of --set and of a sweep do: what a field takes is said once, by its
// description.
#include "preset/animation.h"

#include "base/counted.h"
#include "base/monotone_cubic.h"
#include "preset/describe.h"
#include "preset/document.h"
#include "preset/read.h"
#include "preset/walks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace nephroid::preset {
namespace {

using Path = std::vector<std::string>;

/// For messages: whoever gave the value at pointer.
Location where(const Preset& preset, const std::string& pointer) {
  return preset.provenance.origins ? preset.provenance.origins->where(pointer) : Location(preset.source, pointer);
}

std::string pointer_of(std::size_t track) { return child("/animation/tracks", track); }

std::string pointer_of(const Path& path) {
  std::string pointer;
  for (const std::string& key : path) pointer = child(pointer, key);
  return pointer;
}

/// The value at the path; null where there is none.
const Json* find(const Json& json, const Path& path) {
  Json::json_pointer at;
  for (const std::string& key : path) at /= key;
  return json.contains(at) ? &json[at] : nullptr;
}

bool is_numbers(const Json& json) {
  return json.is_number() ||
         (json.is_array() && std::all_of(json.begin(), json.end(), [](const Json& item) { return item.is_number(); }));
}

/// Numbers as the field's `before` has them: one or a list. Where it has whole ones they are rounded if asked for.
Json as_field(const Json& before, const std::vector<double>& numbers, bool rounds) {
  const bool list = before.is_array();
  const auto one = [&](std::size_t i) -> Json {
    const Json& item = list && i < before.size() ? before[i] : before;
    const double x = rounds && item.is_number_integer() ? std::round(numbers[i]) : numbers[i];
    if (std::abs(x) < 0x1p53 && x == std::trunc(x)) return static_cast<std::int64_t>(x); // as people write it
    return x;
  };
  if (!list && numbers.size() == 1) return one(0);
  Json all = Json::array();
  for (std::size_t i = 0; i < numbers.size(); ++i) all.push_back(one(i));
  return all;
}

/// A preset as JSON, into which values of tracks are put.
class Stage {
public:
  explicit Stage(const Preset& preset)
      : preset_(preset), json_(as_json(value_of(preset))),
        document_(json_, Origin{preset.source, true, std::filesystem::path(preset.source).parent_path()}) {}

  /// Null where the preset has no such field, and where it has no value.
  Json field(const Path& path) const {
    const Json* found = find(json_, path);
    return found ? *found : Json();
  }
  bool has(const Path& path) const { return find(json_, path) != nullptr; }

  /// origin: of the value, for messages.
  void put(const Path& path, Json value, const Location& origin) {
    document_.set(path, std::move(value), Origin{origin, false, document_.origins().main().folder});
    pointers_.emplace_back(pointer_of(path), origin);
  }

  /// The preset as it now is. Throws bad_input at the origin of a value that its field does not take.
  Preset read() const {
    Preset changed;
    preset::read(document_, changed);
    changed.source = preset_.source;
    changed.provenance = preset_.provenance;
    auto origins = preset_.provenance.origins ? std::make_shared<Origins>(*preset_.provenance.origins) : nullptr;
    for (const auto& [pointer, origin] : pointers_)
      if (origins)
        origins->set_whole(pointer, std::make_shared<const Origin>(Origin{origin, false, origins->at(pointer).folder}));
    changed.provenance.origins = std::move(origins);
    return changed;
  }

private:
  const Preset& preset_;
  Json json_;
  Document document_;
  std::vector<std::pair<std::string, Location>> pointers_;
};

Preset made_at(const Preset& preset, int frame) {
  Stage stage(preset);
  for (std::size_t i = 0; i < preset.animation->tracks.size(); ++i) {
    const Track& track = preset.animation->tracks[i];
    const Path path = split_path(track.path);
    stage.put(path, as_field(stage.field(path), value_at(track, frame), true), where(preset, pointer_of(i)));
  }
  return stage.read();
}

/// A word for what a path leads to that cannot be animated.
std::string kind_of(const Json& json) {
  if (json.is_object()) return "a section";
  if (json.is_boolean()) return "true or false";
  return json.is_array() ? "a list of something else than numbers" : "a word";
}

Path check_path(const Preset& preset, const Stage& stage, std::size_t index) {
  const Track& track = preset.animation->tracks[index];
  const Location place = where(preset, child(pointer_of(index), "path"));
  const Path path = split_path(track.path);
  if (path.empty() || track.path.starts_with('/'))
    throw bad_input(place, in_quotes(track.path) + " is no path",
                    "expected keys joined by dots, for instance scene.objects.0.transform.translate");
  if (path.front() == "animation")
    throw bad_input(place, in_quotes(track.path) + " cannot be animated", "expected a field outside of the animation");
  if (track.path.starts_with("scene.camera.resolution"))
    throw bad_input(place, in_quotes(track.path) + " cannot be animated", "frames of one size make a video");
  const Json field = stage.field(path);
  if (!stage.has(path)) { // the reader knows which fields there may be
    Stage other = stage;
    other.put(path, as_field(field, track.keys.front().value, false), place);
    other.read();
  } else if (!field.is_null() && !is_numbers(field))
    throw bad_input(place, fmt::format("{} is {}", in_quotes(track.path), kind_of(field)),
                    "expected a field with a number or a list of numbers");
  return path;
}

void check_keys(const Preset& preset, std::size_t index) {
  const std::vector<Key>& keys = preset.animation->tracks[index].keys;
  for (std::size_t k = 1; k < keys.size(); ++k) {
    const std::string pointer = child(child(pointer_of(index), "keys"), k);
    if (keys[k].frame <= keys[k - 1].frame)
      throw bad_input(where(preset, child(pointer, "frame")),
                      fmt::format("is {}, and the key before it is at {}", keys[k].frame, keys[k - 1].frame),
                      "expected keys by rising frame");
    if (keys[k].value.size() != keys[0].value.size())
      throw bad_input(where(preset, child(pointer, "value")),
                      fmt::format("has {}, and the first key has {}", counted(keys[k].value.size(), "number"),
                                  keys[0].value.size()),
                      "expected as many in each key");
  }
}

void check_overlaps(const Preset& preset, const std::vector<Path>& paths) {
  for (std::size_t i = 0; i < paths.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const std::size_t common = std::min(paths[i].size(), paths[j].size());
      if (std::equal(paths[i].begin(), paths[i].begin() + static_cast<std::ptrdiff_t>(common), paths[j].begin()))
        throw bad_input(where(preset, child(pointer_of(i), "path")),
                        fmt::format("{} has a track already, {}", in_quotes(preset.animation->tracks[i].path),
                                    in_quotes(preset.animation->tracks[j].path)),
                        "expected one track for a field");
    }
}

/// The first key's values of all tracks, then the second one's, and so on: what lies between two keys is in range where
/// they are.
void check_values(const Preset& preset, const Stage& unchanged, const std::vector<Path>& paths) {
  const std::vector<Track>& tracks = preset.animation->tracks;
  std::size_t most = 0;
  for (const Track& track : tracks) most = std::max(most, track.keys.size());
  for (std::size_t k = 0; k < most; ++k) {
    Stage stage = unchanged;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      const std::size_t key = std::min(k, tracks[i].keys.size() - 1);
      const std::string pointer = child(child(child(pointer_of(i), "keys"), key), "value");
      stage.put(paths[i], as_field(unchanged.field(paths[i]), tracks[i].keys[key].value, false),
                where(preset, pointer));
    }
    stage.read();
  }
}

/// The key or index in `after` of the item that `before` has at `key`: an edit may have moved or renamed it, or made it
/// another one in its place. Nothing where it is gone.
std::optional<std::string> followed(const Json& before, const Json& after, const std::string& key) {
  const Json* item = find(before, {key});
  if (!item) return key;
  if (after.is_null()) return std::nullopt;
  if (before.type() != after.type()) return key;
  if (before.is_object()) {
    if (after.contains(key)) return key;
    for (const auto& [name, value] : after.items())
      if (value == *item && !before.contains(name)) return name;
    return std::nullopt;
  }
  const Json* there = find(after, {key});
  if (!item->is_object() || (there && *there == *item)) return key;
  if (const auto moved = std::find(after.begin(), after.end(), *item); moved != after.end())
    return std::to_string(moved - after.begin());
  return after.size() < before.size() ? std::nullopt : std::optional(key);
}

/// A track's path after an edit; nothing where what it leads to is gone.
std::optional<Path> followed(const Json& before, const Json& after, const Path& path) {
  const Json *old = &before, *now = &after;
  Path to;
  for (const std::string& key : path) {
    auto there = old && now ? followed(*old, *now, key) : std::optional(key);
    if (!there) return std::nullopt;
    to.push_back(*std::move(there));
    old = old ? find(*old, {key}) : nullptr;
    now = now ? find(*now, {to.back()}) : nullptr;
  }
  return to;
}

void set_key(Json& keys, int frame, const Json& value) {
  const auto at = std::find_if(keys.begin(), keys.end(), [&](const Json& key) { return key.at("frame") >= frame; });
  if (at != keys.end() && at->at("frame") == frame)
    at->at("value") = value;
  else
    keys.insert(at, Json{{"frame", frame}, {"value", value}});
}

} // namespace

std::vector<double> value_at(const Track& track, int frame) {
  const std::vector<Key>& keys = track.keys;
  std::vector<double> value;
  if (track.interpolation == Track::Interpolation::smooth) {
    for (std::size_t i = 0; i < keys.front().value.size(); ++i) {
      std::vector<MonotoneCubic::Row> rows;
      for (const Key& key : keys) rows.push_back({static_cast<double>(key.frame), key.value[i]});
      value.push_back(MonotoneCubic(std::move(rows))(frame));
    }
    return value;
  }
  const auto after = std::find_if(keys.begin(), keys.end(), [&](const Key& key) { return key.frame > frame; });
  if (after == keys.begin()) return keys.front().value;
  const Key& before = *(after - 1);
  if (after == keys.end()) return before.value;
  const double part = static_cast<double>(frame - before.frame) / (after->frame - before.frame);
  for (std::size_t i = 0; i < before.value.size(); ++i)
    value.push_back(std::lerp(before.value[i], after->value[i], part));
  return value;
}

Preset at_frame(const Preset& preset, int frame) {
  Preset frame_preset = made_at(preset, frame);
  frame_preset.name += fmt::format(",frame={}", frame);
  frame_preset.animation.reset();
  frame_preset.provenance.frame = frame;
  at_origins(frame_preset,
             [&] { check(frame_preset, [&](const std::string& pointer) { return where(frame_preset, pointer); }); });
  return frame_preset;
}

Preset at_start(const Preset& preset) {
  const Stage stage(preset);
  std::vector<Path> paths;
  for (std::size_t i = 0; i < preset.animation->tracks.size(); ++i) {
    check_keys(preset, i);
    paths.push_back(check_path(preset, stage, i));
  }
  check_overlaps(preset, paths);
  check_values(preset, stage, paths);
  return made_at(preset, 0);
}

Preset shown_at(const Preset& preset, int frame) {
  Preset shown = made_at(preset, frame);
  shown.provenance.frame = frame;
  return shown;
}

Json with_keys(const Json& before, Json edited, int frame, const std::string& source) {
  const Json::json_pointer place("/animation/tracks");
  if (!before.contains(place) || !edited.contains(place) || before["animation"] != edited["animation"]) return edited;
  Json tracks = Json::array();
  for (Json track : edited[place]) {
    const Path path = split_path(track.at("path").get<std::string>());
    const auto now = followed(before, edited, path);
    if (!now) continue;
    track["path"] = fmt::format("{}", fmt::join(*now, "."));
    const Json *old_value = find(before, path), *value = find(edited, *now);
    if (value && (!old_value || *value != *old_value)) {
      if (!is_numbers(*value))
        throw bad_input(Location(source, pointer_of(*now)), "changes with the frames, and no key can be this",
                        "expected numbers", "take its track out of 'animation' first");
      set_key(track["keys"], frame, *value);
    }
    tracks.push_back(std::move(track));
  }
  edited[place] = std::move(tracks);
  return edited;
}

} // namespace nephroid::preset
