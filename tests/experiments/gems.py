#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Light return of the stones in gems/, by a ray tracer of its own and by Nephroid. Needs numpy.

    tests/experiments/gems.py PROGRAM FOLDER [--rays 1000000] [--passes 256] [--size 128] [--stones round-brilliant ...]

Light return is the mean radiance over a stone's outline, seen from straight above, over the zenith's. Three skies, dark
below the horizon: ISO is even; COS falls as the cosine of the angle from the zenith; HEAD is even, but dark within 20
degrees of the vertical, as where a head looks at the stone.

The tracer shares no line with the program. It reads the .asc, and a stone is its half-spaces. A ray from above is split
at the crown; inside it is reflected or refracted at random by Fresnel's equations, without polarization, until it has
left. Nephroid imports the .asc; its preset gets an orthographic camera and the sky as a file, and loses table and lamp.
All light of the picture is the stone's, so its sum is taken, over the area of the outline. Both errors are one standard
deviation of the mean: the tracer's by its rays, Nephroid's by two seeds.
"""
import argparse
import itertools
import json
import math
import pathlib
import subprocess

import numpy as np
from layers import read_layer, write_pfm

HERE = pathlib.Path(__file__).resolve().parent
LUMINANCE = np.array([.2126729, .7151522, .0721750])
HEAD_DEG = 20
SKIES = {
    "ISO": lambda up: np.where(up > 0, 1.0, 0.0),
    "COS": lambda up: np.maximum(up, 0.0),
    "HEAD": lambda up: np.where((up > 0) & (up < math.cos(math.radians(HEAD_DEG))), 1.0, 0.0),
}


class Stone:
    """Unit normals (n, 3), +y up, and distances of the planes; corners; the area of the outline; one unit in mm."""

    def __init__(self, file):
        self.normals, self.distances = [], []
        for line in file.read_text().splitlines():
            key, *words = line.split()
            if key == "g":
                gear = float(words[0])
            elif key == "I":
                self.n = float(words[0])
            elif key == "a":
                self.add(words, gear)
        self.normals, self.distances = np.array(self.normals), np.array(self.distances)
        self.corners = self.meets()
        across = self.corners[:, [0, 2]]
        self.low, self.high = across.min(axis=0), across.max(axis=0)
        self.mm = 10 / max(self.high - self.low)
        self.area = hull_area(across)

    def add(self, words, gear):
        angle, distance = math.radians(float(words[0])), float(words[1])
        up = -1 if words[0].startswith("-") else 1
        words = words[2:words.index("G")] if "G" in words else words[2:]
        for at, word in enumerate(words):
            if word == "n" or words[at - 1] == "n" and at > 0:
                continue
            turn = 2 * math.pi * float(word) / gear
            out = math.sin(abs(angle))
            self.normals.append([out * math.cos(turn), up * math.cos(angle), -out * math.sin(turn)])
            self.distances.append(distance)

    def meets(self):
        """Where three planes meet and no other one cuts that off."""
        threes = np.array(list(itertools.combinations(range(len(self.normals)), 3)))
        found = []
        for part in np.array_split(threes, 1 + len(threes) // 20000):
            planes = self.normals[part]
            part = part[np.abs(np.linalg.det(planes)) > 1e-6]
            points = np.linalg.solve(self.normals[part], self.distances[part][..., None])[..., 0]
            inside = (points @ self.normals.T <= self.distances + 1e-9).all(axis=1)
            found.append(points[inside])
        return np.concatenate(found)


def hull_area(points):
    """Of the convex hull of points in a plane (Andrew 1979)."""
    points = sorted(map(tuple, points))
    half = []
    for line in (points, points[::-1]):
        chain = []
        for p in line:
            while len(chain) > 1 and ((chain[-1][0] - chain[-2][0]) * (p[1] - chain[-2][1])
                                      - (chain[-1][1] - chain[-2][1]) * (p[0] - chain[-2][0])) <= 0:
                chain.pop()
            chain.append(p)
        half += chain[:-1]
    x, y = np.array(half).T
    return abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def fresnel(cos_in, ratio):
    """Part reflected, unpolarized, and the cosine behind the surface; ratio: index before over index behind."""
    squared = 1 - ratio**2 * (1 - cos_in**2)
    cos_out = np.sqrt(np.maximum(squared, 0))
    s = (ratio * cos_in - cos_out) / (ratio * cos_in + cos_out)
    p = (cos_in - ratio * cos_out) / (cos_in + ratio * cos_out)
    return np.where(squared > 0, (s * s + p * p) / 2, 1.0), cos_out


def bent(directions, normals, cos_in, cos_out, ratio):
    """Refracted directions; the normals look against the rays."""
    return ratio * directions + (ratio * cos_in - cos_out)[:, None] * normals


def light_return(stone, rays):
    """Mean and its standard deviation, by sky; and the part of the rays that goes round for ever, as in a cube."""
    at_once = 100000
    parts = [part_of_light(stone, at_once, seed) for seed in range(max(1, rays // at_once))]
    light = {name: np.concatenate([totals[name] for totals, _ in parts]) for name in SKIES}
    lost = sum(lost for _, lost in parts) / len(light["ISO"])
    return {name: (t.mean(), t.std() / math.sqrt(len(t))) for name, t in light.items()}, lost


def part_of_light(stone, rays, seed):
    """Light of each ray that meets the stone, by sky; and how many of them have not left."""
    random = np.random.default_rng(seed)
    normals, distances = stone.normals, stone.distances
    across = stone.low + random.random((rays, 2)) * (stone.high - stone.low)
    # The ray's heights: it enters at the lowest plane that looks up, where no plane keeps it out.
    up, down, side = normals[:, 1] > 1e-12, normals[:, 1] < -1e-12, np.abs(normals[:, 1]) <= 1e-12
    rest = distances - across @ normals[:, [0, 2]].T
    heights = np.where(up, rest / np.where(up, normals[:, 1], 1), np.inf)
    face, top = heights.argmin(axis=1), heights.min(axis=1)
    bottom = np.where(down, rest / np.where(down, normals[:, 1], 1), -np.inf).max(axis=1)
    hit = (top > bottom) & (~side | (rest > 0)).all(axis=1)
    face, points = face[hit], np.column_stack([across[hit, 0], top[hit], across[hit, 1]])
    count = len(face)
    totals = {name: np.zeros(count) for name in SKIES}
    d = np.tile([0.0, -1.0, 0.0], (count, 1))
    n = normals[face]
    cos_in = n[:, 1]
    reflected, cos_out = fresnel(cos_in, 1 / stone.n)
    for name, sky in SKIES.items():
        totals[name] += reflected * sky((d + 2 * cos_in[:, None] * n)[:, 1])
    ray, weight = np.arange(count), 1 - reflected
    d = bent(d, n, cos_in, cos_out, 1 / stone.n)
    for _ in range(2000):
        if not len(ray):
            break
        slope = d @ normals.T
        gap = np.maximum(distances - points @ normals.T, 0)
        way = np.where(slope > 1e-12, gap / np.where(slope > 1e-12, slope, 1), np.inf)
        way[np.arange(len(ray)), face] = np.inf
        face = way.argmin(axis=1)
        points = points + way[np.arange(len(ray)), face][:, None] * d
        n = normals[face]
        cos_in = np.einsum("ij,ij->i", d, n)
        reflected, cos_out = fresnel(cos_in, stone.n)
        leaves = random.random(len(ray)) >= reflected
        away = bent(d[leaves], -n[leaves], cos_in[leaves], cos_out[leaves], stone.n)[:, 1]
        for name, sky in SKIES.items():
            totals[name][ray[leaves]] += weight[ray[leaves]] * sky(away)
        stays = ~leaves
        d = (d - 2 * cos_in[:, None] * n)[stays]
        points, face, ray = points[stays], face[stays], ray[stays]
    return totals, len(ray)


def write_skies(folder):
    """Latitude and longitude; a quarter of a degree a row, so that the edges lie between rows."""
    rows = 720
    up = np.cos((np.arange(rows) + .5) * math.pi / rows)
    for name, sky in SKIES.items():
        write_pfm(folder / f"{name}.pfm", np.broadcast_to(sky(up)[:, None, None], (rows, 2 * rows, 3)))


def nephroid(program, folder, file, stone, sky, seed, size, passes):
    """The mean over the stone's outline of the picture."""
    preset = folder / f"{file.stem}.json"
    if not preset.exists():
        subprocess.run([program, "import", str(file), "-o", str(preset)], check=True, capture_output=True)
    scene = json.loads(preset.read_text())
    height = 10.5
    scene["white"] = 1
    scene["scene"]["objects"] = [o for o in scene["scene"]["objects"] if o["name"] == "stone"]
    scene["scene"]["lights"] = []
    middle = stone.mm * (stone.low + stone.high) / 2
    scene["scene"]["camera"] = {
        "position": [middle[0], 100, middle[1]], "target": [middle[0], 0, middle[1]], "up": [0, 0, -1],
        "projection": "orthographic", "height": height, "resolution": [size, size]}
    scene["scene"]["environment"] = {"type": "file", "file": f"{sky}.pfm", "lights": True}
    scene["stop"] = {"passes": passes}
    scene["seed"] = seed
    own = folder / f"{file.stem}-{sky}-{seed}.json"
    own.write_text(json.dumps(scene))
    out = folder / f"{file.stem}-{sky}-{seed}"
    if not (out / "image.exr").exists():
        subprocess.run([program, "run", str(own), "-o", str(out)], check=True, capture_output=True)
    luminance = read_layer(out / "image.exr", "") @ LUMINANCE
    return luminance.sum() * (height / size) ** 2 / (stone.area * stone.mm**2)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--rays", type=int, default=1000000, help="of the tracer, within the box about the outline")
    parser.add_argument("--passes", type=int, default=256)
    parser.add_argument("--size", type=int, default=128, help="of the picture, in pixels")
    parser.add_argument("--stones", nargs="*", help="without it all")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    write_skies(options.folder)
    worst = 0
    print("| stone | sky | tracer % | error | Nephroid % | error | ratio |\n|---|---|---|---|---|---|---|")
    for file in sorted((HERE / "gems").glob("*.asc")):
        if options.stones and file.stem not in options.stones:
            continue
        stone = Stone(file)
        traced, lost = light_return(stone, options.rays)
        for sky, (mean, error) in traced.items():
            first, second = (nephroid(options.program, options.folder, file, stone, sky, seed, options.size,
                                      options.passes) for seed in (1, 2))
            ours, spread = (first + second) / 2, abs(first - second) / 2
            worst = max(worst, abs(ours / mean - 1))
            print(f"| {file.stem} | {sky} | {100 * mean:.3f} | {100 * error:.3f} | {100 * ours:.3f} | "
                  f"{100 * spread:.3f} | {ours / mean:.4f} |", flush=True)
        if lost:
            print(f"{100 * lost:.3g} % of the rays stay in {file.stem}", flush=True)
    print(f"largest difference {100 * worst:.2f} %")


if __name__ == "__main__":
    main()
