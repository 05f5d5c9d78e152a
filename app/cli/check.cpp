// SPDX-License-Identifier: Apache-2.0
// `nephroid check`: the numerical self-checks of a device, a line each as it is done.
#include "check/check.h"
#include "base/interrupts.h"
#include "base/json_output.h"
#include "cli/verb.h"
#include "engine/engine.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>

namespace nephroid::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct CheckOptions {
  compute::DeviceOptions device;
  std::uint64_t seed = 1;
  bool all = false, details = false, json = false;
};

/// The device's properties that matter to the kernels. They are no checks: each of them works or is refused.
std::string properties(const compute::DeviceInfo& device) {
  return fmt::format("{}; {}; groups of up to {} work items, of which 64 are used",
                     device.int64_atomics ? "64-bit atomics" : "no 64-bit atomics: sums by 32-bit halves",
                     device.fp64 ? "double precision, which no kernel uses"
                                 : "no double precision, which no kernel uses",
                     device.max_group_items);
}

constexpr const char* line_format = "{:<42}  {:>10}  {:>10}  {:<9}  {}\n";

void print_row(const check::Result& result, bool details) {
  fmt::print(fmt::runtime(line_format), result.name,
             std::isnan(result.figure) ? "none" : fmt::format("{:.3g}", result.figure),
             fmt::format("{:.3g}", result.tolerance), result.unit, result.passed() ? "pass" : "FAIL");
  if (details || !result.passed()) fmt::print("    {}\n", result.detail);
  std::fflush(stdout);
}

nlohmann::ordered_json to_json(const std::string& device, const std::vector<check::Result>& results) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const check::Result& r : results) // NaN becomes null
    list.push_back({{"name", r.name},
                    {"figure", r.figure},
                    {"tolerance", r.tolerance},
                    {"unit", r.unit},
                    {"pass", r.passed()},
                    {"detail", r.detail}});
  return {{"device", device}, {"checks", list}};
}

/// Runs every check on one device and prints them. Returns the names of those that failed.
std::vector<std::string> check_device(const CheckOptions& options, const compute::DeviceOptions& which,
                                      const std::stop_token& interrupted) {
  const auto begin = Clock::now();
  const compute::Context context = compute::Context::open(which);
  const compute::DeviceInfo& device = context.device();
  if (!options.json) {
    fmt::print("{}\n   {}\n\n", device_line(device), properties(device));
    fmt::print(fmt::runtime(line_format), "check", "figure", "tolerance", "unit", "result");
  }
  std::vector<check::Result> results;
  std::vector<std::string> failures;
  for (const check::Check& check : engine::checks()) {
    if (interrupted.stop_requested())
      throw Error(ErrorKind::interrupted, device.name,
                  fmt::format("interrupted after {} of {} checks", results.size(), engine::checks().size()));
    results.push_back(check::run_check(check, context, options.seed));
    if (!results.back().passed()) failures.push_back(results.back().name);
    if (!options.json) print_row(results.back(), options.details);
  }
  if (options.json)
    fmt::print("{}\n", json_text(to_json(device.name, results)));
  else
    fmt::print("\n{} of {} checks pass, in {:.1f} s\n\n", results.size() - failures.size(), results.size(),
               std::chrono::duration<double>(Clock::now() - begin).count());
  std::fflush(stdout);
  return failures;
}

std::vector<compute::DeviceOptions> devices_to_check(const CheckOptions& options) {
  if (!options.all) return {options.device};
  std::vector<compute::DeviceOptions> list;
  for (const compute::DeviceInfo& device : compute::list_devices())
    list.push_back({std::to_string(device.index), options.device.kernels});
  if (list.empty()) throw compute::no_device_error();
  return list;
}

void check_devices(const CheckOptions& options) {
  const Interrupts interrupts; // before OpenCL starts its threads
  if (const std::string note = compute::prepare_kernel_cache(); !note.empty()) fmt::print(stderr, "note: {}\n", note);
  std::vector<std::string> failures;
  for (const compute::DeviceOptions& device : devices_to_check(options))
    for (std::string& name : check_device(options, device, interrupts.token())) failures.push_back(std::move(name));
  if (!failures.empty())
    throw failed("check", fmt::format("{} failed: {}", failures.size(), fmt::join(failures, ", ")), {},
                 "docs/checking.md says what each one means");
}

} // namespace

void add_check(CLI::App& program, Session&) {
  const auto options = std::make_shared<CheckOptions>();
  Verb verb(program, "check", "Numerical self-checks of a device: run it first on a new one",
            {{"nephroid check --details", ""}},
            "Each check has a figure, how far it is from the truth, and a tolerance. Exit code 1 where one fails.");
  verb.option("--device", options->device.selector,
              {.type = "SEL", .says = "An index or part of a name (see nephroid devices)"});
  verb.flag("--all", options->all, "Every device there is, one after the other", "--device");
  verb.option("--kernels", options->device.kernels,
              {.type = "DIR", .says = "Load kernels from this folder instead of the built-in ones"});
  verb.option(
      "--seed", options->seed,
      {.type = "N", .says = "Of the random numbers (default 1); a right device passes with every one", .from = 0});
  verb.flag("--details", options->details, "Say under each line what was compared with what");
  verb.flag("--json", options->json,
            "One object a device: "
            "{\"device\",\"checks\":[{\"name\",\"figure\",\"tolerance\",\"unit\",\"pass\",\"detail\"}]}");
  verb.work([options] { check_devices(*options); });
}

} // namespace nephroid::cli
