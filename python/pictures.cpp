// SPDX-License-Identifier: Apache-2.0
// A snapshot of a run: its pictures as arrays, where they are, and its figures.
#include "job/job.h"
#include "python/bindings.h"
#include "run/meter_files.h"

#include <nlohmann/json.hpp>

#include <memory>

namespace nephroid::python {
namespace {

using Snapshot = std::shared_ptr<job::Snapshot>;

/// [row][column][3], as long as anybody has it.
py::array pixels(const std::shared_ptr<const job::Picture>& picture, const std::vector<float>& rgb) {
  return lent<float, job::Picture>(picture, rgb, {picture->height, picture->width, 3});
}

/// By name.
py::dict columns_of(const std::vector<std::string>& names, const std::vector<std::vector<double>>& rows) {
  py::dict columns;
  for (std::size_t c = 0; c < names.size(); ++c) {
    std::vector<double> values;
    values.reserve(rows.size());
    for (const std::vector<double>& row : rows) values.push_back(row.at(c));
    const auto size = static_cast<py::ssize_t>(values.size());
    columns[py::str(names[c])] = given(std::move(values), {size});
  }
  return columns;
}

py::dict history(const Snapshot& snapshot) {
  std::vector<std::string> names{"seconds", "wall_seconds", "step", "work"};
  std::vector<std::vector<double>> rows;
  if (snapshot->history) {
    names.insert(names.end(), snapshot->history->columns.begin(), snapshot->history->columns.end());
    for (const job::HistoryRow& r : snapshot->history->rows) {
      rows.push_back({r.seconds, r.wall_seconds, static_cast<double>(r.step), static_cast<double>(r.work)});
      rows.back().insert(rows.back().end(), r.errors.begin(), r.errors.end());
    }
  }
  return columns_of(names, rows);
}

py::dict figures(const Snapshot& snapshot) {
  py::dict groups;
  for (const job::Scalar& scalar : snapshot->scalars) {
    const py::str group(scalar.group);
    if (!groups.contains(group)) groups[group] = py::dict();
    groups[group][py::str(scalar.name)] = scalar.value;
  }
  return groups;
}

/// What measure.json has of each meter, as text, and its cells.
py::dict meter_table(const Snapshot& snapshot) {
  py::dict all;
  if (!snapshot->meters) return all;
  const auto list = run::to_json("", *snapshot->meters).at("meters");
  auto json = list.begin();
  for (const meters::Shown& shown : snapshot->meters->meters) {
    if (!shown.reading) continue;
    py::dict cells;
    const scene::MeterSurface& surface = *shown.surface;
    for (const meters::Quantity quantity : meters::quantities) {
      std::vector<std::vector<double>> rows;
      for (const meters::Interval& cell : shown.reading->all().cells[static_cast<std::size_t>(quantity)])
        rows.push_back({cell.value, cell.low, cell.high});
      cells[run::unit_of(surface, quantity)] = columns_of({"value", "low", "high"}, rows);
    }
    std::vector<std::vector<double>> places;
    for (const glm::dvec3& centre : surface.centres) {
      const glm::dvec3 p = centre + shown.origin;
      places.push_back({p.x, p.y, p.z});
    }
    cells["place"] = columns_of({"x", "y", "z"}, places);
    all[py::str(shown.meter.name)] = py::make_tuple((json++)->dump(), cells);
  }
  return all;
}

} // namespace

void add_pictures(py::module_& module) {
  py::class_<job::Snapshot, Snapshot>(module, "Snapshot")
      .def_readonly("stands_in", &job::Snapshot::stands_in)
      .def_readonly("caption", &job::Snapshot::caption)
      .def_readonly("warnings", &job::Snapshot::warnings)
      .def_readonly("progress", &job::Snapshot::progress)
      .def_readonly("phases", &job::Snapshot::phases)
      .def("picture", [](const Snapshot& snapshot) { return pixels(snapshot->picture, snapshot->picture->rgb); })
      .def("error_draw",
           [](const Snapshot& snapshot) -> py::object {
             if (snapshot->picture->error_draw.empty()) return py::none();
             return pixels(snapshot->picture, snapshot->picture->error_draw);
           })
      .def("layers",
           [](const Snapshot& snapshot) {
             py::dict layers;
             for (const job::Layer& layer : snapshot->picture->layers)
               layers[py::str(layer.name)] = pixels(snapshot->picture, layer.rgb);
             return layers;
           })
      .def("pictures",
           [](const Snapshot& snapshot) {
             py::dict pictures;
             for (const job::NamedPicture& named : snapshot->pictures)
               pictures[py::str(named.name)] = pixels(named.picture, named.picture->rgb);
             return pictures;
           })
      .def("history", &history)
      .def("error_column",
           [](const Snapshot& snapshot) { return snapshot->history ? snapshot->history->error_column : ""; })
      .def("figures", &figures)
      .def("meters", &meter_table)
      .def("curves", [](const Snapshot& snapshot) {
        py::dict curves;
        for (const job::Curve& curve : snapshot->curves)
          curves[py::str(curve.name)] = columns_of(curve.columns, curve.rows);
        return curves;
      });
}

} // namespace nephroid::python
