// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// import ltcfit: the library for Python.
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.h"

namespace ltcfit::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

// "key=value" for load_config: texts as they are, since it takes bare ones too.
std::string override_of(const std::pair<py::handle, py::handle>& item) {
  py::object value = py::reinterpret_borrow<py::object>(item.second);
  if (py::isinstance<py::bool_>(value))
    value = py::str(value).attr("lower")();
  return py::str(item.first).cast<std::string>() + "=" + py::str(value).cast<std::string>();
}

Config to_config(const std::optional<std::filesystem::path>& file, const py::dict& set) {
  Config config{file.value_or(std::filesystem::path()), {}};
  for (const auto& item : set)
    config.overrides.push_back(override_of(item));
  return config;
}

// Where nobody watches, still somebody presses Ctrl-C: Python's handler is asked between steps, and
// what it raises ends the work.
Run to_run(int threads, const py::object& progress) {
  return {threads,
          [progress](std::string_view stage, std::size_t done, std::size_t total) {
            const py::gil_scoped_acquire locked;
            if (PyErr_CheckSignals() != 0)
              throw py::error_already_set();
            if (progress.is_none())
              return true;
            const py::object goes_on = progress(stage, done, total);
            return goes_on.is_none() || goes_on.cast<bool>();
          },
          [](const std::string& line) {
            const py::gil_scoped_acquire locked;
            if (PyErr_WarnEx(PyExc_UserWarning, line.c_str(), 1) != 0)
              throw py::error_already_set();
          }};
}

template <typename Work>
auto without_lock(Work&& work) {
  const py::gil_scoped_release unlocked;
  return work();
}

void add_exceptions(py::module_& module) {
  py::register_exception<InputError>(module, "InputError", PyExc_ValueError);
  py::register_exception<IoError>(module, "IoError", PyExc_OSError);
  py::register_exception<CheckFailure>(module, "CheckFailure", PyExc_RuntimeError);
  py::register_exception<Interrupted>(module, "Interrupted", PyExc_RuntimeError);
}

void add_fit(py::module_& module) {
  py::class_<FittedLobe>(module, "FittedLobe", "An LTC fitted to one lobe.")
      .def_property_readonly(
          "matrix", [](const FittedLobe& fit) { return to_array(fit.shading.matrix); },
          "M, 3x3: clamped cosine to lobe; third column of unit length")
      .def_property_readonly("amplitude",
                             [](const FittedLobe& fit) { return fit.shading.amplitude; })
      .def_property_readonly("fresnel", [](const FittedLobe& fit) { return fit.shading.fresnel; })
      .def_readonly("loss", &FittedLobe::loss, "sliced-Wasserstein distance to GGX, held out")
      .def_readonly("spread", &FittedLobe::spread, "of the lobe, the scale of losses");
  module.def(
      "fit",
      [](double alpha_x, double alpha_y, double theta, double phi,
         const std::optional<std::filesystem::path>& config, const py::dict& set) {
        const Config settings = to_config(config, set);
        return without_lock([&] { return fit({alpha_x, alpha_y, theta, phi}, settings); });
      },
      "Fits an LTC to the lobe of anisotropic GGX; angles in radians.", "alpha_x"_a, "alpha_y"_a,
      "theta"_a, "phi"_a, py::kw_only(), "config"_a = py::none(), "set"_a = py::dict());
}

using Values = std::span<const float> (Table::*)() const;

// A property over the table's own values, of the table's shape and `more`.
auto values(Values get, std::vector<py::ssize_t> more = {}) {
  return [get, more](const py::object& self) {
    const Table& table = self.cast<const Table&>();
    std::vector<py::ssize_t> shape;
    for (const std::size_t nodes : table.shape())
      shape.push_back(static_cast<py::ssize_t>(nodes));
    shape.insert(shape.end(), more.begin(), more.end());
    return view((table.*get)(), shape, self);
  };
}

py::dict axes(const Table& table) {
  py::dict result;
  std::size_t index = 0;
  for (const char* name : {"alpha", "lambda", "theta", "phi"}) {
    const std::vector<double>& nodes = table.axis(index++);
    result[name] = py::array_t<double>(static_cast<py::ssize_t>(nodes.size()), nodes.data());
  }
  return result;
}

void add_table(py::module_& module) {
  py::class_<Table>(module, "Table",
                    "A table over alpha, lambda, theta and phi. Immutable; its arrays are views.")
      .def_static(
          "read",
          [](const std::filesystem::path& file) {
            return without_lock([&] { return Table::read(file); });
          },
          "Reads a table's file; its name says of which format it is.", "file"_a)
      .def(
          "write",
          [](const Table& table, const std::filesystem::path& file, bool half) {
            without_lock([&] { table.write(file, half); });
          },
          "Writes the format that the name ends in, whole or not at all.", "file"_a, py::kw_only(),
          "half"_a = false)
      .def_property_readonly("shape", &Table::shape)
      .def_property_readonly("axes", &axes, "the nodes' values by the axis' name")
      .def_property_readonly("storage", &Table::storage)
      .def_property_readonly("config", &Table::config, "the TOML that made it")
      .def_property_readonly("matrix", &matrices, "M of every node, shape + (3, 3), a copy")
      .def_property_readonly("stored", values(&Table::stored, {3, 3}), "what is interpolated")
      .def_property_readonly("amplitude", values(&Table::amplitude))
      .def_property_readonly("fresnel", values(&Table::fresnel))
      .def_property_readonly("loss", values(&Table::loss))
      .def("look_up", &look_up,
           "(matrix, amplitude, fresnel) of lobes, as a shader has them; arguments broadcast.",
           "alpha_x"_a, "alpha_y"_a, "theta"_a, "phi"_a);
  module.def(
      "generate",
      [](const std::optional<std::filesystem::path>& config, const py::dict& set,
         const std::optional<std::filesystem::path>& scene,
         const std::optional<std::filesystem::path>& extend, int threads,
         const py::object& progress) {
        const Config settings = to_config(config, set);
        const Run run = to_run(threads, progress);
        const Part part{scene.value_or(""), extend.value_or("")};
        return without_lock([&] { return generate(settings, run, part); });
      },
      "Makes the table of a config; `set` changes keys, as ltcfit --set does. Of it, only what the "
      "materials of `scene` need, and only what the table file `extend` lacks. `progress(stage, "
      "done, total)` may return False to stop.",
      "config"_a = py::none(), py::kw_only(), "set"_a = py::dict(), "scene"_a = py::none(),
      "extend"_a = py::none(), "threads"_a = 0, "progress"_a = py::none());
}

void add_validate(py::module_& module) {
  py::class_<Check>(module, "Check")
      .def_readonly("name", &Check::name)
      .def_readonly("checked", &Check::checked)
      .def_readonly("passed", &Check::passed)
      .def_readonly("value", &Check::value)
      .def_readonly("limit", &Check::limit)
      .def_readonly("message", &Check::message)
      .def("__repr__", [](const Check& check) {
        return py::str("<Check {}: {}>")
            .format(check.name, !check.checked ? "not checked"
                                : check.passed ? "passed"
                                               : "failed");
      });
  py::class_<Quality>(module, "Quality")
      .def_readonly("node_loss", &Quality::node_loss)
      .def_readonly("loss", &Quality::loss)
      .def_readonly("floor_loss", &Quality::floor_loss)
      .def_readonly("area_light_error", &Quality::area_light_error)
      .def_readonly("floor_area_light_error", &Quality::floor_area_light_error);
  py::class_<Validation>(module, "Validation")
      .def_readonly("checks", &Validation::checks)
      .def_readonly("quality", &Validation::quality)
      .def_property_readonly("passed", &Validation::passed);
  module.def(
      "validate",
      [](const Table& table, const std::optional<std::filesystem::path>& limits,
         const py::dict& set, bool quality, int threads, const py::object& progress) {
        const Config settings = to_config(limits, set);
        const Run run = to_run(threads, progress);
        return without_lock([&] { return validate(table, settings, quality, run); });
      },
      "Checks a table as ltcfit validate does.", "table"_a, "config"_a = py::none(), py::kw_only(),
      "set"_a = py::dict(), "quality"_a = true, "threads"_a = 0, "progress"_a = py::none());
}

}  // namespace
}  // namespace ltcfit::python

PYBIND11_MODULE(ltcfit, module) {
  using namespace ltcfit::python;
  module.doc() = "Look-up tables of linearly transformed cosines for anisotropic GGX.";
  module.attr("__version__") = std::string(ltcfit::version());
  add_exceptions(module);
  add_fit(module);
  add_table(module);
  add_validate(module);
}
