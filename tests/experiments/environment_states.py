#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures engine 2 on shapes that deform, between baked shapes, and prints the table of docs/notebook/environment.md.

    tests/experiments/environment_states.py PROGRAM OUT [--shapes NAME...] [--weights W...] [--size N]
    [--reference-seconds S]

The caustic layer where the camera sees a receiver, spheres alone, against engine 1 with the same shape: a bake of its
own at each weight, and spheres mixed between shapes baked at 2, 3, 5 and 9 weights from 0 to 1; how far these are
from its own bake, and how far that is from one of another seed. OUT/SHAPE.png shows the layers, a weight a row. Then
whole pictures of both ways, spheres with photons, some seconds after the shape is new. Errors are means over the
weights. Bakes are kept in OUT/cache, and what is in OUT is not made again. Needs numpy and ImageMagick.
"""
import argparse
import json
import os
import shutil
from pathlib import Path

import numpy as np
from animation import jelly, torus
from environment import METRICS, ONE, SEEDS, Bench, head, row
from layers import read_layer, side_by_side, write_png

GLASS = {"type": "dielectric", "dispersion": 1.5}
# What makes the shape, which of its states it goes to, and where it stands.
SHAPES = {"torus": (torus, 1, {"translate": [0, .85, 0], "scale": [.9, .9, .9]}),
          "jelly": (jelly, 1, {"translate": [0, 1, 0], "scale": [1, 1, 1]})}
STEPS = (1, 2, 4, 8)
ERRORS = ("lab_mean", "rel_l2")
SECONDS = (1, 4)
WHITE = 1  # what of the caustic layer is shown white


class Deformed(Bench):
    """Of the preset `ring`, with a shape of glass in the ring's place, at a weight of its state."""

    def __init__(self, options, shape, weight):
        super().__init__(options.program, Path(options.out) / shape / f"{weight:g}", options.size, 8,
                         options.reference_seconds)
        make, state, transform = SHAPES[shape]
        made = make(self.out.resolve())
        self.shape = {"scene.objects.0.mesh": made["scene.objects.0.mesh"], "scene.objects.0.transform": transform,
                      "scene.objects.0.states": [{**made["scene.objects.0.states"][state], "weight": weight}],
                      "scene.materials.gold": GLASS, "scene.camera.fov_deg": 50}

    def run(self, preset, name, settings, *words):
        return super().run(preset, name, {**self.shape, **settings}, *words)

    def errors(self, run, truth, mask):
        found = dict(zip(METRICS, super().errors(run, truth, mask)))
        return [found[metric] for metric in ERRORS]


def caustics_of(run):
    """A picture of the caustic layer; its file."""
    picture = run / "caustics.png"
    write_png(picture, read_layer(run / "image.exr", "caustic") / WHITE)
    return picture


def seconds_of(run):
    return json.loads((run / "run.json").read_text())["phase_seconds"]["bake"]


def mixed(bench, steps, settings, name, *words):
    return bench.run("ring", f"{name}-{steps}", {"environment.weight_steps": steps, **settings}, *words)


def measure(options, shape):
    ways = {0: "a bake of its own", **{steps: f"{steps + 1} shapes" for steps in STEPS}}
    errors, baking, pictures = {}, {}, []
    for weight in options.weights:
        bench = Deformed(options, shape, weight)
        truth, other = (bench.reference("ring", seed) for seed in SEEDS)
        mask = bench.mask("ring", truth)
        pictures.append(caustics_of(truth))
        errors.setdefault("another reference", []).append(
            [*bench.errors(other, truth, mask), np.nan])
        own = mixed(bench, 0, {**ONE, "stop.passes": 8}, "spheres")
        other = mixed(bench, 0, {**ONE, "stop.passes": 8, "seed": 2}, "spheres-of-another-seed")
        errors.setdefault("a bake of another seed", []).append(
            [*bench.errors(other, truth, mask), bench.errors(other, own, mask)[-1]])
        for steps, label in ways.items():
            run = mixed(bench, steps, {**ONE, "stop.passes": 8}, "spheres")
            errors.setdefault(label, []).append(
                [*bench.errors(run, truth, mask), bench.errors(run, own, mask)[-1]])
            baking.setdefault(label, []).append(seconds_of(run))
            pictures.append(caustics_of(run))
    head(f"{shape}: spheres alone, {bench.size} x {bench.size}, weights {options.weights}",
         [*ERRORS, "rel_l2 from its own bake", "seconds of baking, by weight"])
    for label, values in errors.items():
        print(f"| {label} | " + " | ".join(f"{v:.3g}" for v in np.mean(values, axis=0)) + " | " +
              ", ".join(f"{s:.1f}" for s in baking.get(label, [])) + " |", flush=True)
    side_by_side(pictures, 1 + len(ways), bench.size, Path(options.out) / f"{shape}.png")

    head(f"{shape}: whole pictures some seconds after the shape is new", ["seconds", *ERRORS])
    for seconds in SECONDS:
        for steps, label in ((0, "a bake of its own, which is not there"), (4, "5 shapes, which are")):
            values = []
            for weight in options.weights:
                bench = Deformed(options, shape, weight)
                truth = bench.reference("ring", SEEDS[0])
                bakes = Path(options.out) / "cache/nephroid/bakes"
                aside = bakes.with_name("aside")
                if steps == 0:
                    bakes.rename(aside)
                try:
                    run = mixed(bench, steps, {}, f"whole-{seconds}", "--seconds", seconds)
                finally:
                    if steps == 0:
                        shutil.rmtree(bakes, ignore_errors=True)
                        aside.rename(bakes)
                values.append(bench.errors(run, truth, bench.mask("ring", truth)))
            row(label, [seconds, *np.mean(values, axis=0)])


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("out")
    arguments.add_argument("--shapes", nargs="+", default=list(SHAPES))
    arguments.add_argument("--weights", nargs="+", type=float, default=[.1875, .4375, .6875])
    arguments.add_argument("--size", type=int, default=128)
    arguments.add_argument("--reference-seconds", type=int, default=60)
    options = arguments.parse_args()
    os.environ["XDG_CACHE_HOME"] = str(Path(options.out).resolve() / "cache")
    for shape in options.shapes:
        measure(options, shape)


if __name__ == "__main__":
    main()
