#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Does every file and every name that the docs and the comments give exist? Needs no program and no build.

    tests/docs/names.py

It reads the backticks of every page and of comments, and the files that a comment names with or without backticks. A
path exists if it is a file or folder, or the end of one's path (`cli/verb.h`), or a shipped preset (`spectral/prism`),
or a file that the page itself gives, or if a string of the sources has its name (`image.exr`). A field of a preset
(`spectral.jitter`) has to be in the schema. Of anything else, each word has to be a word of the sources' code or of a
file's name; comments do not count. A name that is said to be in a file has to be in that one. Code that a page shows
has to stand in the sources; `...` is anything. EXCEPTIONS has what is named though it is not ours.
"""

import json
import re
import sys
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = [
    ".ci",
    ".github",
    "app",
    "cmake",
    "docs",
    "kernels",
    "packaging",
    "presets",
    "python",
    "tests",
    "third_party",
    "ui",
]
C_LIKE = {".h", ".cpp", ".cl", ".in"}
HASHED = {".py", ".pyi", ".sh", ".cmake", ".txt", ".yml", ".toml"}
ENDINGS = "h|cpp|cl|py|pyi|sh|json|md|txt|cmake|yml|in"
DEFINE = re.compile(r"(?<!\w)-D(?=[A-Z])")
PLACEHOLDER = re.compile(r"(?<![A-Za-z])[A-Z]+(?![A-Za-z])")  # NAME_test.cpp
# A word or a path, and why it is named though nothing of the project has it.
EXCEPTIONS = {
    "ccache": "a program to build with",
    "CMAKE_CXX_COMPILER_LAUNCHER": "CMake's",
    "CL_CONFIG_CPU_VECTORIZER_MODE": "of Intel's OpenCL",
    "POCL_KERNEL_CACHE": "PoCL's",
    "pocl_cache_init_topdir": "PoCL's",
    "CL/cl_ext.h": "Khronos'",
    "cl_khr_icd": "Khronos'",
    "imgui.h": "Dear ImGui's",
    "Shortcut": "Dear ImGui's",
    "InputText": "Dear ImGui's",
    "kat_vectors": "a file of Random123",
    "RLIM_INFINITY": "POSIX'",
    "mca": "Open MPI's",
    "odls_base_sigkill_timeout": "Open MPI's",
    "benchmark_filter": "Google Benchmark's",
    "gtest_output": "GoogleTest's",
    "Depends": "a field of a Debian package",
    "openimageio": "a CMake package",
    "appstream": "a Debian package",
    "sunset": "a file of blender-data",
    "jiter": "a misspelling that the page shows",
    "swing": "a preset that a reader may write",
    "_16": "the end of a file's name, of numbers",
    "_2": "the end of a file's name, of numbers",
    "kernels_tests": "cmake/NephroidTargets.cmake names it after its folder",
    "physics_tests": "the same",
    "estimated_lab_rms": "a metric with its prefix",
    "*.nephroid.json": "what a reader's presets are called",
    "SMALL_PRESET": "a preset of the reader's",
    "psi_lambda_theta": "a derivative",
    "rho_green": "a reflectance",
    "rho_red": "a reflectance",
}


def project_files():
    """Files by their path from the project's folder; what builds and runs write is not among them."""
    files = [file for file in ROOT.iterdir() if file.is_file()]
    for folder in FOLDERS:
        files += [file for file in (ROOT / folder).rglob("*") if file.is_file() and "__pycache__" not in file.parts]
    return {str(file.relative_to(ROOT)): file for file in files}


def split_c(text):
    """Code and comments of C++ or OpenCL C, both with the lines where they were."""
    parts = re.compile(r'R"(\w*)\((?:.|\n)*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|//[^\n]*|/\*(?:.|\n)*?\*/')

    def blank(found):
        return re.sub(r"[^\n]", " ", found)

    def is_comment(found):
        return found.startswith(("//", "/*"))

    code = parts.sub(lambda found: blank(found[0]) if is_comment(found[0]) else found[0], text)
    comments, at = "", 0
    for found in parts.finditer(text):
        if is_comment(found[0]):
            comments += blank(text[at : found.start()]) + found[0]
            at = found.end()
    return code, comments


def split_hashed(text):
    """The same of Python, shell and CMake, whose comments are lines."""
    code, comments = [], []
    for line in text.split("\n"):
        is_comment = re.match(r"\s*#(?!!)", line)
        code.append("" if is_comment else line)
        comments.append(line if is_comment else "")
    return "\n".join(code), "\n".join(comments)


def fields_of(schema):
    """The names of all fields of presets, whatever they stand in."""
    if isinstance(schema, dict):
        yield from schema.get("properties", {}) if isinstance(schema.get("properties"), dict) else []
    for part in schema.values() if isinstance(schema, dict) else schema if isinstance(schema, list) else []:
        yield from fields_of(part)


class Project:
    def __init__(self):
        self.files = project_files()
        self.ends, self.words, self.strings = set(), set(), ""
        self.comments = {}
        schema = json.loads((ROOT / "presets" / "schema.json").read_text(encoding="utf-8"))
        self.sections, self.fields = set(schema["properties"]), set(fields_of(schema))
        for name, file in self.files.items():
            parts = name.split("/")
            self.ends |= {"/".join(parts[first:last]) for last in range(1, len(parts) + 1) for first in range(last)}
            self.words |= set(re.findall(r"\w+", name))
            if (
                file.suffix in C_LIKE
                or file.suffix in HASHED
                or file.suffix == ".json"
                or file.suffix == ""
                and file.parent != ROOT
            ):
                self.read(name, file)

    def read(self, name, file):
        text = file.read_text(encoding="utf-8", errors="replace")
        split = split_c if file.suffix in C_LIKE else split_hashed if file.suffix in HASHED else None
        code, comments = split(text) if split else (text, "")
        self.comments[name] = comments
        if not name.startswith("tests/docs/"):  # it would know its own exceptions
            self.words |= set(re.findall(r"\w+", DEFINE.sub(" ", code)))
            self.strings += code

    @cache
    def has_path(self, path, page):
        path = re.sub(r"^\./|/$", "", path)
        parts = path.split("/")
        if path in self.ends or path + ".json" in self.ends or (Path(page).parent / path).as_posix() in self.files:
            return True
        if PLACEHOLDER.search(path) or "*" in path or path.startswith("_"):
            pattern = re.escape(PLACEHOLDER.sub("*", path)).replace(r"\*", r"[^/]+")
            pattern = re.compile(("" if parts[0] in FOLDERS else r"(.*/)?" if path[0] != "_" else r".*") + pattern)
            if any(pattern.fullmatch(name) for name in self.files):
                return True
        if re.search(r"\.(h|cpp|cl|py)$", path) or parts[0] in FOLDERS:
            return False
        if "." in parts[-1]:  # what a run or a build writes
            return re.search(rf'["/ {{}}]{re.escape(PLACEHOLDER.sub("", parts[-1]))}', self.strings) is not None
        return all(self.has_word(part) for part in re.findall(r"\w+", path) if not part.isdigit())

    @cache
    def has_word(self, word):
        if word in self.words or re.fullmatch(r"[A-Z]+", word):
            return True
        begin, end = re.match(r"(\w+_)[A-Z]*$", word), re.match(
            r"[A-Z]*(_[a-z]+)$", word
        )  # frame_NNNN: "frame_{:04}"; *_stage
        return any(begin and known.startswith(begin[1]) or end and known.endswith(end[1]) for known in self.words)

    def missing(self, text, page, given):
        """What of the text in backticks does not exist."""
        if text in EXCEPTIONS or re.match(r"(nephroid|\./run\.sh|git )", text) or re.search(r"[^\x00-\x7f]", text):
            return []  # commands are read by commands.py
        if re.fullmatch(r"[\w.*-]+(/[\w.*-]+)*/?", text) and ("/" in text or re.fullmatch(rf".*\w\.({ENDINGS})", text)):
            return [] if text in given or text.startswith("out/") or self.has_path(text, page) else [text]
        if field := re.match(rf"/?(?!\w+\.(?:glb|mp4|json)$)((?:{'|'.join(self.sections)})(?:[./]\w+)+)($|=)", text):
            parts = re.split(r"[./]", re.sub(r"(materials)[./]\w+", r"\1", field[1]))
            return [part for part in parts if part not in self.fields and not part.isdigit()]
        words = re.findall(r"\b[A-Za-z_]\w*", DEFINE.sub(" ", text))
        return [word for word in words if word not in given and word not in EXCEPTIONS and not self.has_word(word)]


def lines_of(text):
    return enumerate(text.split("\n"), 1)


def line_of(text, found):
    return text.count("\n", 0, found.start()) + 1


def misplaced(project, name, text, pattern):
    """Names that are said to be in a file, and are not."""
    for found in re.finditer(pattern, text):
        files = [file for path, file in project.files.items() if f"/{path}".endswith("/" + found[2])]
        word = found[1].split("::")[-1]
        if files and not any(re.search(rf"\b{word}\b", file.read_text(encoding="utf-8")) for file in files):
            yield f"{name}:{line_of(text, found)}: {found[2]} has no `{found[1]}`"


def page_failures(project, name, text):
    given = set(re.findall(r"<!-- (?:file|given): (\S+)", text))
    outside = re.sub(r"^```.*?^```|<!--.*?-->", lambda found: "\n" * found[0].count("\n"), text, flags=re.M | re.S)
    for span in re.finditer(r"``(.+?)``|`((?:[^`\n]|\n(?!\n))+)`", outside):
        for lost in project.missing((span[1] or span[2]).replace("\n", " "), name, given):
            yield f"{name}:{line_of(outside, span)}: `{lost}` is in no file and no code"
    for block in re.finditer(r"^```c(?:pp)?\n(.*?)^```", text, re.M | re.S):
        for number, line in enumerate(block[1].rstrip("\n").split("\n"), line_of(text, block) + 1):
            pattern = r"\s+".join(re.escape(word).replace(r"\.\.\.", r"(?:.|\n)*?") for word in line.split())
            if not re.search(pattern, project.strings):
                yield f"{name}:{number}: no source has this line"
    yield from misplaced(project, name, outside, r"`([\w:]+)` (?:in |\()`([\w/]+\.(?:h|cpp|cl|py|cmake))`")


def comment_failures(project, name, comments):
    """Beside backticks: files, and what only code writes so: names with an underscore, calls, members of structs."""
    for number, line in lines_of(comments):
        spans = set(re.findall(r"`([^`]+)`", line))
        spans |= set(re.findall(r"(?<![\w./*-])[A-Za-z][\w/-]*\.(?:h|cpp|cl|py|md)(?![\w.*])", line))
        plain = re.sub(r"`[^`]+`|[\w/.-]+\.\w+", " ", DEFINE.sub(" ", line))
        spans |= set(re.findall(r"(?<![\w:])[A-Za-z]\w{2,}_\w{3,}|[A-Za-z]\w+(?=\(\))|(?<!\w)[A-Z]\w+::\w+", plain))
        for span in sorted(spans):
            for lost in project.missing(span, name, ()):
                yield f"{name}:{number}: `{lost}` is in no file and no code"
    yield from misplaced(
        project,
        name,
        comments,
        r"([A-Za-z]\w+_\w+|[A-Z]\w*[a-z]\w*(?:::\w+)?) (?:\(|in )((?:\w+/)*\w+\.(?:h|cpp|cl))\)",
    )


def main():
    project = Project()
    pages = [name for name in sorted(project.files) if name.endswith(".md")]
    failures = []
    for name in pages:
        failures += page_failures(project, name, project.files[name].read_text(encoding="utf-8"))
    for name, comments in sorted(project.comments.items()):
        failures += comment_failures(project, name, comments)
    print(f"{len(pages)} pages, {len(project.comments)} sources, {len(project.words)} names")
    print("\n".join(failures))
    return 1 if failures or not pages else 0


if __name__ == "__main__":
    sys.exit(main())
