#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a material costs: prints the table of docs/materials.md.

    tests/experiments/material_costs.py PROGRAM OUT [--seconds S] [ROW...]       S: of each run (12)

The ball on a table of docs/tours/sun-on-a-table.md, with another material of the ball or of the table in each row. A
first run of one pass compiles the kernels, so that its time does not count. A row has the run's own estimate of its
error after S seconds (CIELAB, mean of the picture), and how many times as long as clear glass it takes to the same
error, were errors to fall as one over the root of the time.
"""
import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
TOUR = ROOT / "docs/tours/sun-on-a-table.md"
GLASS = {"type": "dielectric", "dispersion": "N-BK7"}
OAK = {"type": "plastic", "reflectance": 1, "texture": "textures/oak.png"}
ROWS = {
    "clear glass": ("glass", GLASS),
    "glass of one index": ("glass", {**GLASS, "dispersion": 1.52}),
    "tinted glass": ("glass", {**GLASS, "tint": {"type": "table", "table": [[400, .6], [550, .95], [700, .7]]}}),
    "frosted glass, roughness .2": ("glass", {**GLASS, "roughness": .2}),
    "frosted glass, roughness .4": ("glass", {**GLASS, "roughness": .4}),
    "diamond": ("glass", {**GLASS, "dispersion": "diamond-Peter"}),
    "polished gold": ("glass", {"type": "conductor", "metal": "gold"}),
    "rough gold, roughness .3": ("glass", {"type": "conductor", "metal": "gold", "roughness": .3}),
    "lacquered brass": ("glass", {"type": "varnished_metal", "metal": "brass"}),
    "plastic": ("glass", {"type": "plastic", "reflectance": .6}),
    "matt": ("glass", {"type": "diffuse", "reflectance": .6}),
    "a table with a picture": ("table", {"type": "diffuse", "texture": "textures/oak.png"}),
    "a varnished table with a picture": ("table", OAK),
    "the same, roughness .2": ("table", {**OAK, "roughness": .2}),
    "a table of polished silver": ("table", {"type": "conductor", "metal": "silver"}),
}


def measure(program, out, name, seconds):
    """The run's estimate of its error."""
    preset = json.loads(TOUR.read_text().split("```json\n")[1].split("```")[0])
    place, material = ROWS[name]
    preset["scene"]["materials"][place] = material
    file = out / f"{name.replace(' ', '-').replace(',', '')}.json"
    file.write_text(json.dumps(preset))
    run = [program, "run", str(file), "-o", str(out / file.stem)]
    for stop in (["--passes", "1"], ["--seconds", str(seconds)]):
        subprocess.run([*run, *stop], check=True, capture_output=True)
    return json.loads((out / file.stem / "run.json").read_text())["errors"]["estimated_lab_mean"]


def main():
    arguments = sys.argv[1:]
    if len(arguments) < 2:
        sys.exit(__doc__)
    program, out, rows = arguments[0], Path(arguments[1]), arguments[2:]
    seconds = 12
    if rows[:1] == ["--seconds"]:
        seconds, rows = float(rows[1]), rows[2:]
    if not set(rows) <= set(ROWS):
        sys.exit(f"rows: {', '.join(ROWS)}")
    out.mkdir(parents=True, exist_ok=True)
    first = None
    print("| material | error | times as long |\n|---|---|---|")
    for name in rows or ROWS:
        error = measure(program, out, name, seconds)
        first = first or error
        print(f"| {name} | {error:.2f} | {(error / first) ** 2:.1f} |", flush=True)


if __name__ == "__main__":
    main()
