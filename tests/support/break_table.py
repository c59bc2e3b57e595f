# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the ltcfit authors
"""Breaks one thing in a good table: break_table.py GOOD.h5 BAD.h5 FAULT [ENTRY]

FAULT is one of the names below. ENTRY, as `ltcfit fit --entry` takes it (4,4,4,4 if left out), is
the entry that the faults of an entry break. `swapped` exchanges its matrix with that of the next
theta; `attribute` and `shape` are no matter of entries.
"""
import shutil
import sys

import h5py
import numpy as np


def with_matrix(change):
    """A fault that replaces the entry's matrix by change(matrix)."""

    def damage(file, entry):
        matrix = file["matrix"][entry].astype(np.float64)
        file["matrix"][entry] = change(matrix).astype(np.float32)

    return damage


def turned(matrix, degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ matrix


def without_second_column(matrix):
    result = matrix.copy()
    result[:, 1] = result[:, 0]
    return result


def with_nan(matrix):
    result = matrix.copy()
    result[1, 1] = np.nan
    return result


def swap_with_next_theta(file, entry):
    other = (entry[0], entry[1], entry[2] + 1, entry[3])
    matrices = file["matrix"]
    matrices[entry], matrices[other] = matrices[other], matrices[entry]


def remove_attribute(file, _):
    del file.attrs["storage"]


def flatten_amplitude(file, _):
    shape = file["amplitude"].shape
    values = file["amplitude"][()].reshape(shape[0] * shape[1], shape[2], shape[3])
    del file["amplitude"]
    file["amplitude"] = values


FAULTS = {
    "rotated": with_matrix(lambda matrix: turned(matrix, 30)),
    "scaled": with_matrix(lambda matrix: 1.5 * matrix),
    "negated": with_matrix(lambda matrix: -matrix),
    "singular": with_matrix(without_second_column),
    "nan": with_matrix(with_nan),
    "swapped": swap_with_next_theta,
    "attribute": remove_attribute,
    "shape": flatten_amplitude,
}


def main():
    if len(sys.argv) not in (4, 5) or sys.argv[3] not in FAULTS:
        sys.exit(f"usage: break_table.py GOOD.h5 BAD.h5 FAULT [ENTRY]; faults: {', '.join(FAULTS)}")
    good, bad, fault = sys.argv[1:4]
    entry = tuple(int(index) for index in (sys.argv[4] if len(sys.argv) == 5 else "4,4,4,4").split(","))
    if good != bad:
        shutil.copyfile(good, bad)
    with h5py.File(bad, "r+") as file:
        FAULTS[fault](file, entry)


main()
