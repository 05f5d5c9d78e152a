#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs every command of README.md, the pages below docs/ and the program's help, cut short, and demands that it works.

    tests/docs/commands.py PROGRAM [PAGE...]      PAGE: a part of a page's name; `help` is the examples of `--help`

A page's commands stand in ```sh blocks (documents.py reads them, and says what marks there are). They run in the order
of the page, in a folder of its own that looks like a clone: `presets` and `kernels` are there. So a later command finds
what an earlier one wrote. What is cut, and nothing else (CUT and cut_short):

- `run` has one pass, a picture of 64 x 64 pixels, no reference, few photons, few facets and a small bake, and of an
  animation two frames. Where the command itself has at most 2 passes it keeps them. Before that, `plan` is asked about
  the same preset and settings as they stand, at full size.
- A `run` or `plan` of a shipped preset that stands on several pages is run once; a later page gets a copy of its
  folder.
- `export` renders its pictures of light, 64 pixels wide, for a second each.
- `check` is run by tests of its own; here its arguments are checked.
- a window opens on a virtual display, with 3 frames and a screenshot. Where there is no Xvfb, it is not run.

Every option that a command in running text has must be one of its verb. What was run, checked for its arguments only,
and not run is printed at the end, with reasons.
"""
import json
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from documents import Page, help_page  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
CUT = ["--set", "scene.camera.resolution=[64,64]", "--set", "reference=null"]
CUT_OF_ENGINE = {"spectral": ["--set", "spectral.photons_per_pass=1024"],
                 "inverse": ["--set", "inverse.facets=[16,16]", "--set", "inverse.cells=[32,32]"],
                 "environment": ["--set", "environment.photons=1024", "--set", "environment.resolution=16", "--set",
                                 "environment.spheres=4",
                                 "--set", "environment.lights=6"]}
MOST_PASSES = 2
LONGEST = 240  # seconds that one command may take, on a busy machine


def processor_seconds():
    """Of all commands so far: what a busy machine does not change."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def value_of(words, name):
    """Of the option `name`, with its place; None where it is not there."""
    return (words.index(name), words[words.index(name) + 1]) if name in words[:-1] else None


def without(words, options):
    """The words without these options and their values."""
    rest = list(words)
    for option in options:
        if found := value_of(rest, option):
            del rest[found[0]:found[0] + 2]
    return rest


def cut_short(words, engine):
    """A `run` as the test does it."""
    short = without(words, ("--seconds", "--until-error", "--pictures-at"))
    passes = value_of(short, "--passes")
    if passes and int(passes[1]) > MOST_PASSES:
        short[passes[0] + 1] = "1"
    if frames := value_of(short, "--frames"):
        first = frames[1].split("-")[0]
        short[frames[0] + 1] = f"{first}-{int(first) + 1}"
    return short + ([] if passes else ["--passes", "1"]) + CUT + CUT_OF_ENGINE.get(engine, [])


def settings_of(words):
    return [part for at, word in enumerate(words[:-1]) if word == "--set" for part in ("--set", words[at + 1])]


def output_of(words):
    """The folder of a `run`, as the program chooses it."""
    for name in ("-o", "--output"):
        if found := value_of(words, name):
            return Path(found[1])
    return Path("out") / Path(words[1]).stem


class Display:
    """A virtual X display of this test's own."""

    def __init__(self):
        self.server = subprocess.Popen(["Xvfb", "-displayfd", "1", "-screen", "0", "1600x1000x24", "-nolisten", "tcp",
                                        "-noreset"],
                                       stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.name = ":" + self.server.stdout.readline().strip()

    def close(self):
        self.server.terminate()
        self.server.wait()


class Runner:
    def __init__(self, program):
        self.program = Path(program).resolve()
        self.help = {}
        self.verbs = re.findall(r"^  ([a-z]+) ", self.help_of("").split("Verbs:")[1], re.M)
        self.presets = set(re.findall(r"^(\S+)", self.text("presets"), re.M))
        self.own = set()  # presets that the page gives
        self.planned = {}  # of what `plan` was asked about a shipped preset: its engine
        self.made = {}  # of a `run` of a shipped preset: its finished folder, a copy
        self.kept = tempfile.TemporaryDirectory(prefix="nephroid-docs-made-")
        self.counts, self.failures, self.notes = Counter(), [], []
        self.display = Display() if "--screenshot" in self.help_of("") and shutil.which("Xvfb") else None

    def text(self, *arguments):
        return subprocess.run([self.program, *arguments], capture_output=True, text=True, check=True).stdout

    def help_of(self, verb):
        if verb not in self.help:
            self.help[verb] = self.text(*([verb] if verb else []), "--help")
        return self.help[verb]

    def environment(self, folder):
        """The user's cache of kernels, and nothing else of the user's."""
        cache = os.environ.get("POCL_CACHE_DIR", os.path.expanduser("~/.cache/pocl/kcache"))
        own = {"XDG_CACHE_HOME": f"{folder}/.cache", "XDG_STATE_HOME": f"{folder}/.state", "POCL_CACHE_DIR": cache}
        if self.display:  # the driver's memory is not ours: as tests/support/x_display.h says
            own |= {"DISPLAY": self.display.name, "ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "")
                    + ":detect_leaks=0"}
        everything = os.environ | own
        everything.pop("WAYLAND_DISPLAY", None)
        return everything

    def fail(self, command, reason):
        self.failures.append(f"{command.place}: {command.text}\n    {reason}")
        print(f"FAILED {self.failures[-1]}", flush=True)

    def run(self, command, folder, words):
        """True where it ends with exit code 0. What it prints goes to the file that the line names after `>`."""
        start = processor_seconds()
        target = subprocess.PIPE
        if ">" in words:
            at = words.index(">")
            target, words = open(folder / words[at + 1], "w", encoding="utf-8"), words[:at] + words[at + 2:]
        try:
            ended = subprocess.run([self.program, *words], cwd=folder, env=self.environment(folder),
                                   stdin=subprocess.DEVNULL,
                                   stdout=target, stderr=subprocess.PIPE, text=True, timeout=LONGEST)
        except subprocess.TimeoutExpired:
            self.fail(command, f"takes longer than {LONGEST} s as: {' '.join(words)}")
            return False
        if "--frames" in words and "has no animation" in ended.stderr and "--frames" not in command.words:
            raise LookupError
        print(f"{processor_seconds() - start:5.1f} s  {command.place}: nephroid {' '.join(words)}", flush=True)
        if ended.returncode != 0:
            self.fail(command, f"exit code {ended.returncode}: {ended.stderr.strip()[-600:]}")
        return ended.returncode == 0

    def engine_of(self, command, folder):
        """As `plan` says of a `run`'s preset and settings; None where it fails."""
        words = command.words
        asked = (words[1], *settings_of(words))
        if asked in self.planned:
            return self.planned[asked]
        plan = folder / ".plan.json"
        if not self.run(command, folder, ["plan", *asked, "--json", ">", plan.name]):
            return None
        engine = json.loads(plan.read_text(encoding="utf-8").splitlines()[0])["engine"]
        if words[1] in self.presets - self.own:
            self.planned[asked] = engine
        return engine

    def run_run(self, command, folder):
        words = command.words
        engine = self.engine_of(command, folder)
        if engine is None:
            return
        short, output = cut_short(words, engine), folder / output_of(words)
        same = tuple(without(short, ("-o", "--output")))
        alone = words[1] in self.presets - self.own and "--resume" not in words and not output.exists()
        if alone and same in self.made:
            shutil.copytree(self.made[same], output)
            self.counts["run"] -= 1
            self.counts["the same as an earlier one"] += 1
            return
        try:
            done = self.run(command, folder, short + ([] if "--frames" in short else ["--frames", "0-1"]))
        except LookupError:
            done = self.run(command, folder, short)
        if done and not any(output.rglob("run.json")):
            self.fail(command, f"left no finished run in {output_of(words)}")
        elif done and alone:
            self.made[same] = shutil.copytree(output, Path(self.kept.name) / str(len(self.made)))

    def run_window(self, command, folder):
        if not self.display:
            self.leave_out(command, "no Xvfb, or a build without the window")
            return
        picture = value_of(command.words, "--screenshot")
        words = []
        for word in command.words:  # as a shell does
            words += sorted(str(path.relative_to(folder)) for path in folder.glob(word)) if "*" in word else [word]
        for name in ("--frames", "--until"):
            if found := value_of(words, name):
                del words[found[0]:found[0] + 2]
        words += ([] if picture else ["--screenshot", "window.png"]) + ["--frames", "3"]
        self.counts["run"] += 1
        written = folder / (picture[1] if picture else "window.png")
        if self.run(command, folder, words) and not written.is_file():
            self.fail(command, f"left no {written.name}")
        written.unlink(missing_ok=True) if not picture else None

    def leave_out(self, command, reason):
        self.counts["not run"] += 1
        self.notes.append(f"not run: {command.place}: {command.text}: {reason}")

    def check_arguments(self, command):
        """The verb is one, its options are its own, and a shipped preset that is named is there."""
        words = [word for word in command.words if word not in ("...", "…")]
        verb = words[0] if words and words[0] in self.verbs else ""
        known = set(re.findall(r"(?<![\w-])--?[a-z][a-z-]*", self.help_of(verb)))
        for word in words:
            name = word.split("=")[0]
            if name.startswith("-") and name.strip("[]") not in known:
                self.fail(command, f"'{name}' is no option of nephroid {verb}")
        if not verb and words and re.fullmatch(r"[a-z]+", words[0]) and words[0] not in self.presets | self.own:
            self.fail(command, f"'{words[0]}' is no verb, no shipped preset and none of this page")
        first = words[1] if verb in ("run", "plan", "importance") and len(words) > 1 else ""
        if re.fullmatch(r"[a-z]+/[a-z0-9/-]+", first) and first not in self.presets and not first.startswith("out/"):
            self.fail(command, f"'{first}' is no shipped preset")

    def do(self, command, folder):
        if command.words is None:
            self.fail(command, "is no line that can be read; expected: nephroid and plain words, and perhaps > FILE")
            return
        self.check_arguments(command)
        if command.mark == "not run":
            self.leave_out(command, command.reason)
        elif command.mark == "planned":
            self.counts["checked for its arguments only"] += 1
            self.notes.append(f"only planned: {command.place}: {command.text}: {command.reason}")
            if command.words[0] == "run":
                self.run(command, folder, ["plan", command.words[1], *settings_of(command.words)])
        elif command.words and command.words[0] == "run" and "--help" not in command.words:
            self.counts["run"] += 1
            self.run_run(command, folder)
        elif command.words and command.words[0] == "check":
            self.counts["checked for its arguments only"] += 1
        elif command.words and (command.words[0] in self.verbs or command.words[0] in ("--help", "--version")):
            self.counts["run"] += 1
            cut = ["--seconds", "1", "--size", "64"] if command.words[0] == "export" else []
            self.run(command, folder, without(command.words, cut[::2]) + cut)
        else:
            self.run_window(command, folder)

    def do_page(self, page):
        with tempfile.TemporaryDirectory(prefix="nephroid-docs-") as scratch:
            folder = Path(scratch)
            for name in ("presets", "kernels"):
                (folder / name).symlink_to(ROOT / name)
            for place, line in page.outside:
                self.failures.append(f"{place}: a command outside of a ```sh block is run by no test: {line}")
            self.own = {name.removesuffix(".json") for name, _ in page.files}
            for name, content in page.files:
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
                (folder / name).write_bytes(content)
            for command in page.commands:
                self.do(command, folder)
            for command in page.inline:
                self.counts["checked for its arguments only"] += 1
                self.check_arguments(command)


def pages_of(runner):
    files = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    return [help_page(runner.help_of, runner.verbs, ROOT), *(Page(file, ROOT) for file in files)]


def main(program, wanted):
    runner = Runner(program)
    try:
        pages = [page for page in pages_of(runner) if not wanted or any(part in page.name for part in wanted)]
        for page in pages:
            runner.do_page(page)
    finally:
        runner.kept.cleanup()
        if runner.display:
            runner.display.close()
    print("\n".join(runner.notes))
    print(f"{processor_seconds():.0f} s of processor time")
    print(f"{len(pages)} pages: " + ", ".join(f"{runner.counts[kind]} {kind}" for kind in
                                              ("run", "the same as an earlier one",
                                               "checked for its arguments only", "not run")))
    for failure in runner.failures:
        print(f"FAILED {failure}")
    return 1 if runner.failures or not runner.counts["run"] else 0


if __name__ == "__main__":
    if len(sys.argv) < 2 or not os.access(sys.argv[1], os.X_OK):
        sys.exit("usage: commands.py PROGRAM [PAGE...], PROGRAM being the program, as build/release/bin/nephroid")
    sys.exit(main(sys.argv[1], sys.argv[2:]))
