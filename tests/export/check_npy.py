# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the ltcfit authors
"""Checks an array of matrices with NumPy: check_npy.py ARRAY.npy EXPECTED.json

Exit code 0 if type, order, shape and values are the expected ones (null stands for NaN); otherwise
1, with the first difference on standard output.
"""
import json
import sys

import numpy as np


def require(condition, what):
    if not condition:
        print("check_npy:", what)
        sys.exit(1)


def main():
    with open(sys.argv[2], encoding="utf-8") as text:
        expected = json.load(text)
    found = np.load(sys.argv[1])
    require(found.dtype.str == "<f4", f"type is {found.dtype.str}")
    require(found.flags.c_contiguous, "not in C order")
    require(list(found.shape) == expected["shape"], f"shape is {found.shape}")
    values = np.array(expected["values"], dtype=float).astype("<f4").reshape(found.shape)
    require(np.array_equal(found, values, equal_nan=True), "other values")


main()
