#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Do the completions that the build made know every verb and option of `--help`, and do the shells take them?

    tests/packaging/completions.py PROGRAM FOLDER

bash, zsh and fish parse theirs; bash and fish also complete some lines. MetricSet of them are here is printed.
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path

# A line, and one of the words that must be offered for its end.
LINES = [
    ("nephroid ru", "run"), ("nephroid run first", "first-light"), ("nephroid run --dev", "--device"),
    ("nephroid plan spectral/pr", "spectral/prism"),
    ("nephroid first", "first-light"), ("nephroid clusters --method th", "thesis"), ("nephroid completions z", "zsh"),
    ("nephroid help disp", "dispersion"), ("nephroid run --device ", "0"), ("nephroid check --device ", "0"),
    ("nephroid run mi", "mine.nephroid.json"),
    ("nephroid run first-light --res", "--resume"),
]
BASH = """source "$1"; program=$2; shift 2; set -- nephroid "$@"
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _nephroid "$program" "${!#}" "${COMP_WORDS[COMP_CWORD-1]}"
printf '%s\\n' "${COMPREPLY[@]}" """


def text(*command, **more):
    return subprocess.run(command, capture_output=True, text=True, check=True, **more).stdout


def main(program, folder):
    scripts = {"bash": Path(folder, "nephroid"), "zsh": Path(folder, "_nephroid"),
               "fish": Path(folder, "nephroid.fish")}
    failures, asked = [], []
    top = text(program, "--help")
    verbs = re.findall(r"^  ([a-z]+) ", top.split("Verbs:")[1], re.M)
    if len(verbs) < 10:
        failures.append(f"only {len(verbs)} verbs")
    options = {verb: sorted(set(re.findall(r"^  (?:-\w,)?(--?[\w-]+)",
                                           text(program, *([verb] if verb else []), "--help"), re.M)))
               for verb in ["", *verbs]}
    # One part of a script a verb.
    parts = {
        "bash": lambda script,
        verb: re.search(rf"^    {verb or chr(92) + '*'}\)\n(.*?);;\n(?:    \w+\)|    \*\)|  "
                        rf"esac)", script, re.M | re.S),
        "zsh": lambda script,
        verb: re.search(rf"^    {verb or chr(92) + '*'}\) _arguments(.*?);;", script, re.M | re.S),
    }
    for shell, file in scripts.items():
        script = file.read_text(encoding="utf-8")
        if script != text(program, "completions", shell):
            failures.append(f"{file} is not what `nephroid completions {shell}` prints")
        if shutil.which(shell):
            asked.append(shell)
            said = subprocess.run([shell, "-n", file], capture_output=True, text=True, check=False)
            if said.returncode or said.stderr:
                failures.append(f"{shell}: {said.stderr}")
        for verb, names in options.items():
            if shell == "fish":
                when = f"'__nephroid_verb {verb}'" if verb else "'not __nephroid_verb "
                part = "\n".join(line for line in script.splitlines() if when in line)
                names = [f"-{'l' if name.startswith('--') else 's'} {name.lstrip('-')} " for name in names]
            else:
                match = parts[shell](script, verb)
                part = match.group(1) if match else ""
            failures += [f"{shell}: '{verb}' does not know {name}" for name in names if name not in part]
    mine = Path(folder, "mine.nephroid.json")
    mine.touch()
    try:
        for line, wanted in LINES:
            said = text("bash", "-c", BASH, "bash", scripts["bash"], program, *re.split(" +", line)[1:],
                        cwd=folder).split("\n")
            if wanted not in said:
                failures.append(f"bash: '{line}' gives {said}, not {wanted}")
            if "fish" in asked:
                said = text("fish", "-c",
                            f"set PATH {Path(program).parent} $PATH; source {scripts['fish']}; complete -C '{line}'",
                            cwd=folder)
                if wanted not in re.findall(r"^[^\t\n]+", said, re.M):
                    failures.append(f"fish: '{line}' gives {said.splitlines()[:8]}, not {wanted}")
    finally:
        mine.unlink()
    print(f"{len(verbs)} verbs, {sum(map(len, options.values()))} options, {len(LINES)} lines; taken by: "
          f"{', '.join(asked)}")
    print("\n".join(failures))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
