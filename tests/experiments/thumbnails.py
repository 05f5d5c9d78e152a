#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes presets/thumbnails/ again: a small picture of each shipped preset, for the panel Presets.

    tests/experiments/thumbnails.py PROGRAM [NAME...]   of these presets, or of all; one at a time, of lowest priority

Each is rendered small for a few seconds; of the engine environment the bake comes before that, from fewer photons. What
takes longer, or needs a file that this machine has not, is skipped with the reason. ImageMagick makes the JPEG files.
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

WIDTH, HEIGHT = 128, 96
SECONDS, PASSES, PATIENCE = 20, 32, 240
TARGET = Path(__file__).resolve().parents[2] / "presets" / "thumbnails"


def own(file, find, default):
    """What find(JSON) has of the file, or else of its parents."""
    value = json.loads(file.read_text())
    found = find(value)
    if found:
        return found
    for folder in (file.parent, TARGET.parent):
        for ending in ("", ".json"):
            parent = folder / (value.get("parent", "") + ending)
            if parent.is_file():
                return own(parent, find, default)
    return default


def render(program, preset, target):
    """Empty, or why there is no picture."""
    file = Path(preset["file"])
    width, height = own(file, lambda value: value.get("scene", {}).get("camera", {}).get("resolution"), [512, 512])
    scale = min(WIDTH / width, HEIGHT / height)
    size = [max(1, round(width * scale)), max(1, round(height * scale))]
    with tempfile.TemporaryDirectory() as folder:
        command = ["nice", "-n", "19", program, "run", preset["name"], "--seconds", str(SECONDS), "-o", folder + "/run",
                   "--set", f"scene.camera.resolution={size}", "--set", "sweep=null", "--set", "reference=null",
                   "--set", "animation=null",
                   "--set", "measure.mask=null", "--set", "stop.error=null"]
        if own(file, lambda value: value.get("engine"), "spectral") == "environment":
            command[command.index("--seconds"):command.index("--seconds") + 2] = ["--passes", str(PASSES)]
            command += ["--set", "environment.photons=16384"]
        try:
            run = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            return f"takes longer than {PATIENCE} s"
        picture = Path(folder) / "run" / "image.png"
        if run.returncode != 0 or not picture.is_file():
            return run.stderr.strip().splitlines()[-1] if run.stderr.strip() else f"exit code {run.returncode}"
        target.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run(["convert", str(picture), "-strip", "-quality", "85", str(target)], check=True)
    return ""


def main(program, names):
    shipped = json.loads(subprocess.run([program, "presets", "--json"], capture_output=True, text=True,
                                        check=True).stdout)
    skipped = 0
    for preset in shipped:
        if names and preset["name"] not in names:
            continue
        target = TARGET / (preset["name"] + ".jpg")
        reason = render(program, preset, target)
        skipped += bool(reason)
        print(f"{preset['name']}: {'skipped: ' + reason if reason else f'{target.stat().st_size} bytes'}", flush=True)
    total = sum(file.stat().st_size for file in TARGET.rglob("*.jpg"))
    print(f"{total} bytes in all; {skipped} skipped")


if __name__ == "__main__":
    if len(sys.argv) < 2 or not os.access(sys.argv[1], os.X_OK):
        sys.exit("usage: thumbnails.py PROGRAM [NAME...], PROGRAM being the program, as build/release/bin/nephroid")
    main(sys.argv[1], sys.argv[2:])
