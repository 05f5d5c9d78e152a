#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares exported scenes in Blender with our own pictures of them.

    tests/experiments/blender.py PROGRAM OUT [PRESET...]

Asks for Blender, ImageMagick and numpy (Debian's packages blender, imagemagick, python3-numpy). For each preset OUT has
both pictures side by side, ours on the left. The table has quartiles of the light in Blender over ours, of blocks of 8
x 8 pixels that are not nearly black.
"""
import json
import subprocess
import sys
from pathlib import Path

import numpy as np

from layers import read_layer

PRESETS = ["first-light", "spectral/ball-lens", "spectral/evening-sun", "spectral/glass-in-a-room", "environment/ball"]
SECONDS = "20"  # of our picture, and of each caustic
EDGE = 8


def blocks(path):
    """Means of luminance."""
    light = read_layer(path, "") @ [.2126, .7152, .0722]
    height, width = (n // EDGE for n in light.shape)
    return light[:height * EDGE, :width * EDGE].reshape(height, EDGE, width, EDGE).mean((1, 3))


def compare(program, out, preset):
    folder = out / preset.replace("/", "-")
    ours, export = folder / "run", folder / "export"
    quiet = {"check": True, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    subprocess.run([program, "run", preset, "-o", ours, "--seconds", SECONDS, "--set", "engine=spectral",
                    *(["--set", "scene.environment.lights=true"] if preset.startswith("environment/") else [])],
                   **quiet)
    subprocess.run([program, "export", preset, "-o", export, "--seconds", SECONDS], **quiet)
    for kind in ("OPEN_EXR", "PNG"):
        subprocess.run(["blender", "-b", "--python", export / "blender.py", "-o", folder / "blender_", "-F", kind, "-f",
                        "1"], **quiet)
    subprocess.run(["convert", ours / "image.png", folder / "blender_0001.png", "+append", folder / "both.png"],
                   check=True)
    white = json.loads((export / "caustics.json").read_text())["white"]
    a, b = blocks(ours / "image.exr"), blocks(folder / "blender_0001.exr") / white
    seen = a > .02
    low, middle, high = np.percentile(b[seen] / a[seen], [25, 50, 75])
    print(f"| {preset} | {seen.sum()} | {low:.3f} | {middle:.3f} | {high:.3f} |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 3 or not Path(sys.argv[1]).is_file():
        sys.exit("usage: blender.py PROGRAM OUT [PRESET...], PROGRAM being the program, as build/release/bin/nephroid")
    print("| preset | blocks | a quarter is below | a half | three quarters |\n| --- | ---: | ---: | ---: | ---: |")
    for name in sys.argv[3:] or PRESETS:
        compare(sys.argv[1], Path(sys.argv[2]).absolute(), name)
