// SPDX-License-Identifier: Apache-2.0
// What has any number of items: lists and maps of objects, tables, lists of numbers and of texts.
#include "base/counted.h"
#include "ui/parameters/panel.h"
#include "ui/widgets/theme.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

using preset::Outline;
using Kind = Outline::Kind;

constexpr std::size_t many_rows = 50; ///< rows out of sight are not drawn where there are more

double clamped(double value, const preset::Bounds& bounds) { return std::clamp(value, bounds.low, bounds.high); }

/// The row that is added: after the last one as far as that is from the one before.
Json next_row(const Outline& o, const Json& rows) {
  if (o.kind == Kind::texts) return "";
  if (o.kind == Kind::numbers) return clamped(0, o.field.bounds);
  const preset::Column &first = o.field.columns[0], &second = o.field.columns[1];
  if (rows.empty()) return {clamped(first.unit == "nm" ? 550 : 0, first.bounds), clamped(1, second.bounds)};
  const auto at = [&](std::size_t back) { return rows[rows.size() - back].at(0).get<double>(); };
  return {clamped(at(1) + (rows.size() > 1 ? at(1) - at(2) : 10), first.bounds), rows.back().at(1)};
}

/// Renames the uses of a material in an object and whatever is inside of it.
void rename_uses(const std::vector<Outline>& fields, Json& object, const std::string& name, const std::string& to) {
  for (const Outline& o : fields) {
    const auto found = object.find(o.field.name);
    if (found == object.end()) continue;
    Json& value = *found;
    if (o.field.names == preset::Names::material && value == name)
      value = to;
    else if (!value.is_null() && o.kind == Kind::object)
      rename_uses(o.fields(value), value, name, to);
    else if (o.kind == Kind::list || o.kind == Kind::map)
      for (Json& item : value) rename_uses(o.fields(item), item, name, to);
  }
}

/// A copy of an item that has a name of its own.
Json copy_of(const Json& items, Json item) {
  if (const auto name = item.find("name");
      name != item.end() && name->is_string() && !name->get_ref<const std::string&>().empty())
    *name = untaken_name(*name, [&](const std::string& n) {
      return std::any_of(items.begin(), items.end(), [&](const Json& other) { return other.value("name", "") == n; });
    });
  return item;
}

} // namespace

void FieldRows::draw_add(const Outline& o, const Json& value, const std::string& pointer) {
  ImGui::BeginDisabled(value.size() >= o.field.count.high);
  if (ImGui::Button(("Add##" + pointer).c_str())) {
    Json more = value;
    std::string key = std::to_string(value.size());
    if (o.kind == Kind::map)
      more[key = untaken_name("new", [&](const std::string& n) { return value.contains(n); })] = o.fresh();
    else
      more.push_back(o.kind == Kind::list ? o.fresh() : next_row(o, value));
    form_.ask("add to " + dotted(pointer), pointer, std::move(more));
    form_.reveal = child_of(pointer, key);
  }
  ImGui::EndDisabled();
  form_.note(pointer + ":add");
  ImGui::SameLine();
  if (o.kind == Kind::table) {
    if (ImGui::Button(("Sort##" + pointer).c_str())) {
      Json sorted = value;
      std::stable_sort(sorted.begin(), sorted.end(), [](const Json& a, const Json& b) { return a.at(0) < b.at(0); });
      form_.ask("sort " + dotted(pointer), pointer, std::move(sorted));
    }
    form_.note(pointer + ":sort");
    ImGui::SameLine();
  }
  ImGui::TextDisabled("%s", counted(value.size(), o.kind == Kind::table ? "row" : "item").c_str());
}

/// Draws the buttons behind an item of a list or a map: duplicate, move, remove.
void FieldRows::draw_item_buttons(const Json& items, const std::string& key, const std::string& pointer) {
  const std::string at = child_of(pointer, key);
  const bool is_list = items.is_array();
  const std::size_t index = is_list ? std::stoul(key) : 0;
  const auto button = [&](const char* label, const char* name, const char* help, const auto& change) {
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    if (ImGui::SmallButton(fmt::format("{}##{}{}", label, name, at).c_str())) {
      Json changed = items;
      change(changed);
      form_.ask(fmt::format("{} {}", name, dotted(at)), pointer, std::move(changed));
    }
    form_.note(at + ":" + name, help);
  };
  button("+", "duplicate", "One more like this", [&](Json& changed) {
    if (is_list)
      changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(index) + 1, copy_of(items, items[index]));
    else
      changed[untaken_name(key, [&](const std::string& n) { return items.contains(n); })] = items[key];
  });
  if (is_list) {
    ImGui::BeginDisabled(index == 0);
    button("^", "move up", "Before the one above",
           [&](Json& changed) { std::swap(changed[index - 1], changed[index]); });
    ImGui::EndDisabled();
  }
  button("x", "remove", "Remove this", [&](Json& changed) {
    if (is_list)
      changed.erase(index);
    else
      changed.erase(key);
  });
}

void FieldRows::draw_items(const Outline& o, const Json& value, const std::string& pointer) {
  for (const auto& entry : value.items()) {
    const Json& item = entry.value();
    const std::string& key = entry.key();
    const std::string at = child_of(pointer, key);
    if (form_.searching() && !form_.wants_any(o, item, at)) continue;
    const std::string name = item.value("name", "");
    const bool open = draw_label(name.empty() ? key : fmt::format("{}  {}", key, name), at, false, true);
    ImGui::TableNextColumn();
    values_.draw_type(o, item, at);
    draw_item_buttons(value, key, pointer);
    if (o.kind == Kind::map && open) draw_name(value, key, pointer);
    draw_problem(at, !open);
    if (pointer == materials_pointer && open) draw_picture(key, at);
    if (!open) continue;
    draw_fields(o.fields(item), item, at);
    ImGui::TreePop();
  }
}

/// Draws the name of a map's item, to be typed.
void FieldRows::draw_name(const Json& items, const std::string& name, const std::string& pointer) {
  const std::string at = child_of(pointer, name), id = at + ":name";
  ImGui::TextDisabled("name");
  ImGui::SameLine();
  const auto problem = [&](const std::string& text) -> std::optional<Problem> {
    if (!text.empty() && !items.contains(text)) return std::nullopt;
    return Problem{at, at, text.empty() ? "a name is wanted" : "there is another " + text};
  };
  if (const auto to = values_.type_text(id, name, -ImGui::GetFrameHeight(), problem)) rename(pointer, name, *to);
  if (values_.typed_at() == id && values_.wrong()) draw_wrapped(colour::error, values_.wrong()->text);
}

/// Renames an item of a map, and all uses of the name.
void FieldRows::rename(const std::string& map, const std::string& name, const std::string& to) {
  Json whole = form_.draft.value(), renamed = Json::object();
  Json& items = whole[Json::json_pointer(map)];
  if (to.empty() || items.contains(to)) return;
  for (const auto& [key, item] : items.items()) renamed[key == name ? to : key] = item;
  items = renamed;
  rename_uses(preset::outline(whole), whole, name, to);
  form_.ask(fmt::format("rename {} to {}", name, to), "", std::move(whole));
}

void FieldRows::draw_rows(const Outline& o, const Json& value, const std::string& pointer) {
  const bool pairs = o.kind == Kind::table;
  if (pairs) {
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(1);
    const auto heading = [](const preset::Column& c) {
      return std::string(c.name) + (c.unit.empty() ? "" : " (" + std::string(c.unit) + ")");
    };
    ImGui::TextDisabled("%s, %s", heading(o.field.columns[0]).c_str(), heading(o.field.columns[1]).c_str());
  }
  const auto draw_row = [&](std::size_t i) {
    const std::string at = child_of(pointer, std::to_string(i));
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    draw_label(std::to_string(i), at, true, false);
    ImGui::TableNextColumn();
    const float width = ImGui::GetContentRegionAvail().x - 3 * ImGui::GetFrameHeight();
    if (pairs)
      for (std::size_t c = 0; c < 2; ++c) {
        if (c > 0) ImGui::SameLine(0, gap);
        values_.draw_number({o.field.columns[c].bounds, false, (width - gap) / 2}, value[i].at(c),
                            child_of(at, std::to_string(c)));
      }
    else if (o.kind == Kind::texts)
      values_.draw_text(at, value[i], width, [](const std::string& text) { return Json(text); });
    else
      values_.draw_number({o.field.bounds, o.whole, width}, value[i], at);
    draw_item_buttons(value, std::to_string(i), pointer);
    draw_problem(at, true);
  };
  if (value.size() > many_rows) return draw_rows_in_sight(value.size(), draw_row);
  for (std::size_t i = 0; i < value.size(); ++i) draw_row(i);
}

} // namespace nephroid::ui
