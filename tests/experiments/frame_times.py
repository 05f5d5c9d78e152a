#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures how long the window's frames take while each engine works, and how soon an edit is followed by a run.

    tests/experiments/frame_times.py PROGRAM [ENGINE...]     of these engines, or of spectral, environment and inverse

For each engine a preset is opened in a window under Xvfb, twice: the first opening compiles its kernels, the second is
the warm start. Then its file is changed, which the window takes over as an edit, and keys of xdotool undo and redo that
edit while the run works. What is printed comes from the file of --frame-times, so an edit's times are those of the
frames in which it was seen. Nothing else should run on the machine: it draws by software, and with PoCL it computes on
the same cores. Needs Xvfb and xdotool.
"""
import csv
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

RECEIVERS = [{"distance_mm": d, "picture": {"type": "disc", "radius": 0.3}} for d in (100, 150)]
MOVED = [dict(RECEIVERS[0]), dict(RECEIVERS[1], distance_mm=160)]
# A preset, and the edit that is done and undone.
PRESETS = {
    "spectral": ({"parent": "first-light"}, {"scene": {"camera": {"position": [1.3, 7.2, 10.2]}}}),
    "environment": ({"parent": "environment/ball"}, {"scene": {"camera": {"position": [0.6, 5, 7]}}}),
    "inverse": ({"parent": "inverse/shapes", "inverse": {"receivers": RECEIVERS}}, {"inverse": {"receivers": MOVED}}),
}
SECONDS, EDITS = 10, 20
PATIENCE = 120  # for what has to come


class Window:
    def __init__(self, program, preset, folder, display):
        self.times = Path(folder) / "frames.csv"
        self.times.unlink(missing_ok=True)
        self.environment = dict(os.environ, DISPLAY=display, XDG_STATE_HOME=folder)
        self.began = time.monotonic()
        self.log = open(Path(folder) / "log", "w")
        self.child = subprocess.Popen([program, str(preset), "--frame-times", str(self.times)], stdout=self.log,
                                      stderr=self.log,
                                      env=self.environment)
        self.opened_s = None

    def frames(self):
        """What is complete of the file, with "at": seconds since the first frame began."""
        if not self.times.exists():
            return []
        text = self.times.read_text()
        rows, at = [], 0.0
        for row in csv.DictReader(text[:text.rfind("\n") + 1].splitlines()):
            at += float(row["period_ms"]) / 1000
            rows.append({name: value if name == "state" else float(value) for name, value in row.items()} | {"at": at})
        return rows

    def until(self, what, condition):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            frames = self.frames()
            if frames and self.opened_s is None:
                self.opened_s = time.monotonic() - self.began - frames[-1]["at"]
            if frames and condition(frames):
                return frames
            if self.child.poll() is not None:
                sys.exit(f"the program ended: {Path(self.log.name).read_text().strip()}")
            time.sleep(0.01)
        sys.exit(f"it does not come to this: {what}")

    def keys(self, chord):
        subprocess.run(["xdotool", "key", chord], env=self.environment, check=True)

    def focus(self):
        found = subprocess.run(["xdotool", "search", "--onlyvisible", "--name", "Nephroid"], env=self.environment,
                               capture_output=True,
                               text=True, check=True).stdout.split()
        subprocess.run(["xdotool", "windowfocus", "--sync", found[0]], env=self.environment, check=True)

    def close(self):
        self.child.terminate()
        self.child.wait()
        self.log.close()


def percentile(values, part):
    return sorted(values)[min(len(values) - 1, int(part * len(values)))]


def has_worked(frame):
    """Whether some of the run is done."""
    return frame["state"] == "finished" or (frame["state"] == "running" and frame["fraction"] > 0)


def begins(before, frame):
    """Whether a run was begun between two frames. A run that takes an edit on is the same run, and what is done of it
    begins anew."""
    return frame["run"] > before["run"] or frame["fraction"] < before["fraction"]


def after_edits(frames):
    """Seconds from the start of the frame that sees an edit until its run is begun, and until some of it is done. An
    edit is carried out before the frame is drawn, so what is told of that frame's own share is the most that it can
    have taken."""
    begun, done = [], []
    for i in range(1, len(frames)):
        if frames[i]["edits"] == frames[i - 1]["edits"]:
            continue
        before, start = frames[i - 1], None
        for j in range(i, len(frames)):
            if j > i and frames[j]["edits"] != frames[i]["edits"]:
                break
            if start is None and begins(before, frames[j]):
                start = j
                begun.append(frames[j]["at"] - frames[i]["at"] + frames[j]["own_ms"] / 1000)
            if start is not None and has_worked(frames[j]):
                done.append(frames[j]["at"] - frames[i]["at"])
                break
    return begun, done


def first_image_s(window):
    frames = window.until("a first image", lambda f: has_worked(f[-1]))
    first = next(f for f in frames if has_worked(f))
    return window.opened_s + first["at"]


def measure(program, engine, display):
    base, edit = PRESETS[engine]
    with tempfile.TemporaryDirectory() as folder:
        preset = Path(folder) / "measured.json"
        preset.write_text(json.dumps(base))
        cold = Window(program, preset, folder, display)
        cold_s = first_image_s(cold)
        cold.close()
        window = Window(program, preset, folder, display)
        warm_s = first_image_s(window)
        window.focus()
        time.sleep(2)  # the window has looked at the file by then
        before = len(window.frames())
        preset.write_text(json.dumps(base | edit))
        window.until("the changed file is taken over", lambda f: any(begins(f[i - 1], f[i])
                                                                     for i in range(before, len(f))))
        window.until("its run works", lambda f: has_worked(f[-1]))
        first = len(window.frames())
        for i in range(EDITS):
            edits = window.frames()[-1]["edits"]
            window.keys("ctrl+z" if i % 2 == 0 else "ctrl+shift+z")
            time.sleep(SECONDS / EDITS)
            window.until("the edit's run works", lambda f: f[-1]["edits"] > edits and has_worked(f[-1]))
        frames = window.frames()[first:]
        window.close()
    return frames, cold_s, warm_s


def main(program, engines):
    server = subprocess.Popen(["Xvfb", "-displayfd", "1", "-screen", "0", "1600x1000x24", "-nolisten", "tcp",
                               "-noreset"],
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    display = ":" + server.stdout.readline().strip()
    try:
        print("            our own share of a frame, ms         | what it computes   | from an edit to its run, ms: "
              "begun, some done | seconds to the first image")
        print("engine      frames  median    95 %    99 %     max |  median    99 %    |   edits  median     max  "
              "median     max       |    cold    warm")
        for engine in engines:
            frames, cold_s, warm_s = measure(program, engine, display)
            own, computed = ([f[name] for f in frames] for name in ("own_ms", "own_cpu_ms"))
            begun, done = ([1000 * s for s in times] for times in after_edits(frames))
            figures = [percentile(t, part) if t else float("nan") for t in (begun, done) for part in (0.5, 1)]
            print(f"{engine:11} {len(own):6} " + " ".join(f"{percentile(own, part):7.2f}"
                                                          for part in (0.5, 0.95, 0.99, 1))
                  + f" | {percentile(computed, 0.5):7.2f} {percentile(computed, 0.99):7.2f}    | "
                    f"{len(begun):3}/{len(done):3} " + " ".join(f"{value:7.0f}" for value in figures)
                  + f"       | {cold_s:7.2f} {warm_s:7.2f}", flush=True)
    finally:
        server.terminate()
        server.wait()


if __name__ == "__main__":
    unknown = [name for name in sys.argv[2:] if name not in PRESETS]
    if len(sys.argv) < 2 or not os.access(sys.argv[1], os.X_OK) or unknown:
        sys.exit("usage: frame_times.py PROGRAM [ENGINE...], PROGRAM being the program, as build/release/bin/nephroid; "
                 "engines: "
                 + ", ".join(PRESETS))
    main(sys.argv[1], sys.argv[2:] or list(PRESETS))
