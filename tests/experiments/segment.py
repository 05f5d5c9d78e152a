#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Cuts maps into lights and prints how far the lights' irradiance is from the map's, over all normals, in percent, as
tables of docs/notebook/environment.md.

    tests/experiments/segment.py PROGRAM MAP... [--q N...]

docs/notebook/environment.md has the eight maps of Debian's package blender-data
(usr/share/blender/datafiles/studiolights/world/*.exr).
"""
import argparse
import json
import subprocess
import sys
from pathlib import Path
from statistics import median

WAYS = {"variance": [], "thesis": ["--method", "thesis"],
        "thesis, texel weights": ["--method", "thesis", "--weights", "texel"]}


def error_percent(program, picture, lights, options):
    done = subprocess.run([program, "segment", picture, "-q", str(lights), *options, "--json"], capture_output=True,
                          text=True)
    if done.returncode:
        sys.exit(done.stderr.splitlines()[-1])
    return 100 * json.loads(done.stdout)["irradiance_error"]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("maps", nargs="+")
    arguments.add_argument("--q", nargs="+", type=int, default=[8, 16, 24, 64, 256])
    chosen = arguments.parse_args()
    print("| q | method | " + " | ".join(Path(m).stem for m in chosen.maps) + " | median |")
    print("|---|---|" + "---|" * (len(chosen.maps) + 1))
    wins = 0
    for lights in chosen.q:
        of = {way: [error_percent(chosen.program, m, lights, options) for m in chosen.maps] for way,
              options in WAYS.items()}
        for way, errors in of.items():
            print(f"| {lights} | {way} | " + " | ".join(f"{e:.3g}" for e in errors) + f" | {median(errors):.3g} |",
                  flush=True)
        wins += sum(a < b for a, b in zip(of["variance"], of["thesis"]))
    print(f"\nvariance is better than thesis {wins} times of {len(chosen.q) * len(chosen.maps)}")


main()
