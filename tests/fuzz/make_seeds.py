# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the ltcfit authors
"""Writes the seeds that the fuzzers start from: make_seeds.py LTCFIT FOLDER

LTCFIT is the program, FOLDER gets a folder for each reader. A seed is a good small file, or one with
a single lie of the kind that readers fall for: sizes of 2^60, negative sizes, NaN where a number is
expected, links in a circle, values nested deep. /usr/bin/python3 has h5py on Debian.
"""
import json
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile

import h5py
import numpy as np

AXES = ("alpha", "lambda", "theta", "phi")


def made_table(ltcfit, folder):
    """A table of 2x2x2x2 in all formats."""
    nodes = [f"--set=table.{axis}.nodes=2" for axis in AXES]
    subprocess.run([ltcfit, "generate", *nodes, "-o", folder], check=True, capture_output=True)


# ---- HDF5 ----

def short_copy(source, path, libver, **matrix_options):
    """The table with a short config, in a format of HDF5: the earliest has no checksums."""
    with h5py.File(source) as table, h5py.File(path, "w", libver=libver) as copy:
        copy.attrs.update(table.attrs)
        copy.attrs["config"] = "short"
        for name in ("matrix", "amplitude", "fresnel", "sw_loss", "status", "iterations"):
            options = matrix_options if name == "matrix" else {}
            copy.create_dataset(name, data=table[name][()], **options)
        for axis in AXES:
            copy[f"axis/{axis}"] = table[f"axis/{axis}"][()]
            copy[f"axis/{axis}"].attrs.update(table[f"axis/{axis}"].attrs)


def virtual_matrix(file):
    del file["matrix"]
    layout = h5py.VirtualLayout(shape=(2, 2, 2, 2, 3, 3), dtype="f4")
    layout[...] = h5py.VirtualSource("/etc/passwd", "matrix", shape=(2, 2, 2, 2, 3, 3))
    file.create_virtual_dataset("matrix", layout)


def other_files_bytes(file):
    del file["amplitude"]
    file.create_dataset("amplitude", shape=(2, 2, 2, 2), dtype="f4", external=[("/etc/passwd", 0, 64)])


def linked(target):
    def damage(file):
        del file["fresnel"]
        file["fresnel"] = target
    return damage


def group_in_itself(file):
    file["axis/axis"] = file["/"]
    del file["matrix"]
    file["matrix"] = file["axis"]


def never_written(file):
    del file["matrix"]
    file.create_dataset("matrix", shape=(2, 2, 2, 2, 3, 3), dtype="f4")


def axes_of_64_never_written(file):
    for axis in AXES:
        attributes = dict(file[f"axis/{axis}"].attrs)
        del file[f"axis/{axis}"]
        last = {"theta": 1.5706, "phi": 1.5707}.get(axis, 1)
        file[f"axis/{axis}"] = np.linspace(0, last, 64)
        file[f"axis/{axis}"].attrs.update(attributes)
    for name, kind in (("matrix", "f4"), ("amplitude", "f4"), ("fresnel", "f4"), ("sw_loss", "f4"),
                       ("status", "u1"), ("iterations", "u2")):
        shape = (64,) * 4 + ((3, 3) if name == "matrix" else ())
        del file[name]
        file.create_dataset(name, shape=shape, dtype=kind)


def huge_axis(file):
    del file["axis/phi"]
    file.create_dataset("axis/phi", shape=(1 << 60,), dtype="f8", chunks=(1024,))
    file["axis/phi"].attrs["warp"] = "linear"


HDF5_LIES = {
    "virtual_matrix": virtual_matrix,
    "other_files_bytes": other_files_bytes,
    "link_to_itself": linked(h5py.SoftLink("/fresnel")),
    "link_to_another_file": linked(h5py.ExternalLink("/dev/zero", "/fresnel")),
    "group_in_itself": group_in_itself,
    "never_written": never_written,
    "axes_of_64_never_written": axes_of_64_never_written,
    "axis_of_2_to_60": huge_axis,
    "alpha_min_is_nan": lambda f: f.attrs.__setitem__("alpha_min", np.float64("nan")),
    "seed_is_a_list": lambda f: f.attrs.__setitem__("seed", np.zeros(16, "u8")),
}


def hdf5_seeds(table, folder):
    shutil.copyfile(table, folder / "good.h5")
    short_copy(table, folder / "old_format.h5", "earliest")
    short_copy(table, folder / "new_format.h5", ("v108", "v108"))
    short_copy(table, folder / "chunked.h5", "earliest", chunks=True)
    for name, damage in HDF5_LIES.items():
        shutil.copyfile(folder / "new_format.h5", folder / f"{name}.h5")
        with h5py.File(folder / f"{name}.h5", "r+") as file:
            damage(file)
    for cut in (8, 48, 500):
        (folder / f"cut_{cut}.h5").write_bytes(table.read_bytes()[:cut])


# ---- NPY ----

def npy(shape, values, version=1, descr="<f4"):
    text = f"{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}".encode()
    size = struct.pack("<H" if version == 1 else "<I", len(text))
    return b"\x93NUMPY" + bytes([version, 0]) + size + text + values


def npy_seeds(table, folder):
    (folder / "good.npy").write_bytes(table.read_bytes())
    one = np.eye(3, dtype="<f4").tobytes()
    lies = {
        "one_entry": npy("(1, 1, 1, 1, 3, 3)", one),
        "version_2": npy("(1, 1, 1, 1, 3, 3)", one, 2),
        "skipped": npy("(1, 1, 1, 1, 3, 3)", np.full(9, np.nan, "<f4").tobytes()),
        "nan_in_a_matrix": npy("(1, 1, 1, 1, 3, 3)", one[:-4] + struct.pack("<f", float("nan"))),
        "all_64_no_values": npy("(64, 64, 64, 64, 3, 3)", b""),
        "2_to_60": npy(f"({1 << 60}, 1, 1, 1, 3, 3)", one),
        "2_to_64": npy(f"({1 << 64}, 1, 1, 1, 3, 3)", one),
        "product_wraps": npy(f"({1 << 32}, {1 << 32}, 1, 1, 3, 3)", one),
        "negative": npy("(-1, 1, 1, 1, 3, 3)", one),
        "zero": npy("(0, 1, 1, 1, 3, 3)", b""),
        "deep": npy("(" * 2000, one),
        "header_of_4_gb": b"\x93NUMPY\x02\x00\xff\xff\xff\xff",
        "f8": npy("(1, 1, 1, 1, 3, 3)", one + one, descr="<f8"),
    }
    for name, content in lies.items():
        (folder / f"{name}.npy").write_bytes(content)


# ---- OpenEXR ----

def exr_attribute(content, name, change):
    """The file with the value of a header attribute changed; its size with it."""
    start = content.index(name.encode() + b"\0")
    size_at = content.index(b"\0", start + len(name) + 1) + 1
    (size,) = struct.unpack_from("<i", content, size_at)
    value = change(content[size_at + 4:size_at + 4 + size])
    return content[:size_at] + struct.pack("<i", len(value)) + value + content[size_at + 4 + size:]


def axes_of_64(value):
    axes = json.loads(value)
    for axis in AXES:
        axes[axis] = list(np.linspace(0, axes[axis][-1], 64).round(15))
    return json.dumps(axes).encode()


def with_size(content, name, size):
    start = content.index(name.encode() + b"\0")
    at = content.index(b"\0", start + len(name) + 1) + 1
    return content[:at] + struct.pack("<i", size) + content[at + 4:]


def exr_seeds(texture, folder):
    good = texture.read_bytes()
    lies = {
        "good": good,
        "cut": good[:300],
        "window_negative": exr_attribute(good, "dataWindow", lambda v: struct.pack("<4i", 3, 3, 0, 0)),
        "window_of_2_to_31": exr_attribute(
            good, "dataWindow", lambda v: struct.pack("<4i", -(1 << 31), 0, (1 << 31) - 1, 3)),
        "all_64_no_pixels": exr_attribute(
            exr_attribute(good, "dataWindow", lambda v: struct.pack("<4i", 0, 0, 4095, 4095)),
            "ltc:axes", axes_of_64),
        "alpha_min_is_nan": exr_attribute(good, "ltc:alpha_min",
                                          lambda v: struct.pack("<d", float("nan"))),
        "axes_deep": exr_attribute(good, "ltc:axes", lambda v: b"[" * 4000),
        "axes_are_text": exr_attribute(good, "ltc:axes", lambda v: b'{"alpha": "0, 1"}'),
        "attribute_of_negative_size": with_size(good, "ltc:axes", -1),
        "attribute_of_2_gb": with_size(good, "ltc:axes", (1 << 31) - 1),
        "compression_of_200": exr_attribute(good, "compression", lambda v: b"\xc8"),
    }
    for name, content in lies.items():
        (folder / f"{name}.exr").write_bytes(content)


# ---- Textures ----

HALVES = np.arange(2 * 2 * 4, dtype="<f2").tobytes()


def dds(values=HALVES, width=2, height=2, depth=1, levels=1, caps=0, dxgi=10, dimension=3, misc=0,
        layers=1, four_cc=b"DX10"):
    header = struct.pack("<4s7I44x", b"DDS ", 124, 0x100f, height, width, 8 * width % (1 << 32),
                         depth, levels)
    header += struct.pack("<2I4s20x2I12x", 32, 4, four_cc, 0x1000, caps)
    if four_cc == b"DX10":
        header += struct.pack("<5I", dxgi, dimension, misc, layers, 0)
    return header + values


def dds_seeds(folder):
    good = dds()
    lies = {
        "good": good,
        "legacy": dds(four_cc=struct.pack("<I", 113)),
        "volume": dds(HALVES * 3, depth=3, dimension=4),
        "cut": good[:140],
        "no_values": dds(b""),
        "2_to_32": dds(width=(1 << 32) - 1, height=(1 << 32) - 1, layers=(1 << 32) - 1),
        "largest_no_values": dds(b"", width=16384, height=3072),
        "product_wraps": dds(b"", width=1 << 16, height=1 << 16, layers=1 << 31),
        "zero": dds(b"", width=0),
        "no_layers": dds(b"", layers=0),
        "mip_levels": dds(levels=2),
        "cube": dds(HALVES * 6, misc=4, layers=6),
        "old_cube": dds(HALVES * 6, caps=0xfe00, four_cc=struct.pack("<I", 113)),
        "bc7": dds(dxgi=98),
        "dxt1": dds(four_cc=b"DXT1"),
    }
    for name, content in lies.items():
        (folder / f"{name}.dds").write_bytes(content)


def zstd(content, size=None):
    """A frame of one block that is not compressed, or of as many as it takes of a single byte."""
    size = len(content) if size is None else size
    frame = b"\x28\xb5\x2f\xfd\xe0" + struct.pack("<Q", size)
    if len(content) > 1:
        return frame + struct.pack("<I", 1 | len(content) << 3)[:3] + content
    for begin in range(0, size, 1 << 17):
        length = min(1 << 17, size - begin)
        frame += struct.pack("<I", (begin + length == size) | 2 | length << 3)[:3] + content
    return frame


def ktx2(level=HALVES, width=2, height=2, depth=0, layers=0, faces=1, levels=1, scheme=0, vk=97,
         offset=104, length=None, size=len(HALVES), description=(104, 0)):
    header = b"\xabKTX 20\xbb\r\n\x1a\n"
    header += struct.pack("<9I", vk, 2, width, height, depth, layers, faces, levels, scheme)
    header += struct.pack("<4I2Q", *description, 104, 0, 0, 0)
    length = len(level) if length is None else length
    return header + struct.pack("<3Q", offset, length, size) + level


def ktx2_seeds(folder):
    good = ktx2()
    lies = {
        "good": good,
        "volume": ktx2(HALVES * 3, depth=3, size=3 * len(HALVES)),
        "compressed": ktx2(zstd(HALVES), scheme=2),
        "cut": good[:100],
        "no_values": ktx2(b""),
        "offset_of_2_to_64": ktx2(offset=(1 << 64) - 1),
        "offset_in_the_header": ktx2(offset=0),
        "length_of_2_to_64": ktx2(length=(1 << 64) - 1),
        "end_wraps": ktx2(offset=(1 << 64) - 16, length=16 + 104 + len(HALVES)),
        "size_of_2_to_60": ktx2(size=1 << 60),
        "descriptor_of_4_gb": ktx2(description=(0xffffffff, 0xffffffff)),
        "2_to_32": ktx2(width=0xffffffff, height=0xffffffff, layers=0xffffffff),
        "product_wraps": ktx2(width=1 << 31, height=1 << 31, layers=4, size=0),
        "array_of_volumes": ktx2(depth=1, layers=1),
        "cube": ktx2(HALVES * 6, faces=6),
        "mip_levels": ktx2(levels=2),
        "basis": ktx2(scheme=1),
        "rgba8": ktx2(vk=37),
        "no_frame": ktx2(scheme=2),
        "frame_of_2_to_60": ktx2(zstd(HALVES, 1 << 60), scheme=2),
        "frame_too_short": ktx2(zstd(HALVES[1:], len(HALVES)), scheme=2),
        "frame_too_long": ktx2(zstd(HALVES * 2, len(HALVES)), scheme=2),
        "two_frames": ktx2(zstd(HALVES) * 2, scheme=2),
        "bomb": ktx2(zstd(b"\0", 4096 * 4096 * 8), 4096, 4096, scheme=2, size=4096 * 4096 * 8),
    }
    for name, content in lies.items():
        (folder / f"{name}.ktx2").write_bytes(content)


OCTAVE_NAMES = [f"tab{column}{row}" for column in range(3) for row in range(3)]


def octave(matrices):
    return "".join(f"# name: {name}\n# type: matrix\n# ndims: 2\n {rows} {columns}\n{values}\n\n"
                   for name, rows, columns, values in matrices)


def raw_seeds(folder):
    def described(data, **changes):
        image = {"name": "a", "shape": "flat", "width": 2, "height": 1, "layers": 1, "channels": 2,
                 "precision": "half"} | changes
        return json.dumps({"images": [image]}).encode() + b"\0" + data
    seeds = {
        "good": described(bytes(8)),
        "babylon": bytes(16),
        "playcanvas": b"\0\0\1\0" + bytes(32),
        "empty": b"",
        "odd_length": bytes(24),
        "playcanvas_cut": b"\0\0\1\0" + bytes(28),
        "wrong_count": described(bytes(6)),
        "size_of_2_to_60": described(bytes(8), width=1 << 60, height=1 << 60),
        "negative": described(bytes(8), width=-2),
        "no_json": b"{" + bytes(8),
    }
    for name, content in seeds.items():
        (folder / f"{name}.bin").write_bytes(content)


def number_seeds(folder):
    lies = {
        "good.json": '{"size": {"a": [2, 1, 2, 1]}, "a": [1, -0.0, 1e-5, [65504]]}',
        "good.js": "// a\nexport const a = [ 1, - 2e-05, .5, 1., ], b = new C('=[1');\nc = [d, 1];",
        "good.h": "#ifndef A\n/* width 1, height 1, layers 1, channels 2 */\n"
                  "static const float a[2] = {1.0f, -2e-5f};\nx b[1][4] = {{1, 2, 3, 4}};\n#endif\n",
        "size_of_2_to_60.json": '{"size": {"a": [%d, %d, 1, 1]}, "a": [1]}' % (1 << 60, 1 << 60),
        "product_wraps.json": '{"size": {"a": [%d, %d, 1, 1]}, "a": []}' % (1 << 32, 1 << 32),
        "size_of_2_to_64.h": "/* width %d, height 1, layers 1, channels -1 */ a = {1}" % (1 << 64),
        "wrong_count.json": '{"size": {"a": [2, 2, 1, 4]}, "a": [1, 2, 3, 4]}',
        "wrong_count.js": "a = [1, 2, 3]",
        "nan.json": '{"a": [1, 2, 3, NaN]}',
        "nan.js": "a = [1, 2, 3, NaN]",
        "huge.json": '{"a": [1, 2, 3, 1e999]}',
        "huge.js": "a = [1, 2, 3, 1e39]",
        "infinite.h": "a = {1, 2, 3, -inf}",
        "deep.json": '{"a": ' + "[" * 2000,
        "deep.js": "a = " + "[" * 2000 + "1",
        "twice.json": '{"a": [1, 2, 3, 4], "a": [1, 2, 3, 4]}',
        "not_closed.js": "a = [1, 2, 3, 4",
        "not_closed.h": "a = {1, 2, 3, 4]",
        "comment_not_closed.js": "a = [1, /* 2, 3, 4]",
        "good.cs": "static ushort[] a = new ushort[1 * 1 * 4]\n{ 15360, 0, 48128, 31743, };",
        "half_of_17_bits.cs": "a = new ushort[4] { 65536, 0, 0, 0 };",
        "good.inc": "static const mat33 m[1] = {{1, 0, 0, 0, 1, 0, 0, 0, 1}};",
        "good.mat": octave([(name, 1, 2, "1 -2e-05") for name in OCTAVE_NAMES]),
        "one_missing.mat": octave([(name, 1, 1, "1") for name in OCTAVE_NAMES[:8]]),
        "sizes_differ.mat": octave([(name, 1, 1 + (name == "tab22"), "1 1") for name in OCTAVE_NAMES]),
        "size_of_2_to_60.mat": octave([("tab00", 1 << 60, 1 << 60, "1")]),
        "cut.mat": octave([("tab00", 2, 2, "1 2 3")]),
        "nan.mat": octave([(name, 1, 1, "NaN") for name in OCTAVE_NAMES]),
    }
    for name, content in lies.items():
        (folder / name).write_text(content)


# ---- Text ----

def config_seeds(source, folder):
    lies = {
        "default": (source / "config/default.toml").read_text(),
        "sections": "[table]\nstorage = 'mirror-frame'\n[table.alpha]\nnodes = 4\nfirst = 0.1\n",
        "inline": "table = { alpha = { nodes = 3 }, brdf = \"ggx\" }\nfit.seed = 1\n",
        "2_to_60": f"[table.alpha]\nnodes = {1 << 60}\n",
        "2_to_64": f"[table.alpha]\nnodes = {1 << 64}\n",
        "negative": "[table.alpha]\nnodes = -1\n",
        "nan": "[table]\nalpha_min = nan\n[table.theta]\nlast_degrees = inf\n",
        "list": "[fit]\nseed = [1, [2, {a = 1979-05-27T07:32:00Z}]]\n",
        "deep_list": "a = " + "[" * 1000,
        "deep_table": "a = " + "{a=" * 1000,
        "deep_key": ".".join("a" * 1000) + " = 1\n",
        "text": "[output]\nname = \"\"\"a\\u00e9\\\n  b\"\"\"\n",
    }
    for name, content in lies.items():
        (folder / f"{name}.toml").write_text(content)


def scene_seeds(source, folder):
    material = '[[material]]\nname = "m"\n'
    lies = {
        "all_keys": material + "roughness = [0.1, 0.5]\nanisotropy = 0.5\nview_angle_degrees = [0, 60]\n"
                    + material + "alpha_x = 0.2\nalpha_y = [0, 1]\n",
        "nan": material + "roughness = nan\n",
        "infinite": material + "alpha_x = [-inf, inf]\nalpha_y = 1e308\n",
        "2_to_60": material + f"alpha_x = {1 << 60}\nalpha_y = -{1 << 60}\n",
        "not_a_list": "material = 1\n",
        "list_of_lists": "material = [[1], [{}]]\n",
        "deep": material + "alpha_x = " + "[" * 1000,
        "no_name": "[[material]]\n",
    }
    for name, content in lies.items():
        (folder / f"{name}.toml").write_text(content)


def glb(chunk, length=None, kind=b"JSON", chunk_length=None):
    length = 20 + len(chunk) if length is None else length
    chunk_length = len(chunk) if chunk_length is None else chunk_length
    return b"glTF" + struct.pack("<III", 2, length, chunk_length) + kind + chunk


def gltf_seeds(folder):
    good = {"asset": {"version": "2.0"}, "materials": [
        {}, {"name": "m", "pbrMetallicRoughness": {"roughnessFactor": 0.3, "metallicRoughnessTexture": {"index": 0}},
             "extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 0.5, "anisotropyTexture": {"index": 1}}}}],
        "nodes": [{"children": [0]}], "buffers": [{"byteLength": 1 << 60}]}
    text = json.dumps(good).encode()
    # Every extension that is followed, animated by values in a buffer.
    coat = "/materials/0/extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor"
    all_keys = {
        "asset": {"version": "2.0"}, "extensionsUsed": ["KHR_animation_pointer"],
        "materials": [{"extensions": {
            "KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessTexture": {"index": 0}},
            "KHR_materials_pbrSpecularGlossiness": {"glossinessFactor": 0.5},
            "MSFT_packing_normalRoughnessMetallic": {"normalRoughnessMetallicTexture": {"index": 0}}}},
            {"extensions": {"KHR_materials_unlit": {}}}],
        "meshes": [{"primitives": [{"mode": 0, "attributes": {"NORMAL": 0}}, {"material": 0}]}],
        "animations": [{"samplers": [{"output": 0, "interpolation": "STEP"}], "channels": [
            {"sampler": 0, "target": {"path": "pointer", "extensions": {
                "KHR_animation_pointer": {"pointer": coat}}}}]}],
        "accessors": [{"componentType": 5126, "type": "SCALAR", "count": 2, "bufferView": 0}],
        "bufferViews": [{"buffer": 0, "byteLength": 8, "byteStride": 4}],
        "buffers": [{"uri": "data:;base64,zczMPc3MTD4="}]}
    lies = {
        "all_keys.gltf": json.dumps(all_keys).encode(),
        "good.gltf": text,
        "good.glb": glb(text),
        "nan.gltf": text.replace(b"0.3", b"NaN"),
        "huge.gltf": text.replace(b"0.3", b"1e999"),
        "negative_index.gltf": text.replace(b'"index": 0', b'"index": -1'),
        "deep_list.gltf": b'{"materials": ' + b"[" * 2000,
        "deep_object.gltf": b'{"a":' * 2000,
        "chunk_of_4_gb.glb": glb(text, chunk_length=0xffffffff),
        "file_of_4_gb.glb": glb(text, length=0xffffffff),
        "empty_chunk.glb": glb(b""),
        "binary_first.glb": glb(text, kind=b"BIN\0"),
        "not_utf8.gltf": text.replace(b'"m"', b'"\xff\xc0"'),
    }
    for name, content in lies.items():
        (folder / name).write_bytes(content)


def main():
    ltcfit, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    source = pathlib.Path(__file__).resolve().parents[2]
    for reader in ("hdf5", "npy", "exr", "config", "scene", "gltf", "dds", "ktx2", "text",
                   "raw"):
        (folder / reader).mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as made:
        made_table(ltcfit, made)
        made = pathlib.Path(made)
        hdf5_seeds(made / "ltc.h5", folder / "hdf5")
        npy_seeds(made / "ltc.npy", folder / "npy")
        exr_seeds(made / "ltc.0.exr", folder / "exr")
    config_seeds(source, folder / "config")
    scene_seeds(source, folder / "scene")
    gltf_seeds(folder / "gltf")
    dds_seeds(folder / "dds")
    ktx2_seeds(folder / "ktx2")
    number_seeds(folder / "text")
    raw_seeds(folder / "raw")


main()
