#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""STEP files of the inverse engine, read by gmsh: one closed solid, and the volume of the STL.

    tests/experiments/step.py PROGRAM FOLDER [PRESET...]

It takes gmsh. Prints a row of Markdown an object: faces, bytes, seconds of the whole run, and by how much the volumes
differ. Without names: facets upright and drafted, a mirror, a lens and a round one.
"""
import pathlib
import re
import struct
import subprocess
import sys
import time

SMALL = ["inverse.facets=[32, 32]", "inverse.cells=[16, 16]", "stop.passes=3"]
OBJECTS = {
    "facets": ("inverse/shapes", SMALL),
    "draft of 3 degrees": ("inverse/shapes", SMALL + ["inverse.draft_deg=3"]),
    "free heights": ("inverse/shapes", SMALL + ["inverse.heights=free"]),
    "half an inch": ("inverse/shapes", SMALL + ["inverse.stock_mm=1/2 in"]),
    "mirror": ("inverse/mirror", ["inverse.facets=[64, 64]", "stop.passes=3"]),
    "lens": ("inverse/lens", ["inverse.facets=[64, 64]"]),
    "round lens": ("inverse/lens", ["inverse.facets=[64, 64]", "inverse.outline=round"]),
}


def volume_of_stl(file):
    data = file.read_bytes()
    count = struct.unpack_from("<I", data, 80)[0]
    total = 0.0
    for i in range(count):
        a, b, c = (struct.unpack_from("<3f", data, 84 + 50 * i + 12 * k) for k in (1, 2, 3))
        total += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                  + a[2] * (b[0] * c[1] - b[1] * c[0]))
    return total / 6


def by_gmsh(file):
    """Solids, faces and the volume."""
    script = file.with_suffix(".geo")
    script.write_text(f'SetFactory("OpenCASCADE");\nv() = ShapeFromFile("{file.resolve()}");\n'
                      'm = Mass Volume{v(0)};\ns() = Surface{:};\nPrintf("read %g %g %.12g", #v(), #s(), m);\n')
    # It fails where it cannot export a surface that it has read: round sides.
    said = subprocess.run(["gmsh", "-0", script], capture_output=True, text=True).stdout
    solids, faces, volume = re.search(r"read (\S+) (\S+) (\S+)", said).groups()
    return int(float(solids)), int(float(faces)), float(volume)


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    objects = {name: (name, []) for name in sys.argv[3:]} or OBJECTS
    print("| object | faces | STEP | seconds | volume, STEP over STL |\n|---|---|---|---|---|")
    for name, (preset, settings) in objects.items():
        out = folder / re.sub(r"\W", "-", name)
        began = time.time()
        sets = [word for s in ["inverse.step=true"] + settings for word in ("--set", s)]
        subprocess.run([program, "run", preset, "-o", out, *sets], check=True, capture_output=True)
        seconds = time.time() - began
        solids, faces, volume = by_gmsh(out / "object.step")
        assert solids == 1, (name, solids)
        off = volume / volume_of_stl(out / "object.stl") - 1
        print(f"| {name} | {faces} | {(out / 'object.step').stat().st_size / 2**20:.2f} MiB | {seconds:.0f} | "
              f"1 {off:+.1e} |", flush=True)
        if "round" not in name:  # the STL's outline is a polygon
            assert abs(off) < 1e-4, (name, off)


if __name__ == "__main__":
    main()
