#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes presets/thumbnails/ again: a small picture of each shipped preset, for the panel Presets.

    tests/experiments/thumbnails.py PROGRAM [NAME...]     of these presets, or of all; one at a time, with the lowest priority

Each is rendered small for a few seconds. What takes longer, or needs a file that this machine has not, is skipped with the reason.
ImageMagick makes the JPEG files.
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

WIDTH, HEIGHT = 128, 96
SECONDS, PATIENCE = 8, 120
TARGET = Path(__file__).resolve().parents[2] / "presets" / "thumbnails"


def own_resolution(file):
    """As the file or its parents say it; 512 x 512 is the default."""
    value = json.loads(file.read_text())
    found = value.get("scene", {}).get("camera", {}).get("resolution")
    if found:
        return found
    if "parent" not in value:
        return [512, 512]
    root = TARGET.parent
    for folder in (file.parent, root):
        for ending in ("", ".json"):
            parent = folder / (value["parent"] + ending)
            if parent.is_file():
                return own_resolution(parent)
    return [512, 512]


def render(program, preset, target):
    """Empty, or why there is no picture."""
    width, height = own_resolution(Path(preset["file"]))
    scale = min(WIDTH / width, HEIGHT / height)
    size = [max(1, round(width * scale)), max(1, round(height * scale))]
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "run", preset["name"], "--seconds", str(SECONDS), "-o", folder + "/run",
                   "--set", f"scene.camera.resolution={size}", "--set", "sweep=null", "--set", "reference=null", "--set", "animation=null",
                   "--set", "measure.mask=null", "--set", "stop.error=null"]
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
    shipped = json.loads(subprocess.run([program, "presets", "--json"], capture_output=True, text=True, check=True).stdout)
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
