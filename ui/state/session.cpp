// SPDX-License-Identifier: Apache-2.0
#include "ui/state/session.h"

#include "base/error.h"
#include "base/hashed_bytes.h"
#include "base/json_output.h"
#include "preset/read.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace nephroid::ui {
namespace {

using Json = nlohmann::ordered_json;
using PresetPtr = std::shared_ptr<const preset::Preset>;

constexpr int session_version = 1, settings_version = 2;
constexpr std::size_t most_panels = 64;

constexpr std::array<std::string_view, 3> tones{"standard", "false_colour", "filmic"}; ///< the last: of an older window

/// Dear ImGui trusts what it reads, so text that it did not write itself is refused here.
std::string checksum(const std::string& ini) { return fmt::format("{:016x}", hash_of(ini)); }

double within(const Json& value, double low, double high) {
  const double read = value.get<double>();
  if (!(read >= low && read <= high)) throw std::out_of_range(fmt::format("{} is not in {}..{}", read, low, high));
  return read;
}

template <class T, std::size_t N>
void read_within(const Json& values, double low, double high, std::array<T, N>& to) {
  for (std::size_t i = 0; i < N; ++i) to[i] = static_cast<T>(within(values.at(i), low, high));
}

ViewSettings read_view_settings(const Json& value) {
  ViewSettings view_settings;
  view_settings.exposure_stops = within(value.at("exposure_stops"), -20, 20);
  const std::string tone = value.value("tone", "standard");
  if (std::ranges::find(tones, tone) == tones.end()) throw std::out_of_range("there is no such tone");
  view_settings.false_colour = tone == tones[1];
  if (value.contains("false_colour"))
    view_settings.range =
        valid_range({value["false_colour"].at(0).get<double>(), value["false_colour"].at(1).get<double>()});
  view_settings.fit = value.at("fit").get<bool>();
  view_settings.zoom = within(value.at("zoom"), 1.0 / 1024, 1024);
  read_within(value.at("centre"), -1e6, 1e6, view_settings.centre);
  view_settings.meter = value.value("meter", "");
  return view_settings;
}

Bookmark read_bookmark(const Json& value) {
  constexpr double far = 1e12;
  Bookmark bookmark{value.at("name").get<std::string>(), {}};
  preset::Camera& camera = bookmark.camera;
  read_within(value.at("position"), -far, far, camera.position);
  read_within(value.at("target"), -far, far, camera.target);
  read_within(value.at("up"), -far, far, camera.up);
  camera.fov_deg = within(value.at("fov_deg"), 0, 180);
  read_within(value.at("resolution"), 1, 1 << 20, camera.resolution);
  if (!value.contains("aperture")) return bookmark; // of an older window
  if (value.at("orthographic").get<bool>()) camera.projection = preset::Camera::Projection::orthographic;
  if (!value.at("height").is_null()) camera.height = within(value.at("height"), 0, far);
  read_within(value.at("shift"), -10, 10, camera.shift);
  camera.aperture = within(value.at("aperture"), 0, far);
  if (!value.at("focus_distance").is_null()) camera.focus_distance = within(value.at("focus_distance"), 0, far);
  return bookmark;
}

/// Keeps the entries around the current one.
UndoStack::State trimmed(UndoStack::State state) {
  constexpr std::size_t most = Session::most_entries;
  auto& [opened, entries, index, saved, frame] = state;
  if (entries.size() <= most) return state;
  const std::size_t first = std::min(entries.size() - most, index - std::min(index, most / 2));
  const auto begin = entries.begin() + static_cast<std::ptrdiff_t>(first);
  entries = std::deque(begin, begin + most);
  index -= first;
  if (saved) saved = *saved >= first && *saved - first < most ? std::optional(*saved - first) : std::nullopt;
  return state;
}

PresetPtr read_state(const Json& json, const std::string& source, const std::string& where) {
  try {
    return std::make_shared<const preset::Preset>(preset::parse_preset(json.dump(), source));
  } catch (const Error& error) {
    throw std::out_of_range(where + " is no preset: " + error.text());
  }
}

preset::Sweep read_sweep(const Json& value) {
  preset::Sweep sweep;
  for (const Json& field : value) {
    sweep.push_back({field.at(0).get<std::string>(), field.at(1).get<std::vector<std::string>>()});
    for (const std::string& swept_value : sweep.back().values)
      if (!Json::accept(swept_value)) throw std::out_of_range("a swept value is no JSON");
  }
  return sweep;
}

UndoStack::State read_edits(const Json& value) {
  UndoStack::State state;
  const auto source = value.at("source").get<std::string>();
  state.opened = read_state(value.at("opened"), value.at("opened_source").get<std::string>(), "what was opened");
  Json now;
  for (const Json& entry : value.at("entries")) {
    if (state.entries.size() >= Session::most_entries) throw std::out_of_range("there are too many entries");
    now = state.entries.empty() ? entry.at("preset") : now.patch(entry.at("patch"));
    state.entries.push_back({entry.at("label").get<std::string>(),
                             read_state(now, source, fmt::format("entry {}", state.entries.size())), 0,
                             read_sweep(entry.value("sweep", Json::array()))});
  }
  const auto index_of = [&](const Json& json) {
    return static_cast<std::size_t>(within(json, 0, static_cast<double>(state.entries.size()) - 1));
  };
  state.index = index_of(value.at("index"));
  state.frame = static_cast<int>(within(value.value("frame", Json(0)), 0, preset::max_frames));
  if (!value.at("saved").is_null()) state.saved = index_of(value.at("saved"));
  return state;
}

EngineLayout read_engine_layout(const Json& value) {
  EngineLayout layout{value.at("ini").get<std::string>(), {}};
  if (value.at("checksum").get<std::string>() != checksum(layout.ini))
    throw std::out_of_range("a layout is not as the window wrote it");
  if (value.at("closed").size() > most_panels) throw std::out_of_range("there are too many panels");
  value.at("closed").get_to(layout.closed);
  return layout;
}

/// Calls read(value) with the text as JSON of this version. Every failure becomes one kind of error.
template <class Read>
auto read_kept(const std::string& text, int version, const Location& source, const std::string& what_is_wrong,
               const std::string& remedy, Read read) {
  try {
    const Json value = Json::parse(text);
    if (value.at("version") != Json(version)) throw std::out_of_range("it is of another version of the program");
    return read(value);
  } catch (const std::exception& error) { // from the JSON library or the checks above
    throw bad_input(source, fmt::format("{} ({})", what_is_wrong, error.what()), "", remedy);
  }
}

template <class Read>
auto read_session(const std::string& text, const std::string& source, Read read) {
  return read_kept(text, session_version, source, "the session cannot be read", "", read);
}

} // namespace

std::string to_json(const WindowSettings& settings) {
  Json engines = Json::object();
  for (const auto& [engine, layout] : settings.engines)
    engines[engine] = {{"closed", layout.closed}, {"ini", layout.ini}, {"checksum", checksum(layout.ini)}};
  return json_text({{"version", settings_version},
                    {"theme", settings.theme == Theme::light ? "light" : "dark"},
                    {"text_size", settings.text_size},
                    {"engines", engines}},
                   2);
}

WindowSettings parse_settings(const std::string& text, const std::string& source) {
  return read_kept(text, settings_version, source, "these are no settings of the window",
                   "delete the file; the window writes a new one", [](const Json& value) {
                     WindowSettings settings;
                     settings.theme = value.at("theme").get<std::string>() == "light" ? Theme::light : Theme::dark;
                     settings.text_size =
                         within(value.at("text_size"), WindowSettings::smallest_text, WindowSettings::largest_text);
                     for (const auto& [engine, layout] : value.at("engines").items())
                       settings.engines[engine] = read_engine_layout(layout);
                     return settings;
                   });
}

/// A preset as JSON, and its difference from the one before.
struct SessionText::Known {
  PresetPtr preset, before;
  Json json, patch;
};

std::string SessionText::of(const Session& session) {
  std::vector<std::shared_ptr<const Known>> used;
  const auto known = [&](const PresetPtr& preset, const std::shared_ptr<const Known>& before) {
    const PresetPtr before_preset = before ? before->preset : nullptr;
    for (const auto& entry : known_)
      if (entry->preset == preset && entry->before == before_preset) return used.emplace_back(entry);
    Json json = preset::as_json(*preset);
    Json patch = before ? Json::diff(before->json, json) : Json();
    return used.emplace_back(
        std::make_shared<const Known>(Known{preset, before_preset, std::move(json), std::move(patch)}));
  };
  const ViewSettings& view_settings = session.view_state.view_settings;
  Json text{{"version", session_version},
            {"closed", session.closed},
            {"look",
             {{"exposure_stops", view_settings.exposure_stops},
              {"tone", tones[view_settings.false_colour ? 1 : 0]},
              {"fit", view_settings.fit},
              {"zoom", view_settings.zoom},
              {"centre", view_settings.centre},
              {"meter", view_settings.meter}}},
            {"error_metric", session.view_state.error_metric},
            {"material", session.view_state.material}};
  if (view_settings.range) text["look"]["false_colour"] = {view_settings.range->low, view_settings.range->high};
  text["pins"] = Json::array();
  for (const Session::Pin& pin : session.pins)
    text["pins"].push_back({{"folder", pin.folder}, {"name", pin.name}, {"colour", pin.colour}, {"shown", pin.shown}});
  text["bookmarks"] = Json::array();
  for (const auto& [name, camera] : session.view_state.bookmarks)
    text["bookmarks"].push_back({{"name", name},
                                 {"position", camera.position},
                                 {"target", camera.target},
                                 {"up", camera.up},
                                 {"fov_deg", camera.fov_deg},
                                 {"orthographic", camera.projection == preset::Camera::Projection::orthographic},
                                 {"height", camera.height ? Json(*camera.height) : Json()},
                                 {"shift", camera.shift},
                                 {"aperture", camera.aperture},
                                 {"focus_distance", camera.focus_distance ? Json(*camera.focus_distance) : Json()},
                                 {"resolution", camera.resolution}});
  if (session.edits) {
    const UndoStack::State state = trimmed(*session.edits);
    Json& edits = text["edits"];
    edits["source"] = state.entries[state.index].preset->source;
    edits["opened_source"] = state.opened->source;
    edits["opened"] = known(state.opened, nullptr)->json;
    edits["index"] = state.index;
    edits["frame"] = state.frame;
    edits["saved"] = state.saved ? Json(*state.saved) : Json();
    std::shared_ptr<const Known> before;
    for (const UndoStack::Entry& entry : state.entries) {
      const auto now = known(entry.preset, before);
      edits["entries"].push_back(
          {{"label", entry.label}, {before ? "patch" : "preset", before ? now->patch : now->json}});
      for (const preset::SweptField& field : entry.sweep)
        edits["entries"].back()["sweep"].push_back({field.key, field.values});
      before = now;
    }
  }
  known_ = std::move(used);
  return json_text(text);
}

SessionHeader parse_session_header(const std::string& text, const std::string& source) {
  return read_session(text, source, [](const Json& value) {
    return SessionHeader{value.at("closed").get<bool>(), value.contains("edits")};
  });
}

Session parse_session(const std::string& text, const std::string& source) {
  return read_session(text, source, [](const Json& value) {
    Session session;
    session.closed = value.at("closed").get<bool>();
    session.view_state.view_settings = read_view_settings(value.at("look"));
    session.view_state.error_metric = value.at("error_metric").get<std::string>();
    session.view_state.material = value.at("material").get<std::string>();
    for (const Json& pin : value.at("pins"))
      session.pins.push_back({pin.at("folder").get<std::string>(), pin.at("name").get<std::string>(),
                              static_cast<std::uint32_t>(within(pin.at("colour"), 0, 0xffffffff)),
                              pin.at("shown").get<bool>()});
    for (const Json& bookmark : value.at("bookmarks")) session.view_state.bookmarks.push_back(read_bookmark(bookmark));
    if (value.contains("edits")) session.edits = read_edits(value.at("edits"));
    return session;
  });
}

} // namespace nephroid::ui
