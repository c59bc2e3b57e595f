# SPDX-License-Identifier: MIT
"""The Python module: values, shapes, views, exceptions, stops."""
import math
import pathlib
import re
import tempfile
import threading
import warnings

import h5py
import ltcfit
import numpy as np


def raises(kinds, call, *arguments, **named):
    try:
        call(*arguments, **named)
    except kinds as error:
        return str(error)
    raise AssertionError(f"{call} raised nothing of {kinds}")


SMALL = {"table.alpha.nodes": 2, "table.lambda.nodes": 3, "table.theta.nodes": 4, "table.phi.nodes": 2,
         "refine.steps": 0, "output.exr": False}
table = ltcfit.generate(set=SMALL, threads=1)
assert table.shape == [2, 3, 4, 2], table.shape
assert table.storage == "matrix"
assert list(table.axes) == ["alpha", "lambda", "theta", "phi"]
assert "exr = false" in table.config

with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder) / "t.h5"
    table.write(file)
    with h5py.File(file) as h5:
        assert np.array_equal(h5["matrix"], table.stored)
        assert np.array_equal(h5["amplitude"], table.amplitude)
        assert np.array_equal(h5["fresnel"], table.fresnel)
        assert np.array_equal(h5["sw_loss"], table.loss)
        assert np.array_equal(h5["axis/theta"], table.axes["theta"])
        assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", h5.attrs["created"])
    again = ltcfit.Table.read(str(file))
    again.write(file.with_suffix(".npy"))
    assert np.array_equal(np.load(file.with_suffix(".npy")), table.matrix.astype(np.float32))

# Views: no copy, and nobody writes into a table.
assert np.shares_memory(table.stored, table.stored)
assert not table.stored.flags.writeable
del again
stored = ltcfit.generate(set=SMALL).stored
assert np.array_equal(stored, table.stored)  # its table is gone but for this view

# A look-up at a node is the node; arguments broadcast.
node = (1, 1, 2, 0)
alpha, ratio, theta, phi = (table.axes[name][i] for name, i in zip(table.axes, node))
M, amplitude, fresnel = table.look_up(alpha, ratio * alpha, theta, phi)
assert M.shape == (3, 3) and amplitude.shape == ()
assert np.allclose(M, table.matrix[node], rtol=0, atol=1e-12)  # weights are 0 and 1
many, amplitudes, _ = table.look_up(alpha, ratio * alpha, theta, np.array([phi, 0.3, -4]))
assert many.shape == (3, 3, 3) and amplitudes.shape == (3,)
assert np.array_equal(many[0], M)
assert table.look_up(np.ones((2, 1)), 1, np.zeros(3), 0)[0].shape == (2, 3, 3, 3)
assert table.look_up([], [], [], [])[0].shape == (0, 3, 3)

fit = ltcfit.fit(0.4, 0.1, 1.0, 0.5)
assert fit.matrix.shape == (3, 3) and abs(np.linalg.norm(fit.matrix[:, 2]) - 1) < 1e-6  # floats
assert 0 < fit.loss / fit.spread < 0.1 and 0 < fit.amplitude <= 1

report = ltcfit.validate(table, quality=False)
assert report.passed and report.quality is None and len(report.checks) > 10
assert not ltcfit.validate(table, set={"invariants.albedo_error": 0}, quality=False).passed

assert "allowed" in raises(ltcfit.InputError, ltcfit.fit, 2, 0.1, 1, 0)
raises(ValueError, ltcfit.generate, set={"table.alpha.nodes": 0})
raises(ltcfit.IoError, ltcfit.Table.read, "/nowhere/t.h5")
raises(OSError, table.write, "/nowhere/t.h5")
raises(TypeError, ltcfit.fit, "a", 1, 1, 1)

SLOW = {"fit.solver": "sgd", "table.alpha.nodes": 2}  # minutes, were it not stopped
raises(ltcfit.Interrupted, ltcfit.generate, set=SLOW, progress=lambda stage, done, total: False)
raises(ZeroDivisionError, ltcfit.generate, set=SLOW, progress=lambda *_: 1 / 0)
threading.Timer(0.5, lambda: __import__("_thread").interrupt_main()).start()
raises(KeyboardInterrupt, ltcfit.generate, set=SLOW)
assert math.isfinite(ltcfit.fit(0.4, 0.1, 1.0, 0.5).loss)  # and it goes on

# A scene asks for a part of the table, which is then extended to the whole, bit for bit.
with tempfile.TemporaryDirectory() as folder:
    scene, part = pathlib.Path(folder) / "s.gltf", pathlib.Path(folder) / "part.h5"
    scene.write_text('{"asset": {"version": "2.0"}, "materials": [{"pbrMetallicRoughness": {"roughnessFactor": 0.3},'
                     ' "extensions": {"EXT_felt": {"feltRoughnessFactor": 0.3}}}]}')
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        few = ltcfit.generate(set=SMALL, scene=scene)
    assert len(heard) == 1 and "EXT_felt" in str(heard[0].message), heard
    assert 0 < np.isnan(few.loss).sum() < few.loss.size
    few.write(part)
    assert np.array_equal(ltcfit.generate(set=SMALL, extend=part).stored, table.stored)
    raises(ltcfit.InputError, ltcfit.generate, set=SMALL, extend=part.with_suffix(".npy"))
