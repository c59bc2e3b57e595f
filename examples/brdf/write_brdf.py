#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the ltcfit authors
"""Writes a BRDF as a file of values that ltcfit fits tables to: python3 write_brdf.py fabric.h5

Here the "distribution-based" velvet of Ashikhmin and Premoze 2007, an inverted normal distribution
over the fibres' slopes, at eight roughnesses. Put your own shading code in place of `brdf`.
"""
import sys

import h5py
import numpy as np


def brdf(alpha, view, light):
    """In 1/sr; `view` and `light` are unit vectors about the normal z, the light's an array."""
    half = view + light
    half /= np.linalg.norm(half, axis=-1, keepdims=True)
    cosine2 = half[..., 2] ** 2
    sine2 = np.maximum(1 - cosine2, 1e-6)
    distribution = (1 + 4 * np.exp(-cosine2 / (sine2 * alpha**2)) / sine2**2) / (
        np.pi * (1 + 4 * alpha**2))
    v, l = view[2], light[..., 2]
    return distribution / (4 * np.maximum(v + l - v * l, 1e-6))


def direction(theta, phi):
    return np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi),
                     np.cos(theta) + 0 * phi], axis=-1)


alpha = np.linspace(0.1, 1, 8)
theta = np.radians(np.linspace(0, 89.9, 24))        # of the view, whose azimuth is 0
theta_light = np.radians(np.linspace(0, 90, 46))
phi_light = np.radians(np.linspace(0, 180, 46))     # the other half turn is its mirror image
light = direction(theta_light[:, None], phi_light[None, :])

values = np.zeros((len(alpha), 1, len(theta), 1, len(theta_light), len(phi_light)), np.float32)
for i, a in enumerate(alpha):
    for j, t in enumerate(theta):
        values[i, 0, j, 0] = brdf(a, direction(t, np.float64(0)), light)

with h5py.File(sys.argv[1] if len(sys.argv) > 1 else "fabric.h5", "w") as file:
    file.attrs["format"] = "ltc-brdf"
    file.attrs["format_version"] = 1
    file.attrs["quantity"] = "brdf"                 # or "brdf-cosine"
    for name, nodes in {"alpha": alpha, "lambda": [1.0], "theta": theta, "phi": [0.0],
                        "theta_light": theta_light, "phi_light": phi_light}.items():
        file[name] = np.asarray(nodes, np.float64)
    file["values"] = values
