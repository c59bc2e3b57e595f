#!/usr/bin/python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the ltcfit authors
"""What axes, storages and settings of the refinement give: the table of docs/refinement.md.

    bench/refinement_study.py [--program build/release/ltcfit] [--queries 2400] [ROW …]

Makes every table with and without refinement, in a temporary folder, and prints the mean relative
loss of random queries between the nodes as `ltcfit validate` measures it, on a quarter of its
samples and half of its directions, in Markdown. ROW picks rows by a part of their name. A row takes
half a minute.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

SQRT_AXES = ["table.alpha.warp=sqrt", "table.lambda.warp=sqrt"]
MIRROR = ["table.storage=mirror-frame"]
GRAZING = ["table.theta.warp=complement-sqrt"]
KEEP = ["refine.keep_smoothest=true"]
PERCEPTUAL = SQRT_AXES + GRAZING + MIRROR

ROWS = {
    "paper's axes, \"matrix\", nodes at α = 0 free (`config/default.toml`)": [],
    "the same, nodes at α = 0 kept": KEEP,
    "the same as the first, `node_weight` 0.1": ["refine.node_weight=0.1"],
    "the same as the first, 16 queries a cell": ["refine.queries_per_cell=16"],
    "α `sqrt`, λ and θ `linear`, \"mirror-frame\"": ["table.alpha.warp=sqrt"] + MIRROR + KEEP,
    "α and λ `sqrt`, θ `linear`, \"mirror-frame\"": SQRT_AXES + MIRROR + KEEP,
    "α and λ `sqrt`, θ `complement-sqrt`, \"matrix\"": SQRT_AXES + GRAZING + KEEP,
    "α and λ `sqrt`, θ `complement-sqrt`, \"roughness-scaled\"":
        SQRT_AXES + GRAZING + ["table.storage=roughness-scaled"] + KEEP,
    "α and λ `sqrt`, θ `complement-sqrt`, \"mirror-frame\"": PERCEPTUAL + KEEP,
    "the same, `node_weight` 0.1 (`config/perceptual.toml`)":
        PERCEPTUAL + KEEP + ["refine.node_weight=0.1"],
    "perceptual, nodes at α = 0 free": PERCEPTUAL + ["refine.node_weight=0.1"],
    "perceptual, 16 queries a cell":
        PERCEPTUAL + KEEP + ["refine.node_weight=0.1", "refine.queries_per_cell=16"],
}


def run(program, arguments):
    subprocess.run([program, *arguments], check=True, capture_output=True)


def options(settings):
    return [word for setting in settings for word in ("--set", setting)]


def quality(program, folder, settings, queries):
    run(program, ["generate", "--output", folder, *options(settings)])
    report = pathlib.Path(folder) / "report.json"
    # Exit code 1 where a limit is passed: what counts here is the figure.
    subprocess.run(
        [program, "validate", f"{folder}/ltc.h5", "--json", report,
         *options([f"quality.queries={queries}", "quality.query_samples=4096",
                   "quality.query_directions=16", "quality.nodes=0", "quality.quads=1"])],
        capture_output=True)
    return json.loads(report.read_text())["quality"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/release/ltcfit")
    parser.add_argument("--queries", type=int, default=2400)
    parser.add_argument("rows", nargs="*", metavar="ROW")
    arguments = parser.parse_args()
    program = str(pathlib.Path(arguments.program).resolve())
    print("| axes and storage | fitted | refined |\n|---|---|---|")
    floor = None
    for name, settings in ROWS.items():
        if arguments.rows and not any(part in name for part in arguments.rows):
            continue
        means = []
        for steps in (["refine.steps=0"], []):
            with tempfile.TemporaryDirectory() as folder:
                found = quality(program, folder, settings + steps, arguments.queries)
            means.append(found["query_loss"]["mean"])
            floor = found["floor_loss"]["mean"]
        print(f"| {name} | {means[0]:.4f} | {means[1]:.4f} |", flush=True)
    if floor is not None:
        print(f"| each query fitted by itself | | {floor:.4f} |")


if __name__ == "__main__":
    main()
