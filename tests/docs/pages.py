#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Is every page to use short, does every link lead somewhere, is every picture used, and do all files give one version?

    tests/docs/pages.py

Pages to use are those of docs/ outside of docs/notebook/. Links are those to files of the project, with the heading
after #.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
MOST_WORDS = 1500


def without_code(text):
    return re.sub(r"^```.*?^```|`[^`\n]*`", "", text, flags=re.M | re.S)


def anchors(file):
    """The names that GitHub gives the headings of a page."""
    heads = re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```", "", file.read_text(encoding="utf-8"), flags=re.M | re.S),
                       re.M)
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}


VERSIONS = {"pyproject.toml": r'^version = "(.+?)"', "CITATION.cff": r"^version: (.+)",
            "packaging/changelog": r"^nephroid \((.+?)\)",
             "packaging/org.nephroid.Nephroid.metainfo.xml": r'<release version="(.+?)"'}


def other_versions():
    """Files whose newest version is not that of CMakeLists.txt."""
    own = re.search(r"project\(nephroid VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
    for name, pattern in VERSIONS.items():
        found = re.search(pattern, (ROOT / name).read_text(encoding="utf-8"), re.M)
        if not found or found[1] != own:
            yield f"{name}: has the version {found[1] if found else 'of none'}; expected {own}, as CMakeLists.txt"


def main():
    pages = [*sorted(ROOT.glob("*.md")), *sorted(DOCS.rglob("*.md"))]
    failures, used, links = list(other_versions()), set(), 0
    for page in pages:
        name, text = page.relative_to(ROOT), page.read_text(encoding="utf-8")
        words = len(text.split())
        if DOCS in page.parents and DOCS / "notebook" not in page.parents and words > MOST_WORDS:
            failures.append(f"{name}: has {words} words; expected at most {MOST_WORDS}; measurements belong into "
                            f"docs/notebook")
        for link in re.findall(r"\]\(([^)\s]+)\)", without_code(text)):
            if "://" in link:
                continue
            links += 1
            path, _, anchor = link.partition("#")
            file = (page.parent / path).resolve() if path else page
            used.add(file)
            if not file.exists():
                failures.append(f"{name}: {link}: there is no such file")
            elif anchor and anchor not in anchors(file):
                failures.append(f"{name}: {link}: the page has no such heading")
    pictures = {file for file in DOCS.rglob("*") if file.suffix in (".png", ".jpg")}
    failures += [f"{file.relative_to(ROOT)}: no page shows it" for file in sorted(pictures - used)]
    failures += [f"{page.relative_to(ROOT)}: no page leads to it" for page in pages if DOCS in page.parents
                 and page not in used and page != DOCS / "README.md"]
    print(f"{len(pages)} pages, {links} links, {len(pictures)} pictures")
    print("\n".join(failures))
    return 1 if failures or not links else 0


if __name__ == "__main__":
    sys.exit(main())
