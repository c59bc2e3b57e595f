# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the ltcfit authors
"""Runs the Python look-up of docs/files.md: documented_look_up.py FILES.md TABLE.h5 QUERIES.json

Each query is [alpha_x, alpha_y, theta, phi]. Prints a JSON list: the nine entries of M by rows,
amplitude and Fresnel term of each, and k and g of folded lobes.
"""
import json
import re
import sys


def main():
    with open(sys.argv[1], encoding="utf-8") as text:
        blocks = re.findall(r"^```python\n(.*?)^```$", text.read(), re.DOTALL | re.MULTILINE)
    assert len(blocks) == 1, f"{len(blocks)} Python examples in the document"
    example = {}
    exec(compile(blocks[0], sys.argv[1], "exec"), example)
    table = example["load"](sys.argv[2])
    with open(sys.argv[3], encoding="utf-8") as text:
        queries = json.load(text)
    results = []
    for query in queries:
        matrix, *numbers = example["look_up"](table, *query)
        results.append([*matrix.ravel().tolist(), *map(float, numbers)])
    print(json.dumps(results))


main()
