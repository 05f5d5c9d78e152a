#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures what engine 2's caustics do from frame to frame against engine 1, and prints the tables of
docs/notebook/environment.md.

    tests/experiments/environment_films.py PROGRAM OUT [turning] [card]

turning: the sky turns about a glass bunny, 120 frames; 12 pairs of neighbouring frames are compared. All frames are
rendered of `ours` alone. OUT/turning-sheet.png: every fifth of them. card: a card passes between the sun and a ball, 24
frames, all compared. OUT/card-sheet.png: caustics of ours over the reference's. Frames that are in OUT are not made
again. Needs numpy and ImageMagick.
"""
import argparse
import json
from itertools import groupby

import numpy as np
from environment import ONE, PRESETS, SEEDS, TRUTH, Bench, head, name_of, row
from layers import read_layer, read_mask, side_by_side, write_png

THESIS = {**ONE, "environment.segmentation": "thesis"}
WAYS = {"as in the thesis": THESIS, "as in the thesis, 98 directions": {**THESIS, "environment.directions": 98},
        "variance, spheres alone": ONE,
        "ours": {}, "ours, 98 directions": {"environment.directions": 98}}
OURS = "ours"
PAIRS = range(0, 120, 10)


def rms(picture):
    return float(np.sqrt(np.mean(np.square(picture))))


class Film:
    """The caustic layer of some frames, pixels of receivers only."""

    def __init__(self, bench, preset, name, settings, frames, passes):
        self.folder = bench.out / name
        missing = [k for k in frames if not self.path(k).exists()]
        for _, near in groupby(enumerate(missing), lambda pair: pair[1] - pair[0]):
            block = [k for _, k in near]
            words = {"scene.camera.resolution": [bench.size, bench.size], "stop.passes": passes, **settings}
            bench.call("run", PRESETS / f"{preset}.json", "-o", self.folder, "--frames", f"{block[0]}-{block[-1]}",
                       *(w for key, value in words.items() for w in ("--set", f"{key}={json.dumps(value)}")))
        mask = read_mask(bench.mask(preset, self.folder))
        self.pixels = {k: read_layer(self.path(k), "caustic")[mask] for k in frames}

    def path(self, frame):
        return self.folder / f"frame_{frame:04}.exr"

    def changes(self, frames):
        """From each of the frames to its next."""
        return [self.pixels[k + 1] - self.pixels[k] for k in frames]

    def light(self):
        """The mean over pixels and colours, of each frame."""
        return np.array([pixels.mean() for pixels in self.pixels.values()])


def reference(bench, preset, seed, frames, passes):
    return Film(bench, preset, f"{preset}-reference-{seed}", {**TRUTH, "seed": seed}, frames, passes)


def noise_of(first, second):
    """The mean square that noise adds to a pixel of one frame."""
    common = sorted(set(first.pixels) & set(second.pixels))
    return float(np.mean([np.mean((first.pixels[k] - second.pixels[k]) ** 2) / 2 for k in common]))


def size(change, noise):
    """Root mean square without that of noise."""
    return float(np.sqrt(max(0, rms(change) ** 2 - noise)))


def both(pairs):
    return [k for pair in pairs for k in (pair, pair + 1)]


def quadratic(values):
    return float(np.sqrt(np.mean(np.square(values))))


def turning(bench, passes, reference_passes):
    truth = reference(bench, "turning-sky", SEEDS[0], both(PAIRS), reference_passes)
    noise = noise_of(truth, reference(bench, "turning-sky", SEEDS[1], (0, 1), reference_passes))
    level = quadratic([rms(pixels) for pixels in truth.pixels.values()])
    print(f"\nturning: {bench.size} x {bench.size}, {passes} passes. Noise of the reference: "
          f"{np.sqrt(noise) / level:.2g} of its root mean square.")
    head("change of the caustic layer in 3 degrees, parts of the reference's",
         ["change", "largest", "change that is wrong", "light, mean", "light, spread"])
    for label, settings in WAYS.items():
        film = Film(bench, "turning-sky", name_of(f"turning-{bench.size}", settings), settings, both(PAIRS), passes)
        own, made = truth.changes(PAIRS), film.changes(PAIRS)
        whole = quadratic([size(change, 2 * noise) for change in own])
        light = film.light() / truth.light()
        row(label, [quadratic([rms(change) for change in made]) / whole,
                    max(map(rms, made)) / max(size(change, 2 * noise) for change in own),
                    quadratic([size(ours - theirs, 2 * noise) for ours, theirs in zip(made, own)]) / whole,
                    light.mean(), light.std()])
    film = Film(bench, "turning-sky", f"turning-{bench.size}", WAYS[OURS], range(120), passes)
    steps = [rms(change) / level for change in film.changes(range(119))]
    print(f"\nours, all 119 steps, parts of the reference's root mean square: median {np.median(steps):.3g}, largest "
          f"{max(steps):.3g}, "
          f"smallest {min(steps):.3g}; the largest ratio of neighbouring steps "
          f"{max(max(a / b, b / a) for a, b in zip(steps, steps[1:])):.3g}")
    side_by_side([film.path(k).with_suffix(".png") for k in range(0, 120, 5)], 8, bench.size,
                 bench.out / "turning-sheet.png")


def card(bench, passes, reference_passes):
    frames = range(24)
    truth = reference(bench, "passing-card", SEEDS[0], frames, reference_passes)
    noise = noise_of(truth, reference(bench, "passing-card", SEEDS[1], range(7, 10), reference_passes))
    films = {"reference": truth}
    for way in ("as in the thesis", OURS):
        films[way] = Film(bench, "passing-card", name_of(f"card-{bench.size}", WAYS[way]), WAYS[way], frames, passes)
    print(f"\ncard: {bench.size} x {bench.size}, {passes} passes. Noise of the reference: "
          f"{np.sqrt(noise) / rms(truth.pixels[0]):.2g} of its "
          "root mean square in frame 0.")
    head("light on receivers, parts of the reference's in frame 0", [str(k) for k in frames])
    for label, film in films.items():
        row(label, film.light() / truth.light()[0])
    head("change to the next frame, parts of the reference's root mean square in frame 0",
         [str(k) for k in frames[:-1]])
    for label, film in films.items():
        row(label, [size(change, 2 * noise if film is truth else 0) / rms(truth.pixels[0])
                    for change in film.changes(frames[:-1])])
    receivers = read_mask(bench.mask("passing-card", truth.folder))[..., None]
    for part, film in (("reference", truth), ("ours", films[OURS])):
        for k in frames:
            write_png(bench.out / f"card-{part}-{k}.png",
                      read_layer(film.path(k), "caustic") * receivers / np.percentile(truth.pixels[0], 99.5))
    side_by_side([bench.out / f"card-{part}-{k}.png" for part in ("ours", "reference") for k in range(2, 22, 2)], 10,
                 96, bench.out / "card-sheet.png")


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("out")
    arguments.add_argument("films", nargs="*", default=["turning", "card"], metavar="FILM")
    arguments.add_argument("--size", type=int, default=128)
    arguments.add_argument("--passes", type=int, default=4)
    arguments.add_argument("--reference-passes", type=int, default=5)
    chosen = arguments.parse_args()
    bench = Bench(chosen.program, chosen.out, chosen.size, chosen.passes, 0)
    for film in chosen.films:
        {"turning": turning, "card": card}[film](bench, chosen.passes, chosen.reference_passes)


main()
