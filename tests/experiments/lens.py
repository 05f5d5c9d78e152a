#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Judges a lens of engine 3 by its STL alone, with no line of the program's own code. Needs numpy and Pillow.

    tests/experiments/lens.py OUT/object.stl --index 1.55 --distance 150 --picture photo.png   rel_l2 at 64 to 256 cells
    tests/experiments/lens.py OUT/object.stl --index 1.55 --distance 150 --rings 128           of even grey, 128 x 128

Parallel light falls straight onto the front, and on each triangle of the relief as much as it covers of the front: at
random points of the triangle. Snell's law in vectors and Fresnel's equations bend and weaken it. A ray leaves a height
field for good where no triangle is as steep as the ray would have to be to meet it again. That is checked, so every
point is one ray.
"""
import argparse
import sys

import numpy as np
from PIL import Image


def relief(stl):
    """Corners (n, 3, 3) and outward normals of the triangles that face down, without sides and front."""
    with open(stl, "rb") as file:
        count = int(np.frombuffer(file.read(84), "<u4", offset=80)[0])
        rows = np.fromfile(file, np.dtype([("f", "<f4", (4, 3)), ("attribute", "<u2")]), count)
    if len(rows) != count:
        sys.exit(f"{stl}: has {len(rows)} triangles of {count}")
    corners = rows["f"][:, 1:].astype(float)
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    down = across[:, 2] < -1e-9 * np.linalg.norm(across, axis=1)
    corners, across = corners[down], across[down]
    return corners, across / np.linalg.norm(across, axis=1, keepdims=True), -across[:, 2] / 2


def leaves(normals, n):
    """Directions behind the relief of light along -z, and the part of it that is not reflected."""
    cos_in = -normals[:, 2]
    squared = 1 - n * n * (1 - cos_in**2)
    cos_out = np.sqrt(np.maximum(squared, 0))
    direction = n * np.array([0, 0, -1.0]) + (cos_out - n * cos_in)[:, None] * normals
    s, p = (n * cos_in - cos_out) / (n * cos_in + cos_out), (cos_in - n * cos_out) / (cos_in + n * cos_out)
    return direction, np.where(squared > 0, 1 - (s * s + p * p) / 2, 0)


def trace(stl, n, distance, receiver, cells, rays, seed):
    """Light a cell, row 0 at the top, as parts of all light; and the part of it that is sent."""
    corners, normals, areas = relief(stl)
    directions, passed = leaves(normals, n)
    slopes = directions[:, :2] / -directions[:, 2:]
    steepness = np.linalg.norm(normals[:, :2], axis=1) / -normals[:, 2]
    if steepness.max() * np.linalg.norm(slopes, axis=1).max() >= 1:
        sys.exit("a ray might meet the relief twice, which is not traced")
    light = np.zeros(cells * cells)
    random = np.random.default_rng(seed)
    points = max(1, round(rays / len(areas)))
    power = areas * passed / areas.sum()
    # strata of the distance from a corner; steps by the golden ratio across, from a random begin
    for k in range(points):
        if k == 0:
            begin = random.random(len(areas))
        root, v = np.sqrt((k + random.random(len(areas))) / points), (begin + 0.6180339887 * k) % 1
        at = ((1 - root)[:, None] * corners[:, 0] + (root * (1 - v))[:, None] * corners[:, 1]
              + (root * v)[:, None] * corners[:, 2])
        hit = at[:, :2] + slopes * (distance + at[:, 2])[:, None]
        x = np.floor((hit[:, 0] / receiver[0] + 0.5) * cells).astype(int)
        y = np.floor((0.5 - hit[:, 1] / receiver[1]) * cells).astype(int)
        inside = (x >= 0) & (y >= 0) & (x < cells) & (y < cells)
        light += np.bincount((y * cells + x)[inside], power[inside] / points, len(light))
    return light.reshape(cells, cells), power.sum()


def rel_l2(wanted, there):
    wanted, there = wanted / wanted.sum(), there / there.sum()
    return np.linalg.norm(wanted - there) / np.linalg.norm(wanted)


def coarser(picture, times):
    rows, columns = picture.shape
    return picture.reshape(rows // times, times, columns // times, times).sum(axis=(1, 3))


def picture_of(file, cells):
    """Luminance a cell of a grey sRGB file that is a multiple of the cells."""
    grey = np.asarray(Image.open(file).convert("L")).astype(float) / 255
    return coarser(np.where(grey > 0.04045, ((grey + 0.055) / 1.055) ** 2.4, grey / 12.92), len(grey) // cells)


def rings(a):
    """How strongly an even grey waves as often as there are facets, and halves of facets. Two traces with other points
    have the same waves and another noise. So the mean of one's spectrum times the other's is that of the waves, and the
    spectrum of their difference is the noise. Middle half of the picture, four cells a facet, along rows."""
    cells, middle = 4 * a.rings, slice(a.rings, 3 * a.rings)
    window = np.hanning(2 * a.rings)
    one, two = ((light / light.mean() - 1) * window for light in
                (trace(a.stl, a.index, a.distance, a.receiver, cells, a.rays, seed)[0][middle, middle]
                 for seed in (1, 2)))
    first, second = np.fft.rfft(one, axis=1), np.fft.rfft(two, axis=1)
    waves, noise = (first * second.conj()).real.mean(axis=0), (np.abs(first - second) ** 2).mean(axis=0) / 2
    as_amplitude = 2 / window.sum()
    uncertain = np.sqrt(noise[1:].mean() / np.sqrt(len(first))) * as_amplitude
    coarse = 8 + int(np.argmax(waves[8:a.rings // 8 + 1]))  # longer ones are the light's fall towards the rim
    for name, at in (("strongest of four facets and longer", coarse), ("facets", a.rings // 2),
                     ("half facets", a.rings)):
        often, power = 2 * at, waves[at - 1:at + 2].max()  # `at` is in the middle half
        print(f"{name}: waves of {np.sqrt(max(power, 0)) * as_amplitude:.5f} of the grey, {often} across; "
              f"told from noise above {uncertain:.5f}; one ray's noise {np.sqrt(noise[at]) * as_amplitude:.5f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stl")
    parser.add_argument("--index", type=float, required=True)
    parser.add_argument("--distance", type=float, required=True, help="mm")
    parser.add_argument("--receiver", type=float, nargs=2, default=[100, 100], help="mm")
    parser.add_argument("--picture", help="a file whose sides are multiples of 256")
    parser.add_argument("--rings", type=int, help="facets across")
    parser.add_argument("--rays", type=float, default=2e7)
    a = parser.parse_args()
    if a.rings:
        return rings(a)
    light, sent = trace(a.stl, a.index, a.distance, a.receiver, 256, a.rays, 1)
    errors = [rel_l2(picture_of(a.picture, cells), coarser(light, 256 // cells)) for cells in (64, 128, 256)]
    print("rel_l2 at 64, 128, 256 cells: " + ", ".join(f"{e:.4f}" for e in errors))
    print(f"sent {sent:.4f}, of it beside the receiver {1 - light.sum() / sent:.4f}")


if __name__ == "__main__":
    main()
