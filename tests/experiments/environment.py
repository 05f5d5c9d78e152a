#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures engine 2 against engine 1 and prints the tables of docs/notebook/environment.md: the caustic layer where the
camera sees a receiver, as the thesis compares.

    tests/experiments/environment.py PROGRAM OUT [--presets NAME...] [--sky MAP] [--size N] [--reference-seconds S]
    [TABLE...]

Tables: scenes (five scenes with their references; pictures OUT/NAME-sheet.png), and of the preset bunny: lights (3.1:
how many, by which segmentation), spheres (3.2: how many, with which radii), histogram (figure 3.16), directions,
refining; converging (error against time of all scenes, where kernels have been compiled before and the machine has
nothing else to do), estimate (a run's own estimate against its error). Engine 1 traces photons from every texel of the
same environment through the same objects: no spheres, no segments. Two of its runs with different seeds tell the noise
floor. What is in OUT is not made again. Needs numpy and ImageMagick.
"""
import argparse
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
from layers import lab, read_layer, read_mask, side_by_side, write_pfm, write_png

METRICS = ["lab_mean", "lab_max", "rel_l2", "iw_ssim"]
SCENES = ["ball", "bunny", "glass", "ring", "brilliant"]
TRUTH = {"engine": "spectral", "scene.environment.lights": True, "spectral.smoothing": "off", "spectral.direct": False,
         "spectral.estimator": "splat"}
SEEDS = (101, 102)
PRESETS = Path(__file__).resolve().parents[2] / "presets/environment"


class Bench:
    def __init__(self, program, out, size, passes, seconds, sky=None):
        self.program, self.out, self.size, self.passes = program, Path(out), size, passes
        self.seconds, self.sky = seconds, sky
        self.out.mkdir(parents=True, exist_ok=True)

    def call(self, *words):
        done = subprocess.run([self.program, *map(str, words)], capture_output=True, text=True)
        if done.returncode:
            sys.exit(done.stderr.splitlines()[-1])
        return done.stdout

    def run(self, preset, name, settings, *words):
        """The run's folder. words: more of the command line."""
        folder = self.out / name
        if not (folder / "image.exr").exists():
            settings = {"scene.camera.resolution": [self.size, self.size], **settings}
            if preset == "torus":
                preset, settings = "ring", {"scene.materials.gold": {"type": "dielectric", "dispersion": 1.5},
                                            "scene.environment.file": self.sky, **settings}
            sets = [word for key, value in settings.items() for word in ("--set", f"{key}={json.dumps(value)}")]
            self.call("run", PRESETS / f"{preset}.json", "-o", folder, *words, *sets)
        return folder

    def ours(self, preset, settings):
        return self.run(preset, name_of(f"{preset}-{self.size}", settings), {"stop.passes": self.passes, **settings})

    def reference(self, preset, seed):
        return self.run(preset, f"{preset}-reference-{seed}", {**TRUTH, "seed": seed}, "--seconds", self.seconds)

    def mask(self, preset, like):
        """White where the camera sees a receiver: not glass, not a mirror, not the sky. like: the folder of a run of
        the preset."""
        target = self.out / f"{preset}-{self.size}-receivers.png"
        if not target.exists():
            scene = json.loads((like / "preset.json").read_text())["scene"]
            black = {f"scene.materials.{name}": {"type": "diffuse", "reflectance": 0} for name,
                     m in scene["materials"].items() if m["type"] != "diffuse"}
            even = {"scene.environment": {"type": "constant", "colour": [1, 1, 1], "lights": True},
                    "engine": "spectral", "stop.passes": 16, "animation": None}
            lit = read_layer(self.run(preset, f"{preset}-{self.size}-even", {**even, **black}) / "image.exr",
                             "direct").sum(axis=-1)
            most = np.pad(lit > 0, 1, mode="edge")
            inside = np.all([most[1 + y:most.shape[0] - 1 + y, 1 + x:most.shape[1] - 1 + x] for y in (-1, 0, 1)
                             for x in (-1, 0, 1)], axis=0)
            write_png(target, np.repeat(inside[..., None], 3, axis=-1))
        return target

    def errors(self, run, truth, mask):
        """METRICS over receivers. IW-SSIM's windows are wide: it gets pictures that are black elsewhere."""
        receivers, files = read_mask(mask)[..., None], [self.out / "ours.pfm", self.out / "reference.pfm"]
        for file, folder in zip(files, (run, truth)):
            write_pfm(file, read_layer(folder / "image.exr", "caustic") * receivers)
        found = json.loads(self.call("compare", *files, "--mask", mask, "--json"))
        return [{**found["masked"], "iw_ssim": found["iw_ssim"]}[metric] for metric in METRICS]


def name_of(start, settings):
    return "-".join([start, *(f"{key.split('.')[-1]}={value}" for key, value in settings.items())])


def row(label, values):
    print("| " + label + " | " + " | ".join("-" if v is None else f"{v:.3g}" for v in values) + " |", flush=True)


def head(title, columns):
    print(f"\n{title}\n\n| | " + " | ".join(columns) + " |\n|---|" + "---|" * len(columns), flush=True)


# Spheres alone, as in the thesis.
ONE = {"environment.refine": False}
TABLES = {
    "lights": [({**ONE, "environment.lights": q, "environment.segmentation": way}, f"{way}, q = {q}")
               for way in ("thesis", "variance") for q in (8, 16, 24, 32, 40, 48, 56, 64)],
    "spheres": [({**ONE, "environment.spheres": s, "environment.radii": way}, f"{way}, s = {s}")
                for way in ("quadratic", "uniform") for s in (8, 16, 32)],
    "directions": [({**ONE, "environment.directions": n}, f"{n} directions") for n in (26, 98)],
    "refining": [({"stop.passes": n}, f"refined, {n} passes") for n in (2, 4, 16, 64)],
}
BINS = (0, 1, 2, 5, 10, 20, 40, 60)  # of CIELAB's distance


def scenes(bench, presets):
    head(f"five scenes, {bench.size} x {bench.size}, q = 24, s = 16, {bench.passes} passes", METRICS)
    for name in presets:
        first, second = (bench.reference(name, seed) for seed in SEEDS)
        ours = bench.ours(name, {})
        thesis = bench.ours(name, {**ONE, "environment.segmentation": "thesis"})
        mask = bench.mask(name, ours)
        row(f"{name}: another reference", bench.errors(second, first, mask))
        row(f"{name}: as in the thesis", bench.errors(thesis, first, mask))
        row(f"{name}: ours", bench.errors(ours, first, mask))
        sheet(bench, name, ours, first, mask)


def sheet(bench, name, ours, truth, mask):
    """Ours, the reference, their difference; caustic layers, receivers only. Where the reference's 99.5th percentile
    is, there is white."""
    receivers = read_mask(mask)
    pictures = [read_layer(run / "image.exr", "caustic") * receivers[..., None] for run in (ours, truth)]
    white = np.percentile(pictures[1][receivers].max(axis=-1), 99.5)
    files = [bench.out / f"{name}-sheet-{part}.png" for part in ("ours", "reference", "difference")]
    for file, picture in zip(files, (pictures[0], pictures[1], np.abs(pictures[0] - pictures[1]))):
        write_png(file, picture / white)
    side_by_side([ours / "image.png", *files], 4, bench.size, bench.out / f"{name}-sheet.png")


def table(bench, preset, name):
    first, second = (bench.reference(preset, seed) for seed in SEEDS)
    head(f"{name}: {preset}, {bench.size} x {bench.size}, {bench.passes} passes", METRICS)
    row("another reference", bench.errors(second, first, bench.mask(preset, first)))
    for settings, label in TABLES[name]:
        row(label, bench.errors(bench.ours(preset, settings), first, bench.mask(preset, first)))


def histogram(bench, preset):
    """Figure 3.16: which part of the pixels is how far from the reference, in CIELAB."""
    first, second = (bench.reference(preset, seed) for seed in SEEDS)
    receivers = read_mask(bench.mask(preset, first))
    colours = [lab(read_layer(run / "image.exr", "caustic"))[receivers] for run in (first, second)]
    head(f"histogram: {preset}, percent of the pixels by their distance in CIELAB",
         [f"{a} to {b}" for a, b in zip(BINS, BINS[1:])] + [f"{BINS[-1]} and more"])
    for label, theirs in [("another reference", colours[1])] + [
            (label, lab(read_layer(bench.ours(preset, settings) / "image.exr", "caustic"))[receivers]) for settings,
            label in TABLES["spheres"]]:
        distances = np.linalg.norm(theirs - colours[0], axis=-1)
        row(label, 100 * np.histogram(distances, [*BINS, np.inf])[0] / len(distances))


SECONDS = (0.1, 0.25, 0.5, 1, 2, 4, 8)


def converging(bench, preset):
    """Error against time: photons of engine 1 alone, the same smoothed, all that engine 1 renders, spheres, ours. Bakes
    are there before."""
    truth, other = (bench.reference(preset, seed) for seed in SEEDS)
    mask = bench.mask(preset, truth)
    bench.ours(preset, {})  # bakes
    alone = {"spectral.background": False, "seed": 201}
    ways = {"photons": {**TRUTH, **alone}, "photons, smoothed": {**TRUTH, **alone, "spectral.smoothing": "automatic"},
            "engine 1, whole pictures": {"engine": "spectral", "scene.environment.lights": True, "seed": 201},
            "spheres": {"environment.refine": False}, "ours, whole pictures": {}}
    head(f"converging: {preset}, {bench.size} x {bench.size}; another reference: " +
         ", ".join(f"{metric} {error:.3g}" for metric, error in zip(METRICS, bench.errors(other, truth, mask))),
         ["seconds", *METRICS])
    for seconds in SECONDS:
        for way, settings in ways.items():
            if way == "spheres" and seconds != 1:
                continue  # they stay as they are
            run = bench.run(preset, f"{preset}-{bench.size}-{way.replace(', ', '-').replace(' ', '-')}-{seconds}s",
                            settings, "--seconds", seconds)
            row(way, [seconds, *bench.errors(run, truth, mask)])


def estimate(bench, preset):
    """A run's own estimate over its error, of whole pictures, against a long run: the mean of eight seeds, with the
    lowest and the highest."""
    def last(run):
        names, *_, values = ((run / "history.csv").read_text().splitlines())
        return dict(zip(names.split(","), map(float, values.split(","))))

    truth = bench.run(preset, f"{preset}-{bench.size}-long", {"stop.passes": 384, "seed": 301})
    print(f"\nestimate: {preset}, {bench.size} x {bench.size}; the long run's own error: rel_l2 "
          f"{last(truth)['estimated_rel_l2']:.2g}, lab_mean {last(truth)['estimated_lab_mean']:.2g}")
    for passes in (2, 8, 32):
        ratios = {metric: [] for metric in ("rel_l2", "lab_mean")}
        for seed in range(401, 409):
            run = bench.run(preset, f"{preset}-{bench.size}-{passes}-passes-{seed}",
                            {"stop.passes": passes, "seed": seed})
            errors = json.loads(bench.call("compare", run / "image.exr", truth / "image.exr", "--json"))
            for metric, values in ratios.items():
                values.append(last(run)[f"estimated_{metric}"] / errors[metric])
        print(f"{passes} passes: " + ", ".join(f"{metric} {np.mean(v):.2f} ({min(v):.2f} to {max(v):.2f})" for metric,
                                               v in ratios.items()), flush=True)


ALONE = {"histogram": histogram}
OF_SCENES = {"converging": converging, "estimate": estimate}


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("out")
    arguments.add_argument("tables", nargs="*", default=["scenes", *TABLES, "histogram", *OF_SCENES], metavar="TABLE")
    arguments.add_argument("--presets", nargs="+", default=SCENES, help="of `scenes`, `converging` and `estimate`")
    arguments.add_argument("--sky", help="a latitude-longitude map: adds a torus of glass under it to the scenes")
    arguments.add_argument("--size", type=int, default=192)
    arguments.add_argument("--passes", type=int, default=8)
    arguments.add_argument("--reference-seconds", type=int, default=120)
    chosen = arguments.parse_args()
    bench = Bench(chosen.program, chosen.out, chosen.size, chosen.passes, chosen.reference_seconds, chosen.sky)
    presets = chosen.presets + (["torus"] if chosen.sky else [])
    for name in chosen.tables:
        if name == "scenes":
            scenes(bench, presets)
        elif name in OF_SCENES:
            for preset in presets:
                OF_SCENES[name](bench, preset)
        elif name in ALONE:
            ALONE[name](bench, "bunny")
        else:
            table(bench, "bunny", name)


if __name__ == "__main__":
    main()
