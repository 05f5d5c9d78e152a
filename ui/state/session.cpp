// SPDX-License-Identifier: Apache-2.0
#include "ui/state/session.h"

#include "base/error.h"
#include "base/json_output.h"
#include "preset/read.h"
#include "ui/state/tone.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace nephroid::ui {
namespace {

using Json = nlohmann::ordered_json;
using PresetPtr = std::shared_ptr<const preset::Preset>;

constexpr int version = 1;

constexpr std::array tone_names{"standard", "filmic", "false_colour"}; ///< in the order of ToneCurve

Json bookmark_json(const Bookmark& bookmark)
{
  const preset::Camera& camera = bookmark.camera;
  return {{"name", bookmark.name}, {"position", camera.position}, {"target", camera.target},
          {"up", camera.up},       {"fov_deg", camera.fov_deg},   {"resolution", camera.resolution}};
}

Json look_json(const Look& look)
{
  Json json{{"exposure_stops", look.exposure_stops},
            {"tone", tone_names[static_cast<std::size_t>(look.tone)]},
            {"fit", look.fit},
            {"zoom", look.zoom},
            {"centre", look.centre}};
  if (look.false_colour) json["false_colour"] = {look.false_colour->low, look.false_colour->high};
  return json;
}

double finite(const Json& value, double low, double high)
{
  const double read = value.get<double>();
  if (!(read >= low && read <= high)) throw std::out_of_range(fmt::format("{} is not in {}..{}", read, low, high));
  return read;
}

Look read_look(const Json& value)
{
  constexpr double far = 1e6;
  Look look;
  look.exposure_stops = finite(value.at("exposure_stops"), -20, 20);
  const auto tone = std::ranges::find(tone_names, value.value("tone", std::string(tone_names[0])));
  if (tone == tone_names.end()) throw std::out_of_range("there is no such tone curve");
  look.tone = static_cast<ToneCurve>(tone - tone_names.begin());
  if (value.contains("false_colour"))
    look.false_colour = valid_range({value["false_colour"].at(0).get<double>(), value["false_colour"].at(1).get<double>()});
  look.fit = value.at("fit").get<bool>();
  look.zoom = finite(value.at("zoom"), 1.0 / 1024, 1024);
  for (std::size_t i = 0; i < 2; ++i) look.centre[i] = finite(value.at("centre").at(i), -far, far);
  return look;
}

Bookmark read_bookmark(const Json& value)
{
  constexpr double far = 1e12;
  const auto vector = [&](const char* key) {
    preset::Vec3 read{};
    for (std::size_t i = 0; i < 3; ++i) read[i] = finite(value.at(key).at(i), -far, far);
    return read;
  };
  Bookmark bookmark{value.at("name").get<std::string>(), {}};
  bookmark.camera.position = vector("position");
  bookmark.camera.target = vector("target");
  bookmark.camera.up = vector("up");
  bookmark.camera.fov_deg = finite(value.at("fov_deg"), 0, 180);
  for (std::size_t i = 0; i < 2; ++i) bookmark.camera.resolution[i] = static_cast<int>(finite(value.at("resolution").at(i), 1, 1 << 20));
  return bookmark;
}

/// The entries about the current one.
UndoStack::State trimmed(UndoStack::State state)
{
  while (state.entries.size() > Session::most_entries && state.index > Session::most_entries / 2) {
    state.entries.pop_front();
    --state.index;
    if (state.saved) state.saved = *state.saved > 0 ? std::optional(*state.saved - 1) : std::nullopt;
  }
  while (state.entries.size() > Session::most_entries) {
    state.entries.pop_back();
    if (state.saved && *state.saved >= state.entries.size()) state.saved.reset();
  }
  return state;
}

PresetPtr read_state(const Json& json, const std::string& source, const std::string& where)
{
  try {
    return std::make_shared<const preset::Preset>(preset::parse_preset(json.dump(), source));
  } catch (const Error& error) {
    throw std::out_of_range(where + " is no preset: " + error.text());
  }
}

preset::Sweep read_sweep(const Json& value)
{
  preset::Sweep sweep;
  for (const Json& field : value) {
    sweep.push_back({field.at(0).get<std::string>(), field.at(1).get<std::vector<std::string>>()});
    for (const std::string& swept_value : sweep.back().values)
      if (!Json::accept(swept_value)) throw std::out_of_range("a swept value is no JSON");
  }
  return sweep;
}

UndoStack::State read_edits(const Json& value)
{
  UndoStack::State state;
  const auto source = value.at("source").get<std::string>();
  state.opened = read_state(value.at("opened"), value.at("opened_source").get<std::string>(), "what was opened");
  Json now;
  for (const Json& entry : value.at("entries")) {
    if (state.entries.size() >= Session::most_entries) throw std::out_of_range("there are too many entries");
    now = state.entries.empty() ? entry.at("preset") : now.patch(entry.at("patch"));
    state.entries.push_back({entry.at("label").get<std::string>(), read_state(now, source, fmt::format("entry {}", state.entries.size())),
                             0, read_sweep(entry.value("sweep", Json::array()))});
  }
  const auto index_of = [&](const Json& json) {
    const auto index = json.get<std::size_t>();
    if (index >= state.entries.size()) throw std::out_of_range("the current entry is not there");
    return index;
  };
  state.index = index_of(value.at("index"));
  if (!value.at("saved").is_null()) state.saved = index_of(value.at("saved"));
  return state;
}

} // namespace

/// A preset as JSON, and what makes it of the one before.
struct SessionText::Known {
  PresetPtr preset, before;
  Json json, patch;
};

std::string SessionText::of(const Session& session)
{
  std::vector<std::shared_ptr<const Known>> used;
  const auto known = [&](const PresetPtr& preset, const std::shared_ptr<const Known>& before) {
    const PresetPtr before_preset = before ? before->preset : nullptr;
    for (const auto& entry : known_)
      if (entry->preset == preset && entry->before == before_preset) return used.emplace_back(entry);
    Json json = Json::parse(preset::to_json(*preset));
    Json patch = before ? Json::diff(before->json, json) : Json();
    return used.emplace_back(std::make_shared<const Known>(Known{preset, before_preset, std::move(json), std::move(patch)}));
  };
  Json text{{"version", version},
            {"closed", session.closed},
            {"look", look_json(session.chosen.look)},
            {"error_metric", session.chosen.error_metric},
            {"material", session.chosen.material}};
  text["pins"] = Json::array();
  for (const Session::Pin& pin : session.pins)
    text["pins"].push_back({{"folder", pin.folder}, {"name", pin.name}, {"colour", pin.colour}, {"shown", pin.shown}});
  text["bookmarks"] = Json::array();
  for (const Bookmark& bookmark : session.chosen.bookmarks) text["bookmarks"].push_back(bookmark_json(bookmark));
  if (session.edits) {
    const UndoStack::State state = trimmed(*session.edits);
    Json& edits = text["edits"];
    edits["source"] = state.entries[state.index].preset->source;
    edits["opened_source"] = state.opened->source;
    edits["opened"] = known(state.opened, nullptr)->json;
    edits["index"] = state.index;
    edits["saved"] = state.saved ? Json(*state.saved) : Json();
    std::shared_ptr<const Known> before;
    for (const UndoStack::Entry& entry : state.entries) {
      const auto now = known(entry.preset, before);
      edits["entries"].push_back({{"label", entry.label}, {before ? "patch" : "preset", before ? now->patch : now->json}});
      for (const preset::SweptField& field : entry.sweep) edits["entries"].back()["sweep"].push_back({field.key, field.values});
      before = now;
    }
  }
  known_ = std::move(used);
  return json_text(text);
}

namespace {

/// Calls read(value) of the text as JSON. Whatever is wrong becomes one error.
template <class Read>
auto read_session(const std::string& text, const std::string& source, Read read)
{
  try {
    const Json value = Json::parse(text);
    if (value.at("version").get<int>() != version) throw std::out_of_range("it is of another version of the program");
    return read(value);
  } catch (const std::exception& error) { // of the JSON library, or of the checks above
    throw bad_input(source, fmt::format("the session cannot be read ({})", error.what()));
  }
}

} // namespace

SessionHeader parse_session_header(const std::string& text, const std::string& source)
{
  return read_session(text, source, [](const Json& value) {
    return SessionHeader{value.at("closed").get<bool>(), value.contains("edits")};
  });
}

Session parse_session(const std::string& text, const std::string& source)
{
  return read_session(text, source, [](const Json& value) {
    Session session;
    session.closed = value.at("closed").get<bool>();
    session.chosen.look = read_look(value.at("look"));
    session.chosen.error_metric = value.at("error_metric").get<std::string>();
    session.chosen.material = value.at("material").get<std::string>();
    for (const Json& pin : value.at("pins"))
      session.pins.push_back({pin.at("folder").get<std::string>(), pin.at("name").get<std::string>(), pin.at("colour").get<std::uint32_t>(),
                              pin.at("shown").get<bool>()});
    for (const Json& bookmark : value.at("bookmarks")) session.chosen.bookmarks.push_back(read_bookmark(bookmark));
    if (value.contains("edits")) session.edits = read_edits(value.at("edits"));
    return session;
  });
}

} // namespace nephroid::ui
