// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// NumPy arrays of a table's values, and look-ups of whole arrays of lobes.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <span>
#include <vector>

#include "ltcfit/ltcfit.h"

namespace ltcfit::python {

// A read-only array over a table's own values, without a copy; `owner` keeps them alive.
pybind11::array_t<float> view(std::span<const float> values, std::vector<pybind11::ssize_t> shape,
                              const pybind11::object& owner);

pybind11::array_t<double> to_array(const Eigen::Matrix3d& matrix);

using Values = pybind11::array_t<double>;

// (matrix, amplitude, fresnel) of shapes S + (3, 3), S and S, with S what the four shapes broadcast
// to.
pybind11::tuple look_up(const Table& table, const Values& alpha_x, const Values& alpha_y,
                        const Values& theta, const Values& phi);

// Every node's M, shape + (3, 3).
pybind11::array_t<double> matrices(const Table& table);

}  // namespace ltcfit::python
