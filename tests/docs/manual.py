#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Is the man page that the build made the program's own, does it have every verb and option of `--help`, and is it
sound roff?

    tests/docs/manual.py PROGRAM PAGE

groff and mandoc read it without a warning, where they are there; which of them did is printed.
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path


def text(*command, **more):
    return subprocess.run(command, capture_output=True, text=True, check=True, **more).stdout


def words_of(help_text):
    """Options as --help names them, and each word of its own lines."""
    return set(re.findall(r"^  (?:-\w,)?(--?[\w-]+)", help_text, re.M))


def main(program, page):
    roff = Path(page).read_text(encoding="utf-8")
    failures = [] if roff == text(program, "manual") else [f"{page} is not what `nephroid manual` prints"]
    top = text(program, "--help")
    verbs = re.findall(r"^  ([a-z]+) ", top.split("Verbs:")[1], re.M)
    sections = dict(zip(["", *verbs], re.split(r"^\.SS .*\n", roff, flags=re.M)))
    if len(sections) != len(verbs) + 1 or len(verbs) < 10:
        failures.append(f"{len(verbs)} verbs, {len(sections) - 1} sections")
    options = 0
    for verb, section in sections.items():
        plain = section.replace("\\-", "-")
        for option in words_of(text(program, *([verb] if verb else []), "--help")):
            options += 1
            if option not in plain:
                failures.append(f"{option} of '{verb}' is missing")
    readers = {"groff": ["groff", "-man", "-ww", "-Tutf8", "-z", page],
               "mandoc": ["mandoc", "-Tlint", "-Wwarning", page]}
    asked = []
    for name, command in readers.items():
        if not shutil.which(name):
            continue
        asked.append(name)
        said = subprocess.run(command, capture_output=True, text=True, check=False)
        if said.returncode or said.stdout + said.stderr:
            failures.append(f"{name}: {(said.stdout + said.stderr).strip()}")
    print(f"{len(verbs)} verbs, {options} options, {len(roff.splitlines())} lines; read by: "
          f"{', '.join(asked) or 'neither groff nor mandoc is here'}")
    print("\n".join(failures))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
