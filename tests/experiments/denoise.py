#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares smoothing with Open Image Denoise on ten presets, or on those named, at equal time.

    tests/experiments/denoise.py PROGRAM OUT [--seconds S] [--reference S] [PRESET...]

It asks for numpy, ImageMagick, and pyoidn of PyPI. Each scene is run for S seconds (10) as it comes, and without
smoothing; the second picture goes to Open Image Denoise, which gets no albedo and no normals. The reference is a run of
another seed without smoothing, of so many seconds (120). OUT/SCENE.png has, from the left: without smoothing, smoothed,
by Open Image Denoise, reference. Prints a table: mean CIELAB distance, rel_l2 and FLIP against the reference.
"""
import argparse
import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pyoidn
from layers import read_layer, side_by_side, write_pfm, write_png

SCENES = ["first-light", "spectral/on-wood", "spectral/glass-in-a-room", "spectral/wine-glass", "spectral/coatings",
          "spectral/gold-and-copper", "spectral/frosted-bottle", "spectral/evening-sun", "spectral/thesis/bunny",
          "spectral/brilliant"]
METRICS = ["lab_mean", "rel_l2", "flip"]


def run(program, preset, folder, seconds, *settings):
    """Runs a preset at 320 x 200; the folder of a run that is there is kept."""
    if not (folder / "run.json").exists():
        words = [word for setting in ("scene.camera.resolution=[320,200]", *settings) for word in ("--set", setting)]
        subprocess.run([program, "run", preset, "-o", str(folder), "--seconds", str(seconds), *words], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return folder / "image.exr"


def errors(program, picture, reference):
    done = subprocess.run([program, "compare", str(picture), str(reference), "--json"], check=True,
                          capture_output=True, text=True)
    found = json.loads(done.stdout)
    return [found[name] for name in METRICS]


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("program")
    parser.add_argument("out", type=Path)
    parser.add_argument("presets", nargs="*", default=SCENES)
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--reference", type=float, default=120)
    asked = parser.parse_intermixed_args()
    asked.out.mkdir(parents=True, exist_ok=True)
    print("| scene | without smoothing | smoothed | Open Image Denoise | its seconds |\n|---|---|---|---|---|")
    for preset in asked.presets:
        name = preset.split("/")[-1]
        folder = asked.out / name
        reference = run(asked.program, preset, folder / "reference", asked.reference, "spectral.smoothing=off",
                        "seed=2")
        plain = run(asked.program, preset, folder / "plain", asked.seconds, "spectral.smoothing=off")
        smoothed = run(asked.program, preset, folder / "smoothed", asked.seconds)
        noisy = read_layer(plain, "").astype(np.float32)
        pyoidn.denoise(noisy, hdr=True)  # the first call loads its weights
        begin = time.perf_counter()
        denoised = pyoidn.denoise(noisy, hdr=True)
        took = time.perf_counter() - begin
        by_library = folder / "denoised.pfm"
        write_pfm(by_library, np.asarray(denoised))
        row = [", ".join(f"{value:.3g}" for value in errors(asked.program, picture, reference))
               for picture in (plain, smoothed, by_library)]
        pictures = [noisy, read_layer(smoothed, ""), denoised, read_layer(reference, "")]
        for number, picture in enumerate(pictures):
            write_png(folder / f"{number}.png", picture)
        side_by_side([folder / f"{number}.png" for number in range(len(pictures))], len(pictures), 320,
                     asked.out / f"{name}.png")
        print(f"| {name} | {' | '.join(row)} | {took:.2f} |", flush=True)


if __name__ == "__main__":
    sys.exit(main())
