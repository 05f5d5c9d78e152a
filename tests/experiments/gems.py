#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Light return of the stones in gems/, by a ray tracer of its own and by Nephroid. Needs numpy.

    tests/experiments/gems.py PROGRAM FOLDER [--rays 1000000] [--passes 256] [--size 128] [--stones round-brilliant ...]
        [--tilts 0 10 -20] [--material materials/diamond-Peter.yml]

Light return is the mean radiance over a stone's outline, seen from straight above, over the zenith's. Three skies, dark
below the horizon: ISO is even; COS falls as the cosine of the angle from the zenith; HEAD is even, but dark within 20
degrees of the vertical, as where a head looks at the stone.

The tracer shares no line with the program. It reads the .asc, and a stone is its half-spaces. A ray from above is split
at the crown; inside it is reflected or refracted at random by Fresnel's equations, without polarization, until it has
left. Nephroid imports the .asc; its preset gets an orthographic camera and the sky as a file, and loses table and lamp.
All light of the picture is the stone's, so its sum is taken, over the area of the outline. Both errors are one standard
deviation of the mean: the tracer's by its rays, Nephroid's by two seeds. --passes 0 leaves pictures out.

`nephroid gem` is asked, too, at each of the tilts about x, with the half width of its 95 % interval. Where the material
disperses, the tracer takes its indices for d, C and F, and follows C and F along the surfaces that d meets: fire is the
mean angle between them where they leave, of the light that ISO returns. Scintillation is the mean change of HEAD at a
place by a degree of tilt, of branches that are followed to the last ten thousandth.
"""
import argparse
import copy
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
                self.lines = [self.n] * 3
            elif key == "a":
                self.add(words, gear)
        self.normals, self.distances = np.array(self.normals), np.array(self.distances)
        self.corners = self.meets()
        across = self.corners[:, [0, 2]]
        self.low, self.high = across.min(axis=0), across.max(axis=0)
        self.mm = 10 / max(self.high - self.low)
        self.area = hull_area(across)

    def turned(self, axis, degrees):
        """The same stone, turned about the middle of its bounds: about x (0) or z (2), counter-clockwise seen from the
        axis' positive end."""
        other = copy.copy(self)
        middle = (self.corners.min(axis=0) + self.corners.max(axis=0)) / 2
        other.distances = self.distances - self.normals @ middle
        turn, one, two = math.radians(degrees), (axis + 1) % 3, (axis + 2) % 3
        rotation = np.eye(3)
        rotation[[one, two], [one, two]] = math.cos(turn)
        rotation[two, one] = math.sin(turn)
        rotation[one, two] = -math.sin(turn)
        other.normals, other.corners = self.normals @ rotation.T, (self.corners - middle) @ rotation.T
        across = other.corners[:, [0, 2]]
        other.low, other.high = across.min(axis=0), across.max(axis=0)
        return other

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


def bent(directions, normals, ratio):
    """Refracted directions; the normals look against the rays. Where there is total reflection they are not finite."""
    cos_in = -np.einsum("ij,ij->i", directions, normals)
    with np.errstate(invalid="ignore"):
        cos_out = np.sqrt(1 - ratio**2 * (1 - cos_in**2))
    return ratio * directions + (ratio * cos_in - cos_out)[:, None] * normals


def mirrored(directions, normals):
    return directions - 2 * np.einsum("ij,ij->i", directions, normals)[:, None] * normals


def light_return(stone, rays):
    """Mean and its standard deviation, by sky and of fire; and the part of the rays that goes round for ever."""
    at_once = 100000
    parts = [part_of_light(stone, at_once, seed) for seed in range(max(1, rays // at_once))]
    light = {name: np.concatenate([totals[name] for totals, _ in parts]) for name in [*SKIES, "angle", "followed"]}
    lost = sum(lost for _, lost in parts) / len(light["ISO"])
    means = {name: (light[name].mean(), light[name].std() / math.sqrt(len(light[name]))) for name in SKIES}
    fire = light["angle"].mean() / light["followed"].mean()
    rest = light["angle"] - fire * light["followed"]
    means["fire"] = fire, rest.std() / math.sqrt(len(rest)) / light["followed"].mean()
    return means, lost


def enter(stone, across):
    """Where rays from above meet the stone: their numbers, facets and points. A ray enters at the lowest plane that
    looks up, where no plane keeps it out."""
    normals, distances = stone.normals, stone.distances
    up, down, side = normals[:, 1] > 1e-12, normals[:, 1] < -1e-12, np.abs(normals[:, 1]) <= 1e-12
    rest = distances - across @ normals[:, [0, 2]].T
    heights = np.where(up, rest / np.where(up, normals[:, 1], 1), np.inf)
    face, top = heights.argmin(axis=1), heights.min(axis=1)
    bottom = np.where(down, rest / np.where(down, normals[:, 1], 1), -np.inf).max(axis=1)
    hit = np.flatnonzero((top > bottom) & (~side | (rest > 0)).all(axis=1))
    return hit, face[hit], np.column_stack([across[hit, 0], top[hit], across[hit, 1]])


def next_facet(stone, points, d, face):
    slope = d @ stone.normals.T
    gap = np.maximum(stone.distances - points @ stone.normals.T, 0)
    way = np.where(slope > 1e-12, gap / np.where(slope > 1e-12, slope, 1), np.inf)
    way[np.arange(len(face)), face] = np.inf
    face = way.argmin(axis=1)
    return face, points + way[np.arange(len(face)), face][:, None] * d


def part_of_light(stone, rays, seed):
    """Light of each ray that meets the stone, by sky; the same of ISO whose lines all leave, alone and times the angle
    between C and F in degrees; and how many of the rays have not left."""
    random = np.random.default_rng(seed)
    _, face, points = enter(stone, stone.low + random.random((rays, 2)) * (stone.high - stone.low))
    count = len(face)
    totals = {name: np.zeros(count) for name in [*SKIES, "angle", "followed"]}

    def add(ray, weight, lines):
        for name, sky in SKIES.items():
            totals[name][ray] += weight * sky(lines[0][:, 1])
        weight = weight * SKIES["ISO"](lines[0][:, 1]) * (np.isfinite(lines[1]) & np.isfinite(lines[2])).all(axis=1)
        angle = np.degrees(2 * np.arcsin(np.minimum(np.linalg.norm(lines[1] - lines[2], axis=1) / 2, 1)))
        totals["followed"][ray] += weight
        totals["angle"][ray] += np.where(weight > 0, weight * angle, 0)

    lines = [np.tile([0.0, -1.0, 0.0], (count, 1))] * 3  # d, C, F
    n = stone.normals[face]
    reflected, _ = fresnel(n[:, 1], 1 / stone.n)
    ray = np.arange(count)
    add(ray, reflected, [mirrored(d, n) for d in lines])
    weight = 1 - reflected
    lines = [bent(d, n, 1 / index) for d, index in zip(lines, stone.lines)]
    for _ in range(2000):
        if not len(ray):
            break
        face, points = next_facet(stone, points, lines[0], face)
        n = stone.normals[face]
        reflected, _ = fresnel(np.einsum("ij,ij->i", lines[0], n), stone.n)
        leaves = random.random(len(ray)) >= reflected
        add(ray[leaves], weight[ray[leaves]],
            [bent(d[leaves], -n[leaves], index) for d, index in zip(lines, stone.lines)])
        stays = ~leaves
        lines = [mirrored(d, n)[stays] for d in lines]
        points, face, ray = points[stays], face[stays], ray[stays]
    return totals, len(ray)


def head_of(stone, across):
    """HEAD of each ray, with its branches; NaN where it misses the stone."""
    hit, face, points = enter(stone, across)
    light = np.full(len(across), np.nan)
    d, n = np.tile([0.0, -1.0, 0.0], (len(hit), 1)), stone.normals[face]
    part, _ = fresnel(n[:, 1], 1 / stone.n)
    light[hit] = part * SKIES["HEAD"](mirrored(d, n)[:, 1])
    d, weight = bent(d, n, 1 / stone.n), 1 - part
    for _ in range(2000):
        if not len(hit):
            break
        face, points = next_facet(stone, points, d, face)
        n = stone.normals[face]
        part, _ = fresnel(np.einsum("ij,ij->i", d, n), stone.n)
        out = np.nan_to_num(bent(d, -n, stone.n)[:, 1], nan=-1.0)
        light[hit] += weight * (1 - part) * SKIES["HEAD"](out)
        weight = weight * part
        stays = weight > 1e-4
        d, points, face, hit, weight = mirrored(d, n)[stays], points[stays], face[stays], hit[stays], weight[stays]
    return light


def scintillation(stone, rays):
    changes = []
    for seed in range(max(1, rays // 100000)):
        for axis in (0, 2):
            one, two = stone.turned(axis, -.5), stone.turned(axis, .5)
            low, high = np.minimum(one.low, two.low), np.maximum(one.high, two.high)
            across = low + np.random.default_rng(seed).random((100000, 2)) * (high - low)
            change = np.abs(head_of(one, across) - head_of(two, across))
            changes.append(change[np.isfinite(change)])
    changes = np.concatenate(changes)
    return changes.mean(), changes.std() / math.sqrt(len(changes))


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


def measured(program, file, folder, material):
    """What `nephroid gem` says of a stone."""
    words = [program, "gem", str(file), "--json", "-o", str(folder / f"{file.stem}-gem")]
    done = subprocess.run(words + (["--material", material] if material else []), check=True, capture_output=True)
    return json.loads(done.stdout)


class Table:
    """Rows of a Markdown table, and the largest difference in them."""

    def __init__(self):
        self.worst = 0
        print("\n| stone | what | tracer | error | Nephroid | error | ratio |\n|---|---|---|---|---|---|---|")

    def row(self, stone, what, theirs, ours):
        """theirs, ours: a value and its error."""
        ratio = ours[0] / theirs[0] if theirs[0] else 1
        self.worst = max(self.worst, abs(ratio - 1))
        numbers = " | ".join(f"{number:.4f}" for number in [*theirs, *ours, ratio])
        print(f"| {stone} | {what} | {numbers} |", flush=True)

    def end(self):
        print(f"largest difference {100 * self.worst:.2f} %")


def compare_gem(table, options, file, stone):
    report = measured(options.program, file, options.folder, options.material)
    stone.n, *stone.lines[1:] = stone.lines[:] = [report["n"][line] for line in ("d", "C", "F")]

    def ours(interval):
        return interval["value"], (interval["high"] - interval["low"]) / 2

    for tilt in options.tilts:
        traced, _ = light_return(stone.turned(0, tilt), options.rays)
        returns = next(t for t in report["tilts"] if t["axis"] == "x" and t["angle_deg"] == tilt)
        for sky in SKIES:
            table.row(file.stem, f"{sky} at {tilt}", traced[sky], ours(returns[sky.lower()]))
        if tilt == 0 and report["fire_deg"]:
            table.row(file.stem, "fire", traced["fire"], ours(report["fire_deg"]))
    table.row(file.stem, "scintillation", scintillation(stone, options.rays), ours(report["scintillation_per_deg"]))


def compare_pictures(table, options, file, stone):
    traced, lost = light_return(stone, options.rays)
    for sky in SKIES:
        first, second = (nephroid(options.program, options.folder, file, stone, sky, seed, options.size,
                                  options.passes) for seed in (1, 2))
        table.row(file.stem, sky, traced[sky], ((first + second) / 2, abs(first - second) / 2))
    if lost:
        print(f"{100 * lost:.3g} % of the rays stay in {file.stem}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--rays", type=int, default=1000000, help="of the tracer, within the box about the outline")
    parser.add_argument("--passes", type=int, default=256)
    parser.add_argument("--size", type=int, default=128, help="of the picture, in pixels")
    parser.add_argument("--stones", nargs="*", help="without it all")
    parser.add_argument("--tilts", nargs="*", type=int, default=[0], help="multiples of 5 from -30 to 30")
    parser.add_argument("--material", default="", help="for `nephroid gem`, instead of the file's index")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    write_skies(options.folder)
    files = [f for f in sorted((HERE / "gems").glob("*.asc")) if not options.stones or f.stem in options.stones]
    for compare in [compare_gem] + ([compare_pictures] if options.passes else []):
        table = Table()
        for file in files:
            compare(table, options, file, Stone(file))
        table.end()


if __name__ == "__main__":
    main()
