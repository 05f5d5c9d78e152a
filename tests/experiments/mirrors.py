#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Judges a mirror by its STL file alone: Embree's rays and the law of reflection, nothing of the program.

    tests/experiments/mirrors.py PROGRAM [PRESET] [--rays N] [--out FOLDER]

Runs the preset, by default inverse/mirror, traces N rays a side of the mirror in its parallel light, and prints for
each receiver rel_l2 beside the program's. --out has what its own rays cast. zbarimg reads QR codes in those pictures,
where it is installed. Needs numpy, embreex and pillow.
"""
import argparse
import json
import math
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh
from PIL import Image


def triangles_of(stl):
    """Corners [triangle][corner][axis] of a binary STL file."""
    data = stl.read_bytes()
    count = int.from_bytes(data[80:84], "little")
    rows = numpy.frombuffer(data[84:84 + 50 * count], dtype=[("f", "<f4", 12), ("_", "<u2")])
    return rows["f"].reshape(count, 4, 3)[:, 1:].copy()


def cast(triangles, size, light, rays):
    """Places and directions of the light that leaves, by rays on a jittered lattice."""
    scene = rtcore_scene.EmbreeScene(robust=True)
    TriangleMesh(scene, triangles)
    a, b, c = (triangles[:, i].astype(float) for i in range(3))
    normals = numpy.cross(b - a, c - a)
    normals /= numpy.linalg.norm(normals, axis=1)[:, None]
    random = numpy.random.default_rng(1)
    x, y = numpy.meshgrid(numpy.arange(rays), numpy.arange(rays))
    at = (numpy.stack([x, y], -1).reshape(-1, 2) + random.random((rays * rays, 2))) / rays - 0.5
    points = numpy.concatenate([at * size, numpy.zeros((rays * rays, 1))], 1)
    tilt, turn = math.radians(light.get("tilt_deg", 0)), math.radians(light.get("turn_deg", 0))
    way = numpy.array([math.sin(tilt) * math.cos(turn), math.sin(tilt) * math.sin(turn), math.cos(tilt)])
    directions = numpy.tile(way, (len(points), 1))
    points -= 50 * directions
    lost = numpy.zeros(len(points), bool)
    met = numpy.zeros(len(points), bool)
    go = numpy.arange(len(points))
    for _ in range(16):
        hit = scene.run(points[go].astype("f4"), directions[go].astype("f4"), output=True)
        found = hit["primID"] >= 0
        go, primitive, distance = go[found], hit["primID"][found], hit["tfar"][found]
        if not len(go):
            break
        met[go] = True
        normal = normals[primitive]
        lost[go[numpy.abs(normal[:, 2]) < 1e-9]] |= is_side(triangles, primitive, size)[numpy.abs(normal[:, 2]) < 1e-9]
        points[go] += distance[:, None] * directions[go]
        directions[go] -= 2 * numpy.sum(directions[go] * normal, 1)[:, None] * normal
        points[go] += 1e-4 * normal
        go = go[~lost[go]]
    good = met & ~lost & (directions[:, 2] < 0)
    return points[good], directions[good]


def is_side(triangles, primitive, size):
    """Whether a triangle lies in an outer side of the object."""
    corners = triangles[primitive]
    return numpy.any([numpy.all(numpy.abs(numpy.abs(corners[:, :, k]) - size[k] / 2) < 1e-4, 1) for k in (0, 1)], 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("preset", nargs="?", default="inverse/mirror")
    parser.add_argument("--rays", type=int, default=3072)
    parser.add_argument("--out", type=Path)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        run = Path(temporary) / "run"
        subprocess.run([args.program, "run", args.preset, "-o", run], check=True, stdout=subprocess.DEVNULL)
        report = json.loads((run / "run.json").read_text())
        inverse = json.loads((run / "preset.json").read_text())["inverse"]
        size = numpy.array(inverse["size_mm"], float)
        room = numpy.array(inverse.get("receiver_mm") or size, float)
        across, down = inverse["cells"]
        points, directions = cast(triangles_of(run / "object.stl"), size, inverse["light"], args.rays)
        print(f"{len(points) / args.rays ** 2:.4f} of the rays leave, of the program {report['light']['sent']:.4f}")
        for j, receiver in enumerate(inverse["receivers"]):
            way = -receiver["distance_mm"] - points[:, 2]
            hit = points[:, :2] + directions[:, :2] * (way / directions[:, 2])[:, None]
            hit -= receiver["offset_mm"]
            cell = numpy.floor((hit + [room[0] / 2, -room[1] / 2]) / (room / [across, -down])).astype(int)
            inside = numpy.all((cell >= 0) & (cell < [across, down]), 1)
            light = numpy.bincount(cell[inside, 1] * across + cell[inside, 0], minlength=across * down).astype(float)
            wanted = numpy.asarray(Image.open(run / f"target_{j + 1}.png").convert("L"), float) / 255
            linear = numpy.where(wanted <= 0.04045, wanted / 12.92, ((wanted + 0.055) / 1.055) ** 2.4).ravel()
            linear /= linear.sum()
            share = light / light.sum()
            error = math.sqrt(((share - linear) ** 2).sum() / (linear ** 2).sum())
            said = report["inverse"]["receivers"][j]
            picture = Image.fromarray(numpy.uint8(numpy.clip(255 * (light / light.max()) ** (1 / 2.2), 0, 255))
                                      .reshape(down, across)).resize((8 * across, 8 * down), Image.NEAREST)
            read = ""
            if args.out:
                args.out.mkdir(parents=True, exist_ok=True)
                picture.save(args.out / f"embree_{j + 1}.png")
            if shutil.which("zbarimg") and receiver["picture"]["type"] == "qr":
                file = Path(temporary) / "code.png"
                picture.save(file)
                codes = subprocess.run(["zbarimg", "-q", "--raw", file], capture_output=True, text=True, check=False)
                read = f"; read: {codes.stdout.strip() or 'nothing'}"
            print(f"receiver {j + 1}: rel_l2 {error:.4f}, of the program {said['rel_l2']:.4f}{read}")


if __name__ == "__main__":
    main()
