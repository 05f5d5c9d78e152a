// SPDX-License-Identifier: Apache-2.0
// `nephroid plan`: what a preset would run, what is left out and why, and the memory it takes. Renders nothing.
#include "plan/plan.h"
#include "cli/verb.h"
#include "preset/origins.h"
#include "preset/read.h"
#include "run/prepare.h"

#include <fmt/format.h>

namespace nephroid::cli {
namespace {

struct PlanOptions {
  std::string preset;
  std::vector<std::string> overrides;
  bool json = false;
};

void print_plans(const PlanOptions& options) {
  const std::vector<preset::Preset> presets = preset::read_presets(options.preset, options.overrides);
  for (const preset::Preset& preset : presets) {
    const auto prepared_plan = preset::at_origins(preset, [&] { return run::prepare(preset).plan; });
    const plan::Plan& plan = *prepared_plan;
    if (!options.json && presets.size() > 1) fmt::print("{}\n", preset.name);
    fmt::print("{}\n", options.json ? plan::to_json_line(plan, preset.name) : plan::to_text(plan));
  }
}

} // namespace

void add_plan(CLI::App& program, Session&) {
  const auto options = std::make_shared<PlanOptions>();
  Verb verb(program, "plan", "What a preset would run, what is left out and why, and the memory it takes",
            {{"nephroid plan first-light", ""},
             {"nephroid plan first-light --set leave_out=false", "what would run if nothing were left out"}});
  verb.option("PRESET", options->preset, {.says = "A preset file or the name of a shipped preset", .required = true});
  verb.overrides(options->overrides);
  verb.flag("--json", options->json, "One JSON object a run, a line each, instead of text");
  verb.work([options] { print_plans(*options); });
}

} // namespace nephroid::cli
