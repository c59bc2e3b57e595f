# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the ltcfit authors
"""Checks a table with h5py against what it should hold: check_h5.py TABLE.h5 EXPECTED.json

Exit code 0 if all is as docs/files.md says and the values are the expected ones; otherwise 1, with
the first difference on standard output.
"""
import json
import sys

import h5py
import numpy as np

AXES = ("alpha", "lambda", "theta", "phi")
ENTRY_TYPES = {"matrix": "<f4", "amplitude": "<f4", "fresnel": "<f4", "sw_loss": "<f4",
               "status": "|u1", "iterations": "<u2"}


def require(condition, what):
    if not condition:
        print("check_h5:", what)
        sys.exit(1)


def check_attributes(file, expected):
    require(set(file.attrs) == set(expected["attributes"]), f"attributes are {sorted(file.attrs)}")
    for name, value in expected["attributes"].items():
        found = file.attrs[name]
        kind = {"format_version": np.integer, "refined": np.integer, "seed": np.uint64, "alpha_min": np.float64}.get(name, str)
        require(isinstance(found, kind), f"attribute {name} is {type(found).__name__}")
        require(found == value, f"attribute {name} is {found!r}, expected {value!r}")


def check_axes(file, expected):
    require(set(file["axis"]) == set(AXES), f"axes are {sorted(file['axis'])}")
    for name in AXES:
        dataset = file["axis"][name]
        require(dataset.dtype.str == "<f8", f"axis/{name} is {dataset.dtype.str}")
        require(dataset[()].tolist() == expected["axes"][name], f"axis/{name} is {dataset[()]}")
        warp = dataset.attrs["warp"]
        require(isinstance(warp, str) and warp == expected["warp"][name], f"warp of {name} is {warp!r}")


def check_entries(file, expected):
    require(set(file) == set(ENTRY_TYPES) | {"axis"}, f"datasets are {sorted(file)}")
    shape = tuple(len(expected["axes"][name]) for name in AXES)
    for name, kind in ENTRY_TYPES.items():
        dataset = file[name]
        require(dataset.dtype.str == kind, f"{name} is {dataset.dtype.str}, expected {kind}")
        require(dataset.shape == shape + ((3, 3) if name == "matrix" else ()), f"{name} has shape {dataset.shape}")
        # null stands for NaN.
        values = np.array(expected[name], dtype=float).astype(kind).reshape(dataset.shape)
        same = np.array_equal(dataset[()], values, equal_nan=dataset.dtype.kind == "f")
        require(same, f"{name} holds other values")


def main():
    with open(sys.argv[2], encoding="utf-8") as text:
        expected = json.load(text)
    with h5py.File(sys.argv[1], "r") as file:
        check_attributes(file, expected)
        check_axes(file, expected)
        check_entries(file, expected)


main()
