#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Imports scenes of Mitsuba, PBRT and glTF, renders them, and has Mitsuba render the same: mean light, and where
pictures differ by more than their noise.

    tests/experiments/others.py PROGRAM OUT [SCENE...]            of these scenes of others_scenes.py, or of all
    tests/experiments/others.py PROGRAM OUT --seconds S [SCENE...]   the noise of both after as much processor time

Mitsuba is installed from PyPI into OUT/venv. Both render each scene with several seeds, whose differences are the
noise. A scene's line has the mean light of ours over theirs with its noise, of the pixels that show the floor alone
and of all; the part of blocks of 8 x 8 pixels whose means differ by less than 4 times their noise; and what the import
said to have left out. OUT/SCENE.png is theirs, ours, and their difference, 4 times as bright, about grey.

Noise is the root mean square of a pixel's deviation among seeds over the mean light, of pixels that show the floor
alone. Both have S seconds of all threads together, ours with its start and its files, theirs without.

Mitsuba's particle tracer (of lamps that are points) shows nothing in glass, so there the floor alone counts.
"""
import json
import os
import subprocess
import sys
import time
from pathlib import Path

from peers import in_venv

THEIR_SEEDS, OUR_SEEDS, SAMPLES, PASSES, BLOCK = 4, 4, 256, 16, 8


def loaded_by_mitsuba(scene, folder):
    """The scene, its integrator, and which pixels show the floor alone."""
    import mitsuba
    import numpy as np
    from others_scenes import FLOOR_HEIGHT
    mitsuba.set_variant(scene.get("variant", "llvm_ad_rgb"))
    loaded = mitsuba.load_file(str(folder / scene["theirs"]))
    integrator = mitsuba.load_dict({"type": scene["integrator"], "max_depth": 32, "rr_depth": 32})
    at = np.array(mitsuba.render(loaded, integrator=mitsuba.load_dict({"type": "aov", "aovs": "at:position"}), spp=64))
    return loaded, integrator, np.abs(at[..., -2] - FLOOR_HEIGHT) < 1e-3


def theirs(loaded, integrator, samples):
    import mitsuba
    import numpy as np
    return [np.array(mitsuba.render(loaded, integrator=integrator, spp=samples, seed=seed))[..., :3].astype(float)
            for seed in range(1, THEIR_SEEDS + 1)]


def their_samples(loaded, integrator, seconds):
    """As many a pixel as take this processor time."""
    import mitsuba
    import numpy as np
    samples, taken = 16, 0
    while taken < seconds / 4:
        samples *= 2
        began = time.process_time()
        np.array(mitsuba.render(loaded, integrator=integrator, spp=samples))
        taken = time.process_time() - began
    return max(1, int(samples * seconds / taken))


def ours(scene, folder, program, stop=("--passes", str(PASSES))):
    """Pictures, what the import said, and processor seconds a picture."""
    from layers import read_layer
    from others_scenes import SIZE
    preset = folder / "ours.json"
    done = subprocess.run([program, "import", str(folder / scene["ours"]), "-o", str(preset), "--replace"],
                          capture_output=True, text=True)
    if done.returncode:
        return None, done.stderr.strip(), 0
    size, unit = [], 1
    if scene["ours"].endswith(".gltf"):  # which has no size of a picture, and candela: 683 lm are a watt at the peak
        size = ["--set", f"scene.camera.resolution=[{SIZE},{SIZE}]"]
        unit = 683 * json.loads(preset.read_text())["white"]
    pictures, began = [], os.times()
    for seed in range(1, OUR_SEEDS + 1):
        out = folder / f"ours-{seed}"
        subprocess.run([program, "run", str(preset), "-o", str(out), *stop, "--set", f"seed={seed}",
                        "--set", "spectral.smoothing=off", *size], capture_output=True, check=True)
        pictures.append(unit * read_layer(out / "image.exr", ""))
    ended = os.times()
    seconds = ended.children_user + ended.children_system - began.children_user - began.children_system
    return pictures, done.stderr.strip(), seconds / OUR_SEEDS


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


def folder_of(name, scene, out):
    folder = out / name.replace(" ", "-")
    for file, content in scene["files"].items():
        (folder / file).parent.mkdir(parents=True, exist_ok=True)
        (folder / file).write_bytes(content if isinstance(content, bytes) else content.encode())
    return folder


def noise(pictures, floor):
    import numpy as np
    grey = np.array(pictures).mean(-1)[:, floor]
    return np.sqrt(grey.var(0, ddof=1).mean()) / grey.mean()


def compare_noise(name, scene, program, out, seconds):
    folder = folder_of(name, scene, out)
    loaded, integrator, floor = loaded_by_mitsuba(scene, folder)
    samples = their_samples(loaded, integrator, seconds)
    began = time.process_time()
    a = theirs(loaded, integrator, samples)
    their_seconds = (time.process_time() - began) / THEIR_SEEDS
    b, _, our_seconds = ours(scene, folder, program, ("--seconds", str(seconds / os.cpu_count())))
    print(f"| {name} | {our_seconds:.1f} s, {noise(b, floor):.4f} | {their_seconds:.1f} s, {noise(a, floor):.4f} |",
          flush=True)


def measure(name, scene, program, out):
    import numpy as np
    from layers import write_png
    folder = folder_of(name, scene, out)
    b, said, _ = ours(scene, folder, program)
    if b is None:
        return print(f"| {name} | refused | | | {said} |", flush=True)
    loaded, integrator, floor = loaded_by_mitsuba(scene, folder)
    a = theirs(loaded, integrator, SAMPLES)
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
        sys.exit("usage: others.py PROGRAM OUT [--seconds S] [SCENE...]; PROGRAM is build/release/bin/nephroid")
    target = Path(sys.argv[2]).absolute()
    target.mkdir(parents=True, exist_ok=True)
    in_venv(target)
    from others_scenes import SCENES
    names = sys.argv[3:]
    seconds = float(names[1]) if names[:1] == ["--seconds"] else 0
    names = names[2:] if seconds else names
    if not set(names) <= set(SCENES):
        sys.exit(f"scenes: {', '.join(SCENES)}")
    print("| scene | ours | Mitsuba's |\n|---|---|---|" if seconds else
          "| scene | floor, ours over theirs | picture | blocks that agree | what the import said |\n"
          "|---|---|---|---|---|")
    for scene_name in names or SCENES:
        arguments = scene_name, SCENES[scene_name], os.path.abspath(sys.argv[1]), target
        compare_noise(*arguments, seconds) if seconds else measure(*arguments)
