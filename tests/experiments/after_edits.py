#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures what the window shows after an edit: the time to the first picture, and errors of the pictures after that.

    tests/experiments/after_edits.py PROGRAM OUT BENCH [OLD_BENCH]

BENCH is build/release/tests/bench/nephroid_after_edit, OLD_BENCH that of another version to compare with; it says what
it does. PROGRAM renders the truths into OUT/truth once: so many passes without smoothing. Each scene is measured after
its camera was moved, first-light after each edit. Of every edit the time to the first picture is taken, median and most
of five. Tables go to OUT/tables.md, pictures to OUT/strip-SCENE-EDIT.jpg, a row for each program. Nothing else should
run on the machine.
"""
import csv
import json
import subprocess
import sys
from pathlib import Path

CURVE = [[380, 1.84], [470, 1.80], [540, 1.79], [620, 1.775], [780, 1.76]]
ROOM_BUNNY = {"scale": [2, 2, 2], "rotate_deg": [0, 20, 0], "translate": [-0.3, 1.983, -0.6]}
BUNNY = {"preset": "first-light", "passes": 250, "camera": [1.5, 7.4, 10.0], "glass": "glass", "lamp": "D65",
         "object": ROOM_BUNNY}
# A preset, what is set in it, passes of the truth, and the edits.
SCENES = {
    "first-light": BUNNY,
    "brilliant": {"preset": "spectral/brilliant", "passes": 300, "camera": [1, 15, 23], "glass": "diamond",
                  "lamp": "F10",
                  "object": {"translate": [0.4, 4.2, 0]}},
    "newton": {"preset": "spectral/thesis/newton", "passes": 400, "camera": [8.4, 9.2, 12.8], "glass": "glass",
               "lamp": "D65",
               "object": {"rotate_deg": [-90, 0, 25], "translate": [0.2, 1.7, 0]}},
    "ball-lens": {"preset": "spectral/ball-lens", "passes": 400, "camera": [4.2, 4.2, 3.8], "glass": "glass",
                  "lamp": "F10",
                  "object": {"translate": [0.1, 0.1, 0]}},
    "glass-in-a-room": {"preset": "spectral/glass-in-a-room", "passes": 150, "camera": [0.5, 6.4, 20.6],
                        "glass": "glass", "lamp": "F10",
                        "object": {"translate": [-2.1, 1.7, 1.6]}},
    "faceted bunny": BUNNY | {"set": ["scene.objects.0.normals=faceted"]},
    "relit bunny": BUNNY | {"set": ["spectral.relight=true"]},
}
TABLE_TIMES = ["0.1", "0.25", "0.5", "1", "3", "10", "30"]
STRIP_TIMES = ["00.10", "00.25", "00.50", "01.00", "03.00"]
SECONDS = 30  # after an edit
EDITS = 5     # whose first pictures are waited for


def edits_of(scene):
    return {
        "camera": f"scene.camera.position={scene['camera']}",
        "dispersion": f"scene.materials.{scene['glass']}.dispersion=" + json.dumps({"type": "points", "table": CURVE}),
        "spectrum": f"scene.lights.0.spectrum={scene['lamp']}",
        "object": "scene.objects.0.transform=" + json.dumps(scene["object"]),
    }


def truth_of(program, out, name, scene, edit):
    folder = out / "truth" / f"{name}-{edit}".replace(" ", "-")
    if not (folder / "image.exr").exists():
        sets = [*scene.get("set", []), edits_of(scene)[edit], f'stop={{"passes": {scene["passes"]}}}',
                "spectral.smoothing=off"]
        if "spectral.relight=true" in sets:  # the picture is the same one
            sets.remove("spectral.relight=true")
        subprocess.run([program, "run", scene["preset"], "-o", folder, *(word for s in sets for word in ("--set", s))],
                       check=True)
    return folder / "image.exr"


def words(bench, number, truth, folder, scene, edit):
    return [bench, str(number), truth, folder, scene["preset"], edits_of(scene)[edit], *scene.get("set", [])]


def first_picture(bench, scene, edit):
    """Milliseconds from an edit to its first picture: median and most."""
    answer = subprocess.run(words(bench, EDITS, "-", "-", scene, edit), check=True, stdout=subprocess.PIPE,
                            text=True).stdout
    return [1000 * float(seconds) for seconds in answer.split(",")]


def rows_by_time(bench, scene, edit, truth, folder):
    folder.mkdir(parents=True, exist_ok=True)
    answer = subprocess.run(words(bench, SECONDS, truth, folder, scene, edit), check=True, stdout=subprocess.PIPE,
                            text=True).stdout
    return {row["seconds"]: row for row in csv.DictReader(answer.splitlines())}


def entry(row):
    errors = f"{float(row['lab_mean']):.1f}, {float(row['rel_l2']):.3f}, {float(row['flip']):.3f}"
    return f"({errors})" if row["previous"] else errors


def main():
    program, out, *benches = sys.argv[1:]
    out = Path(out)
    out.mkdir(parents=True, exist_ok=True)
    edits = list(edits_of(BUNNY))
    long = [(name, "camera") for name in SCENES] + [("first-light", edit) for edit in edits[1:]]
    for name, edit in long:
        truth_of(program, out, name, SCENES[name], edit)

    lines = ["| scene | program | " + " | ".join(edits) + " |", "|---" * (2 + len(edits)) + "|"]
    for name, scene in SCENES.items():
        for number, bench in enumerate(benches):
            firsts = [first_picture(bench, scene, edit) for edit in edits]
            lines.append(f"| {name} | {number} | " + " | ".join(f"{median:.0f}, {most:.0f}" for median, most in firsts)
                         + " |")
            print(lines[-1], flush=True)
    lines += ["", "| scene, edit | program | " + " | ".join(TABLE_TIMES) + " |", "|---" * (2 + len(TABLE_TIMES)) + "|"]
    for name, edit in long:
        rows = []
        for number, bench in enumerate(benches):
            folder = out / f"{name}-{edit}-{number}".replace(" ", "-")
            by_time = rows_by_time(bench, SCENES[name], edit, truth_of(program, out, name, SCENES[name], edit), folder)
            lines.append(f"| {name}, {edit} | {number} | " + " | ".join(entry(by_time[time]) for time in TABLE_TIMES)
                         + " |")
            print(lines[-1], flush=True)
            rows.append(["(", *(str(folder / f"{time}.png") for time in STRIP_TIMES), "-resize", "256x", "+append",
                         ")"])
        strip = out / f"strip-{name}-{edit}.jpg".replace(" ", "-")
        subprocess.run(["convert", *(word for row in reversed(rows) for word in row), "-append", "-quality", "85",
                        strip], check=True)
    (out / "tables.md").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
