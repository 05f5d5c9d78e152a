#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs engine 3's presets and prints the tables of docs/notebook/inverse.md.

    tests/experiments/inverse.py PROGRAM OUT [EXPERIMENT...]

Runs of one table follow each other, so that their seconds can be compared.
"""
import csv
import json
import shutil
import subprocess
import sys
from pathlib import Path
from statistics import mean

SETS = ["words", "shapes", "bars", "star", "faces", "qr"]
# The thesis' pipeline after so many trials: figures 5.10, 5.14 and 5.20.
STAGES = {1: "drawn (5.1)", 101: "annealing 1", 201: "annealing 2", 251: "correction"}
PIPELINED = SETS[:-1]  # the second annealing of qr takes over ten minutes
DRAWS = 8  # of every facet, a cost; 32 in the thesis
RING = {"distance_mm": 100, "picture": {"type": "ring", "radius": 0.3, "inner": 0.15}}  # of figure 5.18
LIGHTS = ["point", "tilted", "sun", "wide", "dispersion", "lens"]


class Experiments:
    def __init__(self, program, out):
        self.program, self.out = program, Path(out)

    def run(self, preset, *sets, passes=None, seconds=None):
        """One run; returns its run.json, with the seconds of its slopes and of its judge, and its history of costs."""
        folder = self.out / "-".join([preset, *sets, str(passes or ""), str(seconds or "")]).replace("/", "_")
        command = [self.program, "run", f"inverse/{preset}", "-o", str(folder)]
        for value in sets:
            command += ["--set", f"inverse.{value}"]
        if passes:
            command += ["--passes", str(passes)]
        if seconds:
            command += ["--seconds", str(seconds)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        result = json.loads((folder / "run.json").read_text())
        with (folder / "cost.csv").open() as file:
            result["history"] = list(csv.DictReader(file))
        return result

    @staticmethod
    def row(name, r):
        judged, believed, phases = r["judged"], r["believed"], r["phase_seconds"]
        each = ", ".join(f"{receiver['cost']:.3f}" for receiver in r["inverse"]["receivers"])
        light = r["light"]
        print(f"| {name} | {judged['cost']:.3f} | {believed['cost']:.3f} | {each} | {judged['rel_l2']:.3f} | "
              f"{judged['missed']:.3f} | "
              f"{light['reflected']:.3f} | {light['by_walls']:.4f} | {phases['slopes']:.1f} + {phases['judge']:.1f} |")

    def table(self, names):
        print("| preset | judged cost | believed | each picture | rel_l2 | missed | reflected | by walls | seconds: "
              "slopes + judge |\n" + "|---" * 9 + "|")
        for name in names:
            self.row(f"`{name}`", self.run(name))

    def sets(self):
        self.table(SETS)

    def lights(self):
        self.table(LIGHTS)

    def pictures(self):
        """What the sets want, cast and lack, in one picture: docs/inverse-sets.jpg. Needs ImageMagick."""
        for name in SETS:
            self.run(name)
        subprocess.run(["montage", *(str(self.out / f"{name}--" / "image.png") for name in SETS), "-tile", "3x2",
                        "-geometry", "480x480+4+4", "-background", "#262626",
                        "-quality", "85", str(self.out / "inverse-sets.jpg")], check=True)

    def seeds(self):
        """How close several starts come to each other."""
        for name in SETS[1:4]:
            folder = [self.out / f"{name}-seed{seed}" for seed in (1, 2, 3)]
            for seed, f in enumerate(folder):
                subprocess.run([self.program, "run", f"inverse/{name}", "-o", str(f), "--seed", str(seed + 1)],
                               check=True,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            print(name, *(f"{json.loads((f / 'run.json').read_text())['judged']['cost']:.4f}" for f in folder))

    def relief(self):
        print("| heights | max_relief_mm | judged cost | relief mm | walls mm^2 | light by walls |\n" + "|---" * 6
              + "|")
        for heights, limit in [("flat", None), ("flat", 0.7), ("flat", 0.6), ("flat", 0.5), ("flat", 0.4), ("free", 1),
                               ("free", 2), ("free", 5),
                               ("free", 10), ("free", None)]:
            sets = [f"heights={heights}"] + ([f"max_relief_mm={limit}"] if limit else [])
            r = self.run("shapes", *sets)
            o = r["object"]
            print(f"| {heights} | {limit or '-'} | {r['judged']['cost']:.4f} | {o['relief_mm']:.2f} | "
                  f"{o['wall_area_mm2']:.0f} | "
                  f"{r['light']['by_walls']:.4f} |")

    def smoothing(self):
        print("| smoothing_normals | judged cost | relief mm | walls mm^2 | with free heights: judged | walls mm^2 |\n"
              + "|---" * 6 + "|")
        for weight in [0, 0.01, 0.1, 0.3, 1]:
            r, free = self.run("shapes", f"smoothing_normals={weight}"), self.run("shapes",
                                                                                  f"smoothing_normals={weight}",
                                                                                  "heights=free")
            print(f"| {weight} | {r['judged']['cost']:.4f} | {r['object']['relief_mm']:.2f} | "
                  f"{r['object']['wall_area_mm2']:.0f} | "
                  f"{free['judged']['cost']:.4f} | {free['object']['wall_area_mm2']:.0f} |")

    def speed(self):
        """Judged cost after so many seconds of assigning."""
        for seconds in (1, 2, 5, 10, 60):
            r = self.run("shapes", seconds=seconds)
            print(f"{seconds} s: judged {r['judged']['cost']:.4f}, {r['phase_seconds']['slopes']:.1f} + "
                  f"{r['phase_seconds']['judge']:.1f} s, {r['sweeps']} sweeps")
        r = self.run("shapes", "facets=[512,512]", "cells=[256,256]", passes=4)
        print(f"512: judged {r['judged']['cost']:.4f}, believed {r['believed']['cost']:.4f}, {r['phase_seconds']}")

    def thesis(self):
        """Both methods on one set: when does `assign` reach what the thesis' pipeline ends with?"""
        for name in SETS[1:4]:
            thesis, assign = self.run(name, "method=thesis", passes=251), self.run(name)
            t, goal = thesis["phase_seconds"]["slopes"], thesis["believed"]
            print(f"{name}: thesis {t:.1f} s, judged cost {thesis['judged']['cost']:.3f}, rel_l2 "
                  f"{thesis['judged']['rel_l2']:.3f}; "
                  f"assign {assign['phase_seconds']['slopes']:.1f} s, {assign['judged']['cost']:.3f}, "
                  f"{assign['judged']['rel_l2']:.3f}")
            print("  ", {k: round(v, 4) for k, v in thesis["thesis"].items()})
            for metric in ("cost", "rel_l2"):
                first = next((h for h in assign["history"] if float(h[metric]) <= goal[metric]), None)
                if first:
                    print(f"   believed {metric} {goal[metric]:.3f}: reached by assign within "
                          f"{float(first['seconds']):.2f} s (row {first['sweep']})")

    def pipeline(self, preset, name, *sets, seed=1, stages=tuple(STAGES)):
        """The thesis' pipeline, judged after each of `stages`; returns the folders."""
        folders = [self.out / f"{preset}-{name}-{trials}" for trials in stages]
        for i, (trials, folder) in enumerate(zip(stages, folders)):
            if (folder / "run.json").exists():
                continue
            if i > 0:
                shutil.copytree(folders[i - 1], folder, dirs_exist_ok=True)
            options = [word for value in ("method=thesis", f"thesis.draws={DRAWS}", *sets)
                       for word in ("--set", f"inverse.{value}")]
            subprocess.run([self.program, "run", f"inverse/{preset}", "-o", str(folder), "--seed", str(seed),
                            "--passes", str(trials), *options, *(["--resume"] if i > 0 else [])],
                           check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return folders

    def seen_row(self, name, way, folder):
        """IW-SSIM and FLIP are of the pictures cast beside the wanted ones, a cell enlarged to 4 x 4 pixels, as a sheet
        shows them: means over the pictures. Needs ImageMagick."""
        r = json.loads((folder / "run.json").read_text())
        seen = []
        for j in range(1, len(r["inverse"]["receivers"]) + 1):
            enlarged = [folder / f"enlarged-{kind}.png" for kind in ("receiver", "target")]
            for kind, target in zip(("receiver", "target"), enlarged):
                subprocess.run(["convert", str(folder / f"{kind}_{j}.png"), "-sample", "400%", str(target)], check=True)
            done = subprocess.run([self.program, "compare", "--json", *map(str, enlarged)], check=True,
                                  capture_output=True, text=True)
            seen.append(json.loads(done.stdout))
        own = [value for key, value in r.get("thesis", {}).items() if key.startswith("cost_")]
        print(f"| `{name}` | {way} | {f'{own[-1]:.3f}' if own else '-'} | {r['judged']['cost']:.3f} | "
              f"{r['judged']['rel_l2']:.3f} | {mean(s['iw_ssim'] for s in seen):.3f} | "
              f"{mean(s['flip'] for s in seen):.3f} |", flush=True)

    def stages(self):
        """Figures 5.9, 5.10, 5.14 and 5.20, and the surveys of appendix B by metrics in place of people."""
        print("| set | after | its own cost | judged cost | rel_l2 | IW-SSIM | FLIP |\n" + "|---" * 7 + "|")
        for name in SETS:
            if name in PIPELINED:
                for way, folder in zip(STAGES.values(), self.pipeline(name, "convergence")):
                    self.seen_row(name, way, folder)
                self.seen_row(name, "annealing 1, `each`",
                              self.pipeline(name, "each", "thesis.adjust=each", stages=(101,))[0])
            self.run(name)
            self.seen_row(name, "`assign`", self.out / f"{name}--")

    def again(self):
        """Figure 5.21: the pipeline from other random numbers."""
        print("| set | seed | its own cost | judged cost | rel_l2 | IW-SSIM | FLIP |\n" + "|---" * 7 + "|")
        for seed in (1, 2):
            name = f"seed-{seed}" if seed > 1 else "convergence"
            self.seen_row("shapes", seed, self.pipeline("shapes", name, seed=seed)[-1])

    def one_picture(self):
        """Figure 5.18: one picture of 64 x 64 cells, by as many facets and by four times as many."""
        print("| set | facets | its own cost | judged cost | rel_l2 | IW-SSIM | FLIP |\n" + "|---" * 7 + "|")
        for facets in (64, 128):
            sets = [f"facets=[{facets},{facets}]", f"receivers=[{json.dumps(RING)}]"]
            self.seen_row("shapes", f"{facets}, pipeline", self.pipeline("shapes", f"ring-{facets}", *sets,
                                                                         stages=(251,))[0])
            folder = self.out / f"ring-{facets}-assign"
            subprocess.run([self.program, "run", "inverse/shapes", "-o", str(folder),
                            *(word for value in sets for word in ("--set", f"inverse.{value}"))], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            self.seen_row("shapes", f"{facets}, `assign`", folder)


def main():
    program, out, *names = sys.argv[1:]
    experiments = Experiments(program, out)
    for name in names or ["sets", "lights", "pictures", "seeds", "relief", "smoothing", "speed", "thesis", "stages",
                          "again", "one_picture"]:
        print(f"\n## {name}\n", flush=True)
        getattr(experiments, name)()


if __name__ == "__main__":
    main()
