#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the pictures of docs/README.md, docs/thesis.md and docs/notebook/smoothing.md again; ImageMagick puts them side
by side.

    tests/experiments/pictures.py PROGRAM OUT     writes OUT/gallery.jpg, OUT/thesis-scenes.jpg and OUT/smoothing.jpg
"""
import subprocess
import sys
from pathlib import Path

from thesis import BRUTE, OURS, PLAIN, THESIS, Experiments

SIZE = 256
SCENES = ["bunny", "bunny-arbitrary-2", "diamond-arbitrary-1", "enclosed-bunny", "cylinders", "newton", "prism-f10"]
GALLERY = ["first-light", "spectral/brilliant", "spectral/ball-lens", "spectral/glass-in-a-room", "spectral/prism",
           "spectral/thesis/newton",
           "spectral/thesis/cylinders", "spectral/thesis/diamond-arbitrary-1", "spectral/thesis/enclosed-bunny",
           "spectral/thesis/bunny-arbitrary-2",
           "extremes/laser-beside-lamp", "extremes/nested-eight"]
OTHERS = ["staircase", "rhodamine-6G", "rhodamine-6G-absorption", "F8BT", "F8BT-absorption"]


def side_by_side(folders, columns, gap, target, *options):
    subprocess.run(["montage", *(str(folder / "image.png") for folder in folders), "-tile", f"{columns}x", "-geometry",
                    f"{SIZE}x{SIZE}+{gap}+{gap}",
                    "-background", "black", *options, str(target)], check=True)
    print(target)


def gallery(e, out):
    """Shipped presets as they come, after 20 seconds."""
    folders = [e.out / "gallery" / name.replace("/", "-") for name in GALLERY]
    for name, folder in zip(GALLERY, folders):
        subprocess.run([e.program, "run", name, "--seconds", "20", "-o", str(folder)], check=True, capture_output=True)
    side_by_side(folders, 4, 1, out / "gallery.jpg", "-quality", "88")


def scenes(e, out):
    """Whole pictures, splats."""
    whole = {"estimator": "splat", "photons_per_pass": 1 << 18, "direct": True}
    e.size = SIZE
    folders = [e.run(f"scenes/{name}", f"spectral/thesis/{name}", whole, 64 if name == "bunny" else 24)[2]
               for name in SCENES]
    e.size = None
    folders += [e.run(f"scenes/{name}", f"spectral/{name}", whole, 24)[2] for name in OTHERS]
    side_by_side(folders, 4, 0, out / "thesis-scenes.jpg", "-quality", "88")


def smoothing(e, out):
    """Caustics of the bunny after 8 seconds of each way, and after 120 passes."""
    e.size = SIZE
    variants = [BRUTE, THESIS, PLAIN, OURS]
    folders = [e.run(f"smoothing/{index}", "spectral/thesis/bunny", spectral, seconds=8)[2] for index,
               spectral in enumerate(variants)]
    folders.append(e.run("smoothing/long", "spectral/thesis/bunny", PLAIN, 120)[2])
    side_by_side(folders, 5, 1, out / "smoothing.jpg", "-quality", "85")


if __name__ == "__main__":
    if len(sys.argv) != 3 or not Path(sys.argv[1]).is_file():
        sys.exit("usage: pictures.py PROGRAM OUT, PROGRAM being the program, as build/release/bin/nephroid")
    for make in (gallery, scenes, smoothing):
        make(Experiments(sys.argv[1], sys.argv[2]), Path(sys.argv[2]))
