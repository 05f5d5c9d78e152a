// SPDX-License-Identifier: Apache-2.0
// What the files of the Python module share. Each adds what it is about to the module; nephroid/__init__.py makes of it
// what people use.
#pragma once
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <vector>

namespace nephroid::python {

namespace py = pybind11;

void add_presets(py::module_& module);  ///< presets, devices, the schema
void add_runs(py::module_& module);     ///< a run on its own thread
void add_pictures(py::module_& module); ///< snapshots of a run
void add_optics(py::module_& module);   ///< dispersion, clusters, segmentation, metrics

/// To be called before OpenCL is. Throws failed in a process that was forked from one where it ran already: there it
/// waits for threads that are not there.
void use_opencl();

/// An array that shows values where they are, and cannot be written to; owner: has them.
template <class T, class Owner>
py::array lent(const std::shared_ptr<const Owner>& owner, const std::vector<T>& values,
               std::vector<py::ssize_t> shape) {
  const py::capsule keeper(new std::shared_ptr<const Owner>(owner),
                           [](void* kept) { delete static_cast<std::shared_ptr<const Owner>*>(kept); });
  py::array array(py::dtype::of<T>(), std::move(shape), values.data(), keeper);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// An array of values that nobody else needs, without a copy.
template <class T>
py::array given(std::vector<T> values, std::vector<py::ssize_t> shape) {
  const auto owner = std::make_shared<const std::vector<T>>(std::move(values));
  return lent(owner, *owner, std::move(shape));
}

} // namespace nephroid::python
