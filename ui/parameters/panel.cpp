// SPDX-License-Identifier: Apache-2.0
#include "ui/parameters/panel.h"

#include "preset/origins.h"
#include "preset/read.h"
#include "ui/state/additions.h"
#include "ui/widgets/action.h"

#include <algorithm>
#include <utility>

namespace nephroid::ui {

void ParametersPanel::draw(const Context& context) {
  form_.draft.follow(*context.preset());
  if (const auto& opened = context.edits->state().opened; std::exchange(opened_, opened) != opened) {
    form_.search.clear();
    form_.only_changed = false;
  }
  form_.tasks = &context.tasks;
  form_.balls = &context.balls;
  form_.selected = pointer_of(context.selection());
  places_.clear();
  if (const Selection selection = context.selection(); selection != revealed_) {
    revealed_ = selection;
    if (const std::string pointer = pointer_of(selection); !pointer.empty()) form_.reveal = pointer;
  }
  const std::string revealing = form_.reveal;
  follow_run(context);
  draw_top();
  const float room = ImGui::GetContentRegionAvail().y,
              help = room > 24 * em() ? 3.5f * ImGui::GetTextLineHeightWithSpacing() : 0;
  if (ImGui::BeginChild("fields", {0, room - help})) {
    ImGui::PushID(form_.searching() ? "found" : "all"); // what a search opens is closed again after it
    if (ImGui::BeginTable("fields", 2,
                          ImGuiTableFlags_Resizable | ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV)) {
      ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 2);
      ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 3);
      ImGui::PushItemFlag(ImGuiItemFlags_NoTabStop, true); // Tab goes on to the next number or text
      rows_.draw_fields(preset::outline(form_.draft.value()), form_.draft.value(), "");
      ImGui::PopItemFlag();
      ImGui::EndTable();
    }
    const std::vector<Form::Offer> offers = form_.offers();
    if (!form_.finds_any()) {
      draw_wrapped(colour::quiet_text, form_.search.empty() ? "Every field is as it is by default."
                                       : offers.empty()     ? "No name, unit or help of this preset has these words."
                                                            : "No field of this preset has these words.");
      if (offers.empty())
        for (const std::string& line : form_.of_other_engines()) {
          draw_wrapped(colour::quiet_text, line);
          form_.note(line.substr(0, line.find(',')));
        }
      form_.note("nothing");
    }
    draw_offers(context, offers);
    ImGui::PopID();
  }
  ImGui::EndChild();
  if (help > 0)
    draw_wrapped(colour::quiet_text, rows_.help().empty()
                                         ? "Drag a number, or click on it and type. A right click on a name: its menu."
                                         : rows_.help());
  if (form_.reveal == revealing) form_.reveal.clear(); // in sight, or nowhere
  form_.push_edits(context);
}

/// What the run found wrong with the preset is said at its field, too.
void ParametersPanel::follow_run(const Context& context) {
  form_.refused.reset();
  const std::optional<Error>& error = context.run.status().error;
  if (!error) return;
  const std::string field = preset::field_of(*context.preset(), error->location());
  if (!field.empty()) form_.refused = {field, field, error->text()};
}

/// What a search finds beyond the preset: actions that add it, then types that have it.
void ParametersPanel::draw_offers(const Context& context, const std::vector<Form::Offer>& offers) {
  constexpr std::size_t most = 12;
  if (form_.search.empty()) return;
  ImGui::Spacing();
  for (const Action& action : actions())
    if (action.menu == "Add" && has_words(action.name + " " + action.help, form_.search)) {
      action_button(action.name.c_str(), context);
      places_.note(action.name);
      ImGui::SameLine();
      draw_wrapped(colour::quiet_text, action.help);
    }
  for (std::size_t i = 0; i < std::min(offers.size(), most); ++i) {
    const Form::Offer& offer = offers[i];
    if (places_.small_button(("Make " + offer.name).c_str(), "make " + offer.name)) {
      Json value = offer.value();
      if (offer.pointer == "/scene/lights") { // stands where "Add lamp" puts one, and is as strong
        const Json lamp = preset::as_json(with_thing(*context.preset(), Thing::lamp).preset)["scene"]["lights"].back();
        for (const char* const key : {"position", "power_w"})
          if (value.back().contains(key)) value.back()[key] = lamp[key];
      }
      form_.ask(offer.name, offer.pointer, value);
      form_.search.clear();
      form_.only_changed = false;
      form_.reveal = offer.made;
    }
    ImGui::SameLine();
    draw_wrapped(colour::quiet_text, offer.help);
  }
  if (offers.size() > most) ImGui::TextDisabled("and %zu more", offers.size() - most);
}

void ParametersPanel::draw_top() {
  const float changed =
      ImGui::CalcTextSize("Changed").x + ImGui::GetFrameHeight() + 3 * ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetNextItemWidth(-changed);
  ImGui::InputTextWithHint("##search", "Search names, units and help", &form_.search,
                           ImGuiInputTextFlags_EscapeClearsAll);
  places_.note("search");
  ImGui::SameLine();
  places_.checkbox("Changed", &form_.only_changed, "changed", "Only fields that are not as they are by default");
  for (const auto& [edit, problem] : std::map(form_.draft.problems())) {
    ImGui::PushID(edit.c_str());
    if (places_.small_button("Take back", edit + ":drop")) form_.draft.drop(edit);
    ImGui::SameLine();
    if (ImGui::SmallButton(("Show " + dotted(shown_at(problem))).c_str())) {
      form_.search.clear();
      form_.only_changed = false;
      form_.reveal = shown_at(problem);
    }
    ImGui::PopID();
  }
  if (!form_.draft.problems().empty()) draw_wrapped(colour::error, "The run goes on without this, until it is mended.");
}

} // namespace nephroid::ui
