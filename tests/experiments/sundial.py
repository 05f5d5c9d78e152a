#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads what the windows of a run of inverse/sundial show in each light: the table of docs/notebook/inverse.md.

    tests/experiments/sundial.py RUN     the folder of a run

A reader by templates: a window says the hour whose figures it is most like, by correlation, moved by up to three cells;
below .8 it says nothing. Needs numpy and ImageMagick.
"""
import subprocess
import sys
from pathlib import Path

import numpy as np

READABLE, MOVED = 0.8, 3


def grey(file):
    values = subprocess.run(["convert", str(file), "-colorspace", "Gray", "-depth", "8", "gray:-"], check=True,
                            capture_output=True).stdout
    side = int(len(values)**0.5)
    return np.frombuffer(values, np.uint8).reshape(side, side).astype(float)


def likeness(shown, wanted):
    if shown.std() == 0:
        return 0.0
    return max(np.corrcoef(np.roll(wanted, (dy, dx), (0, 1)).ravel(), shown.ravel())[0, 1]
               for dy in range(-MOVED, MOVED + 1) for dx in range(-MOVED, MOVED + 1))


def main(run):
    count = len(list(run.glob("target_*.png")))
    wanted = [grey(run / f"target_{j + 1}.png") for j in range(count)]
    print("| light of | " + " | ".join(f"window {j + 1}" for j in range(count)) + " |\n" + "|---" * (count + 1) + "|")
    for light in range(count):
        row = []
        for window in range(count):
            own = light == window
            shown = grey(run / (f"receiver_{window + 1}" + ("" if own else f"_light_{light + 1}") + ".png"))
            alike = [likeness(shown, w) for w in wanted]
            best = int(np.argmax(alike))
            row.append(f"{best + 1 if alike[best] > READABLE else '-'} ({alike[best]:.2f})")
        print(f"| {light + 1} | " + " | ".join(row) + " |")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]))
