// SPDX-License-Identifier: Apache-2.0
#include "ui/presets/panel.h"

#include "base/counted.h"
#include "engine/engine.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

/// The colour of what stands in for a picture.
ImU32 badge_of(std::string_view name) {
  engine::Introduction introduction;
  for (const engine::Engine* engine : engine::engines())
    if (name_of(*engine) == name) introduction = engine->introduction;
  const auto [red, green, blue] = introduction.badge;
  return IM_COL32(red, green, blue, 255);
}

/// The picture in the middle of the area, as large as fits; without one the engine's name.
void draw_picture(const PictureTexture* picture, const CatalogueEntry& entry, const ImVec2& corner,
                  const ImVec2& size) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 end = corner + size;
  if (picture && !picture->empty()) {
    const ImTextureRef ref = picture->ref();
    const ImVec2 whole(static_cast<float>(ref._TexData->Width), static_cast<float>(ref._TexData->Height));
    const ImVec2 shown = std::min(size.x / whole.x, size.y / whole.y) * whole, low = corner + (size - shown) / 2;
    list->AddRectFilled(corner, end, colour::surround);
    list->AddImage(ref, low, low + shown);
    return;
  }
  list->AddRectFilled(corner, end, badge_of(entry.engine), 4);
  const std::string text = entry.problem.empty() ? entry.engine : "not readable";
  const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
  list->PushClipRect(corner, end, true);
  list->AddText({corner.x + std::max(2.0f, (size.x - extent.x) / 2), corner.y + (size.y - extent.y) / 2},
                colour::on_dark, text.c_str());
  list->PopClipRect();
}

} // namespace

std::vector<std::string> PresetsPanel::listed() const {
  std::vector<std::string> names;
  for (const std::size_t i : matches_) names.push_back(catalogue_.entries()[i].name);
  return names;
}

const CatalogueEntry* PresetsPanel::chosen_entry() const {
  for (const std::size_t i : matches_)
    if (catalogue_.entries()[i].file == chosen_) return &catalogue_.entries()[i];
  return nullptr;
}

void PresetsPanel::open(const Context& context, const CatalogueEntry& entry) const {
  context.push(command::Open{entry.file.string()});
}

void PresetsPanel::draw(const Context& context) {
  places_.clear();
  if (ImGui::IsWindowAppearing()) {
    catalogue_.read_again();
    thumbnails_.read_again();
  }
  const std::size_t readings = catalogue_.readings();
  catalogue_.follow(context.recent, context.tasks);
  if (catalogue_.readings() != readings) thumbnails_.read_again();
  thumbnails_.update(context.tasks);
  draw_top();
  matches_ = matches(catalogue_.entries(), filter_);
  follow_keys(context);
  const float details = std::min(12 * em(), ImGui::GetContentRegionAvail().y / 2);
  draw_list(context, ImGui::GetContentRegionAvail().y - details - ImGui::GetStyle().ItemSpacing.y);
  if (ImGui::BeginChild("details", {0, 0})) draw_details(context);
  ImGui::EndChild();
}

void PresetsPanel::draw_top() {
  // Whoever comes here without the mouse begins to type.
  const bool focused = ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows);
  if (focused && !focused_ && !ImGui::IsMouseDown(0)) ImGui::SetKeyboardFocusHere();
  focused_ = focused;
  ImGui::SetNextItemWidth(-16 * em());
  if (ImGui::InputTextWithHint("##search", "Search names, descriptions, engines", &filter_.words,
                               ImGuiInputTextFlags_EscapeClearsAll))
    reveal_ = true;
  typing_ = ImGui::IsItemActive() || ImGui::IsItemDeactivated(); // Enter ends typing, and opens
  places_.note("search");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(8 * em());
  {
    Combo list("##engine", filter_.engine.empty() ? "All engines" : filter_.engine, &places_, "engine");
    if (list.entry("All engines", filter_.engine.empty())) filter_.engine.clear();
    for (const engine::Engine* engine : engine::engines())
      if (const std::string name(name_of(*engine)); list.entry(name, filter_.engine == name)) filter_.engine = name;
  }
  ImGui::SameLine();
  places_.checkbox("Newest first", &filter_.newest_first, "newest",
                   "By when they were opened or written, else by name");
}

void PresetsPanel::follow_keys(const Context& context) {
  if (!focused_ || matches_.empty() || (ImGui::GetIO().WantTextInput && !typing_)) return;
  const auto at = std::find_if(matches_.begin(), matches_.end(),
                               [&](std::size_t i) { return catalogue_.entries()[i].file == chosen_; });
  const auto last = static_cast<std::ptrdiff_t>(matches_.size()) - 1;
  const std::ptrdiff_t now = at == matches_.end() ? -1 : at - matches_.begin();
  std::ptrdiff_t next = now;
  const auto step = [&](ImGuiKey key, std::ptrdiff_t by) {
    if (ImGui::IsKeyPressed(key)) next = std::clamp<std::ptrdiff_t>(now < 0 ? 0 : now + by, 0, last);
  };
  step(ImGuiKey_DownArrow, 1);
  step(ImGuiKey_UpArrow, -1);
  step(ImGuiKey_PageDown, page_);
  step(ImGuiKey_PageUp, -page_);
  if (next != now) {
    chosen_ = catalogue_.entries()[matches_[static_cast<std::size_t>(next)]].file.string();
    reveal_ = true;
  }
  if (!ImGui::IsKeyPressed(ImGuiKey_Enter, false) && !ImGui::IsKeyPressed(ImGuiKey_KeypadEnter, false)) return;
  if (const CatalogueEntry* entry = chosen_entry())
    open(context, *entry);
  else if (!filter_.words.empty()) { // what was searched for is at the top
    chosen_ = catalogue_.entries()[matches_.front()].file.string();
    open(context, catalogue_.entries()[matches_.front()]);
  }
}

void PresetsPanel::draw_list(const Context& context, float height) {
  if (ImGui::BeginChild("list", {0, std::max(height, em())}, ImGuiChildFlags_Borders, ImGuiWindowFlags_NoNav)) {
    if (matches_.empty()) ImGui::TextDisabled("%s", catalogue_.readings() == 0 ? "Reading..." : "Nothing is found.");
    for (const std::size_t i : matches_) draw_row(context, catalogue_.entries()[i]);
    reveal_ = false;
  }
  ImGui::EndChild();
}

void PresetsPanel::draw_row(const Context& context, const CatalogueEntry& entry) {
  const float high = 3.6f * em(), wide = high * thumbnail_width / thumbnail_height;
  page_ = std::max(1, static_cast<int>(ImGui::GetWindowHeight() / (high + ImGui::GetStyle().ItemSpacing.y)));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::PushID(entry.file.c_str());
  if (ImGui::Selectable("##row", entry.file == chosen_, ImGuiSelectableFlags_AllowDoubleClick, {0, high})) {
    chosen_ = entry.file.string();
    if (ImGui::IsMouseDoubleClicked(0)) open(context, entry);
  }
  ImGui::PopID();
  if (reveal_ && entry.file == chosen_) ImGui::SetScrollHereY();
  if (!ImGui::IsItemVisible()) return;
  places_.note(entry.name);
  draw_picture(thumbnails_.of(entry.thumbnail), entry, corner, {wide, high});
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float left = corner.x + wide + 0.6f * em();
  list->PushClipRect({left, corner.y}, {corner.x + width, corner.y + high}, true);
  list->AddText({left, corner.y}, entry.problem.empty() ? colour::text : colour::error, entry.name.c_str());
  const std::string& below = entry.problem.empty() ? entry.description : entry.problem;
  list->AddText(nullptr, 0, {left, corner.y + 1.2f * em()}, colour::quiet_text, below.c_str(), nullptr,
                std::max(em(), corner.x + width - left));
  list->PopClipRect();
}

void PresetsPanel::draw_details(const Context& context) {
  const CatalogueEntry* entry = chosen_entry();
  if (!entry) {
    ImGui::TextDisabled("%s", counted(matches_.size(), "preset").c_str());
    ImGui::TextDisabled("Click: what it is. Double click or Enter: open it. Arrows go through the list.");
    return;
  }
  if (places_.button("Open", "open")) open(context, *entry);
  ImGui::SameLine();
  ImGui::TextUnformatted(entry->title.empty() ? entry->name.c_str() : entry->title.c_str());
  if (!entry->problem.empty()) {
    draw_wrapped(colour::error, entry->problem);
    return;
  }
  draw_wrapped(colour::text, entry->description);
  std::string what =
      fmt::format("{}, {} x {} pixels, {}", entry->engine, entry->resolution[0], entry->resolution[1], entry->stop);
  if (entry->frames > 1) what += ", " + counted(entry->frames, "frame");
  if (entry->runs > 1) what += fmt::format(", a sweep of {}", counted(entry->runs, "run"));
  draw_wrapped(colour::quiet_text, what);
  if (entry->needs.empty()) draw_wrapped(colour::quiet_text, "Needs no other file");
  for (const RequiredFile& need : entry->needs)
    draw_wrapped(need.there ? colour::quiet_text : colour::error,
                 "Needs " + need.name + (need.there ? "" : ", which is not there"));
  draw_wrapped(colour::quiet_text, entry->file.string());
}

} // namespace nephroid::ui
