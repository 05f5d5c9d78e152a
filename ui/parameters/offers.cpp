// SPDX-License-Identifier: Apache-2.0
// What is looked for and not in the preset: types of objects that have it.
#include "engine/engine.h"
#include "ui/parameters/form.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

namespace nephroid::ui {
namespace {

using preset::Outline;
using Kind = Outline::Kind;

bool is_in(const std::vector<Outline>& fields, std::string_view name) {
  return std::ranges::any_of(fields, [&](const Outline& o) { return o.field.name == name; });
}

/// What a field holds now, an object or the items of a list or map: the first of each type, with its pointer.
std::map<std::string, std::pair<std::string, Json>> held_by(const Outline& o, const Json& value,
                                                            const std::string& pointer, const std::string& chooser) {
  std::map<std::string, std::pair<std::string, Json>> held;
  const auto add = [&](const std::string& at, const Json& item) {
    held.try_emplace(chooser.empty() ? "" : item.value(chooser, ""), at, item);
  };
  if (o.kind == Kind::object && !value.is_null()) add(pointer, value);
  if (o.kind == Kind::list || o.kind == Kind::map)
    for (const auto& item : value.items()) add(child_of(pointer, item.key()), item.value());
  return held;
}

} // namespace

std::vector<Form::Offer> Form::offers() const {
  std::vector<Offer> offers;
  if (!search.empty()) offer_in(preset::outline(draft.value()), draft.value(), "", offers);
  return offers;
}

std::vector<std::string> Form::of_other_engines() const {
  std::vector<std::string> lines;
  for (const engine::Engine* engine : engine::engines()) {
    const std::string name(name_of(*engine));
    if (search.empty() || draft.value().value("engine", "") == name) continue;
    for (const Outline& section : preset::outline({{"engine", name}}))
      for (const Outline& o :
           section.object&& section.field.name == name ? section.fields(section.fresh()) : std::vector<Outline>())
        if (has_words(fmt::format("{} {}", o.field.name, o.field.sentence), search))
          lines.push_back(fmt::format("{}.{}, of the engine {}: {}", name, o.field.name, name, o.field.sentence));
  }
  return lines;
}

void Form::offer_in(const std::vector<Outline>& fields, const Json& object, const std::string& pointer,
                    std::vector<Offer>& offers) const {
  for (const Outline& o : fields) {
    if (!o.object) continue;
    const std::string at = child_of(pointer, o.field.name);
    const Json& value = part(object, o);
    const Json fresh = o.kind == Kind::object && !value.is_null() ? value : o.fresh(); // another type keeps fields
    const std::vector<Outline> own = o.fields(fresh);
    const auto chooser = std::ranges::find_if(own, &Outline::chooses);
    const std::string key(chooser == own.end() ? "" : chooser->field.name);
    const auto held = held_by(o, value, at, key);
    std::vector<Outline> seen; // the fields that have rows of their own
    for (const auto& [type, item] : held) std::ranges::copy(o.fields(item.second), std::back_inserter(seen));
    const auto offer = [&](const std::string& type, std::string_view sentence, const Json& made) {
      const std::vector<Outline> inner = o.fields(made);
      const auto matching = std::ranges::find_if(inner, [&](const Outline& f) {
        return !f.chooses && !is_in(seen, f.field.name) &&
               has_words(fmt::format("{} {}", f.field.name, f.field.sentence), search);
      });
      const bool by_type = has_words(fmt::format("{} {}", type, sentence), search);
      if (!by_type && matching == inner.end()) return;
      std::string where = at, name;
      if (o.kind == Kind::map)
        name = untaken_name(type.empty() ? "new" : type, [&](const auto& n) { return value.contains(n); });
      if (o.kind == Kind::list || o.kind == Kind::map)
        where = child_of(at, o.kind == Kind::map ? name : std::to_string(value.size()));
      const auto whole = [this, kind = o.kind, made, name, there = Json::json_pointer(at)] {
        if (kind == Kind::object) return made;
        Json all = draft.value().value(there, Json());
        if (kind == Kind::map)
          all[name] = made;
        else
          all.push_back(made);
        return all;
      };
      const std::string help =
          by_type ? std::string(sentence) : fmt::format("{}: {}", matching->field.name, matching->field.sentence);
      offers.push_back({fmt::format("{}{}{}", dotted(at), type.empty() ? "" : ": ", type), help, at, where, whole});
    };
    if (chooser == own.end()) {
      if (held.empty()) offer("", o.field.sentence, fresh);
    } else {
      for (const Outline::Word& word : chooser->words)
        if (!held.contains(std::string(word.name)))
          offer(std::string(word.name), word.sentence,
                preset::as_type(
                    fresh, [&](const Json& other) { return o.fields(other); }, *chooser, word.name));
    }
    for (const auto& [type, item] : held) offer_in(o.fields(item.second), item.second, item.first, offers);
  }
}

} // namespace nephroid::ui
