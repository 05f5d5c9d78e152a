// SPDX-License-Identifier: Apache-2.0
// The lower half of the panel "Dispersion": methods with their counts, and what clustering costs in bias.
#include "base/counted.h"
#include "preset/choices.h"
#include "spectral/describe_settings.h"
#include "ui/dispersion/panel.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

namespace nephroid::ui {
namespace {

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

/// The run's method is the one that is not greyed.
void DispersionPanel::draw_methods(const Context& context) const
{
  if (!ImGui::BeginTable("methods", 5, ImGuiTableFlags_SizingStretchProp)) return;
  heading("Method", "How wavelengths are grouped (spectral.method); the run's is not greyed");
  heading("Clusters", "Groups of wavelengths that share one path each");
  heading("Saving", "401 wavelengths / clusters: so many times fewer paths than one for each wavelength");
  heading("At 45 deg",
          "By how many degrees the refraction angle differs inside a cluster at 45 degrees of incidence: mean over the wavelengths / "
          "greatest");
  heading("0..89 deg", "The same as the mean over 0 to 89 degrees of incidence, which spectral.threshold_deg is about");
  for (const auto& choice : preset::Choices<spectral::ClusterMethod>::all) {
    const ClusterFigures& figures = model_.figures(choice.value);
    const std::string name(choice.name == "brute_force" ? "brute force" : choice.name);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::BeginDisabled(spectral::settings(*context.preset()).method != choice.value);
    ImGui::TextUnformatted(name.c_str());
    ImGui::SetItemTooltip("%s", std::string(choice.sentence).c_str());
    cell(fmt::format("{}", figures.clustering.clusters.size()));
    cell(fmt::format("{:.3g}", figures.saving));
    cell(spread_text(figures.at_45));
    cell(spread_text(figures.over_angles));
    ImGui::EndDisabled();
  }
  ImGui::EndTable();
}

void DispersionPanel::draw_bias(const Context& context) const
{
  const Spread& spread = model_.chosen().at_45;
  std::string text;
  if (spectral::settings(*context.preset()).jitter)
    text = "Bias 0: each photon takes one wavelength of its cluster";
  else if (spread.greatest_deg == 0)
    text = "Bias 0: no cluster bends two rays alike that differ";
  else
    text = fmt::format("Bias: rays of a cluster go one way that differ by up to {:.2g} degrees", spread.greatest_deg);
  draw_wrapped(colour::quiet_text, text);
  if (const auto clusters = model_.clusters_of_run(); clusters && *clusters != model_.chosen().clustering.clusters.size())
    draw_wrapped(colour::quiet_text,
                 fmt::format("The run has {}: those of all its glasses, step_nm and differentials", counted(*clusters, "cluster")));
}

} // namespace nephroid::ui
