#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the pictures of docs/tours again, from the presets and files that stand in the tours themselves.

    tests/experiments/tours.py PROGRAM [PICTURE...]     of these names (dispersion-glasses), or all; one at a time

Renders are by `nephroid run`, pictures of the window by --screenshot under Xvfb. ImageMagick puts them side by side as
JPEG.
"""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "docs"))
from documents import Page  # noqa: E402

TOURS = ROOT / "docs" / "tours"
WIDEST = 640
GLASS = "scene.materials.glass.dispersion"
STRIPES = ["spectral.differentials=false", "spectral.threshold_deg=1"]
FEW_PHOTONS = ["--set", "spectral.photons_per_pass=65536", "--passes", 4]  # small pictures of many runs
NEWTON = ["scene.camera.target=[9.3,0,0]", "scene.camera.fov_deg=30"]


class Studio:
    def __init__(self, program, folder):
        self.program, self.folder = str(Path(program).resolve()), Path(folder)
        for page in sorted(TOURS.glob("*.md")):
            for name, content in Page(page, ROOT).files:
                (self.folder / name).write_bytes(content)

    def call(self, *command):
        subprocess.run([str(word) for word in command], cwd=self.folder, check=True, stdout=subprocess.DEVNULL)

    def run(self, name, preset, *sets, size=None, passes=None, seconds=None):
        """The run's folder."""
        if (self.folder / name / "run.json").exists():
            return self.folder / name
        options = [word for value in sets for word in ("--set", value)]
        options += ["--set", f"scene.camera.resolution=[{size[0]},{size[1]}]"] if size else []
        options += ["--passes", passes] if passes else []
        options += ["--seconds", seconds] if seconds else []
        self.call(self.program, "run", preset, "-o", name, *options)
        return self.folder / name

    def render(self, *arguments, **more):
        return self.run(*arguments, **more) / "image.png"

    def window(self, name, preset, layout, *sets, until=1, pinned=()):
        target = self.folder / f"{name}.png"
        options = [word for value in sets for word in ("--set", value)]
        self.call("xvfb-run", "-a", "-s", "-screen 0 1600x1000x24", self.program, preset, *pinned, *options, "--layout",
                  layout, "--size", "1120x700",
                  "--frames", 60, "--until", until, "--screenshot", target)
        return target

    def keep(self, name, pictures, columns):
        """Side by side, at most WIDEST wide, as docs/tours/NAME.jpg."""
        target = TOURS / f"{name}.jpg"
        self.call("montage", *pictures, "-tile", f"{columns}x", "-geometry", "+2+2", "-background", "black",
                  self.folder / "all.png")
        self.call("convert", self.folder / "all.png", "-resize", f"{WIDEST}x>", "-strip", "-quality", 85, target)
        print(f"{target.relative_to(ROOT)}: {target.stat().st_size} bytes", flush=True)
        if target.stat().st_size > 120_000:
            sys.exit(f"{target} is larger than 120 kB")


def dispersion_glasses(s):
    return [s.render("flint", "first-light", size=(320, 320), passes=8),
            s.render("crown", "first-light", f"{GLASS}=materials/N-BK7.yml", size=(320, 320), passes=8)], 2


def dispersion_window(s):
    return [s.window("newton", "spectral/thesis/newton", "dispersion", "scene.camera.resolution=[256,256]",
                     "stop.passes=8")], 1


def dispersion_designed(s):
    return [s.render("n-sf11", "spectral/thesis/newton", *NEWTON, size=(640, 200), passes=8),
            s.render("wavy", "wavy", *NEWTON, size=(640, 200), passes=8)], 1


def hdri_lights(s):
    s.call(s.program, "segment", "sky.hdr", "-q", 24, "-o", "lights.png")
    return [s.folder / "lights.png"], 1


def hdri_glass(s):
    return [s.render("drink", "drink", size=(480, 360), seconds=30)], 1


def hdri_window(s):
    return [s.window("drink-window", "drink", "environment", "scene.camera.resolution=[256,192]", "stop.seconds=15")], 1


def three_sheet(s):
    return [s.run("shapes", "inverse/shapes") / "image.png"], 1


def three_view(s):
    return [s.render("view", str(s.run("shapes", "inverse/shapes") / "view.json"), size=(560, 350), seconds=20)], 1


def three_window(s):
    return [s.window("mine-window", "mine", "annealing")], 1


def runs_of_sweep(s):
    folder = s.folder / "glasses"
    if not folder.exists():
        s.call(s.program, "run", "glasses", "-o", "glasses", *FEW_PHOTONS)
    return [folder / f"00{number}" for number in (1, 3, 5, 2, 4, 6)]


def batch_sweep(s):
    return [run / "image.png" for run in runs_of_sweep(s)], 3


def batch_window(s):
    return [s.window("glasses-window", "glasses", "runs", "scene.camera.resolution=[256,256]",
                     "spectral.photons_per_pass=65536", "stop.passes=4",
                     pinned=sorted(runs_of_sweep(s)))], 1


def batch_frames(s):
    if not (s.folder / "tilt").exists():
        s.call(s.program, "run", "tilt", "-o", "tilt", *FEW_PHOTONS)
    return [s.folder / "tilt" / f"frame_{number:04}.png" for number in range(8)], 4


def material_window(s):
    return [s.window("heavy-window", "heavy-bunny", "dispersion", "scene.camera.resolution=[320,320]",
                     "stop.passes=8")], 1


def material_colour(s):
    return [s.render("clear", "heavy-bunny", size=(320, 320), passes=8),
            s.render("green", "heavy-bunny", f"{GLASS}=green.yml", size=(320, 320), passes=8)], 2


def option_stripes(s):
    return [s.render(f"jitter-{on}", "spectral/thesis/newton", *NEWTON, *STRIPES, f"spectral.jitter={on}",
                     size=(640, 200), passes=4)
            for on in ("false", "true")], 1


def option_plan(s):
    return [s.window("plan", "first-light", "plan", "scene.camera.resolution=[256,256]", "stop.passes=8")], 1


PICTURES = [dispersion_glasses, dispersion_window, dispersion_designed, hdri_lights, hdri_glass, hdri_window,
            three_sheet, three_view, three_window,
            batch_sweep, batch_window, batch_frames, material_window, material_colour, option_stripes, option_plan]


def main(program, wanted):
    with tempfile.TemporaryDirectory(prefix="nephroid-tours-") as folder:
        studio = Studio(program, folder)
        for make in PICTURES:
            name = make.__name__.replace("_", "-")
            if not wanted or name in wanted:
                studio.keep(name, *make(studio))


if __name__ == "__main__":
    if len(sys.argv) < 2 or not os.access(sys.argv[1], os.X_OK):
        sys.exit("usage: tours.py PROGRAM [PICTURE...], PROGRAM being the program, as build/release/bin/nephroid")
    main(sys.argv[1], sys.argv[2:])
