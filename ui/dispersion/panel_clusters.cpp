// SPDX-License-Identifier: Apache-2.0
// The lower half of the panel "Dispersion": threshold, methods with their counts, and what clustering costs in bias.
#include "base/counted.h"
#include "preset/choices.h"
#include "spectral/describe_settings.h"
#include "ui/dispersion/panel.h"
#include "ui/state/workbench.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

constexpr double least_threshold_deg = 0.001, greatest_threshold_deg = 10; ///< of the slider

double three_digits(double value)
{
  const double decimal = std::pow(10, 2 - std::floor(std::log10(value)));
  return std::round(value * decimal) / decimal;
}

std::string spread_text(const Spread& spread) { return fmt::format("{:.3f} / {:.3f}", spread.mean_deg, spread.greatest_deg); }

void heading(const char* text, const char* help)
{
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", text);
  ImGui::SetItemTooltip("%s", help);
}

void cell(const std::string& text)
{
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(text.c_str());
}

} // namespace

void DispersionPanel::edit_spectral(const Frame& frame, const std::string& label, const spectral::Settings& spectral, std::uint64_t gesture,
                                    bool live)
{
  preset::Preset edited = frame.preset;
  spectral::settings(edited) = spectral;
  frame.commands.push_back(command::Edit{label, std::move(edited), gesture, live});
}

void DispersionPanel::draw_threshold(const Frame& frame)
{
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Threshold");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  spectral::Settings spectral = spectral::settings(frame.preset);
  const bool changed =
      ImGui::SliderScalar("##threshold", ImGuiDataType_Double, &spectral.threshold_deg, &least_threshold_deg, &greatest_threshold_deg,
                          "%.3g degrees", ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  places_.note("Threshold");
  if (ImGui::IsItemActivated()) gestures_.begin();
  spectral.threshold_deg = std::clamp(three_digits(spectral.threshold_deg), least_threshold_deg, greatest_threshold_deg);
  if (changed && spectral != spectral::settings(frame.preset))
    edit_spectral(frame, "threshold of the clusters", spectral, gestures_.number(), true);
  if (ImGui::IsItemDeactivated()) frame.commands.push_back(command::EndGesture{});
  ImGui::SetItemTooltip(
      "Largest change of the refraction angle inside a cluster, as the mean over 0..89 degrees of incidence. Ctrl+click: type it");
}

void DispersionPanel::draw_methods(const Frame& frame)
{
  if (!ImGui::BeginTable("methods", 5, ImGuiTableFlags_SizingStretchProp)) return;
  heading("Method", "How wavelengths are grouped; what is checked is what the run uses");
  heading("Clusters", "Groups of wavelengths that share one path each");
  heading("Saving", "401 wavelengths / clusters: so many times fewer paths than one for each wavelength");
  heading("At 45 deg",
          "By how many degrees the refraction angle differs inside a cluster at 45 degrees of incidence: mean over the wavelengths / "
          "greatest");
  heading("0..89 deg", "The same as the mean over 0 to 89 degrees of incidence, which the threshold is about");
  for (const auto& choice : preset::Choices<spectral::ClusterMethod>::all) {
    const ClusterFigures& figures = model_.figures(choice.value);
    const std::string name(choice.name == "brute_force" ? "brute force" : choice.name);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (ImGui::RadioButton(name.c_str(), spectral::settings(frame.preset).method == choice.value)) {
      spectral::Settings spectral = spectral::settings(frame.preset);
      spectral.method = choice.value;
      edit_spectral(frame, "method of the clusters: " + name, spectral);
    }
    places_.note(name.c_str());
    ImGui::SetItemTooltip("%s", std::string(choice.sentence).c_str());
    cell(fmt::format("{}", figures.clustering.clusters.size()));
    cell(fmt::format("{:.3g}", figures.saving));
    cell(spread_text(figures.at_45));
    cell(spread_text(figures.over_angles));
  }
  ImGui::EndTable();
}

void DispersionPanel::draw_bias(const Frame& frame)
{
  spectral::Settings spectral = spectral::settings(frame.preset);
  if (ImGui::Checkbox("Jitter", &spectral.jitter))
    edit_spectral(frame, spectral.jitter ? "jitter wavelengths" : "do not jitter wavelengths", spectral);
  places_.note("Jitter");
  ImGui::SetItemTooltip("Each photon takes one wavelength of its cluster (spectral.jitter)");
  ImGui::SameLine();
  const Spread& spread = model_.chosen().at_45;
  std::string text;
  if (spectral.jitter)
    text = "Bias 0: each photon takes one wavelength of its cluster";
  else if (spread.greatest_deg == 0)
    text = "Bias 0: no cluster bends two rays alike that differ";
  else
    text = fmt::format("Bias: rays of a cluster go one way that differ by up to {:.2g} degrees", spread.greatest_deg);
  draw_wrapped(colour::quiet_text, text);
  draw_effort(frame);
  if (const auto clusters = model_.clusters_of_run(); clusters && *clusters != model_.chosen().clustering.clusters.size())
    draw_wrapped(colour::quiet_text,
                 fmt::format("The run has {}: those of all its glasses, step_nm and differentials", counted(*clusters, "cluster")));
}

/// What unequal work saves on top of the clusters.
void DispersionPanel::draw_effort(const Frame& frame)
{
  using Effort = spectral::Settings::Effort;
  saving_by_effort_.reset();
  const Effort effort = spectral::settings(frame.preset).effort;
  if (effort != Effort::importance && effort != Effort::radziszewski) return;
  const Spectra& work = work_.update(frame.preset, frame.workbench.seen_by_glass());
  if (!work.why_no_u.empty() || work.iterations() == 0) return; // the panel "Spectra and importance" says why
  saving_by_effort_ = static_cast<double>(work.brute_force()) / static_cast<double>(work.iterations());
  draw_wrapped(colour::quiet_text, fmt::format("With effort {}: {:.3g} times fewer iterations than brute force",
                                               effort == Effort::importance ? "importance" : "radziszewski", *saving_by_effort_));
}

} // namespace nephroid::ui
