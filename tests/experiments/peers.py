#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders the same scenes with Nephroid, Mitsuba 3, LuxCore and POV-Ray, and designs the same lens with another tool:
error against processor time.

    tests/experiments/peers.py PROGRAM OUT [SCENE...]     of these scenes, or of all: ball, bunny, sky, room, lens,
                                                          objects

Mitsuba, LuxCore and Open Image Denoise are installed from PyPI into OUT/venv; POV-Ray is Debian's package povray,
ImageMagick and glmark2-data are asked for too. Each program has the settings that do best at the scene, of those that
we tried, and rows with and without smoothing: its own for Nephroid, whose default it is, Open Image Denoise for the
others.

The reference is a long run of Mitsuba, which has no bias: the mean of two halves, whose difference says how much noise
it has. An error is the root mean square of the distance to it, less that noise, over the mean there: of the glass'
shadow on the floor, or of all floor where a sky or a lamp lights it from many sides. Units differ: each picture is
scaled to the reference's mean there. So a program that has too much light or too little is told of by "shadow over
plain light", where it has both.
"""
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

PACKAGES = ["mitsuba==3.9.1", "pyluxcore==2.11.2", "pyoidn==2.5.1.0", "numpy", "matplotlib", "pillow"]
BUDGETS = [4, 12, 36]  # processor seconds
LONG = 90              # of each half of the reference
LUXCORE_PATH = {"renderengine.type": "PATHCPU", "sampler.type": "SOBOL", "path.pathdepth.total": 33,
                "path.pathdepth.diffuse": 33,
                "path.pathdepth.glossy": 33, "path.pathdepth.specular": 33}
LUXCORE = {
    "bidirectional": {"renderengine.type": "BIDIRCPU", "light.maxdepth": 33, "path.maxdepth": 33,
                      "sampler.type": "RANDOM"},
    "caustic cache": LUXCORE_PATH | {"path.photongi.caustic.enabled": True, "path.photongi.caustic.maxsize": 1_000_000,
                                     "path.photongi.photon.maxcount": 20_000_000,
                                     "path.photongi.caustic.lookup.radius": .03,
                                     "path.photongi.caustic.updatespp": 8},
    "path": LUXCORE_PATH,
}
# Of each scene: Mitsuba's integrators, the first of which makes the reference; LuxCore's; POV-Ray's photons, or
# radiosity's rays, and how many photons it gathers. Worse after 12 s, and left out: LuxCore's Metropolis sampler, its
# paths with light tracing (hybridbackforward), its cache on the bunny, and other numbers that POV-Ray gathers.
BEST = {"ball": (["ptracer"], ["bidirectional", "caustic cache"], ([50_000, 200_000, 1_000_000], "gather 40, 400")),
        "bunny": (["ptracer"], ["bidirectional"], ([20_000, 100_000, 500_000], "gather 5, 20")),
        "sky": (["path"], ["path"], ([], "")),
        "room": (["path"], ["path"], ([50, 400, 1600], ""))}


def in_venv(out):
    """Runs this script again with the Python of OUT/venv, where it is not that one yet."""
    venv = out / "venv"
    # Mitsuba's compiler: version 15, Debian 12's usual one, fails where a processor has AVX-512. The package libllvm19
    # does not.
    libraries = sorted(Path("/usr/lib").glob("*/libLLVM-[0-9][0-9].so"))
    if libraries:
        os.environ.setdefault("DRJIT_LIBLLVM_PATH", str(libraries[-1]))
    if Path(sys.prefix).resolve() == venv.resolve():
        return
    if not (venv / "bin" / "python").exists():
        subprocess.run([sys.executable, "-m", "venv", str(venv)], check=True)
        subprocess.run([str(venv / "bin" / "python"), "-m", "pip", "-q", "install", *PACKAGES], check=True)
    sys.exit(subprocess.run([str(venv / "bin" / "python"), *sys.argv]).returncode)


def work(order):
    """What a program of its own does for apart(): both renderers are libraries, and share others."""
    import numpy as np
    import peers_programs
    from peers_scenes import SCENES
    order = json.loads(order)
    scene, folder = SCENES[order["scene"]], Path(order["folder"])
    floor = np.zeros(0)
    if order["renderer"] == "mitsuba":
        renderer = peers_programs.Mitsuba(scene, order["method"])
        pictures, seconds = renderer.pictures(order["seed"], order["budgets"])
        floor = renderer.floor_only()
    else:
        pictures, seconds = peers_programs.luxcore(scene, folder, order["budgets"], order["seed"],
                                                   LUXCORE[order["method"]])
    np.savez(folder / "made.npz", pictures=pictures, seconds=seconds, floor=floor)
    os._exit(0)  # LuxCore's wheel dies at an orderly end


def apart(**order):
    import numpy as np
    order["folder"] = str(order["folder"])
    no_opencl = os.environ | {"OCL_ICD_VENDORS": "none"}  # LuxCore's wheel dies where it finds PoCL
    done = subprocess.run([sys.executable, __file__, "--work", json.dumps(order)], capture_output=True, text=True,
                          env=no_opencl)
    if done.returncode:
        sys.exit(f"{order['renderer']} failed: {done.stderr[-1500:]}")
    made = np.load(Path(order["folder"]) / "made.npz")
    return list(made["pictures"]), list(made["seconds"]), made["floor"]


def read_hdr(path):
    import mitsuba
    import numpy as np
    mitsuba.set_variant("scalar_rgb")
    return np.array(mitsuba.Bitmap(str(path))).astype(float)[..., :3]


def denoised(pictures, seconds):
    """What Open Image Denoise makes of pictures, without its first call, which loads its weights."""
    import numpy as np
    import pyoidn
    made, times = [], []
    pyoidn.denoise(np.ascontiguousarray(pictures[0], np.float32), hdr=True)
    for picture, took in zip(pictures, seconds):
        before = time.process_time()
        made.append(pyoidn.denoise(np.ascontiguousarray(picture, np.float32), hdr=True).astype(float))
        times.append(took + time.process_time() - before)
    return made, times


def inner(where):
    """Without pixels at an edge: programs differ in where a pixel has its middle."""
    import numpy as np
    return np.all([np.roll(where, (down, right), (0, 1)) for down in (-1, 0, 1) for right in (-1, 0, 1)], axis=0)


def measure(program, out, name):
    import numpy as np
    from layers import write_png
    from peers_programs import nephroid, povray
    from peers_scenes import SCENES
    scene, (integrators, engines, (povray_works, gather)) = SCENES[name], BEST[name]
    folder = out / name
    folder.mkdir(parents=True, exist_ok=True)
    share = {"scene": name, "folder": folder}

    halves = []
    for seed in (11, 12):
        made, _, floor = apart(renderer="mitsuba", method=integrators[0], seed=seed, budgets=[LONG], **share)
        halves.append(made[0].mean(-1))
    truth, noise = (halves[0] + halves[1]) / 2, (halves[0] - halves[1]) / 2
    ours, our_seconds, direct = nephroid(scene, folder, BUDGETS, program)
    direct = direct.mean(-1)
    lit = np.zeros_like(floor)
    if name in ("ball", "bunny"):
        lit = floor & (direct > .5 * direct[floor].max())
        where = floor & (direct == 0) & (truth > 0)
    else:
        where = floor
    where = inner(where)
    aimed = {"ptracer", "bidirectional", "caustic cache"}

    found = [("Nephroid", ours, our_seconds),
             ("Nephroid, unsmoothed", *nephroid(scene, folder, BUDGETS, program,
                                                ["--set", "spectral.smoothing=off"])[:2])]
    if name in ("ball", "bunny"):
        found.append(("Nephroid, tiles", *nephroid(scene, folder, BUDGETS, program,
                                                   ["--set", "spectral.estimator=tiles"])[:2]))
    for method in integrators:
        found.append((f"Mitsuba, {method}", *apart(renderer="mitsuba", method=method, seed=1, budgets=BUDGETS,
                                                   **share)[:2]))
    for method in engines:
        found.append((f"LuxCore, {method}", *apart(renderer="luxcore", method=method, seed=1, budgets=BUDGETS,
                                                   **share)[:2]))
    if povray_works:
        found.append(("POV-Ray, " + ("photons" if "body" in scene else "radiosity"),
                      *povray(scene, folder, povray_works, gather, read_hdr)))
    found = [row for name, *made in found for row in [(name, *made)] + (
        [] if name.startswith("Nephroid") else [(f"{name}, denoised", *denoised(*made))])]

    level = truth[where].mean()
    floor_noise = np.mean(noise[where] ** 2)
    print(f"\n## {name}: {scene['title']}\n\n{where.sum()} pixels; noise of the reference "
          f"{np.sqrt(floor_noise) / level:.4f}\n")
    print("| program | " + "seconds, error | " * len(BUDGETS) + "shadow over plain light |\n| --- | " + "--- | "
          * len(BUDGETS) + "--- |")
    for program_name, pictures, seconds in found:
        cells, shadow_over_plain = [], None
        for picture, took in zip(pictures, seconds):
            grey = picture.mean(-1)
            if not grey[where].any():  # LuxCore still fills its cache
                cells.append(f"{took:.1f} s, -")
                continue
            is_aimed = program_name.split(", ")[1:2] and program_name.split(", ")[1] in aimed
            unit = level / grey[where].mean()
            if lit.any() and not is_aimed:
                shadow_over_plain = grey[where].mean() / grey[lit].mean()
            error = np.sqrt(max(0, np.mean((unit * grey - truth)[where] ** 2) - floor_noise)) / level
            cells.append(f"{took:.1f} s, {error:.4f}")
            title = program_name.lower().replace(", ", "-").replace(" ", "-")
            write_png(folder / f"{title}-{len(cells)}.png", unit * picture / (4 * level))
        print(f"| {program_name} | " + " | ".join(cells)
              + f" | {'-' if shadow_over_plain is None else f'{shadow_over_plain:.4f}'} |", flush=True)
    write_png(folder / "reference.png", np.repeat(truth[..., None], 3, -1) / (4 * level))


if __name__ == "__main__":
    if sys.argv[1:2] == ["--work"]:
        work(sys.argv[2])
        sys.exit()
    names = [*BEST, "lens", "objects"]
    if len(sys.argv) < 3 or not Path(sys.argv[1]).is_file() or not set(sys.argv[3:]) <= set(names):
        sys.exit(f"usage: peers.py PROGRAM OUT [SCENE...], PROGRAM being the program, as build/release/bin/nephroid; "
                 f"scenes: {', '.join(names)}")
    nephroid_program, target = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).absolute()
    tools = ["convert"] if sys.argv[3:] == ["objects"] else ["convert", "povray"]
    missing = [tool for tool in tools if not shutil.which(tool)]
    if missing:
        sys.exit(f"there is no {' and no '.join(missing)}: apt install povray imagemagick glmark2-data libllvm19")
    in_venv(target)
    for scene_name in sys.argv[3:] or names:
        if scene_name == "lens":
            from peers_lens import measure_lens
            measure_lens(nephroid_program, target)
        elif scene_name == "objects":
            from peers_objects import measure_objects
            measure_objects(nephroid_program, target)
        else:
            measure(nephroid_program, target, scene_name)
