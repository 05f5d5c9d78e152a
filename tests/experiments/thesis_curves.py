#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the thesis' plots again: figures 4.4, 4.8 and 5.20 beside each other (docs/thesis-curves.png).

    tests/experiments/thesis_curves.py PROGRAM PICTURE [OUT]

OUT: the folder of `inverse.py PROGRAM OUT stages`, which has the costs of figure 5.20. Without it that one is left out.
Needs ImageMagick.
"""
import csv
import json
import subprocess
import sys
from math import radians, sin, sqrt
from pathlib import Path

from inverse import PIPELINED, STAGES

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 440, 330, 52, 12, 34, 44
COLOURS = ["#1f5fbf", "#c8442b", "#2c8a4b", "#8b4fae", "#b8860b", "#444444"]
WAVELENGTHS = range(380, 781)
SCENES = ["bunny", "bunny-arbitrary-2", "diamond-arbitrary-1"]


def output_of(*command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


def bending(program):
    """(4.3): by how many degrees a nanometre turns the refracted ray, of N-SF66, for four angles of incidence."""
    material = Path(__file__).resolve().parents[2] / "presets" / "materials" / "N-SF66.yml"
    at = [word for l in range(379, 782) for word in ("--nm", l)]
    n = [sample["n"] for sample in json.loads(output_of(program, "dispersion", material, *at, "--json"))["samples"]]
    curves = {}
    for angle in (89, 60, 30, 10):
        s = sin(radians(angle))
        # d asin(s / n) / dl = s |n'| / (n sqrt(n^2 - s^2)), n' by central differences
        curves[f"{angle} degrees"] = [(l, s * abs(n[i + 2] - n[i]) / 2 / (n[i + 1] * sqrt(n[i + 1] ** 2 - s * s))
                                       / radians(1)) for i, l in enumerate(WAVELENGTHS)]
    return "4.4: degrees a nanometre, N-SF66", "wavelength, nm", curves


def importance(program):
    """u of (4.15) in the three scenes of figure 4.13, and the fixed one."""
    def of(scene, *options):
        done = json.loads(output_of(program, "importance", f"spectral/thesis/figure-4-13-{scene}", "--set",
                                    "sweep=null", *options, "--json"))
        return list(zip(done["wavelengths_nm"], done["importance"]))
    curves = {"Radziszewski et al.": of("bunny", "--set", "spectral.effort=radziszewski")}
    return "4.8: importance u", "wavelength, nm", curves | {scene: of(scene) for scene in SCENES}


def history(out):
    """The lowest cost so far of the thesis' pipeline, of its own kind; its stages end at 1, 101 and 201 trials."""
    curves = {}
    for name in PIPELINED:
        with (out / f"{name}-convergence-{max(STAGES)}" / "annealing.csv").open() as file:
            curves[name] = [(float(row["trial"]), float(row["lowest"])) for row in csv.DictReader(file)]
    return "5.20: own cost of the thesis' pipeline", "trial", curves


def panel(at, title, below, curves):
    """SVG of one plot. Its y axis begins at 0."""
    points = [point for curve in curves.values() for point in curve]
    low, high = min(x for x, _ in points), max(x for x, _ in points)
    top = 1.05 * max(y for _, y in points)

    def place(x, y):
        return (at + LEFT + (x - low) / (high - low) * (WIDTH - LEFT - RIGHT),
                HEIGHT - BOTTOM - y / top * (HEIGHT - TOP - BOTTOM))

    def text(x, y, words, anchor="middle", colour="#222222"):
        look = f'font-size="13" text-anchor="{anchor}" stroke="none" fill="{colour}"'
        return f'<text x="{x:.1f}" y="{y:.1f}" {look}>{words}</text>'
    left, right, zero = place(low, 0)[0], place(high, 0)[0], place(low, 0)[1]
    parts = [f'<rect x="{left}" y="{TOP}" width="{right - left}" height="{zero - TOP}" fill="none" stroke="#999999"/>',
             text((left + right) / 2, TOP - 12, title), text((left + right) / 2, HEIGHT - 8, below)]
    tick = next(t for t in (0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5) if top / t <= 6)
    for k in range(int(top / tick) + 1):
        y = place(low, k * tick)[1]
        parts += [text(left - 5, y + 4, f"{k * tick:g}", "end"),
                  f'<line x1="{left}" y1="{y:.1f}" x2="{right}" y2="{y:.1f}" stroke="#e4e4e4"/>']
    for x in range(-(-int(low) // 100) * 100, int(high) + 1, 100):
        parts.append(text(place(x, 0)[0], zero + 17, x))
    for k, (name, curve) in enumerate(curves.items()):
        line = " ".join("{:.1f},{:.1f}".format(*place(x, y)) for x, y in curve)
        parts += [f'<polyline points="{line}" fill="none" stroke="{COLOURS[k]}" stroke-width="1.6"/>',
                  text(right - 8, TOP + 17 + 16 * k, name, "end", COLOURS[k])]
    return "\n".join(parts)


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit("usage: thesis_curves.py PROGRAM PICTURE [OUT]")
    program, picture = sys.argv[1], Path(sys.argv[2])
    plots = [bending(program), importance(program)]
    if len(sys.argv) == 4:
        plots.append(history(Path(sys.argv[3])))
    width = WIDTH * len(plots)
    drawn = "\n".join(panel(k * WIDTH, *plot) for k, plot in enumerate(plots))
    svg = picture.with_suffix(".svg")
    svg.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{HEIGHT}">\n'
                   f'<rect width="{width}" height="{HEIGHT}" fill="#ffffff"/>\n{drawn}\n</svg>\n', encoding="utf-8")
    subprocess.run(["convert", str(svg), "-strip", "-colors", "64", str(picture)], check=True)
    svg.unlink()


if __name__ == "__main__":
    main()
