// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/start_page.h"

#include "base/counted.h"
#include "base/files.h"
#include "engine/engine.h"

#include <fmt/format.h>

namespace nephroid::ui {
namespace {

/// A card each; the preset's picture is the card's.
std::vector<engine::ShippedExample> examples() {
  std::vector<engine::ShippedExample> examples;
  for (const engine::Engine* engine : engine::engines())
    if (engine->introduction.example.preset) examples.push_back(engine->introduction.example);
  return examples;
}

constexpr float picture_aspect = static_cast<float>(thumbnail_height) / static_cast<float>(thumbnail_width);

std::filesystem::path file_of(const engine::ShippedExample& example) {
  return presets_folder() / (std::string(example.preset) + ".json");
}

void draw_card(const engine::ShippedExample& card, const PictureTexture* picture, float width, const Context& context,
               WidgetPlaces& places) {
  const float high = 7 * em();
  ImGui::PushID(card.preset);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
  if (ImGui::BeginChild("card", {width, high + 2 * ImGui::GetStyle().WindowPadding.y},
                        ImGuiChildFlags_Borders | ImGuiChildFlags_NavFlattened)) {
    const ImVec2 corner = ImGui::GetCursorScreenPos(), size{high / picture_aspect, high};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(corner, corner + size, colour::surround);
    if (picture) list.AddImage(picture->ref(), corner, corner + size);
    ImGui::SetCursorScreenPos({corner.x + size.x + em(), corner.y});
    ImGui::BeginGroup();
    ImGui::TextUnformatted(card.title);
    draw_wrapped(colour::quiet_text, card.sentence);
    if (places.button("Open an example", card.preset, card.preset)) context.push(command::Open{file_of(card).string()});
    ImGui::EndGroup();
  }
  ImGui::EndChild();
  ImGui::PopStyleColor();
  ImGui::PopID();
}

} // namespace

void StartPage::draw(const Context& context, Panel& presets, bool to_presets) {
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport.WorkPos);
  ImGui::SetNextWindowSize(viewport.WorkSize);
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoDocking | ImGuiWindowFlags_NoSavedSettings |
                                     ImGuiWindowFlags_NoBringToFrontOnFocus;
  if (ImGui::Begin("Start", nullptr, flags)) {
    draw_engines(context);
    draw_devices(context.tasks);
    ImGui::Spacing();
    for (const char* name : {"New scene", "Open...", "Reopen the last session", "Commands..."}) {
      action_button(name, context);
      places_.note(name);
      ImGui::SameLine();
    }
    ImGui::TextDisabled("or drop a preset, a glTF scene or a run's folder here");
    if (to_presets) ImGui::SetNextWindowFocus();
    if (ImGui::BeginChild("presets", {}, ImGuiChildFlags_NavFlattened)) presets.draw(context);
    ImGui::EndChild();
  }
  ImGui::End();
}

void StartPage::draw_engines(const Context& context) {
  static const std::vector<engine::ShippedExample> cards = examples();
  if (pictures_.empty())
    for (const engine::ShippedExample& card : cards) pictures_.push_back(thumbnail_of(file_of(card), {}));
  thumbnails_.update(context.tasks);
  const auto count = static_cast<float>(cards.size());
  const float gap = ImGui::GetStyle().ItemSpacing.x,
              width = (ImGui::GetContentRegionAvail().x - (count - 1) * gap) / count;
  for (std::size_t i = 0; i < cards.size(); ++i) {
    if (i > 0) ImGui::SameLine();
    draw_card(cards[i], thumbnails_.of(pictures_[i]), width, context, places_);
  }
}

void StartPage::draw_devices(TaskQueue& tasks) {
  if (!devices_) {
    const auto look = [] {
      Devices devices{compute::list_devices(), {}};
      if (devices.list.empty()) devices.why_none = compute::no_device_error().line();
      return devices;
    };
    if (!tasks.busy(asking_))
      tasks.start(asking_, {"looking for devices"}, look, [this](Devices devices) { devices_ = std::move(devices); });
    return draw_wrapped(colour::quiet_text, "Looking for devices");
  }
  if (!devices_->why_none.empty()) return draw_wrapped(colour::error, devices_->why_none);
  std::string line = "Devices";
  for (const compute::DeviceInfo& device : devices_->list)
    line += fmt::format("   {}: {} ({}, {}, {:.1f} GB)", device.index, device.name, device.type,
                        counted(device.compute_units, "compute unit"), static_cast<double>(device.memory_bytes) * 1e-9);
  draw_wrapped(colour::quiet_text, line);
}

} // namespace nephroid::ui
