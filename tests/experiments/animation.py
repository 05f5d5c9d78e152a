#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures what frames of an animation gain where each begins with the one before, and prints the tables of
docs/notebook/animation.md.

    tests/experiments/animation.py PROGRAM OUT [FILM...] [--frames N] [--measured M] [--passes P...] [--alone P...]
    [--photons N] [--size W H] [--reference-passes R] [--seeds]

A frame by itself is one of --frames NUMBER in a folder of its own, where there is no frame before. The reference is of
many passes and another seed. Errors are root mean squares of all pixels and channels, clipped to 0 to 1, over the
reference's mean: a single pixel of 100 in glass would be all of the error else. Flicker is the same of what changes
from frame to frame and should not. Both are means over the last frames (--measured). OUT/FILM.png shows frames of the
reference, by themselves and after one another. What is in OUT is not made again.
Needs numpy and ImageMagick.
"""
import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
from layers import lab, read_layer, side_by_side


def animation(path, first, last):
    return {"animation": {"fps": 12, "tracks": [{"path": path, "keys": [{"frame": 0, "value": first},
                                                                       {"frame": 24, "value": last}]}]}}


def write_mesh(file, vertices, faces):
    lines = [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in vertices] + ["f " + " ".join(map(str, face)) for face in faces]
    file.write_text("\n".join(lines) + "\n")


def deforming(out, vertices, faces, states, transform):
    """Settings of first-light with this mesh in the bunny's place. It goes to each of its states and back, one after
    the other within 24 frames."""
    write_mesh(out / "rest.obj", vertices, faces)
    tracks = []
    for i, state in enumerate(states):
        write_mesh(out / f"state-{i}.obj", state, faces)
        keys = [{"frame": round(24 * (i + k / 2) / len(states)), "value": k % 2} for k in range(3)]
        tracks.append({"path": f"scene.objects.0.states.{i}.weight", "interpolation": "smooth", "keys": keys})
    return {"scene.objects.0.mesh": str(out / "rest.obj"), "scene.objects.0.transform": transform,
            "scene.objects.0.states": [{"mesh": str(out / f"state-{i}.obj")} for i in range(len(states))],
            "animation": {"fps": 12, "tracks": tracks}}


def torus(out):
    """Becomes an oval, then a saddle."""
    around, across = 128, 64
    a, b = np.meshgrid(np.arange(around) * 2 * np.pi / around, np.arange(across) * 2 * np.pi / across, indexing="ij")
    rest = np.stack([(1 + .36 * np.cos(b)) * np.cos(a), .36 * np.sin(b), -(1 + .36 * np.cos(b)) * np.sin(a)], -1)
    oval = rest * [1.3, 1, .7]
    saddle = rest + np.stack([0 * a, .45 * np.cos(2 * a), 0 * a], -1)
    at = lambda i, j: i % around * across + j % across + 1
    faces = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for i in range(around) for j in range(across)]
    return deforming(out, rest.reshape(-1, 3), faces, [oval.reshape(-1, 3), saddle.reshape(-1, 3)],
                     {"rotate_deg": [15, 0, 20], "translate": [.3, 1.6, 0]})


def jelly(out):
    """The bunny of first-light sinks, then leans."""
    file = next(path for folder in os.environ.get("XDG_DATA_DIRS", "/usr/local/share:/usr/share").split(":")
                if (path := Path(folder) / "glmark2/models/bunny.obj").exists())
    lines = [line.split() for line in file.read_text().splitlines() if line.strip()]
    rest = np.array([line[1:4] for line in lines if line[0] == "v"], float)
    faces = [[corner.split("/")[0] for corner in line[1:]] for line in lines if line[0] == "f"]
    low, high = rest.min(0), rest.max(0)
    up = (rest[:, 1:2] - low[1]) / (high[1] - low[1])
    middle = (low + high) / 2
    sunk = np.concatenate([middle[:1] + (rest[:, :1] - middle[0]) * (1 + .25 * up * (1 - up)),
                           low[1] + .8 * (rest[:, 1:2] - low[1]),
                           middle[2:] + (rest[:, 2:] - middle[2]) * (1 + .25 * up * (1 - up))], 1)
    leaning = rest + .3 * (high[1] - low[1]) * up ** 2 * np.array([1, -.3, 0])
    return deforming(out, rest, faces, [sunk, leaning],
                     {"scale": [2, 2, 2], "rotate_deg": [0, 20, 0], "translate": [-.6, 1.983, -.8]})


# A preset, and what is set in it or what makes that in a folder.
FILMS = {
    "water": ("spectral/pool", {}),
    "torus": ("first-light", torus),
    "jelly": ("first-light", jelly),
    "turning-sky": ("environment/turning-sky", {}),
    "turning-prism": ("spectral/turning-prism", {}),
    "passing-card": ("environment/passing-card", {}),
    "still": ("first-light", animation("scene.camera.fov_deg", 38, 38)),
    "camera": ("first-light", animation("scene.camera.position.0", 1.2, 1.8)),
    "glass": ("first-light", animation("scene.objects.0.transform.translate.0", -.6, -.35)),
    "fast-glass": ("first-light", animation("scene.objects.0.transform.rotate_deg.1", 20, 260)),
}


class Film:
    def __init__(self, program, out, name, options):
        self.program, self.out, self.name = program, Path(out) / name, name
        self.frames, self.count, self.size, self.photons = (options.frames, options.measured, options.size,
                                                            options.photons)
        self.out.mkdir(parents=True, exist_ok=True)
        self.preset, self.settings = FILMS[name]
        if callable(self.settings):
            self.settings = self.settings(self.out.resolve())

    def run(self, folder, passes, *words):
        folder = self.out / folder
        if not (folder / "frames.csv").exists():
            settings = {"scene.camera.resolution": self.size, "stop.seconds": None, "stop.passes": passes,
                        **self.settings, "animation.frames": self.frames}
            if not self.preset.startswith("environment/"):
                settings["spectral.photons_per_pass"] = self.photons
            sets = [word for key, value in settings.items() for word in ("--set", f"{key}={json.dumps(value)}")]
            done = subprocess.run([self.program, "run", self.preset, "-o", folder, *map(str, words), *sets],
                                  capture_output=True, text=True)
            if done.returncode:
                sys.exit(done.stderr.splitlines()[-1])
        return folder

    def measured(self):
        """The last frames, and the one before them."""
        return range(self.frames - self.count - 1, self.frames)

    def together(self, passes):
        folder = self.run(f"together-{passes}", passes)
        return [self.frame(folder, n) for n in self.measured()]

    def alone(self, passes, seed=None, seed_a_frame=False):
        name = f"alone-{passes}" + ("" if seed is None else f"-{seed}") + ("-seeds" if seed_a_frame else "")
        pictures = []
        for n in self.measured():
            of = n + 1000 if seed_a_frame else seed
            folder = self.run(f"{name}/{n:04}", passes, "--frames", n, *([] if of is None else ["--seed", of]))
            pictures.append(self.frame(folder, n))
        return pictures

    def frame(self, folder, n):
        seconds = json.loads((folder / f"frames/{n:04}/run.json").read_text())["work_seconds"]
        picture = folder / f"frame_{n:04}.exr"
        return read_layer(picture, ""), seconds, read_layer(picture, "caustic")


def rms(picture):
    return float(np.sqrt(np.mean(picture ** 2)))


def figures(film, reference):
    """Error, that of the caustic layer, Lab error, flicker, light with its standard error, seconds of work a frame."""
    errors, caustics, labs, flickers, light = [], [], [], [], []
    for n in range(1, len(film)):
        (ours, _, caustic), (truth, _, true_caustic) = film[n], reference[n]
        caustics.append(rms(caustic - true_caustic) / true_caustic.mean())
        light.append(ours.mean() / truth.mean())
        before, truth_before = film[n - 1][0], reference[n - 1][0]
        ours, truth, before, truth_before = (np.clip(picture, 0, 1) for picture in (ours, truth, before, truth_before))
        errors.append(rms(ours - truth) / truth.mean())
        labs.append(float(np.mean(np.linalg.norm(lab(ours) - lab(truth), axis=-1))))
        flickers.append(rms((ours - before) - (truth - truth_before)) / truth.mean())
    return [np.mean(errors), np.mean(caustics), np.mean(labs), np.mean(flickers), np.mean(light),
            np.std(light) / max(len(light) - 1, 1) ** .5, np.mean([seconds for _, seconds, _ in film[1:]])]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("out")
    parser.add_argument("films", nargs="*", default=list(FILMS))
    parser.add_argument("--frames", type=int, default=12)
    parser.add_argument("--measured", type=int, default=3)
    parser.add_argument("--photons", type=int, default=32768, help="a pass of engine 1")
    parser.add_argument("--passes", type=int, nargs="+", default=[2, 4, 8])
    parser.add_argument("--alone", type=int, nargs="*", default=None)
    parser.add_argument("--size", type=int, nargs=2, default=[128, 96])
    parser.add_argument("--reference-passes", type=int, default=128)
    parser.add_argument("--seeds", action="store_true", help="also frames by themselves with a seed each")
    options = parser.parse_args()
    print("| film | passes | frames | error | of caustics | CIELAB | flicker | light | seconds |\n"
          "|---|---|---|---|---|---|---|---|---|")
    for name in options.films:
        film = Film(options.program, options.out, name, options)
        reference = film.alone(options.reference_passes, seed=4711)
        ways = [("alone", p, film.alone(p)) for p in (options.alone or options.passes)]
        if options.seeds:
            ways += [("alone, a seed each", p, film.alone(p, seed_a_frame=True)) for p in options.passes]
        ways += [("together", p, film.together(p)) for p in options.passes]
        for way, passes, pictures in ways:
            error, caustic, colour, flicker, light, spread, seconds = figures(pictures, reference)
            print(f"| {name} | {passes} | {way} | {error:.3f} | {caustic:.3f} | {colour:.2f} | {flicker:.3f} | "
                  f"{light:.4f} ± {spread:.4f} | {seconds:.2f} |", flush=True)
        chosen = [film.frames - 2, film.frames - 1]
        passes = options.passes[0]
        files = [film.out / f"{folder.format(n)}/frame_{n:04}.png" for n in chosen
                 for folder in (f"alone-{options.reference_passes}-4711/{{:04}}", f"alone-{passes}/{{:04}}",
                                f"together-{passes}")]
        side_by_side(files, 3, 384, Path(options.out) / f"{name}.png")


if __name__ == "__main__":
    main()
