#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes optics for ten wanted intensities, and traces their STL files alone. Needs numpy and embreex.

    tests/experiments/far.py PROGRAM OUT [NAME...] [--method lens] [--away 200] [--lambert]
        [--rays 4000000] [--set KEY=VALUE]

No line of the program's own code traces here: embree finds hits, and Snell's law and Fresnel's equations in vectors
bend and weaken the light. The lamp is a disc of a fifth of the lens, which shines evenly to all sides as the engine has
it, or by Lambert's law. What is wanted is computed here once more, from the shapes or from what the IES and EULUMDAT
files are made of. Sides are black. The noise is half the difference of two halves of the rays.
"""
import argparse
import json
import subprocess
from pathlib import Path

import numpy as np
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh

INDEX, SIZE, LAMP = 1.49, 100.0, 20.0
THICK, THICKER = 13, {"cutoff": 24, "street.ldt": 20, "wall.ies": 28}  # what turns all light aside is a wedge, too
CELLS = 64


def smooth(depth, edge):
    t = np.clip(depth / edge + 0.5, 0, 1) if edge > 0 else (depth >= 0) * 1.0
    return t * t * (3 - 2 * t)


def ellipse(x, y, size, edge):
    r = np.hypot(x / size[0] * 2, y / size[1] * 2)
    far = np.hypot(x, y)
    return smooth(np.where(r > 0, (1 - r) * far / np.maximum(r, 1e-12), min(size) / 2), edge)


def rectangle(x, y, size, edge):
    return smooth(np.minimum(size[0] / 2 - abs(x), size[1] / 2 - abs(y)), edge)


def batwing(x, y, size, edge):
    return ellipse(x, y, size, edge) * (1 + np.tan(np.radians(x)) ** 2 + np.tan(np.radians(y)) ** 2) ** 1.5


def cutoff(x, y, size, edge):
    below = y <= np.maximum(x, 0) * np.tan(np.radians(15))
    return below * smooth(np.minimum(size[0] / 2 - abs(x), y + size[1]), edge)


def ring(x, y, size, _):
    r = np.hypot(x, y) / size[0]
    return (r < 0.45) & (r >= 0.2)


SHAPES = {
    "rectangle": (rectangle, {"size_deg": [50, 30], "edge_deg": 8}),
    "ellipse": (ellipse, {"size_deg": [56, 36], "edge_deg": 8}),
    "batwing": (batwing, {"size_deg": [70, 70], "edge_deg": 10}),
    "cutoff": (cutoff, {"size_deg": [56, 16], "edge_deg": 8}),
    "ring": (ring, {"size_deg": [50, 50], "picture": {"type": "ring", "radius": 0.45, "inner": 0.2}}),
}


def lobe(gamma, c, at, turn, width):
    """A spot in a direction."""
    g, p = np.radians(gamma), np.radians(c)
    a, q = np.radians(at), np.radians(turn)
    cosine = np.sin(g) * np.sin(a) * np.cos(p - q) + np.cos(g) * np.cos(a)
    return np.exp((cosine - 1) / (1 - np.cos(np.radians(width))))


FILES = {
    "spot.ies": lambda g, c: lobe(g, c, 0, 0, 10),
    "flood.ldt": lambda g, c: 1 / (1 + np.exp((g - 28) / 3)),
    "wing.ies": lambda g, c: (1 + 1.5 * (g / 30) ** 2 * np.cos(2 * np.radians(c)) ** 2) / (1 + np.exp((g - 27) / 2.5)),
    "street.ldt": lambda g, c: lobe(g, c, 22, 15, 11) + lobe(g, c, 22, 165, 11) + 0.6 * lobe(g, c, 0, 0, 12),
    "wall.ies": lambda g, c: lobe(g, c, 18, 90, 9) + 0.5 * lobe(g, c, 5, 90, 12) + 0.3 * lobe(g, c, 15, 0, 10),
}


def write_file(path, intensity):
    gammas, planes = np.arange(0, 90.1, 1), np.arange(0, 360, 5)
    values = 1000 * np.array([intensity(gammas, np.full_like(gammas, c)) for c in planes])
    values[values < 1] = 0
    values *= gammas < 60
    if path.suffix == ".ies":
        rows = [gammas, np.append(planes, 360), *values, values[0]]
        text = f"IESNA:LM-63-2002\n[TEST] own\nTILT=NONE\n1 1000 1 {len(gammas)} {len(planes) + 1} 1 2 0 0 0\n1 1 0\n"
        text += "".join(" ".join(f"{v:.6g}" for v in row) + "\n" for row in rows)
    else:
        head = ["own", 1, 0, len(planes), 5, len(gammas), 1, "own", "own", "", "", ""] + [0] * 9
        head += [100, 100, 1, 0, 1, 1, "-", 1000, "-", "-", 0] + [0] * 10
        text = "\n".join(str(v) for v in [*head, *planes, *gammas, *(f"{v:.6g}" for v in values.ravel())]) + "\n"
    path.write_text(text, encoding="ascii")


def wanted_at(name, more, tx, ty):
    if name in FILES:
        gamma, c = np.degrees(np.arctan(np.hypot(tx, ty))), np.degrees(np.arctan2(ty, tx)) % 360
        value = FILES[name](gamma, c)
        return np.where((value >= 0.001) & (gamma < 60), value, 0)
    x, y = np.degrees(np.arctan(tx)), np.degrees(np.arctan(ty))
    return SHAPES[name][0](x, y, more["size_deg"], more.get("edge_deg", 0)) * 1.0


class Solid:
    def __init__(self, stl):
        with open(stl, "rb") as file:
            count = int(np.frombuffer(file.read(84), "<u4", offset=80)[0])
            rows = np.fromfile(file, np.dtype([("f", "<f4", (4, 3)), ("attribute", "<u2")]), count)
        self.corners = rows["f"][:, 1:].astype(np.float32)
        across = np.cross(*(self.corners[:, k].astype(float) - self.corners[:, 0] for k in (1, 2)))
        length = np.linalg.norm(across, axis=1, keepdims=True)
        self.normals = across / np.where(length > 0, length, 1)
        self.scene = rtcore_scene.EmbreeScene()
        TriangleMesh(self.scene, self.corners)

    def hits(self, origins, ways):
        found = self.scene.run(origins.astype(np.float32), ways.astype(np.float32), output=1)
        return found["primID"], found["tfar"].astype(float)

    def follow(self, origins, ways, power):
        """Directions and powers behind the solid; rays that are lost have no power."""
        alive = np.arange(len(power))
        for _ in range(12):
            ids, t = self.hits(origins[alive], ways[alive])
            hit = ids >= 0
            gone = alive[~hit]
            power[gone[ways[gone, 2] >= 0]] = 0
            alive, ids, t = alive[hit], ids[hit], t[hit]
            if len(alive) == 0:
                return ways, power
            d = ways[alive]
            p = origins[alive] + t[:, None] * d
            n = self.normals[ids]
            side = (abs(n[:, 2]) < 1e-3) & (abs(p[:, :2]).max(1) > SIZE / 2 - 1e-2)
            cos_n = (n * d).sum(1)
            enters = cos_n < 0
            n = np.where(enters[:, None], n, -n)
            before, behind = np.where(enters, 1, INDEX), np.where(enters, INDEX, 1)
            c, ratio = abs(cos_n), before / behind
            square = 1 - ratio**2 * (1 - c**2)
            total = square < 0
            b = np.sqrt(np.maximum(square, 0))
            s, q = (before * c - behind * b) / (before * c + behind * b), (behind * c - before * b) / (
                behind * c + before * b)
            new = np.where(total[:, None], d + 2 * c[:, None] * n, ratio[:, None] * d + (ratio * c - b)[:, None] * n)
            ways[alive] = new / np.linalg.norm(new, axis=1, keepdims=True)
            power[alive] *= np.where(side, 0, np.where(total, 1, 1 - (s * s + q * q) / 2))
            origins[alive] = p + 2e-4 * ways[alive]
            alive = alive[~side]
        power[alive] = 0
        return ways, power


def trace(solid, half, away, rays, lambert, seed):
    """Light of each cell, and all that is sent, as parts of what falls on the front."""
    random = np.random.default_rng(seed)
    front = solid.corners[:, :, 2].max()
    light, on_front, sent_in_all = np.zeros((CELLS, CELLS)), 0.0, 0.0
    for _ in range(max(1, rays // 500_000)):
        count = 500_000
        turn, r = random.random(count) * 2 * np.pi, LAMP / 2 * np.sqrt(random.random(count))
        lamp = np.stack([r * np.cos(turn), r * np.sin(turn), np.full(count, front + away)], 1)
        at = np.append((random.random((count, 2)) - 0.5) * SIZE, np.full((count, 1), front), 1)
        ways = at - lamp
        length = np.linalg.norm(ways, axis=1, keepdims=True)
        ways /= length
        power = -ways[:, 2] / length[:, 0] ** 2 * (-ways[:, 2] if lambert else 1)
        on_front += power.sum()
        out, power = solid.follow(at - ways, ways, power)
        sent = power > 0
        sent_in_all += power.sum()
        t = out[sent, :2] / -out[sent, 2:]
        cell = np.floor((t / half * [1, -1] + 1) / 2 * CELLS).astype(int)
        inside = ((cell >= 0) & (cell < CELLS)).all(1)
        np.add.at(light, (cell[inside, 1], cell[inside, 0]), power[sent][inside])
    return light / on_front, sent_in_all / on_front


def steradians(half):
    x, y = (np.linspace(-h, h, CELLS + 1) for h in half)
    corner = np.arctan(x[None] * y[:, None] / np.sqrt(1 + x[None] ** 2 + y[:, None] ** 2))
    return corner[1:, 1:] - corner[1:, :-1] - corner[:-1, 1:] + corner[:-1, :-1]


def rms_of(intensity, wanted, angle, target):
    scale = (wanted * angle)[target].sum() / (intensity * angle)[target].sum()
    over = (intensity * scale - wanted)[target]
    return np.sqrt((over**2 * angle[target]).sum() / (wanted**2 * angle)[target].sum()), scale


def judge(out, name, more, away, rays, lambert):
    table = np.loadtxt(out / "intensity.csv", delimiter=",", skiprows=1)
    tangents = np.tan(np.radians(table[:, :2]))
    half = tangents.max(0) * CELLS / (CELLS - 1)
    fine = 8
    tx, ty = (((np.arange(CELLS * fine) + 0.5) / CELLS / fine * 2 - 1) * h for h in half)
    wanted = wanted_at(name, more, tx[None], -ty[:, None]).reshape(CELLS, fine, CELLS, fine).mean((1, 3))
    angle, target = steradians(half), wanted > 0.01 * wanted.max()
    solid = Solid(out / "object.stl")
    traced = [trace(solid, half, away, rays // 2, lambert, seed) for seed in (1, 2)]
    halves, sent = [light / angle for light, _ in traced], np.mean([all_sent for _, all_sent in traced])
    rms, _ = rms_of((halves[0] + halves[1]) / 2, wanted, angle, target)
    mean = (halves[0] + halves[1]) / 2
    scale = (wanted * angle)[target].sum() / (mean * angle)[target].sum()
    noise = np.sqrt((((halves[0] - halves[1]) / 2 * scale) ** 2 * angle)[target].sum()
                    / (wanted**2 * angle)[target].sum())
    there = (mean * angle)[target].sum()
    own = json.loads((out / "run.json").read_text())
    figures = own.get("far") or own["inverse"]["far"]
    print(f"{name:10} {rms:7.4f} {noise:7.4f} {there:9.3f} {there / sent:7.3f}"
          f"   {figures['rms']:7.4f} {figures['on_target']:7.3f} {figures['uniformity']:7.3f}"
          f" {figures.get('contrast', float('nan')):7.2f}", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("out", type=Path)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--method", default="lens")
    parser.add_argument("--away", type=float, default=200, help="from the front to the lamp, mm")
    parser.add_argument("--lambert", action="store_true")
    parser.add_argument("--rays", type=int, default=4_000_000)
    parser.add_argument("--set", action="append", default=[])
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    print("target         rms  noise on_target of_sent | judge: rms on_target uniformity contrast")
    for name in args.names or [*SHAPES, *FILES]:
        far = {"type": "luminaire", "file": name} if name in FILES else {
            "type": "picture" if name == "ring" else name, **SHAPES[name][1]}
        if name in FILES:
            write_file(args.out / name, FILES[name])
        preset = {"engine": "inverse", "unit": "mm", "scene": {"camera": {"resolution": [256, 512]}}, "inverse": {
            "method": args.method, "facets": [128, 128], "cells": [CELLS, CELLS], "index": INDEX,
            "size_mm": [SIZE, SIZE],
            "thickness_mm": THICKER.get(name, THICK), "far": far, "mesh_error": 0.1,
            "light": {"type": "area", "shape": "disc", "size_mm": [LAMP, LAMP], "distance_mm": args.away}}}
        file = args.out / f"{name}.json"
        file.write_text(json.dumps(preset, indent=1), encoding="ascii")
        folder = args.out / f"run-{name}"
        subprocess.run([args.program, "run", file, "-o", folder]
                       + [part for pair in args.set for part in ("--set", pair)], check=True, capture_output=True)
        judge(folder, name, far, args.away, args.rays, args.lambert)


if __name__ == "__main__":
    main()
