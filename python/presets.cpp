// SPDX-License-Identifier: Apache-2.0
// Presets, the devices, the schema.
#include "compute/compute.h"
#include "preset/origins.h"
#include "preset/read.h"
#include "python/bindings.h"
#include "run/prepare.h"

#include <unistd.h>

#include <tuple>

namespace nephroid::python {

void use_opencl() {
  static const pid_t first = ::getpid();
  if (first != ::getpid())
    throw failed("device", "this process was forked from one that has opened devices, and they work there alone", {},
                 "use multiprocessing's start method 'spawn'");
}

void add_presets(py::module_& module) {
  py::class_<preset::Preset>(module, "Preset")
      .def_readonly("name", &preset::Preset::name)
      .def_readonly("source", &preset::Preset::source)
      .def_property_readonly("engine", [](const preset::Preset& p) { return std::string(p.settings.engine()); })
      .def("json", [](const preset::Preset& p) { return preset::to_json(p); });
  module.def(
      "read_presets",
      [](const std::string& name, const preset::Overrides& overrides) { return preset::read_presets(name, overrides); },
      py::arg("name"), py::arg("overrides"));
  module.def(
      "parse_preset",
      [](const std::string& json, const std::string& source, const preset::Overrides& overrides) {
        return preset::parse_preset(json, source, overrides);
      },
      py::arg("json"), py::arg("source"), py::arg("overrides"));
  module.def("schema", &preset::schema);
  module.def("shipped_presets", [] {
    std::vector<std::tuple<std::string, std::string, std::string>> list;
    for (const preset::ShippedPreset& p : preset::shipped_presets())
      list.emplace_back(p.name, p.description, p.file.string());
    return list;
  });
  module.def("devices", [] {
    use_opencl();
    std::vector<py::dict> list;
    for (const compute::DeviceInfo& d : compute::list_devices())
      list.push_back(py::dict(py::arg("index") = d.index, py::arg("name") = d.name, py::arg("type") = d.type,
                              py::arg("platform") = d.platform, py::arg("driver") = d.driver,
                              py::arg("version") = d.version, py::arg("compute_units") = d.compute_units,
                              py::arg("memory_bytes") = d.memory_bytes));
    return list;
  });
  // What would run: as `nephroid plan --json` has it.
  module.def(
      "plan_json",
      [](const preset::Preset& preset) {
        return preset::at_origins(preset, [&] { return plan::to_json(*run::prepare(preset).plan); });
      },
      py::arg("preset"), py::call_guard<py::gil_scoped_release>());
}

} // namespace nephroid::python
