# SPDX-License-Identifier: Apache-2.0
"""The last scene of peers.py: what engine 3's objects cast, by the engine's own judge and by Mitsuba's particle tracer,
as the thesis has it by mental ray. They share the file object.obj and nothing else."""
import json

import numpy as np

from layers import side_by_side, write_png
from peers_programs import DEEP, run_measured

PRESETS = ["shapes", "words"]
PARTICLES = 2048  # a cell, of each of two halves
ALBEDO = 0.05     # so that light from the receiver by way of the glass back to it does not matter
CLEAR = 12.0      # mm behind the facets, where Mitsuba's light starts: before the front


def scene_of(mi, receiver, glass, mesh):
    """Light along -z onto the front. A pinhole between the object and the receiver sees the receiver and no more. mesh:
    None where the object is left out."""
    T = mi.ScalarTransform4f
    lit, distance, cells = glass["size_mm"], receiver["distance_mm"], receiver["cells"]
    width, height, up = receiver["width_mm"], receiver["height_mm"], distance / 2
    parts = {
        "type": "scene", "integrator": {"type": "ptracer", "max_depth": DEEP, "rr_depth": DEEP, "hide_emitters": True},
        "sensor": {"type": "perspective", "fov": float(np.degrees(2 * np.arctan(width / 2 / up))), "fov_axis": "x",
                   "near_clip": 1.0, "far_clip": 10.0 * up,
                   "to_world": T().look_at([0, 0, up - distance], [0, 0, -distance], [0, 1, 0]),
                   "film": {"type": "hdrfilm", "width": cells[0], "height": cells[1], "rfilter": {"type": "box"}}},
        "light": {"type": "rectangle",
                  "to_world": T().translate([0, 0, CLEAR]).rotate([1, 0, 0], 180).scale([lit[0] / 2, lit[1] / 2, 1]),
                  "emitter": {"type": "directionalarea", "radiance": 1.0}},
        "receiver": {"type": "rectangle",
                     "to_world": T().translate([0, 0, -distance]).scale([width / 2, height / 2, 1]),
                     "bsdf": {"type": "diffuse", "reflectance": ALBEDO}}}
    if mesh:
        parts["glass"] = {"type": "obj", "filename": str(mesh), "face_normals": True,
                          "bsdf": {"type": "dielectric", "int_ior": glass["index"]["n"], "ext_ior": 1.0}}
    return mi.load_dict(parts)


def measure_objects(program, out):
    import mitsuba as mi
    mi.set_variant("llvm_ad_rgb")

    def light(scene, seed, particles=PARTICLES):
        return np.array(mi.render(scene, spp=particles, seed=seed))[..., 0].astype(float)

    print("\n## Objects that cast pictures\n\n| object | receiver | rel_l2 | correlation | Mitsuba's noise | the "
          "judge's | rel_l2 without noise | light on the receiver: Mitsuba | the judge |\n" + "|---" * 9 + "|")
    for preset in PRESETS:
        folder = out / "objects" / preset
        run_measured([program, "run", f"inverse/{preset}", "-o", folder], out)
        run, settings = (json.loads((folder / f"{name}.json").read_text()) for name in ("run", "preset"))
        glass, pictures = settings["inverse"], []
        for j, receiver in enumerate(run["inverse"]["receivers"], 1):
            ours, wanted = (np.array(mi.Bitmap(str(folder / f"{name}_{j}.exr")))[..., 0].astype(float)
                            for name in ("receiver", "target"))
            receiver = receiver | {"cells": ours.shape[::-1]}
            halves = [light(scene_of(mi, receiver, glass, folder / "object.obj"), seed) for seed in (1, 2)]
            plain = light(scene_of(mi, receiver, glass, None), 3, 256).mean()
            theirs = sum(halves) / 2
            part, scaled = theirs.mean() / plain, ours * theirs.sum() / ours.sum()
            norm = np.linalg.norm(theirs)
            noise, distance = np.linalg.norm(halves[0] - halves[1]) / 2 / norm, np.linalg.norm(scaled - theirs) / norm
            own = run["judged"]["noise_rel_l2"]
            left = np.sqrt(max(0, distance**2 - noise**2 - own**2))
            judged = run["light"]["sent"] * (1 - receiver["missed"])
            print(f"| `{preset}` | {receiver['distance_mm']:g} mm | {distance:.4f} | "
                  f"{np.corrcoef(scaled.ravel(), theirs.ravel())[0, 1]:.5f} | {noise:.4f} | {own:.4f} | {left:.4f} | "
                  f"{part:.4f} | {judged:.4f} |", flush=True)
            white = np.quantile(theirs, 0.995)
            rows = (wanted * theirs.sum() / wanted.sum(), scaled, theirs, 0.5 * white + 5 * (scaled - theirs))
            for row, (name, picture) in enumerate(zip(("wanted", "ours", "mitsuba", "difference"), rows)):
                file = folder / f"{name}-{j}.png"
                write_png(file, np.repeat(np.kron(picture / white, np.ones((4, 4)))[..., None], 3, -1))
                pictures.append((row, j, file))
        side_by_side([file for _, _, file in sorted(pictures)], len(run["inverse"]["receivers"]), 192,
                     out / "objects" / f"{preset}.png")
