// SPDX-License-Identifier: Apache-2.0
// `nephroid devices`: what --device chooses from.
#include "base/counted.h"
#include "base/json_output.h"
#include "cli/device_line.h"
#include "cli/verb.h"
#include "cli/verbs.h"
#include "compute/compute.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace nephroid::cli {
namespace {

nlohmann::ordered_json to_json(const compute::DeviceInfo& device)
{
  return {{"index", device.index},
          {"name", device.name},
          {"type", device.type},
          {"platform", device.platform},
          {"driver", device.driver},
          {"version", device.version},
          {"compute_units", device.compute_units},
          {"memory_bytes", device.memory_bytes},
          {"max_buffer_bytes", device.max_buffer_bytes},
          {"max_group_items", device.max_group_items},
          {"fp64", device.fp64},
          {"int64_atomics", device.int64_atomics}};
}

void print_devices(bool json)
{
  if (const std::string note = compute::prepare_kernel_cache(); !note.empty()) fmt::print(stderr, "nephroid: {}\n", note);
  const std::vector<compute::DeviceInfo> devices = compute::list_devices();
  if (devices.empty()) throw compute::no_device_error();
  if (json) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const compute::DeviceInfo& device : devices) list.push_back(to_json(device));
    fmt::print("{}\n", json_text(nlohmann::ordered_json{{"devices", list}}));
    return;
  }
  for (const compute::DeviceInfo& device : devices) fmt::print("{}\n", device_line(device));
}

} // namespace

std::string device_line(const compute::DeviceInfo& device)
{
  return fmt::format("{}  {}  ({}, {}, {:.1f} GB, {} {}{}{})", device.index, device.name, device.type,
                     counted(device.compute_units, "compute unit"), static_cast<double>(device.memory_bytes) * 1e-9, device.platform,
                     device.driver, device.fp64 ? "" : ", no fp64", device.int64_atomics ? "" : ", no 64-bit atomics");
}

void add_devices(CLI::App& program, Session&)
{
  Verb verb(program, "devices", "The OpenCL devices that --device chooses from", {{"nephroid devices", ""}});
  const auto json = std::make_shared<bool>(false);
  verb.flag("--json", *json, "One object: {\"devices\":[{\"index\",\"name\",\"type\",...}]}");
  verb.work([json] { print_devices(*json); });
}

} // namespace nephroid::cli
