#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the turned meshes of presets: a drinking glass, the water in it, a finger ring, straight and bent, a hoop, a
bottle, a wine glass and its wine.

usage: lathe.py [FOLDER]    (presets)

A profile is a list of (radius, height) from below to above along the outside; about the y axis it becomes a closed mesh
that faces outwards. Arcs are fine enough for smooth normals. Centimetres.
"""
import math
import pathlib
import sys


def arc(centre, radius, begin_deg, end_deg, steps):
    """Points of an arc, counter-clockwise where end > begin; 0 degrees is away from the axis, 90 up."""
    angles = [math.radians(begin_deg + (end_deg - begin_deg) * i / steps) for i in range(steps + 1)]
    return [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in angles]


def curve(*corners, steps=8):
    """Points of a cubic Bezier curve, without its last one."""
    def at(t):
        part = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t ** 3]
        return tuple(sum(p * c[axis] for p, c in zip(part, corners)) for axis in (0, 1))

    return [at(i / steps) for i in range(steps)]


def drinking_glass():
    """10 high, walls of 0.24, a floor of 1, rounded wherever it would be sharp. Its sides are straight up."""
    return ([(0, 0), (1.5, 0), (2.9, 0)] + arc((3.1, 0.4), 0.4, -90, 0, 6) + [(3.5, 2), (3.5, 5), (3.5, 8)] +
            arc((3.38, 9.88), 0.12, 0, 180, 8) + [(3.26, 8), (3.26, 5), (3.26, 2)] + arc((2.66, 1.6), 0.6, 0, -90, 8)
            + [(1.3, 1), (0, 1)])


def water():
    """Reaches 0.05 into the floor and the walls of the glass, which hides it there; its top is at 6.5."""
    return ([(0, 0.95), (1.3, 0.95)] + arc((2.66, 1.6), 0.65, -90, 0, 8)
            + [(3.31, 2), (3.31, 4), (3.31, 6.5), (3.27, 6.5), (1.6, 6.5), (0, 6.5)])


def ring():
    """A band of 0.6 across, 0.9 inside, rounded like a D."""
    steps = 24
    around = [2 * math.pi * i / steps for i in range(steps)]

    def place(a):
        across, up = math.cos(a), math.sin(a)
        return (1 + (0.16 if across > 0 else 0.06) * math.copysign(abs(across) ** 0.8, across),
                0.3 * math.copysign(abs(up) ** 0.8, up))

    return [place(a) for a in around]


def hoop():
    """Upright walls from 1 to 1.1, 0.8 high, rounded rims."""
    return (arc((1.05, 0.05), 0.05, 180, 360, 8) + [(1.1, 0.1), (1.1, 0.7)] + arc((1.05, 0.75), 0.05, 0, 180, 8) +
            [(1, 0.7), (1, 0.1)])


def bottle():
    """12.7 high, without its hollow: smaller, it is what fills it."""
    return ([(0, 0), (1.6, 0)] + arc((2.8, 0.4), 0.4, -90, 0, 5) + [(3.2, 0.9), (3.2, 4), (3.2, 7.6)] +
            arc((1.9, 8), 1.3, 0, 62, 8) + [(1.6, 9.6), (1.25, 10.3), (1.12, 11), (1.1, 12.2)] +
            arc((1.1, 12.5), 0.2, -60, 90, 5) + [(0.6, 12.7), (0, 12.7)])


def wine_glass():
    """17.3 high, 7.8 across; its walls are 0.12."""
    return ([(0, 0), (1.6, 0)] + arc((3.22, 0.08), 0.08, -90, 90, 8) +
            curve((3.2, 0.16), (1.6, 0.35), (0.45, 0.5), (0.38, 1.8)) + [(0.36, 3), (0.35, 4.2), (0.36, 5.4)] +
            curve((0.38, 6.6), (0.4, 8), (3.2, 7.6), (4, 11)) + curve((4, 11), (4.35, 12.6), (3.6, 15), (3.1, 17.2)) +
            arc((3.04, 17.24), 0.06, 0, 180, 8) + inside_of_wine_glass()[1:] + [(0, 8.4)])


def inside_of_wine_glass():
    """From the rim down; the bowl's widest is where the second curve begins."""
    return (curve((2.98, 17.2), (3.48, 15), (4.23, 12.6), (3.88, 11)) +
            curve((3.88, 11), (3.08, 7.9), (1, 8.4), (0, 8.4)))


def wine():
    """To the bowl's widest, and 0.04 into the glass, which hides it there."""
    bowl = [(radius + 0.04, height - 0.03) for radius, height in inside_of_wine_glass()[:7:-1]]
    return [(0, 8.37)] + bowl + [(3.92, 11), (3.85, 11), (2, 11), (0, 11)]


def bent(x, y, z):
    """Pressed to an oval whose long ends curl up."""
    return 1.25 * x, y + 0.3 * x * x, 0.75 * z


def turn(profile, segments, closes, place=lambda *at: at):
    """OBJ text. closes: the profile's end joins its begin; else it begins and ends on the axis. place moves a point."""
    def vertex(*at):
        return "v {:.5g} {:.5g} {:.5g}".format(*place(*at))

    lines, rows = [], []
    count = 0
    for radius, height in profile:
        if radius == 0:
            lines.append(vertex(0, height, 0))
            rows.append([count + 1] * segments)
            count += 1
            continue
        for k in range(segments):
            angle = 2 * math.pi * k / segments
            lines.append(vertex(radius * math.cos(angle), height, radius * math.sin(angle)))
        rows.append([count + 1 + k for k in range(segments)])
        count += segments
    for i in range(len(rows) if closes else len(rows) - 1):
        below, above = rows[i], rows[(i + 1) % len(rows)]
        for k in range(segments):
            face = [below[k], above[k], above[(k + 1) % segments], below[(k + 1) % segments]]
            lines.append("f " + " ".join(str(v) for v in dict.fromkeys(face)))
    return "\n".join(lines) + "\n"


def write(folder, name, text):
    (folder / f"{name}.obj").write_text("# made by tests/experiments/lathe.py\n" + text)


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "presets")
    for name, profile, segments, closes in [("environment/drinking-glass", drinking_glass(), 96, False),
                                            ("environment/water", water(), 96, False),
                                            ("environment/ring", ring(), 96, True), ("spectral/hoop", hoop(), 96, True),
                                            ("spectral/bottle", bottle(), 64, False),
                                            ("spectral/wine-glass", wine_glass(), 64, False),
                                            ("spectral/wine", wine(), 64, False)]:
        write(folder, name, turn(profile, segments, closes))
    write(folder, "environment/bent-ring", turn(ring(), 96, True, bent))


if __name__ == "__main__":
    main()
