#!/usr/bin/python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the ltcfit authors
"""Numbers of a field against its error: the table and the picture of docs/field.md.

    bench/field_frontier.py [--program build/release/ltcfit] [--sizes 128,256,…] [--queries 2400]
                            [--table NAME=FILE …] [--svg docs/pictures/field.svg]

Makes a field of every size in a temporary folder and prints, in Markdown, its bytes in 16 bits, the
time, the mean relative loss and the error under area lights of random queries as `ltcfit validate`
measures them, on a quarter of its samples. Tables beside them are judged by the same queries.
"""
import argparse
import json
import math
import pathlib
import subprocess
import tempfile
import time

CONFIG = pathlib.Path(__file__).parent.parent / "config/field.toml"


def run(program, *arguments):
    began = time.monotonic()
    result = subprocess.run([program, *arguments], capture_output=True, text=True)
    if result.returncode > 1:  # 1: a limit of validate, which does not matter here
        raise SystemExit(result.stderr)
    return time.monotonic() - began


def judged(program, table, queries, folder):
    report = folder / "report.json"
    settings = [f"quality.queries={queries}", "quality.query_samples=4096",
                "quality.quad_samples=4096", "quality.node_samples=256",
                "quality.node_directions=4"]
    run(program, "validate", str(table), "--json", str(report),
        *[word for setting in settings for word in ("--set", setting)])
    quality = json.loads(report.read_text())["quality"]
    smooth = quality["by"][0]["bands"][0]  # perceptual roughness 0.1 to 0.2
    return {
        "loss": quality["query_loss"]["mean"], "lights": quality["area_light_error"]["mean"],
        "floor": quality["floor_loss"]["mean"],
        "floor_lights": quality["floor_area_light_error"]["mean"],
        "smooth": smooth["loss"], "floor_smooth": smooth["floor_loss"],
        "largest": quality["query_loss"]["largest"],
    }


def picture(rows, floor):
    """Loss over numbers, both on logarithmic scales."""
    width, height, left, bottom = 720, 440, 70, 60
    x0, x1, y0, y1 = math.log(100), math.log(50000), math.log(0.055), math.log(0.13)

    def x(value):
        return left + (math.log(value) - x0) / (x1 - x0) * (width - left - 20)

    def y(value):
        return height - bottom - (math.log(value) - y0) / (y1 - y0) * (height - bottom - 20)

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
             'font-family="sans-serif" font-size="13">',
             f'<rect width="{width}" height="{height}" fill="white"/>']
    for numbers in (128, 256, 512, 1024, 2048, 4096, 8192, 36864):
        parts.append(f'<line x1="{x(numbers):.1f}" x2="{x(numbers):.1f}" y1="20" '
                     f'y2="{height - bottom}" stroke="#ddd"/><text x="{x(numbers):.1f}" '
                     f'y="{height - bottom + 18}" text-anchor="middle">{numbers:,}</text>')
    for loss in (0.06, 0.07, 0.08, 0.1, 0.12):
        parts.append(f'<line x1="{left}" x2="{width - 20}" y1="{y(loss):.1f}" y2="{y(loss):.1f}" '
                     f'stroke="#ddd"/><text x="{left - 8}" y="{y(loss) + 4:.1f}" '
                     f'text-anchor="end">{loss}</text>')
    parts.append(f'<line x1="{left}" x2="{width - 20}" y1="{y(floor):.1f}" y2="{y(floor):.1f}" '
                 f'stroke="#b03a2e" stroke-dasharray="6 4"/><text x="{width - 24}" '
                 f'y="{y(floor) + 16:.1f}" text-anchor="end" fill="#b03a2e">'
                 'an LTC fitted to each lobe</text>')
    fields = [(numbers, loss) for name, numbers, loss in rows if name is None]
    points = " ".join(f"{x(n):.1f},{y(loss):.1f}" for n, loss in fields)
    parts.append(f'<polyline points="{points}" fill="none" stroke="#1f5fa8" stroke-width="2"/>')
    for name, numbers, loss in rows:
        color = "#1f5fa8" if name is None else "#444"
        parts.append(f'<circle cx="{x(numbers):.1f}" cy="{y(loss):.1f}" r="4" fill="{color}"/>')
        if name:
            parts.append(f'<text x="{x(numbers) - 8:.1f}" y="{y(loss) - 8:.1f}" '
                         f'text-anchor="end">{name}</text>')
    if fields:
        parts.append(f'<text x="{x(fields[0][0]) + 10:.1f}" y="{y(fields[0][1]) - 6:.1f}" '
                     'fill="#1f5fa8">fields</text>')
    parts.append(f'<text x="{(left + width) / 2}" y="{height - 14}" text-anchor="middle">numbers of '
                 'the matrices</text>'
                 f'<text transform="translate(18 {height / 2 - 20}) rotate(-90)" '
                 'text-anchor="middle">mean relative loss between nodes</text></svg>')
    return "\n".join(parts) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/release/ltcfit")
    parser.add_argument("--sizes", default="128,256,512,1024,2048,4096")
    parser.add_argument("--queries", type=int, default=2400)
    parser.add_argument("--table", action="append", default=[], metavar="NAME=FILE")
    parser.add_argument("--svg")
    arguments = parser.parse_args()
    program = str(pathlib.Path(arguments.program).resolve())
    rows = []
    print("| | numbers | bytes in 16 bits | all | √α < 0.2 | largest | area lights | over the floor's "
          "| time |\n|---|---|---|---|---|---|---|---|---|")

    def show(name, numbers, found, seconds):
        rows.append((name, numbers, found["loss"]))
        clock = f"{seconds:.1f} s" if seconds else ""
        print(f"| {name or 'field'} | {numbers:,} | {2 * numbers:,} | {found['loss']:.4f} | "
              f"{found['smooth']:.4f} | {found['largest']:.2f} | {found['lights']:.4f} | "
              f"{found['lights'] / found['floor_lights']:.3f} | {clock} |", flush=True)

    found = None
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        for size in map(int, arguments.sizes.split(",")):
            seconds = run(program, "generate", "--config", str(CONFIG), "-o", str(folder / "field"),
                          "--set", f"field.size={size}", "--set", f"field.queries={max(10000, 6 * size)}")
            found = judged(program, folder / "field/ltc_field.json", arguments.queries, folder)
            show(None, size, found, seconds)
        for table in arguments.table:
            name, file = table.split("=", 1)
            found = judged(program, file, arguments.queries, folder)
            show(name, 36864, found, None)
    if found:
        print(f"| an LTC fitted to each lobe | | | {found['floor']:.4f} | {found['floor_smooth']:.4f} "
              f"| | {found['floor_lights']:.4f} | 1 | |")
    if arguments.svg:
        pathlib.Path(arguments.svg).write_text(picture(rows, found["floor"]))


if __name__ == "__main__":
    main()
