#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Imports scenes of Mitsuba, PBRT and glTF, renders them, and has Mitsuba render the same: mean light, and where
pictures differ by more than their noise.

    tests/experiments/others.py PROGRAM OUT [SCENE...]     of these scenes of others_scenes.py, or of all

Mitsuba is installed from PyPI into OUT/venv. Both render each scene with several seeds, whose differences are the
noise. A scene's line has the mean light of ours over theirs with its noise, of the pixels that show the floor alone
and of all; the part of blocks of 8 x 8 pixels whose means differ by less than 4 times their noise; and what the import
said to have left out. OUT/SCENE.png is theirs, ours, and their difference, 4 times as bright, about grey.

Mitsuba's particle tracer (of lamps that are points) shows nothing in glass, so there the floor alone counts. Where a
lamp is a surface, Mitsuba shows its reflection in glass and we do not.
"""
import json
import os
import subprocess
import sys
from pathlib import Path

from peers import in_venv

THEIR_SEEDS, OUR_SEEDS, SAMPLES, PASSES, BLOCK = 4, 4, 256, 16, 8


def theirs(scene, folder):
    """Pictures, and which of their pixels show the floor alone."""
    import mitsuba
    import numpy as np
    from others_scenes import FLOOR_HEIGHT
    mitsuba.set_variant(scene.get("variant", "llvm_ad_rgb"))
    loaded = mitsuba.load_file(str(folder / scene["theirs"]))
    integrator = mitsuba.load_dict({"type": scene["integrator"], "max_depth": 32, "rr_depth": 32})
    at = np.array(mitsuba.render(loaded, integrator=mitsuba.load_dict({"type": "aov", "aovs": "at:position"}), spp=64))
    return [np.array(mitsuba.render(loaded, integrator=integrator, spp=SAMPLES, seed=seed))[..., :3].astype(float)
            for seed in range(1, THEIR_SEEDS + 1)], np.abs(at[..., -2] - FLOOR_HEIGHT) < 1e-3


def ours(scene, folder, program):
    from layers import read_layer
    from others_scenes import SIZE
    preset = folder / "ours.json"
    done = subprocess.run([program, "import", str(folder / scene["ours"]), "-o", str(preset), "--replace"],
                          capture_output=True, text=True)
    if done.returncode:
        return None, done.stderr.strip()
    size, unit = [], 1
    if scene["ours"].endswith(".gltf"):  # which has no size of a picture, and candela: 683 lm are a watt at the peak
        size = ["--set", f"scene.camera.resolution=[{SIZE},{SIZE}]"]
        unit = 683 * json.loads(preset.read_text())["white"]
    pictures = []
    for seed in range(1, OUR_SEEDS + 1):
        out = folder / f"ours-{seed}"
        subprocess.run([program, "run", str(preset), "-o", str(out), "--passes", str(PASSES), "--set", f"seed={seed}",
                        "--set", "spectral.smoothing=off", *size], capture_output=True, check=True)
        pictures.append(unit * read_layer(out / "image.exr", ""))
    return pictures, done.stderr.strip()


def blocks(grey):
    """Means over blocks: seeds x rows x columns."""
    seeds, rows, columns = (grey.shape[0], grey.shape[1] // BLOCK, grey.shape[2] // BLOCK)
    return grey[:, :rows * BLOCK, :columns * BLOCK].reshape(seeds, rows, BLOCK, columns, BLOCK).mean((2, 4))


def compared(a, b):
    """The mean of b over that of a, seed by seed, and its noise."""
    import numpy as np
    means = [p.mean((1, 2)) if p.ndim == 3 else p.mean(1) for p in (a, b)]
    noise = np.sqrt(sum(m.var(ddof=1) / len(m) / m.mean() ** 2 for m in means))
    return f"{means[1].mean() / means[0].mean():.4f} +- {noise:.4f}"


def measure(name, scene, program, out):
    import numpy as np
    from layers import write_png
    folder = out / name.replace(" ", "-")
    for file, content in scene["files"].items():
        (folder / file).parent.mkdir(parents=True, exist_ok=True)
        (folder / file).write_bytes(content if isinstance(content, bytes) else content.encode())
    b, said = ours(scene, folder, program)
    if b is None:
        return print(f"| {name} | refused | | | {said} |", flush=True)
    a, floor = theirs(scene, folder)
    greys = [np.array(pictures).mean(-1) for pictures in (a, b)]
    parts = [blocks(grey) for grey in greys]
    variance = sum(p.var(0, ddof=1) / len(p) for p in parts)
    # Half a percent of the light is let pass: a colour is made a spectrum, and a place in a pixel may differ.
    z = np.abs(parts[1].mean(0) - parts[0].mean(0)) / np.sqrt(variance + (.005 * parts[0].mean(0)) ** 2 + 1e-20)
    notes = "; ".join(line.removeprefix("note: ").replace(f"{folder}/", "") for line in said.splitlines())
    print(f"| {name} | {compared(*(grey[:, floor] for grey in greys))} | {compared(*greys)} | "
          f"{100 * (z < 4).mean():.1f} % | {notes} |", flush=True)
    a, b = np.mean(a, 0), np.mean(b, 0)
    level = 2.5 * np.mean(a)
    write_png(folder.with_suffix(".png"), np.concatenate([a, b, .2 * level + 4 * (b - a)], 1) / level)


if __name__ == "__main__":
    if len(sys.argv) < 3 or not Path(sys.argv[1]).is_file():
        sys.exit("usage: others.py PROGRAM OUT [SCENE...], PROGRAM being the program, as build/release/bin/nephroid")
    target = Path(sys.argv[2]).absolute()
    target.mkdir(parents=True, exist_ok=True)
    in_venv(target)
    from others_scenes import SCENES
    if not set(sys.argv[3:]) <= set(SCENES):
        sys.exit(f"scenes: {', '.join(SCENES)}")
    print("| scene | floor, ours over theirs | picture | blocks that agree | what the import said |\n"
          "|---|---|---|---|---|")
    for scene_name in sys.argv[3:] or SCENES:
        measure(scene_name, SCENES[scene_name], os.path.abspath(sys.argv[1]), target)
