#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures engine 2 against engine 1 and prints the tables of docs/environment.md: the caustic layer alone, as the thesis compares.

    tests/experiments/environment.py PROGRAM OUT [--presets NAME...] [--size N] [--reference-seconds S] [TABLE...]

Tables: lights (3.1: how many, by which segmentation), spheres (3.2: how many, with which radii), directions, refining. Engine 1 traces photons from every
texel of the same environment through the same objects: no spheres, no segments. Two of its runs with different seeds tell the noise floor.
"""
import argparse
import json
import subprocess
import sys
from pathlib import Path

METRICS = ["lab_mean", "rel_l2", "iw_ssim"]


class Bench:
    def __init__(self, program, out, size, seconds):
        self.program, self.out, self.size, self.seconds = program, Path(out), size, seconds
        self.out.mkdir(parents=True, exist_ok=True)

    def call(self, *words):
        done = subprocess.run([self.program, *map(str, words)], capture_output=True, text=True)
        if done.returncode:
            sys.exit(done.stderr.splitlines()[-1])
        return done.stdout

    def run(self, preset, name, settings):
        """The run's image.exr. A run that is there is not made again."""
        folder = self.out / name
        if not (folder / "image.exr").exists():
            words = [word for key, value in settings.items() for word in ("--set", f"{key}={json.dumps(value)}")]
            self.call("run", preset, "-o", folder, "--set", f"scene.camera.resolution=[{self.size},{self.size}]", *words)
        return folder / "image.exr"

    def reference(self, preset, name, seed):
        """The same scene for engine 1."""
        made = json.loads(Path(preset).read_text())
        made["engine"] = "spectral"
        made.pop("environment", None)
        made["scene"]["environment"]["lights"] = True
        copy = Path(preset).with_name(f".reference-{name}.json")  # beside it: it names files
        copy.write_text(json.dumps(made))
        try:
            return self.run(copy, f"{name}-reference-{seed}", {"seed": seed, "stop.seconds": self.seconds, "spectral.smoothing": "off"})
        finally:
            copy.unlink()

    def compare(self, picture, reference):
        found = json.loads(self.call("compare", picture, reference, "--layer", "caustic", "--json"))
        return [found[metric] for metric in METRICS]


def row(label, values):
    print("| " + label + " | " + " | ".join("-" if v is None else f"{v:.3g}" for v in values) + " |", flush=True)


ONE = {"environment.refine": False}  # a light keeps its one direction, as in the thesis
TABLES = {
    "lights": [({**ONE, "environment.lights": q, "environment.segmentation": way}, f"{way}, q = {q}")
               for q in (8, 16, 24, 32, 48, 64) for way in ("thesis", "variance")],
    "spheres": [({**ONE, "environment.spheres": s, "environment.radii": way}, f"{way}, s = {s}") for way in ("quadratic", "uniform") for s in (8, 16, 32)],
    "directions": [({**ONE, "environment.directions": n}, f"{n} directions") for n in (26, 98)],
    "refining": [({"stop.passes": n}, f"refined, {n} passes") for n in (1, 4, 16, 64)],
}


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("out")
    arguments.add_argument("tables", nargs="*", default=list(TABLES), metavar="TABLE")
    arguments.add_argument("--presets", nargs="+", default=["presets/environment/bunny.json"])
    arguments.add_argument("--size", type=int, default=256)
    arguments.add_argument("--passes", type=int, default=8)
    arguments.add_argument("--reference-seconds", type=int, default=120)
    chosen = arguments.parse_args()
    bench = Bench(chosen.program, chosen.out, chosen.size, chosen.reference_seconds)
    for preset in chosen.presets:
        name = Path(preset).stem
        first, second = (bench.reference(preset, name, seed) for seed in (101, 102))
        print(f"\n{name}, {chosen.size} x {chosen.size}, caustic layer\n\n| | " + " | ".join(METRICS) + " |\n|---|" + "---|" * len(METRICS))
        row("another reference", bench.compare(second, first))
        for table in chosen.tables:
            for settings, label in TABLES[table]:
                run = "-".join([name, *(str(value) for value in settings.values())])
                row(label, bench.compare(bench.run(preset, run, {"stop.passes": chosen.passes, **settings}), first))


main()
