#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How well can any object cast several pictures? Prints the table "Past the conflict" of docs/notebook/inverse.md.

    tests/experiments/floors.py [bars|star|lights...]

"lights" prints the table "A picture for each light" instead: pictures at one distance, each in a light of its own. To
the rays that is a picture beside the others by what its light moves them along.

Light is a sum of rays, each from a place of the object in a direction; a ray meets every receiver. Their powers are
what least squares ask for, at each picture's own brightness (multiplicative steps, as ISRA has them: Daube-Witherspoon
and Muehllehner 1986). No surface bends that light, so that the error is below what an object of glass can reach, but
for the rays' number: pictures have 32 x 32 cells here.

"even": every place of the object sends as much as any other, as a flat front in parallel light does. "free": each sends
what it likes, as behind any optics before the facets: a second refracting side, lens arrays, a lamp. "half dark": each
sends up to twice its share or less, and what is left over is thrown away. Needs numpy.
"""
import sys

import numpy as np

CELLS, PLACES, DIRECTIONS, STEPS = 32, 30, 40, 300
SIDE = 100.0  # of a receiver, in millimetres


def plane():
    along = (np.arange(4 * CELLS) + 0.5) / (4 * CELLS) * SIDE - SIDE / 2
    return np.meshgrid(along, -along)


def in_cells(inside):
    return inside.astype(float).reshape(CELLS, 4, CELLS, 4).mean((1, 3))


def bar(upright):
    x, y = plane()[::-1] if upright else plane()
    return in_cells((abs(x) <= 30) & (abs(y) <= 6))


def star(turn_deg, outer=34, inner=14, points=5):
    x, y = plane()
    half = np.pi / points
    angle = np.mod(np.arctan2(y, x) - np.radians(turn_deg) - np.pi / 2, 2 * half)
    angle, r = np.minimum(angle, 2 * half - angle), np.hypot(x, y)
    dx, dy = inner * np.cos(half) - outer, inner * np.sin(half)
    return in_cells(dx * r * np.sin(angle) - dy * (r * np.cos(angle) - outer) >= 0)


SETS = {"bars": (np.array([100.0, 150, 200, 250]), [bar(False), bar(True), bar(False), bar(True)]),
        "star": (np.arange(100.0, 301, 25), [star(8 * i) for i in range(9)])}


def error(distances, pictures, size=SIDE, light="even", offsets=None, room=75.0):
    """rel_l2 of each picture, and the part of the light on each receiver. room: how far from the axis rays go, half
    way."""
    random = np.random.default_rng(1)
    offsets = np.zeros((len(distances), 2)) if offsets is None else np.array(offsets, float)
    place = (np.arange(PLACES) + 0.5) / PLACES * size - size / 2
    way = (np.arange(DIRECTIONS) + 0.5) / DIRECTIONS * 2 * room - room
    rays = np.stack([a.ravel() for a in np.meshgrid(place, place, way, way, indexing="ij")])
    rays += (random.random(rays.shape) - 0.5) * np.array([[size / PLACES]] * 2 + [[2 * room / DIRECTIONS]] * 2)
    slopes = (rays[2:] - rays[:2]) / np.mean(distances)
    kept = np.hypot(*slopes) < 1
    start, slopes = rays[:2, kept], slopes[:, kept]
    source = np.flatnonzero(kept) // DIRECTIONS**2
    cells = []  # of each ray on each receiver; the last one is beside it
    for distance, offset in zip(distances, offsets):
        x, y = (start + slopes * distance - offset[:, None]) / SIDE + 0.5
        column, row = np.floor(x * CELLS).astype(int), np.floor((1 - y) * CELLS).astype(int)
        inside = (column >= 0) & (column < CELLS) & (row >= 0) & (row < CELLS)
        cells.append(np.where(inside, row * CELLS + column, CELLS**2))
    wanted = [np.append(p.ravel() / p.sum(), 0) for p in pictures]

    def shared(power):
        if light == "free":
            return power / power.sum()
        of_place = np.maximum(np.bincount(source, power, PLACES**2), 1e-30)
        share = 1 / PLACES**2 / of_place
        return power * (share if light == "even" else np.minimum(1, 2 * share))[source]

    power = shared(np.full(source.size, 1 / source.size))
    for _ in range(STEPS):
        up, down = np.zeros_like(power), np.zeros_like(power)
        for cell, want in zip(cells, wanted):
            there = np.bincount(cell, power, CELLS**2 + 1)
            there[-1] = 0
            bright, norm = there.sum(), (want**2).sum()
            up += (want / norm / bright)[cell]
            down += (there / norm / bright**2)[cell]
        least = 1e-3 * down.mean()
        power = shared(power * np.clip((up + least) / (down + least), 0.2, 5))
    there = [np.bincount(cell, power, CELLS**2 + 1)[:-1] for cell in cells]
    off = [np.linalg.norm(t / t.sum() - w[:-1]) / np.linalg.norm(w) for t, w in zip(there, wanted)]
    return off, [t.sum() / power.sum() for t in there]


def lights():
    """Bars, lying and upright in turn. Light from another direction moves all that is cast along by `step`, as thin
    glass turns it as far: the receiver is met as one that stands so much further to the other side."""
    print("| step over the receiver's side | 2 pictures | 5 pictures |\n|---|---|---|")
    for step in (0.125, 0.25, 0.5, 0.75, 1.0):
        row = []
        for count in (2, 5):
            offsets = [(-(j - (count - 1) / 2) * step * SIDE, 0) for j in range(count)]
            off, part = error(np.full(count, 400.0), [bar(j % 2 == 1) for j in range(count)], offsets=offsets,
                              room=max(75.0, 75 + (count - 1) / 2 * step * SIDE))
            row.append(f"{np.mean(off):.3f} ({np.mean(part):.2f})")
        print(f"| {step} | " + " | ".join(row) + " |", flush=True)


def main():
    if sys.argv[1:] == ["lights"]:
        return lights()
    for name in sys.argv[1:] or SETS:
        distances, pictures = SETS[name]
        apart = 100 * 2.0 ** np.linspace(0, 3, len(distances))
        tries = {"as it is": {}, "free light": {"light": "free"}, "half dark": {"light": "half"},
                 "object of 75 mm": {"size": 75.0}, "object of 140 mm": {"size": 140.0},
                 "object of 200 mm": {"size": 200.0},
                 "twice as far": {"distances": 2 * distances, "room": 120.0},
                 "to 800 mm, evenly in factors": {"distances": apart, "room": 90.0}}
        if name == "bars":
            tries["lying ones first"] = {"pictures": [pictures[0]] * 2 + [pictures[1]] * 2}
            for by in (15, 30):
                tries[f"{by} mm aside"] = {"offsets": [(-by, -by), (by, by), (-by, by), (by, -by)], "room": 90.0}
        print(f"| {name} | rel_l2 | light on the receivers |\n|---|---|---|")
        for label, changes in tries.items():
            off, light = error(**{"distances": distances, "pictures": pictures, **changes})
            print(f"| {label} | {np.mean(off):.3f} | {', '.join(f'{part:.2f}' for part in light)} |", flush=True)


if __name__ == "__main__":
    main()
