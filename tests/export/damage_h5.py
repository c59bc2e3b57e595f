# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the ltcfit authors
"""Damages a good table in one way at a time: damage_h5.py GOOD.h5 FOLDER

Writes FOLDER/<damage>.h5 for every damage below and prints the names, one a line.
"""
import pathlib
import shutil
import sys

import h5py
import numpy as np


def replace(file, name, values):
    """The dataset with other values (or type, or shape), its attributes kept."""
    attributes = dict(file[name].attrs)
    del file[name]
    file[name] = values
    file[name].attrs.update(attributes)


def changed(values, index, value):
    values[index] = value
    return values


def with_node(axis, index, value):
    return lambda f: replace(f, f"axis/{axis}", changed(f[f"axis/{axis}"][()], index, value))


def with_attribute(name, value):
    return lambda f: f.attrs.__setitem__(name, value)


def without(name):
    return lambda f: f.__delitem__(name)


def without_attribute(name):
    return lambda f: f.attrs.__delitem__(name)


def group_for_dataset(f):
    del f["fresnel"]
    f.create_group("fresnel")


def huge_axis(f):
    # Declared, never written: takes no room in the file.
    del f["axis/phi"]
    f.create_dataset("axis/phi", shape=(1 << 40,), dtype="f8", chunks=(1024,))
    f["axis/phi"].attrs["warp"] = "linear"


def huge_matrix(f):
    del f["matrix"]
    f.create_dataset("matrix", shape=(1 << 30, 2, 5, 4, 3, 3), dtype="f4", chunks=(1, 2, 5, 4, 3, 3))


DAMAGES = {
    "other_format": with_attribute("format", "lut"),
    "format_is_number": with_attribute("format", 1),
    "version_2": with_attribute("format_version", 2),
    "version_is_text": with_attribute("format_version", "1"),
    "version_is_list": with_attribute("format_version", np.array([1, 1])),
    "unknown_storage": with_attribute("storage", "cholesky"),
    "unknown_warp": lambda f: f["axis/theta"].attrs.__setitem__("warp", "cubic"),
    "no_warp": lambda f: f["axis/theta"].attrs.__delitem__("warp"),
    "seed_is_signed": with_attribute("seed", np.int64(1)),
    "alpha_min_is_f32": with_attribute("alpha_min", np.float32(1e-4)),
    "alpha_min_is_nan": with_attribute("alpha_min", np.float64("nan")),
    "alpha_min_is_0": with_attribute("alpha_min", np.float64(0)),
    **{f"no_{name}": without_attribute(name)
       for name in ("format", "format_version", "brdf", "storage", "alpha_min", "seed", "generator",
                    "config", "created")},
    **{f"no_dataset_{name}": without(name)
       for name in ("matrix", "amplitude", "fresnel", "sw_loss", "status", "iterations")},
    "no_axis": without("axis"),
    "no_axis_lambda": without("axis/lambda"),
    "axis_is_f32": lambda f: replace(f, "axis/alpha", f["axis/alpha"][()].astype("f4")),
    "axis_has_nan": with_node("alpha", 1, np.nan),
    "axis_decreases": lambda f: replace(f, "axis/alpha", f["axis/alpha"][()][::-1].copy()),
    "axis_repeats": with_node("theta", 2, 0.0),
    "axis_off_warp": with_node("theta", 2, 0.7),
    "axis_in_degrees": lambda f: replace(f, "axis/phi", np.degrees(f["axis/phi"][()])),
    "axis_negative": with_node("alpha", 0, -0.1),
    "axis_empty": lambda f: replace(f, "axis/phi", np.zeros(0)),
    "axis_is_scalar": lambda f: replace(f, "axis/phi", np.float64(0)),
    "axis_is_square": lambda f: replace(f, "axis/phi", np.zeros((2, 2))),
    "axis_of_65": lambda f: replace(f, "axis/phi", np.linspace(0, 1.5, 65)),
    "axis_huge": huge_axis,
    "axis_shorter": lambda f: replace(f, "axis/phi", f["axis/phi"][()][[0, 3]]),
    "matrix_is_f64": lambda f: replace(f, "matrix", f["matrix"][()].astype("f8")),
    "matrix_is_text": lambda f: replace(f, "matrix", "M"),
    "matrix_transposed": lambda f: replace(f, "matrix", f["matrix"][()].transpose(3, 2, 1, 0, 4, 5).copy()),
    "matrix_flat": lambda f: replace(f, "matrix", f["matrix"][()].reshape(3, 2, 5, 4, 9)),
    "matrix_huge": huge_matrix,
    "matrix_has_nan": lambda f: replace(f, "matrix", changed(f["matrix"][()], (1, 1, 2, 3, 0, 0), np.nan)),
    "matrix_has_infinity": lambda f: replace(f, "matrix", changed(f["matrix"][()], (1, 1, 2, 3, 2, 1), np.inf)),
    "amplitude_is_group": group_for_dataset,
    "status_is_i8": lambda f: replace(f, "status", f["status"][()].astype("i1")),
    "status_of_6": lambda f: replace(f, "status", changed(f["status"][()], (0, 0, 0, 0), 6)),
    "iterations_are_u32": lambda f: replace(f, "iterations", f["iterations"][()].astype("u4")),
    # These are tables still, of other content: for the checker, which knows what to expect.
    "matrix_rows_for_columns": lambda f: replace(f, "matrix", f["matrix"][()].swapaxes(4, 5).copy()),
    "format_is_bytes": with_attribute("format", np.bytes_("ltc-table")),
    "other_seed": with_attribute("seed", np.uint64(2)),
    "extra_dataset": lambda f: f.__setitem__("extra", 1),
    "one_value_off": lambda f: replace(f, "fresnel", changed(f["fresnel"][()], (2, 1, 4, 3), 0.5)),
}


def main():
    good, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    for name, damage in DAMAGES.items():
        path = folder / f"{name}.h5"
        shutil.copyfile(good, path)
        with h5py.File(path, "r+") as file:
            damage(file)
        print(name)


main()
