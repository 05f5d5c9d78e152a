#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What waves do to facets, and what `nephroid judge` says of finished objects: the tables of docs/notebook/finished.md.

    tests/experiments/finished.py PROGRAM waves|meshes [--out FOLDER]

waves: sets of 128 and 512 facets a side with pictures at 150 and 250 mm, designed and judged with and without
diffraction. meshes: five runs, judged with another index, tilted, through focus, and as scans of their thickness with
noise of 2 and 10 micrometres. Needs numpy, pillow and OpenImageIO's oiiotool.
"""
import argparse
import json
import subprocess
import tempfile
from pathlib import Path

import numpy
from PIL import Image


def nephroid(program, *words):
    return subprocess.run([program, *map(str, words)], check=True, capture_output=True, text=True).stdout


def judged(program, *words):
    return json.loads(nephroid(program, "judge", *words, "--json"))["receivers"]


def rel_l2(receivers):
    return " | ".join(f"{r['judged']['rel_l2']:.3f}" for r in receivers)


def waves(program, out):
    print("| object, mm | facets | spread, cells | rays alone | the same, waves judged | designed with waves |")
    print("|---|---|---|---|---|---|")
    for size, facets in ((100, 128), (100, 512), (25, 128), (25, 512)):
        preset = {"engine": "inverse", "unit": "mm", "scene": {"camera": {}}, "inverse": {
            "size_mm": [size, size], "facets": [facets, facets], "receivers": [
                {"distance_mm": 150, "picture": {"type": "ring"}}, {"distance_mm": 250, "picture": {"type": "cross"}}]}}
        file = out / "waves.json"
        file.write_text(json.dumps(preset))
        runs = {}
        for diffraction in ("false", "true"):
            runs[diffraction] = out / f"waves-{size}-{facets}-{diffraction}"
            nephroid(program, "run", file, "-o", runs[diffraction], "--set", f"inverse.diffraction={diffraction}")
        figures = json.loads((runs["true"] / "run.json").read_text())["inverse"]["receivers"]
        figures = figures.values() if isinstance(figures, dict) else figures
        spread = " and ".join(f"{r['diffraction_cells']:.2f}" for r in figures)
        rays = rel_l2(judged(program, runs["false"], "--focus", 0)).replace(" | ", ", ")
        same = rel_l2(judged(program, runs["false"], "--focus", 0, "--set", "inverse.diffraction=true"))
        known = rel_l2(judged(program, runs["true"], "--focus", 0))
        print(f"| {size} | {facets} x {facets} | {spread} | {rays} | {same.replace(' | ', ', ')} | "
              f"{known.replace(' | ', ', ')} |", flush=True)


def read_map(file):
    with tempfile.TemporaryDirectory() as temporary:
        copy = Path(temporary) / "heights.tif"
        subprocess.run(["oiiotool", file, "-d", "float", "-o", copy], check=True)
        return numpy.asarray(Image.open(copy))


def noise(shape, rms, correlated, random):
    """Heights of this root mean square, filtered by a Gaussian of so many pixels."""
    white = random.standard_normal(shape)
    y, x = (numpy.fft.fftfreq(n) for n in shape)
    gauss = numpy.exp(-2 * (numpy.pi * correlated) ** 2 * (y[:, None] ** 2 + x[None, :] ** 2))
    waves = numpy.fft.ifft2(numpy.fft.fft2(white) * gauss).real
    return waves * rms / waves.std()


def meshes(program, out):
    random = numpy.random.default_rng(1)
    for name in ("shapes", "qr", "words", "mirror", "lens"):
        run = out / name
        nephroid(program, "run", f"inverse/{name}", "-o", run)
        mirror = name == "mirror"
        n = json.loads((run / "run.json").read_text())["object"]["index"]
        tilt = json.loads((run / "preset.json").read_text())["inverse"].get("light", {}).get("tilt_deg", 0)
        print(f"\n## {name}\n\n| judged | rel_l2 of each picture |\n|---|---|")

        def row(what, *words):
            print(f"| {what} | {rel_l2(judged(program, *words, '--focus', 0))} |", flush=True)

        row("as designed", run)
        for off in () if mirror else (-0.02, -0.01, 0.01, 0.02):
            row(f"n {off:+}", run, "--set", f"inverse.index={n + off}")
        for off in (1, 3):
            row(f"light tilted by {off} degrees more", run, "--set", f"inverse.light.tilt_deg={tilt + off}")
        heights = read_map(run / "heights.exr")
        size = json.loads((run / "preset.json").read_text())["inverse"].get("size_mm", [100, 100])
        pixel = size[0] / heights.shape[1]
        for rms in (0, 2, 10):
            scan = out / f"{name}-{rms}.tif"
            Image.fromarray((heights + noise(heights.shape, 1e-3 * rms, 1 / pixel, random)).astype("f4")).save(scan)
            said = judged(program, scan, "--design", run, "--focus", 0)
            off = ", ".join(f"{100 * r['surface']['part_off']:.0f} %" for r in said)
            print(f"| a scan with noise of {rms} um | {rel_l2(said)}; a cell off: {off} |", flush=True)
        print(nephroid(program, "judge", run, "-o", out / f"{name}-judge"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("what", choices=("waves", "meshes"))
    parser.add_argument("--out", type=Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        out = options.out or Path(temporary)
        out.mkdir(parents=True, exist_ok=True)
        {"waves": waves, "meshes": meshes}[options.what](options.program, out)


if __name__ == "__main__":
    main()
