# SPDX-License-Identifier: Apache-2.0
"""Whether the 95 % intervals of meters hold the truth: cases with closed forms, several seeds.

usage: python meters.py PROGRAM [--seeds N] [--seconds S] [CASE...]

Prints for each case the truth and how many of the intervals of mean, total, peak and cells hold it, and the sums.
Light is 1 W and 1 m unless a case says otherwise. Needs numpy.
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import tempfile

import numpy

from meter_truths import (CLEAR_TWO, SOLAR_CONTROL, glazing, glazing_material, of_area_lamp, of_point, through_pane,
                          under_ball, under_facade)

GREY = {"type": "diffuse", "reflectance": 0.5}
BLACK = {"type": "diffuse", "reflectance": 0}
GLASS = {"type": "dielectric", "dispersion": 1.5}
MIRROR = {"type": "mirror", "reflectance": 0.9}
SUN = {"type": "directional", "irradiance_w_m2": 1}


def preset(objects, lights, meter, materials=None, **scene):
    named = {"grey": GREY, "black": BLACK, "glass": GLASS, "mirror": MIRROR} | (materials or {})
    used = {o["material"] for o in objects}
    return {"name": "case", "engine": "spectral", "unit": "m",
            "scene": {"camera": {"position": [0, 3, 9]}, "materials": {k: v for k, v in named.items() if k in used},
                      "objects": objects, "lights": lights, "meters": [{"name": "meter"} | meter]} | scene}


def quad(material="black", size=2.0, at=(0, 0, 0), turn=(0, 0, 0), name="floor"):
    return {"name": name, "shape": {"type": "quad", "size": [size, 1, size]}, "material": material,
            "transform": {"translate": list(at), "rotate_deg": list(turn)}}


def shape(kind, material, at=(0, 0, 0), name="object", turn=(0, 0, 0), **sizes):
    return {"name": name, "shape": {"type": kind} | sizes, "material": material,
            "transform": {"translate": list(at), "rotate_deg": list(turn)}}


def plane(at=(0, 0, 0), normal=(0, 1, 0), size=(1, 1), cell=0.1, up=(0, 0, -1)):
    return {"type": "plane", "position": list(at), "normal": list(normal), "size": list(size), "cell": cell,
            "up": list(up)}


def point_lamp(at, watts=1.0):
    return {"type": "point", "power_w": watts, "position": list(at)}


# Truths. A truth is a dictionary with some of "mean" (W/m^2), "mean_lx", "peak" and "cells", a function of a cell's row
# in the table.

def turned_profile(points, rings_down=False, turns=256):
    """An OBJ of a profile turned about y. points: (radius, height, slope of the height), from the axis outwards."""
    vertices, normals, faces = [], [], []
    for r, y, slope in points:
        for turn in range(turns):
            c, s = math.cos(2 * math.pi * turn / turns), math.sin(2 * math.pi * turn / turns)
            n = numpy.array((-slope * c, 1, -slope * s)) * (-1 if rings_down else 1) / math.hypot(slope, 1)
            vertices.append((r * c, y, r * s))
            normals.append(n)
    for ring in range(len(points) - 1):
        for turn in range(turns):
            a, b = ring * turns + turn, ring * turns + (turn + 1) % turns
            quad_of = (a, b, b + turns, a + turns)
            for triangle in ((0, 1, 2), (0, 2, 3)):
                corners = [quad_of[i] for i in triangle]
                if len({tuple(vertices[i]) for i in corners}) == 3:
                    faces.append(corners if not rings_down else corners[::-1])
    return vertices, normals, faces


def obj_of(*parts):
    """Of several turned profiles, whose vertices in the same place are one."""
    text, first, places = "", 0, {}
    for vertices, normals, faces in parts:
        for v in vertices:
            text += "v {:.9g} {:.9g} {:.9g}\n".format(*v)
        for n in normals:
            text += "vn {:.9g} {:.9g} {:.9g}\n".format(*n)
        number = [places.setdefault(tuple(round(c, 7) + 0.0 for c in v), first + i) for i, v in enumerate(vertices)]
        for a, b, c in faces:
            text += "f {}//{} {}//{} {}//{}\n".format(*sum(([number[i] + 1, first + i + 1] for i in (a, b, c)), []))
        first += len(vertices)
    return text


def sun_in_focus(name, mesh, material, focus, facing, truth):
    """What gathers the sun's disc from above, and a small window in the middle of its image."""
    thing = {"name": "object", "mesh": "object.obj", "material": material, "normals": "given"}
    lamp = SUN | {"direction": [0, -1, 0], "angular_diameter_deg": 0.533}
    return name, preset([thing], [lamp], {"type": "point", "position": [0, focus, 0], "normal": [0, facing, 0],
                                          "diameter": 0.002}), {
        "layer": "caustic", "mean": truth, "tolerance": 5e-3, "files": {"object.obj": obj_of(*mesh)}}


def focus_cases():
    """A dish and a lens have .9 and .92 of the sun's radiance over the solid angle that they fill."""
    sine = math.sin(math.radians(0.533 / 2))
    radii = [0.5 * i / 96 for i in range(97)]
    dish = turned_profile([(r, r * r / 4, r / 2) for r in radii])  # its focus is 1 m above it
    rim = 2 * math.atan(0.5 / 2)
    yield sun_in_focus("paraboloid dish in the sun", [dish], "mirror", 1, -1, 0.9 * (math.sin(rim) / sine) ** 2)
    n, radius, half, edge = 1.5, 1.0, 0.05, 0.0005
    sag = radius - math.sqrt(radius ** 2 - half ** 2)
    arc = [(r, math.sqrt(radius ** 2 - r * r) - radius + sag, -r / math.sqrt(radius ** 2 - r * r))
           for r in (half * i / 96 for i in range(97))]
    top = turned_profile([(r, y + edge, slope) for r, y, slope in arc])
    bottom = turned_profile([(r, -y - edge, -slope) for r, y, slope in arc], True)
    ring, outwards = 256, []
    for i in (-1, 1):
        outwards += [(half * math.cos(2 * math.pi * t / ring), i * edge, half * math.sin(2 * math.pi * t / ring))
                     for t in range(ring)]
    side = ([*outwards], [(x / half, 0, z / half) for x, _, z in outwards],
            [f for t in range(ring) for f in ((t, ring + (t + 1) % ring, (t + 1) % ring),
                                              (t, ring + t, ring + (t + 1) % ring))])
    thick = 2 * (sag + edge)
    power = 2 * (n - 1) / radius - (n - 1) ** 2 * thick / (n * radius ** 2)
    behind = (1 - (n - 1) * thick / (n * radius)) / power  # from the lens's last face to the focus
    spot = 2 * math.tan(math.radians(0.533 / 2)) / power
    passed = (1 - ((n - 1) / (n + 1)) ** 2) ** 2
    yield sun_in_focus("lens in the sun", [top, bottom, side], "glass", -thick / 2 - behind, 1,
                       passed * (2 * half / spot) ** 2)


# Elevation and azimuth of the sun in London on 21 June by the hour of the clock, from nephroid measure --hours day.
JUNE = {11: (53.4, 128.5), 12: (59.5, 151.1), 13: (61.9, 178.9), 14: (59.8, 207.1), 15: (54.0, 230.1)}


def facade_cases():
    """Fronts of 480 panes in the sun: what these alone send to the street."""
    def case(name, sun, panes=None, **pillow):
        arc = 0 if pillow else 40
        wall = {"type": "curtain_wall", "size": [40, 72, 1], "arc_deg": arc, "panes": [20, 24], "gap": 0.06} | pillow
        at = (0, 36, 0.1 if pillow else 3.4)
        front = {"name": "front", "shape": wall, "material": "coated", "transform": {"translate": list(at)}}
        facade = under_facade(40, 72, arc, 20, 24, 0.06, numpy.array(at), sun, 0.533,
                              lambda c: glazing(panes, c)[1] if panes else 0.3, (-20, 5), 1, (40, 50), **pillow)
        coated = glazing_material(panes) if panes else MIRROR | {"reflectance": 0.3}
        return name, preset(
            [front, quad(size=400)], [SUN | {"direction": list(sun), "angular_diameter_deg": 0.533}],
            plane((0, 0.001, 30), size=(40, 50), cell=1), {"coated": coated}), {
            "layer": "caustic", "mean": facade.mean(), "peak": facade.max(), "tolerance": 2e-3,
            "cells": lambda row: facade[int(float(row["z"]) - 5)][int(float(row["x"]) + 20)]}
    for sun in ((0.05, -1, -1), (0.4, -1, -0.7)):
        yield case(f"concave facade, sun {sun[0]}", sun)
    for hour, (elevation, azimuth) in JUNE.items():
        e, a = math.radians(elevation), math.radians(azimuth)
        yield case(f"concave facade, June {hour}:00",
                   (-math.cos(e) * math.sin(a), -math.sin(e), math.cos(e) * math.cos(a)))
    yield case("pillowed front", (0.05, -1, -1), pillow=-0.003)
    for sun in ((0.05, -1, -1), (0.4, -1, -0.7), (0.05, -1, -0.3)):
        yield case(f"concave facade of glazing, sun {sun[0]}, {sun[2]}", sun, SOLAR_CONTROL)
    yield case("pillowed front of glazing", (0.05, -1, -1), SOLAR_CONTROL, pillow=-0.003)


def cases():
    x, z, up_z = (1, 0, 0), (0, 0, -1), (0, 0, -1)
    yield "point over a floor", preset([quad()], [point_lamp((0, 1, 0))],
                                       {"type": "surface", "object": "floor", "cell": 0.2}), {
        "mean": 1 / 24, "cells": of_point((0, 1, 0), x, up_z, 0.2)}
    yield "point aside", preset([quad()], [point_lamp((0.73, 0.4, -0.21))], plane()), {
        "cells": of_point((0.73, 0.4, -0.21), x, up_z, 0.1)}
    yield "point on a wall", preset([quad()], [point_lamp((0.3, 0.6, 0.2))],
                                    plane((0, 0.5, -0.5), (0, 0, 1), up=(0, 1, 0))), {
        "cells": of_point((0.3, 0.6, 0.2), x, (0, 1, 0), 0.1)}
    slope = math.sqrt(0.5)
    yield "point on a slope", preset([quad(at=(0, -2, 0))], [point_lamp((0, 1, 0.5))],
                                     plane((0, 0, 0), (0, slope, slope))), {
        "cells": of_point((0, 1, 0.5), x, (0, slope, -slope), 0.1)}
    yield "point, far and small", preset([quad(size=2000)], [point_lamp((0, 100, 0), 1e6)],
                                         {"type": "point", "position": [40, 0, 0], "diameter": 0.02}), {
        "mean": 1e6 / (4 * math.pi) * 100 / math.hypot(100, 40) ** 3}
    yield "box, its top", preset([shape("box", "grey", size=[1, 1, 1])], [point_lamp((0.1, 2, 0.3))],
                                 {"type": "surface", "object": "object", "facing": [0, 1, 0], "cell": 0.1}), {
        "cells": of_point((0.1, 2, 0.3), x, up_z, 0.1)}
    lamp = numpy.array((0.1, 0.9, 0.3))
    yield "box from inside", preset([shape("box", "black", size=[2, 2, 2], inwards=True)], [point_lamp(lamp)],
                                    {"type": "surface", "object": "object", "cell": 0.25}), {"mean": 1 / 24}
    for angle in (0, 60, 89):
        a = math.radians(angle)
        yield f"sun at {angle} degrees", preset([quad()], [SUN | {"direction": [math.sin(a), -math.cos(a), 0]}],
                                                plane()), {
            "mean": math.cos(a), "peak": math.cos(a), "cells": lambda row, a=a: math.cos(a)}
    half = math.radians(0.265)
    yield "sun's disc at 45 degrees", preset([quad()], [SUN | {"direction": [1, -1, 0], "angular_diameter_deg": 0.53}],
                                             plane()), {"mean": slope * (1 + math.cos(half)) / 2}
    yield "spot", preset([quad()], [{"type": "spot", "power_w": 1, "position": [0, 1, 0], "direction": [0, -1, 0],
                                     "half_angle_deg": 60}], plane()), {
        "cells": of_point((0, 1, 0), x, up_z, 0.1, 2 / (1 - 0.5))}
    on_axis = of_area_lamp(1, 0.5, 1, (0, 1, 0), 0.01 * math.sqrt(math.pi) / 2)
    square = {"type": "area", "power_w": 1, "position": [0, 1, 0], "direction": [0, -1, 0], "size": [0.5, 0.5]}
    yield "square lamp", preset([quad()], [square], {"type": "point", "position": [0.2, 0, 0]}), {
        "mean": on_axis(numpy.array((0.2, 0, 0)), numpy.array(x), numpy.array(z))}
    on_wall = of_area_lamp(1, 0.5, 1, (-1, 0, 0), 0.2)
    yield "square lamp on a wall", preset([quad(at=(0, -2, 0))], [square],
                                          plane((0.6, 0, 0), (-1, 0, 0), cell=0.2, up=(0, 1, 0))), {
        "cells": lambda row: on_wall(numpy.array([float(row[k]) for k in "xyz"]), numpy.array((0, 0, 1.)),
                                     numpy.array((0, 1., 0)))}
    yield "shining ball", preset([quad(at=(0, -3, 0)), shape("sphere", "grey", radius=0.2, name="lamp")],
                                 [{"type": "mesh", "object": "lamp", "power_w": 1}],
                                 {"type": "point", "position": [0, -1, 0]}), {
        "mean": (1 - 1.5 * 0.01 ** 2 * math.pi / 24) / (4 * math.pi)}  # over a square as large as the window
    white = {"type": "constant", "colour": [1, 1, 1], "radiance": 1, "lights": True}
    yield "even sky on a plane", preset([quad(at=(0, -1, 0), size=0.01)], [], plane(normal=(0, 1, 0)),
                                        environment=white), {"mean_lx": math.pi * 683.002}
    yield "even sky on a ball", preset([shape("sphere", "black", radius=0.5)], [],
                                       {"type": "surface", "object": "object", "cell": 0.1}, environment=white), {
        "mean_lx": math.pi * 683.002}
    yield "shadow's edge", preset([quad(), quad(size=2, at=(1.23, 0.5, 0), name="screen")],
                                  [SUN | {"direction": [0, -1, 0]}], plane(size=(1, 1))), {
        "mean": 0.73, "cells": lambda row: min(max((0.23 - float(row["x"])) / 0.1 + 0.5, 0), 1)}
    yield "shadow of a ball", preset([quad(), shape("sphere", "grey", at=(0, 0.5, 0), radius=0.3)],
                                     [SUN | {"direction": [0, -1, 0]}], {"type": "surface", "object": "floor"}), {
        "mean": None, "direct": 1 - math.pi * 0.09 / 4}
    for angle in (0, 60):
        a = math.radians(angle)
        yield f"thin pane at {angle} degrees", preset(
            [quad(), quad("pane", 8, (0, 0.5, 0), name="pane")], [SUN | {"direction": [math.sin(a), -math.cos(a), 0]}],
            plane(), {"pane": GLASS | {"thin": True}}), {"mean": math.cos(a) * through_pane(angle, is_thin=True)}
    for angle in (0, 45, 60, 75):
        a = math.radians(angle)
        for panes, kind in ((CLEAR_TWO, "clear"), (SOLAR_CONTROL, "coated")):
            yield f"{kind} glazing at {angle} degrees", preset(
                [quad(), quad("panes", 8, (0, 0.5, 0), name="window")],
                [SUN | {"direction": [math.sin(a), -math.cos(a), 0]}], plane(), {"panes": glazing_material(panes)}), {
                "mean": math.cos(a) * glazing(panes, math.cos(a))[0], "tolerance": 5e-4}
    a = math.radians(20)
    yield "two plates at 20 degrees", preset(
        [quad(), shape("plate", "glass", (0, 0.5, 0), size=[20, 0.01, 20]),
         shape("plate", "glass", (0, 0.53, 0), size=[20, 0.01, 20], name="second")],
        [SUN | {"direction": [math.sin(a), -math.cos(a), 0]}], plane()), {
        "mean": math.cos(a) * glazing(CLEAR_TWO, math.cos(a))[0], "tolerance": 1e-3}
    for angle in (0, 45):
        a = math.radians(angle)
        yield f"plate at {angle} degrees", preset(
            [quad(), shape("plate", "glass", (0, 0.5, 0), size=[8, 0.1, 8])],
            [SUN | {"direction": [math.sin(a), -math.cos(a), 0]}], plane()), {"mean": math.cos(a) * through_pane(angle)}
    yield "mirror at 45 degrees", preset(
        [quad(at=(0, -3, 0), size=20), quad("mirror", 2, (0, 0, 0), (0, 0, 45), name="mirror")],
        [SUN | {"direction": [0, -1, 0]}], plane((-3, 0, 0), (1, 0, 0), (0.5, 0.5), 0.1, (0, 1, 0))), {
        "mean": 0.9, "peak": 0.9, "cells": lambda row: 0.9}
    facets = [quad("mirror", 0.2, (0.5 * i, 0, 0.5 * j), name=f"mirror {i} {j}") for i in range(-2, 3)
              for j in range(-2, 3)]
    for facet in facets:  # each sends the sun to (0, 4, 0)
        at = numpy.array(facet["transform"]["translate"], float)
        way = numpy.array((0, 4, 0)) - at
        n = way / numpy.linalg.norm(way) + (0, 1, 0)
        n /= numpy.linalg.norm(n)
        tilt = math.degrees(math.asin(n[2]))
        facet["transform"]["rotate_deg"] = [tilt, 0, -math.degrees(math.atan2(n[0], n[1]))]
        facet["sent"] = 0.9 * 0.04 * n[1]
    total = sum(facet.pop("sent") for facet in facets)
    yield "mirrors towards one place", preset([quad(at=(0, -3, 0), size=20)] + facets,
                                              [SUN | {"direction": [0, -1, 0]}],
                                              plane((0, 4, 0), (0, -1, 0), (1, 1), 0.05)), {"mean": total}
    yield from facade_cases()
    yield from focus_cases()
    image = under_ball(1, 1.5, -1.6, 1, 10)
    yield "ball in the sun", preset([quad(at=(0, -1.6, 0), size=20), shape("sphere", "glass", radius=1)],
                                    [SUN | {"direction": [0, -1, 0]}], plane((0, -1.6, 0), size=(2, 2), cell=0.2)), {
        "layer": "caustic", "mean": image.mean(), "peak": image.max(), "tolerance": 1e-3,
        "cells": lambda row: image[int((float(row["z"]) + 1) / 0.2)][int((float(row["x"]) + 1) / 0.2)]}
    for reflectance, at in ((0.5, (0, 0, 0)), (0.8, (0.5, 0.2, 0))):
        yield f"integrating sphere, {reflectance}", preset(
            [shape("sphere", "wall", radius=1, inwards=True)], [point_lamp(at)],
            {"type": "surface", "object": "object", "cell": 0.2},
            {"wall": {"type": "diffuse", "reflectance": reflectance}}), {
            "mean": 1 / (4 * math.pi * (1 - reflectance))}
    room = shape("box", "wall", size=[2, 2, 2], inwards=True, name="room")
    whole = {"type": "surface", "object": "room", "cell": 0.25}
    for wall in (0, 0.5):
        walls = {"wall": {"type": "diffuse", "reflectance": wall}, "perfect": {"type": "mirror", "reflectance": 1}}
        truth = {"mean": 1 / (24 * (1 - wall))}
        lamps = [point_lamp((0.3, 0.7, 0.2))]
        yield f"glass ball in a room, {wall}", preset([room, shape("sphere", "glass", radius=0.4)], lamps, whole,
                                                      walls), truth
        yield f"mirror ball in a room, {wall}", preset([room, shape("sphere", "perfect", radius=0.4)], lamps, whole,
                                                       walls), truth
    yield "prism of N-SF11 in a room", preset(
        [room, shape("prism", "flint", side=0.8, height=1)], [point_lamp((0.3, 0.7, 0.6))], whole,
        {"wall": GREY, "flint": {"type": "dielectric", "dispersion": {"type": "cauchy",
                                                                     "coefficients": [1.74, 0.013]}}}), {
        "mean": 1 / 12}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("cases", nargs="*")
    parser.add_argument("--seeds", type=int, default=8)
    parser.add_argument("--seconds", type=float, default=1)
    options = parser.parse_args()
    sums = {}
    print(f"{'case':34} {'truth':>10} {'measured':>10} {'+- %':>7}  held: mean, peak, cells")
    for name, case, truth in cases():
        if options.cases and not any(wanted in name for wanted in options.cases):
            continue
        held = {}
        for seed in range(1, options.seeds + 1):
            with tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder) / "case.json"
                file.write_text(json.dumps(case))
                for mesh, text in truth.get("files", {}).items():
                    (pathlib.Path(folder) / mesh).write_text(text)
                run = subprocess.run([options.program, "measure", file, "--seconds", str(options.seconds), "--seed",
                                      str(seed), "-o", folder, "--json"], capture_output=True, text=True)
                if run.returncode:
                    raise SystemExit(f"{name}: {run.stderr}")
                meter = json.loads(run.stdout)["meters"][0]
                layer = truth.get("layer", "direct" if "direct" in truth else "all")
                numbers = meter["layers"][layer]
                unit = "lx" if "mean_lx" in truth else "W/m^2"
                mean = truth.get("direct") or truth.get("mean") or truth.get("mean_lx")
                tolerance = truth.get("tolerance", 0)

                def holds(interval, value):
                    return interval["low"] - tolerance * value <= value <= interval["high"] + tolerance * value
                if mean is not None:
                    held.setdefault("mean", []).append(holds(numbers[unit]["mean"], mean))
                if "peak" in truth:
                    held.setdefault("peak", []).append(holds(numbers[unit]["peak"], truth["peak"]))
                if "cells" in truth:
                    rows = list(csv.DictReader(open(pathlib.Path(folder) / "meter.csv")))
                    stem = "" if layer == "all" else layer + " "
                    for row in rows:
                        low, high = float(row[f"{stem}{unit} low"]), float(row[f"{stem}{unit} high"])
                        held.setdefault("cells", []).append(holds({"low": low, "high": high}, truth["cells"](row)))
        shown = numbers[unit]["mean"]
        print(f"{name:34} {mean if mean is not None else float('nan'):10.6g} {shown['value']:10.6g} "
              f"{50 * (shown['high'] - shown['low']) / max(shown['value'], 1e-30):7.2g}  "
              + ", ".join(f"{k} {sum(v)}/{len(v)}" for k, v in held.items()), flush=True)
        for kind, values in held.items():
            sums.setdefault(kind, []).extend(values)
    for kind, values in sums.items():
        print(f"{kind}: {sum(values)} of {len(values)}, {100 * sum(values) / len(values):.1f} %")


if __name__ == "__main__":
    main()
