// SPDX-License-Identifier: Apache-2.0
// The Python module: the core as it is, thinly.
#include "base/build_info.h"
#include "base/error.h"
#include "python/bindings.h"

#include <exception>
#include <string>

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

/// Throws ImportError where pybind11 does not know the numpy that is there: pictures would be zeros.
void check_numpy() {
#if PYBIND11_VERSION_MAJOR == 2 && PYBIND11_VERSION_MINOR < 12
  const auto numpy = pybind11::module_::import("numpy").attr("__version__").cast<std::string>();
  if (std::stoi(numpy) >= 2)
    throw pybind11::import_error("nephroid: numpy is " + numpy +
                                 ", and the module was built with a pybind11 that knows numpy 1 only; install "
                                 "\"numpy<2\", or build it with pybind11 2.12 or later");
#endif
}

} // namespace

PYBIND11_MODULE(_nephroid, module) {
  check_numpy();
  module.attr("version") = std::string(nephroid::version());
  add_errors(module);
  nephroid::python::add_presets(module);
  nephroid::python::add_pictures(module);
  nephroid::python::add_runs(module);
  nephroid::python::add_optics(module);
}
