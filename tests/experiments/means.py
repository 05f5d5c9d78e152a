#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests whether presets are right in the mean: as they come against brute force over wavelengths by points.

    tests/experiments/means.py PROGRAM OUT [--passes P] [--seeds N] [PRESET...]

It asks for numpy and scipy. Each side has N runs (6) of P passes (8) at 96 x 72 pixels, none of them smoothed, with
seeds of their own; a run whose folder is there is not repeated. Prints for each preset: the light of the one over that
of the other, with its deviation; how many blocks of 8 x 8 pixels differ by more than four deviations, and in how many
of them noise alone would, by Student's distribution with N - 1 degrees of freedom, the fewest there may be; and what
differs beyond noise, as the root mean square over that of the light.
"""
import argparse
import subprocess
import sys
from pathlib import Path

import numpy as np
from scipy import stats
from layers import read_layer

PRESETS = ["first-light", "spectral/F8BT", "spectral/F8BT-absorption", "spectral/ball-lens", "spectral/brilliant",
           "spectral/coatings", "spectral/evening-sun", "spectral/frosted-bottle", "spectral/glass-in-a-room",
           "spectral/gold-and-copper", "spectral/grazing-rainbow", "spectral/lamps", "spectral/on-wood",
           "spectral/plate", "spectral/prism", "spectral/rhodamine-6G", "spectral/rhodamine-6G-absorption",
           "spectral/staircase", "spectral/sun-in-antwerp", "spectral/three-lamps", "spectral/wine-glass",
           "spectral/thesis/newton", "spectral/thesis/cylinders", "spectral/thesis/diamond-arbitrary-1"]
BRUTE_FORCE = ["spectral.method=brute_force", "spectral.estimator=points"]


def blocks_of(picture, edge=8):
    height, width = (size // edge * edge for size in picture.shape[:2])
    return picture[:height, :width].reshape(height // edge, edge, width // edge, edge, 3).mean(axis=(1, 3))


def runs(asked, preset, folder, settings, seeds):
    pictures = []
    for seed in seeds:
        out = folder / f"seed-{seed}"
        if not (out / "run.json").exists():
            words = [word for setting in ("scene.camera.resolution=[96,72]", "spectral.smoothing=off", *settings)
                     for word in ("--set", setting)]
            run = subprocess.run([asked.program, "run", preset, "-o", str(out), "--passes", str(asked.passes), "--seed",
                                  str(seed), *words], capture_output=True, text=True)
            if run.returncode != 0:
                sys.exit(run.stderr)
        pictures.append(blocks_of(read_layer(out / "image.exr", "").astype(float)))
    return np.array(pictures)


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("program")
    parser.add_argument("out", type=Path)
    parser.add_argument("presets", nargs="*", default=PRESETS)
    parser.add_argument("--passes", type=int, default=8)
    parser.add_argument("--seeds", type=int, default=6)
    asked = parser.parse_intermixed_args()
    n = asked.seeds
    if n < 2:
        parser.error("--seeds has to be 2 or more, as noise is told by how seeds differ")
    print("| preset | light | blocks off by 4 deviations, by noise | beyond noise |\n|---|---|---|---|")
    for preset in asked.presets:
        folder = asked.out / preset.replace("/", "-")
        ours = runs(asked, preset, folder / "ours", [], range(1, n + 1))
        truth = runs(asked, preset, folder / "truth", BRUTE_FORCE, range(101, n + 101))
        variance = (ours.var(axis=0, ddof=1) + truth.var(axis=0, ddof=1)) / n
        difference = ours.mean(axis=0) - truth.mean(axis=0)
        lit = (truth.mean(axis=0) > 0.01 * truth.mean()) & (variance > 0)
        t = difference[lit] / np.sqrt(variance[lit])
        light = ours.mean(axis=(1, 2, 3)), truth.mean(axis=(1, 2, 3))
        ratio = light[0].mean() / light[1].mean()
        deviation = np.hypot(*(of.std(ddof=1) / of.mean() for of in light)) / np.sqrt(n)
        beyond = np.sqrt(max((difference**2 - variance).mean(), 0) / (truth.mean(axis=0)**2).mean())
        chance = 2 * stats.t.sf(4, n - 1) * t.size
        print(f"| {preset} | {ratio:.4f} +- {deviation:.4f} | {np.sum(np.abs(t) > 4)} of {t.size}, {chance:.0f} | "
              f"{beyond:.4f} |", flush=True)


if __name__ == "__main__":
    sys.exit(main())
