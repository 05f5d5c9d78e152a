# SPDX-License-Identifier: Apache-2.0
"""The last scene of peers.py: a lens that casts a photograph, by Nephroid and by poisson_caustic_design, which
OUT/poisson_caustic_design holds or git fetches. lens.py judges both by their meshes alone."""
import json
import subprocess
from pathlib import Path

import numpy as np
from PIL import Image

from lens import coarser, picture_of, rel_l2, trace
from peers_programs import run_measured

TOOL = "https://github.com/dylanmsu/poisson_caustic_design"
INDEX = 1.49    # the tool's own
WIDTH = 100     # mm
DISTANCE = 150  # mm
CELLS = (64, 128)
RAYS = 1e7


def photograph(folder):
    """512 x 512, grey: Grace Hopper (U.S. Navy, public domain), of matplotlib's samples; sRGB, and linear for who takes
    bytes for light."""
    from matplotlib import cbook
    with cbook.get_sample_data("grace_hopper.jpg") as file:
        photo = Image.open(file).convert("L").crop((0, 0, 512, 512))
    photo.save(folder / "photo.png")
    grey = np.asarray(photo) / 255
    linear = np.where(grey > .04045, ((grey + .055) / 1.055) ** 2.4, grey / 12.92)
    # of grey it reads every fourth byte
    Image.fromarray(np.round(255 * linear).astype(np.uint8)).convert("RGB").save(folder / "linear.png")
    return folder / "photo.png"


def built_tool(out):
    """Its program; nothing where it cannot be had."""
    source = out / "poisson_caustic_design"
    if not source.exists():
        subprocess.run(["git", "clone", "-q", TOOL, source], stderr=subprocess.DEVNULL)
    if not source.exists():
        return None
    build = source / "build"
    for command in (["cmake", "-S", source, "-B", build, "-DCMAKE_BUILD_TYPE=Release"], ["cmake", "--build", build]):
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return build / "CausticEngineering"


def write_stl(obj, stl):
    """In millimetres, about the middle, the relief down: the flat side is the one whose corners have the same
    height."""
    vertices, faces = [], []
    for line in open(obj):
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(w) for w in words[1:4]])
        if words[:1] == ["f"]:
            faces.append([int(w.split("/")[0]) - 1 for w in words[1:4]])
    v = np.array(vertices)
    v = (v - (v.min(0) + v.max(0)) / 2) * (WIDTH / np.ptp(v[:, 0]))
    top_is_flat = np.isclose(v[:, 2], v[:, 2].max()).sum() > np.isclose(v[:, 2], v[:, 2].min()).sum()
    if not top_is_flat:
        v = v * [1, -1, -1]
    corners = v[np.array(faces)]
    # its volume is negative
    inside_out = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) < 0
    rows = np.zeros(len(faces), [("f", "<f4", (4, 3)), ("attribute", "<u2")])
    rows["f"][:, 1:] = corners[:, ::-1] if inside_out else corners
    stl.write_bytes(bytes(80) + np.uint32(len(rows)).tobytes() + rows.tobytes())


def judged(stl, photo):
    """rel_l2 at CELLS, of the way up that fits best: programs differ in what is left and right."""
    light, _ = trace(stl, INDEX, DISTANCE, [WIDTH, WIDTH], CELLS[-1], RAYS, 1)
    ways = [np.rot90(light[:, ::step], turn) for step in (1, -1) for turn in range(4)]
    errors = [[rel_l2(picture_of(photo, cells), coarser(way, CELLS[-1] // cells)) for cells in CELLS] for way in ways]
    return min(errors)


def measure_lens(program, out):
    folder = out / "lens"
    folder.mkdir(parents=True, exist_ok=True)
    photo = photograph(folder)
    print(f"\n## lens: a photograph, n = {INDEX}\n\n| program | seconds | "
          + " | ".join(f"error, {c} x {c} cells" for c in CELLS)
          + " |\n| --- | --- | --- | --- |")

    def row(name, seconds, stl):
        print(f"| {name} | {seconds:.1f} | " + " | ".join(f"{e:.3f}" for e in judged(stl, photo)) + " |", flush=True)

    for facets in (128, 256, 512):
        preset = {"engine": "inverse", "unit": "mm", "scene": {"camera": {"resolution": [256, 512]}}, "inverse": {
            "method": "lens", "size_mm": [WIDTH, WIDTH], "facets": [facets, facets], "cells": [CELLS[-1], CELLS[-1]],
            "index": INDEX,
            "receivers": [{"distance_mm": DISTANCE, "picture": {"type": "file", "file": str(photo)}}]}}
        (folder / "lens.json").write_text(json.dumps(preset))
        made = folder / f"nephroid-{facets}"
        row(f"Nephroid, {facets} x {facets} facets", run_measured([program, "run", "lens.json", "-o", made], folder),
            made / "object.stl")
    tool = built_tool(out)
    if not tool:
        return print(f"poisson_caustic_design is left out: {TOOL} cannot be fetched, and "
                     f"{out / 'poisson_caustic_design'} is not there")
    for nodes in (64, 128):
        made = folder / f"poisson-{nodes}"
        made.mkdir(exist_ok=True)
        seconds = run_measured([tool, f"--input_png={folder / 'linear.png'}", f"--output={made}/", f"--res_w={nodes}",
                                f"--mesh_width={WIDTH / 1000}",
                                f"--focal_l={DISTANCE / 1000}", "--thickness=0.01", "--conv_tres=0.01", "--threads=2"],
                               made)
        write_stl(next(made.glob("*.obj")), made / "object.stl")
        row(f"poisson_caustic_design, {nodes} nodes", seconds, made / "object.stl")
