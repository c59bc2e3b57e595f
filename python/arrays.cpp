// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "arrays.h"

#include <algorithm>

namespace ltcfit::python {
namespace {

namespace py = pybind11;

void put(const Eigen::Matrix3d& matrix, double* out) {
  for (Eigen::Index row = 0; row < 3; ++row)
    for (Eigen::Index column = 0; column < 3; ++column)
      *out++ = matrix(row, column);
}

}  // namespace

py::array_t<float> view(std::span<const float> values, std::vector<py::ssize_t> shape,
                        const py::object& owner) {
  py::array_t<float> array(std::move(shape), values.data(), owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

py::array_t<double> to_array(const Eigen::Matrix3d& matrix) {
  py::array_t<double> array({3, 3});
  put(matrix, array.mutable_data());
  return array;
}

py::tuple look_up(const Table& table, const Values& alpha_x, const Values& alpha_y,
                  const Values& theta, const Values& phi) {
  // NumPy's own rule of broadcasting, and contiguous values of every lobe in turn.
  const py::list spread(
      py::module_::import("numpy").attr("broadcast_arrays")(alpha_x, alpha_y, theta, phi));
  std::vector<py::array_t<double, py::array::c_style | py::array::forcecast>> parameters;
  for (const py::handle& values : spread)
    parameters.emplace_back(py::reinterpret_borrow<py::object>(values));
  const auto& first = parameters.front();
  const std::vector<py::ssize_t> shape(first.shape(), first.shape() + first.ndim());
  std::vector<py::ssize_t> matrix_shape = shape;
  matrix_shape.insert(matrix_shape.end(), {3, 3});
  py::array_t<double> matrix(matrix_shape), amplitude(shape), fresnel(shape);
  const double* const x = parameters[0].data();
  const double* const y = parameters[1].data();
  const double* const theta_radians = parameters[2].data();
  const double* const phi_radians = parameters[3].data();
  double* const matrices = matrix.mutable_data();
  double* const amplitudes = amplitude.mutable_data();
  double* const fresnels = fresnel.mutable_data();
  {
    const py::gil_scoped_release unlocked;
    for (py::ssize_t i = 0; i < first.size(); ++i) {
      const Shading shading = table.look_up({x[i], y[i], theta_radians[i], phi_radians[i]});
      put(shading.matrix, matrices + 9 * i);
      amplitudes[i] = shading.amplitude;
      fresnels[i] = shading.fresnel;
    }
  }
  return py::make_tuple(matrix, amplitude, fresnel);
}

py::array_t<double> matrices(const Table& table) {
  const auto [alphas, lambdas, thetas, phis] = table.shape();
  py::array_t<double> result({alphas, lambdas, thetas, phis, std::size_t{3}, std::size_t{3}});
  double* out = result.mutable_data();
  for (std::size_t alpha = 0; alpha < alphas; ++alpha)
    for (std::size_t lambda = 0; lambda < lambdas; ++lambda)
      for (std::size_t theta = 0; theta < thetas; ++theta)
        for (std::size_t phi = 0; phi < phis; ++phi, out += 9)
          put(table.matrix({alpha, lambda, theta, phi}), out);
  return result;
}

}  // namespace ltcfit::python
