# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the ltcfit authors
"""Reads a made table with h5py and NumPy: check_made_table.py TABLE.h5 TABLE.npy

Exit code 0 if both are as docs/files.md says, hold the same matrices and none that a renderer could
not use; otherwise 1, with the first fault on standard output. Prints the numbers of entries by
status, 0 to 4.
"""
import sys

import h5py
import numpy as np


def require(condition, what):
    if not condition:
        print("check_made_table:", what)
        sys.exit(1)


def main():
    with h5py.File(sys.argv[1], "r") as file:
        require(file.attrs["format"] == "ltc-table", "format")
        require(file.attrs["format_version"] == 1, "format_version")
        require(file.attrs["storage"] == "matrix", "storage")
        require("[fit.gauss_newton]" in file.attrs["config"], "config")
        shape = tuple(file["axis"][name].size for name in ("alpha", "lambda", "theta", "phi"))
        matrix, status = file["matrix"][()], file["status"][()]
        amplitude, fresnel = file["amplitude"][()], file["fresnel"][()]
        theta, phi = file["axis/theta"][()], file["axis/phi"][()]
    require(matrix.shape == shape + (3, 3), f"matrix has shape {matrix.shape}")
    require(np.isfinite(matrix).all(), "a matrix is not finite")
    # In double: those of the sharpest lobes are near 1e-8.
    require((np.linalg.det(matrix.astype(float)) > 0).all(), "a determinant is not positive")
    length = np.linalg.norm(matrix.astype(float)[..., 2], axis=-1)
    require((np.abs(length - 1) < 1e-6).all(), "a third column is not of unit length")
    require(((amplitude > 0) & (amplitude <= 1)).all(), "amplitude outside (0, 1]")
    require(((fresnel > 0) & (fresnel <= amplitude)).all(), "fresnel outside (0, amplitude]")
    # Equation (16): no mixing of y with x or z at phi = 0, of x with y or z at phi = pi/2.
    require(theta[0] == 0 and phi[0] == 0 and phi[-1] == np.pi / 2, "axes")
    require((matrix[:, :, :, 0][..., [0, 1, 1, 2], [1, 0, 2, 1]] == 0).all(), "zeros at phi = 0")
    require((matrix[:, :, :, -1][..., [0, 1, 0, 2], [1, 0, 2, 0]] == 0).all(), "zeros at phi = 90")
    require((matrix[:, :, 0][..., ~np.eye(3, dtype=bool)] == 0).all(), "zeros at theta = 0")
    require((matrix[:, :, 0] == matrix[:, :, 0, :1]).all(), "theta = 0 differs over phi")
    array = np.load(sys.argv[2])
    require(array.dtype.str == "<f4" and array.flags.c_contiguous, "type or order of the NPY")
    require(np.array_equal(array, matrix), "the NPY holds other matrices")
    print(*(int((status == value).sum()) for value in range(5)))


main()
