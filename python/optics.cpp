// SPDX-License-Identifier: Apache-2.0
// Functions without a run: dispersion, wavelength clusters, an environment's lights, metrics, what a display shows.
#include "environment/describe_settings.h"
#include "environment/segment/segment.h"
#include "measure/metrics.h"
#include "measure/read_picture.h"
#include "photons/clusters/clusters.h"
#include "photons/describe_settings.h"
#include "preset/choices.h"
#include "python/bindings.h"
#include "run/display.h"
#include "scatter/spectra.h"
#include "scene/environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace nephroid::python {
namespace {

/// An array of floats, in rows, converted where it is another one.
using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::string shape_of(const py::array& array) {
  std::string shape;
  for (py::ssize_t i = 0; i < array.ndim(); ++i) shape += fmt::format("{}{}", i > 0 ? " x " : "", array.shape(i));
  return shape.empty() ? "a number" : shape;
}

/// The array stays as it is while they are used.
measure::Pixels pixels_of(const Floats& array, const std::string& name) {
  if (array.ndim() != 3 || array.shape(2) != 3 || array.size() == 0)
    throw bad_input(name, "is " + shape_of(array), "expected an array of height x width x 3, linear sRGB");
  return {static_cast<int>(array.shape(1)),
          static_cast<int>(array.shape(0)),
          {array.data(), static_cast<std::size_t>(array.size())},
          name};
}

template <preset::Enumeration E>
E chosen(const std::string& name, const std::string& word) {
  std::string words;
  for (const auto& choice : preset::choices<E>) {
    if (choice.name == word) return choice.value;
    words += fmt::format("{}'{}'", words.empty() ? "" : ", ", choice.name);
  }
  throw bad_input(name, fmt::format("is '{}'", word), "expected one of " + words);
}

py::dict compare(const Floats& picture, const Floats& reference,
                 const std::optional<py::array_t<bool, py::array::c_style | py::array::forcecast>>& mask) {
  const measure::Pixels a = pixels_of(picture, "picture"), b = pixels_of(reference, "reference");
  std::vector<unsigned char> counted;
  if (mask) {
    if (mask->ndim() != 2 || mask->shape(0) != b.height || mask->shape(1) != b.width)
      throw bad_input("mask", "is " + shape_of(*mask),
                      fmt::format("expected {} x {}, as the reference", b.height, b.width));
    counted.assign(mask->data(), mask->data() + mask->size());
  }
  const auto metrics = [&] {
    const py::gil_scoped_release released;
    return measure::compare(a, b, counted);
  }();
  py::dict named;
  for (const auto& [name, value] : measure::named(metrics)) named[py::str(name)] = value;
  return named;
}

py::array displayed(const preset::Preset& preset, const Floats& picture) {
  const measure::Pixels pixels = pixels_of(picture, "picture");
  std::vector<unsigned char> bytes(pixels.rgb.size());
  image::show(pixels.rgb, image::showing_of(run::display_of(preset), 0, pixels.rgb), bytes);
  return given(std::move(bytes), {pixels.height, pixels.width, 3});
}

py::tuple sampled(const optics::DispersionCurve& curve, const Doubles& nm) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> n, k;
  std::vector<std::uint8_t> extrapolated;
  for (py::ssize_t i = 0; i < nm.size(); ++i) {
    const double wavelength = nm.data()[i];
    if (!(wavelength > 0) || !std::isfinite(wavelength))
      throw bad_input("nm", fmt::format("has {}", wavelength), "expected wavelengths above 0");
    const optics::IndexSample sample = curve.sample(wavelength);
    n.push_back(sample.n.value_or(none));
    k.push_back(sample.k.value_or(none));
    extrapolated.push_back(sample.extrapolated ? 1 : 0);
  }
  const std::vector<py::ssize_t> shape(nm.shape(), nm.shape() + nm.ndim());
  return py::make_tuple(given(std::move(n), shape), given(std::move(k), shape), given(std::move(extrapolated), shape));
}

py::dict clusters(const Doubles& n, double threshold_deg, const std::string& method) {
  if (n.ndim() != 1 || n.size() != optics::wavelength_count)
    throw bad_input("n", "is " + shape_of(n),
                    fmt::format("expected {} values, one a wavelength of 380..780 nm", optics::wavelength_count));
  optics::Spectrum spectrum{};
  std::copy(n.data(), n.data() + n.size(), spectrum.begin());
  const photons::Clustering made =
      photons::cluster_wavelengths(spectrum, threshold_deg, chosen<photons::ClusterMethod>("method", method));
  py::list list;
  for (const photons::Cluster& cluster : made.clusters) {
    std::vector<int> nm;
    for (const int index : cluster.wavelengths) nm.push_back(optics::wavelength_nm(index));
    const auto count = static_cast<py::ssize_t>(nm.size());
    list.append(py::dict(py::arg("wavelengths_nm") = given(std::move(nm), {count}), py::arg("n_mean") = cluster.n_mean,
                         py::arg("theta_deg2") = cluster.theta_deg2));
  }
  return py::dict(py::arg("method") = method, py::arg("threshold_deg") = made.threshold_deg,
                  py::arg("total_theta_deg2") = made.total_theta_deg2, py::arg("clusters") = list);
}

/// texels: height x width x 3, the top row +y, the middle column -z.
py::dict segment(const Floats& texels, int lights, const std::string& method) {
  const measure::Pixels map = pixels_of(texels, "environment");
  const auto wrong = std::ranges::find_if(map.rgb, [](float value) { return !(value >= 0) || std::isinf(value); });
  if (wrong != map.rgb.end())
    throw bad_input("environment", fmt::format("has the value {}", *wrong), "expected radiance, 0 or more");
  scene::Environment environment;
  environment.width = map.width;
  environment.height = map.height;
  environment.rgb.assign(map.rgb.begin(), map.rgb.end());
  const environment::SegmentSettings settings{.lights = lights,
                                              .method = chosen<environment::SegmentMethod>("method", method)};
  environment::Segmentation made;
  {
    const py::gil_scoped_release released;
    made = environment::segment(environment::make_cube_map(environment), settings);
  }
  const auto count = static_cast<py::ssize_t>(made.lights.size());
  std::vector<double> directions, flux, solid_angles;
  std::vector<int> rectangles;
  for (const environment::Region& region : made.lights) {
    directions.insert(directions.end(), {region.direction.x, region.direction.y, region.direction.z});
    flux.insert(flux.end(), {region.flux.x, region.flux.y, region.flux.z});
    solid_angles.push_back(region.solid_angle_sr);
    rectangles.insert(rectangles.end(), {region.face, region.rect.x0, region.rect.y0, region.rect.x1, region.rect.y1});
  }
  return py::dict(py::arg("directions") = given(std::move(directions), {count, 3}),
                  py::arg("flux") = given(std::move(flux), {count, 3}),
                  py::arg("solid_angles_sr") = given(std::move(solid_angles), {count}),
                  py::arg("rectangles") = given(std::move(rectangles), {count, 5}),
                  py::arg("cube_size") = made.cube_size);
}

} // namespace

void add_optics(py::module_& module) {
  py::class_<optics::DispersionCurve>(module, "DispersionCurve")
      .def_readonly("name", &optics::DispersionCurve::name)
      .def_readonly("source", &optics::DispersionCurve::source)
      .def("range_nm", &optics::DispersionCurve::range_nm)
      .def("sample", &sampled, py::arg("nm"));
  module.def("load_dispersion", &scatter::load_dispersion, py::arg("name"));
  module.def("clusters", &clusters, py::arg("n"), py::arg("threshold_deg"), py::arg("method"));
  module.def("segment", &segment, py::arg("texels"), py::arg("lights"), py::arg("method"));
  module.def("compare", &compare, py::arg("picture"), py::arg("reference"), py::arg("mask"));
  module.def("displayed", &displayed, py::arg("preset"), py::arg("picture"));
  module.def(
      "read_picture",
      [](const std::string& file) {
        measure::LinearPicture picture = measure::read_linear_rgb(file);
        return given(std::move(picture.rgb), {picture.height, picture.width, 3});
      },
      py::arg("file"));
}

} // namespace nephroid::python
