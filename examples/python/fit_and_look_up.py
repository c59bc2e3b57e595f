#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fits a lobe of brushed metal, makes a small table, writes it, reads it back and looks lobes up.

PYTHONPATH=build/release/python python3 examples/python/fit_and_look_up.py
"""
import math
import tempfile
from pathlib import Path

import ltcfit
import numpy as np

fit = ltcfit.fit(alpha_x=0.4, alpha_y=0.1, theta=1.0, phi=0.5)
print(f"fitted: {fit.loss / fit.spread:.4f} of the lobe's spread from GGX, amplitude {fit.amplitude:.4f}")

nodes = {"table.alpha.first": 0.1, "table.alpha.nodes": 4, "table.lambda.nodes": 3, "table.theta.nodes": 4, "table.phi.nodes": 3}
with tempfile.TemporaryDirectory() as folder:
    file = Path(folder) / "table.h5"
    ltcfit.generate(set=nodes | {"refine.steps": 2}).write(file)
    table = ltcfit.Table.read(file)

theta = np.linspace(0, math.radians(80), 5)
M, amplitude, fresnel = table.look_up(0.4, 0.1, theta, 0.5)
for angle, a, f in zip(np.degrees(theta), amplitude, fresnel):
    print(f"theta {angle:4.1f}°: shading is {a:.4f} F0 + {f:.4f} (1 - F0)")

for check in ltcfit.validate(table, quality=False).checks:
    if check.checked and not check.passed:
        print(check.message)
