#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the environments of the presets in presets/spectral: latitude-longitude pictures in Radiance's format (RGBE,
run lengths).

    tests/experiments/skies.py presets/spectral
"""
import math
import pathlib
import sys

WIDTH, HEIGHT = 512, 256


def rgbe(colour):
    """Four bytes of a linear colour: three mantissas and their exponent."""
    largest = max(colour)
    if largest < 1e-32:
        return bytes(4)
    mantissa, exponent = math.frexp(largest)
    scale = mantissa * 256 / largest
    return bytes([int(c * scale) for c in colour] + [exponent + 128])


def run_lengths(plane):
    """One component of a row: runs of equal bytes as 128 + count, value; others as count, values."""
    out, i = bytearray(), 0
    while i < len(plane):
        run = 1
        while run < 127 and i + run < len(plane) and plane[i + run] == plane[i]:
            run += 1
        if run > 2:
            out += bytes([128 + run, plane[i]])
            i += run
            continue
        start = i
        while i < len(plane) and i - start < 128 and not (i + 2 < len(plane)
                                                          and plane[i] == plane[i + 1] == plane[i + 2]):
            i += 1
        out += bytes([i - start]) + plane[start:i]
    return bytes(out)


def write(file, colour_at):
    """colour_at(azimuth, elevation) in degrees: azimuth from -z to the right, the middle of each texel."""
    with open(file, "wb") as out:
        out.write(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {HEIGHT} +X {WIDTH}\n".encode())
        for row in range(HEIGHT):
            texels = [rgbe(colour_at((column + 0.5) / WIDTH * 360 - 180, 90 - (row + 0.5) / HEIGHT * 180))
                      for column in range(WIDTH)]
            out.write(bytes([2, 2, WIDTH >> 8, WIDTH & 255]))
            for part in range(4):
                out.write(run_lengths(bytes(t[part] for t in texels)))


def mixed(a, b, t):
    return [x + (y - x) * t for x, y in zip(a, b)]


def low_sun(azimuth, elevation):
    """A clear evening: blue above, pale at the horizon, warm ground, a sun of 1.4 degrees 24 degrees up on the left."""
    aside = math.radians(azimuth + 60) * math.cos(math.radians(elevation))
    above = math.radians(elevation - 24)
    from_sun = math.degrees(math.hypot(aside, above))
    if from_sun < 0.7:
        return [36000, 29000, 20000]
    if elevation < 0:
        return [0.10, 0.08, 0.06]
    return mixed([0.9, 0.75, 0.6], [0.12, 0.25, 0.6], min(1, math.sin(math.radians(elevation)) ** 0.5))


def windows(azimuth, elevation):
    """A dim room with three narrow lamps, one warm, one white, one cold."""
    lamps = [(-100, 45, 5, 12, [320, 190, 90]), (20, 62, 8, 4, [260, 260, 260]), (115, 35, 4, 14, [80, 150, 330])]
    for middle, height, half_width, half_height, colour in lamps:
        if abs(azimuth - middle) < half_width and abs(elevation - height) < half_height:
            return colour
    return [0.05, 0.05, 0.06] if elevation > 0 else [0.02, 0.02, 0.02]


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1])
    write(folder / "low-sun.hdr", low_sun)
    write(folder / "three-lamps.hdr", windows)
