# SPDX-License-Identifier: Apache-2.0
"""Reads the commands and files of a page of the docs, for commands.py. What is recognised:

    ```sh                      lines that begin with `nephroid` or `./run.sh`; others are not ours; `# ...` is a comment
    <!-- not run: REASON -->   before such a block: nothing of it is run
    <!-- planned: REASON -->   before such a block: the preset and its settings are checked by `nephroid plan`
    <!-- file: NAME -->        before any block: its text is the file NAME for the page's commands
    <!-- given: NAME = FILE --> NAME is a file that the reader has; the test takes FILE of the project
    `nephroid run ...`         in running text: its verb and options are checked

A command that stands indented, without a block, is found too and refused, because nothing would run it.
"""
import re
import shlex
from dataclasses import dataclass
from pathlib import Path

COMMAND = re.compile(r"^\s*(?:\$ )?(nephroid|\./run\.sh)(?=\s|$)(.*)$")
MARK = re.compile(r"<!-- (not run|planned|file|given): (.*?) -->\s*$")


@dataclass
class Command:
    place: str
    text: str
    words: list  # after the program's name; None where the line cannot be read
    mark: str = ""
    reason: str = ""


def words_of(line):
    try:
        words = shlex.split(line, comments=True)
    except ValueError:
        return None
    return None if {"|", "&&", ";", "&", "<"} & set(words) else words


class Page:
    """commands, inline: Command; files: (name, bytes); outside: (place, line) of commands that stand where no test runs
    them."""

    def __init__(self, file, root):
        self.name = str(file.relative_to(root))
        self.commands, self.inline, self.files, self.outside = [], [], [], []
        mark, reason, language, block, continued = "", "", None, [], ""
        for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
            place = f"{self.name}:{number}"
            if line.lstrip().startswith("```"):
                if language is None:
                    language, block = line.strip()[3:], []
                else:
                    if mark == "file":
                        self.files.append((reason, ("\n".join(block) + "\n").encode()))
                    mark, reason, language = "", "", None
            elif language is not None:
                block.append(line)
                if language != "sh":
                    continue
                if line.endswith("\\"):
                    continued += line[:-1].strip() + " "
                elif found := COMMAND.match(continued + line.strip()):
                    self.commands.append(Command(place, (continued + line.strip()), words_of(found[2]), mark, reason))
                    continued = ""
                else:
                    continued = ""
            elif found := MARK.match(line.strip()):
                mark, reason = found[1], found[2]
                if mark == "given":
                    name, source = reason.split(" = ")
                    self.files.append((name, (root / source).read_bytes()))
            else:
                if line.startswith("    ") and COMMAND.match(line):
                    self.outside.append((place, line.strip()))
                for text in re.findall(r"`((?:nephroid|\./run\.sh) [^`]+)`", line):
                    self.inline.append(Command(place, text, words_of(COMMAND.match(text)[2]) or []))
                mark, reason = ("", "") if line.strip() else (mark, reason)


class help_page:  # noqa: N801: one page more, like Page
    """The examples in the program's own help."""

    def __init__(self, help_of, verbs, root):
        self.name = "help"
        self.inline, self.outside = [], []
        self.files = [("scene.gltf", (root / "tests" / "docs" / "scene.gltf").read_bytes())]
        self.commands = []
        for verb in ["", *verbs]:
            found = re.findall(r"^  (nephroid(?: .*)?)$", help_of(verb), re.M)
            if not found:
                self.outside.append((f"nephroid {verb} --help".replace("  ", " "), "has no example"))
            self.commands += [Command(f"nephroid {verb} --help".replace("  ", " "), line,
                                      words_of(line[len("nephroid"):])) for line in found]
