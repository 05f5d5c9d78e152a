# SPDX-License-Identifier: Apache-2.0
"""What pictures.py and tours.py make the docs' pictures with: runs, windows, and several pictures side by side."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "docs"))
from commands import CUT, CUT_OF_ENGINE  # noqa: E402
from documents import Page  # noqa: E402

MOST_BYTES = 500_000


class Studio:
    """Works in a folder that has the files of the tours. small: tiny runs, windows that do not wait, nothing kept."""

    def __init__(self, program, folder, docs, small=False):
        self.program, self.folder, self.docs, self.small = str(Path(program).resolve()), Path(folder), docs, small
        for page in sorted((ROOT / "docs" / "tours").glob("*.md")):
            for name, content in Page(page, ROOT).files:
                (self.folder / name).write_bytes(content)

    def call(self, *command, **more):
        subprocess.run([str(word) for word in command], cwd=self.folder, check=True, stdout=subprocess.DEVNULL, **more)

    def cut(self, preset, options):
        """Options that make a run of the preset tiny."""
        plan = subprocess.run(
            [self.program, "plan", preset, "--json", "--set", "sweep=null", "--set", "animation=null"],
            cwd=self.folder,
            check=True,
            capture_output=True,
            text=True,
        )
        return options + CUT + CUT_OF_ENGINE[json.loads(plan.stdout.splitlines()[0])["engine"]]

    def run(self, name, preset, *sets, size=None, passes=None, seconds=None):
        """The run's folder. Not beside presets: a folder would be found before a preset of its name."""
        folder = self.folder / "runs" / name
        if (folder / "run.json").exists():
            return folder
        options = [word for value in sets for word in ("--set", value)]
        options += ["--set", f"scene.camera.resolution=[{size[0]},{size[1]}]"] if size else []
        if self.small:
            options = self.cut(preset, options) + ["--passes", 1]
        else:
            options += ["--passes", passes] if passes else []
            options += ["--seconds", seconds] if seconds else []
        self.call(self.program, "run", preset, "-o", folder, *options)
        return folder

    def runs(self, preset, passes=4):
        """The folder of a preset with a sweep or an animation: small pictures of many runs."""
        folder = self.folder / "runs" / preset
        if not folder.exists():
            cut = ["--set", "scene.camera.resolution=[64,64]"] if self.small else []
            self.call(
                self.program,
                "run",
                preset,
                "-o",
                folder,
                "--set",
                "spectral.photons_per_pass=65536",
                "--passes",
                1 if self.small else passes,
                *cut,
            )
        return folder

    def script(self, name, *arguments):
        """One of tests/experiments, which prints tables too."""
        self.call(sys.executable, ROOT / "tests" / "experiments" / name, self.program, *arguments)

    def render(self, *arguments, **more):
        return self.run(*arguments, **more) / "image.png"

    def window(self, name, preset, layout, *sets, until=1, pinned=()):
        target = self.folder / f"{name}.png"
        options = [word for value in sets for word in ("--set", value)]
        options = (
            self.cut(preset, options) + ["--frames", 3] if self.small else [*options, "--frames", 60, "--until", until]
        )
        self.call(
            "xvfb-run",
            "-a",
            "-s",
            "-screen 0 1600x1000x24",
            self.program,
            preset,
            *pinned,
            *options,
            "--layout",
            layout,
            "--size",
            "1120x700",
            "--screenshot",
            target,
        )
        return target

    def keep(self, name, pictures, columns=1, gap=2, widest=None, quality=88, geometry=None):
        """Side by side, as docs/NAME. Of one picture that is to stay as it is, the file itself."""
        for picture in pictures:
            if not Path(picture).is_file():
                raise FileNotFoundError(f"there is no {picture}")
        if self.small:
            return
        target = self.docs / name
        gap = gap if len(pictures) > 1 else 0
        if len(pictures) == 1 and not widest and Path(pictures[0]).suffix == target.suffix:
            shutil.copyfile(pictures[0], target)
        else:
            self.call(
                "montage",
                *pictures,
                "-tile",
                f"{columns}x",
                "-geometry",
                f"{geometry or ''}+{gap}+{gap}",
                "-background",
                "black",
                "all.png",
            )
            self.call(
                "convert",
                "all.png",
                *(["-resize", f"{widest}x>"] if widest else []),
                "-strip",
                "-quality",
                quality,
                target,
            )
        print(f"{name}: {target.stat().st_size} bytes", flush=True)
        if target.stat().st_size > MOST_BYTES:
            raise OSError(f"{target} is larger than {MOST_BYTES} bytes")
