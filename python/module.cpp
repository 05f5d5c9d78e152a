// SPDX-License-Identifier: Apache-2.0
// The Python module: the core as it is, thinly.
#include "base/build_info.h"
#include "base/error.h"
#include "python/bindings.h"

#include <exception>

namespace {

/// A Python exception with the program's own line: BadInput (a ValueError) for what the caller can mend, Error for the
/// rest.
void add_errors(pybind11::module_& module) {
  namespace py = pybind11;
  static py::exception<nephroid::Error> error(module, "Error", PyExc_RuntimeError);
  static py::handle bad_input;
  bad_input = PyErr_NewException("nephroid.core._nephroid.BadInput",
                                 py::make_tuple(error, py::handle(PyExc_ValueError)).ptr(), nullptr);
  module.attr("BadInput") = bad_input;
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const nephroid::Error& e) {
      PyErr_SetString(e.kind() == nephroid::ErrorKind::bad_input ? bad_input.ptr() : error.ptr(), e.line().c_str());
    }
  });
}

} // namespace

PYBIND11_MODULE(_nephroid, module) {
  module.attr("version") = std::string(nephroid::version());
  add_errors(module);
  nephroid::python::add_presets(module);
  nephroid::python::add_pictures(module);
  nephroid::python::add_runs(module);
  nephroid::python::add_optics(module);
}
