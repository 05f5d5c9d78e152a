#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Imports public scenes of others with glass and caustics, and has Mitsuba render the same: do both agree, and how much
noise has each after the same time?

    tests/experiments/field.py PROGRAM OUT [--seconds S] [SCENE...]     S: processor seconds a picture (8)

Repositories are cloned into OUT/repositories, or lie there already; git and the internet are asked for, and Mitsuba is
installed from PyPI into OUT/venv. Nothing of theirs is shipped with Nephroid: the table says each scene's licence. A
scene is made smaller and gets a box filter, in a copy that both programs read; the integrator is Mitsuba's path
tracer, with paths to their end, where a file has another.

A scene's line: the mean light of ours over theirs with its noise; the part of blocks of 8 x 8 pixels that differ by
less than 4 times their noise; noise of both as in others.py, after S seconds of all threads together; and what the
import said. OUT/SCENE.png is theirs, ours, and their difference, 4 times as bright, about grey.
"""
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

from others import THEIR_SEEDS, blocks, compared, noise, ours, their_samples, theirs
from peers import in_venv

WIDTH = 160
BITTERLI = "slongle/Rainbow", "scenes/{}/scene.xml", "CC0"
MANIFOLD = "tizian/specular-manifold-sampling", "results/Figure_{}.xml", "BSD 3-clause"
MITSUBA = "mitsuba-renderer/mitsuba-data", "docs/scenes/{}.xml", "none given"
GUIDING = "yysun997/improved-path-guiding", "scenes/{}/scene.xml", "free by its README"
SCENES = {
    "cornell-box": (BITTERLI, "cornell-box"),
    "veach-bidir": (BITTERLI, "veach-bidir"),
    "veach-mis": (BITTERLI, "veach-mis"),
    "volumetric-caustic": (BITTERLI, "volumetric-caustic"),
    "water-caustic": (BITTERLI, "water-caustic"),
    "glass-of-water": (BITTERLI, "glass-of-water"),
    "gold ring": (MANIFOLD, "4_5_RingSolutions/ring"),
    "glass ball on tiles": (MANIFOLD, "8_Constraints/sphere"),
    "slab": (MANIFOLD, "18_DoubleRefraction/slab_pt"),
    "pool": (MANIFOLD, "14_15_MainComparison/pool_pt"),
    "torus in glass": (GUIDING, "torus"),
    "bulb in a box": (GUIDING, "cbox_with_bulb"),
    "kitchenette": (GUIDING, "kitchenette"),
    "water": (MITSUBA, "bsdf_dielectric_glass"),
    "diamond": (MITSUBA, "bsdf_dielectric_diamond"),
    "rough glass": (MITSUBA, "bsdf_roughdielectric_glass"),
    "thin glass": (MITSUBA, "bsdf_thindielectric_glass"),
    "plastic": (MITSUBA, "bsdf_plastic_default"),
    "gold": (MITSUBA, "bsdf_conductor_gold"),
    "rough copper": (MITSUBA, "bsdf_roughconductor_copper"),
    "normal map": (MITSUBA, "bsdf_normalmap_with"),
    "blend": (MITSUBA, "bsdf_blendbsdf"),
    "mask": (MITSUBA, "bsdf_mask_after"),
}


def repository(name, out):
    folder = out / "repositories" / name
    if not folder.is_dir():
        subprocess.run(["git", "clone", "-q", "--depth", "1", f"https://github.com/{name}", str(folder)], check=True)
    return folder


# What no Mitsuba of today knows: elements and parameters of the programs that the files were made for.
FOREIGN = re.compile(r'<mode\b[^>]*/>|<hide\b[^>]*?(/>|>.*?</hide>)|'
                     r'<\w+ name="(caustic_|usePathGuiding|attachLog|sunRadiusScale|extEta|ext_eta|subdiv)\w*"'
                     r'[^>]*/>', re.S)


def made_small(text):
    """The file with a picture of WIDTH pixels, a box filter and no integrator of its own."""
    def film(found):
        given = [re.search(rf'name="{side}"\s+value="(\d+)"', found[0]) for side in ("width", "height")]
        sides = [int(side[1]) for side in given] if all(given) else [4, 3]  # as Mitsuba has it by itself
        name = re.search(r'\bid="[^"]*"', found[1])
        return (f'<film type="hdrfilm" {name[0] if name else ""}><integer name="width" value="{WIDTH}"/>'
                f'<integer name="height" value="{WIDTH * sides[1] // sides[0]}"/><rfilter type="box"/></film>')
    for name, value in re.findall(r'<default\s+name="(\w+)"\s+value="([^"]*)"', text):
        if name in ("width", "height"):
            text = text.replace(f'"${name}"', f'"{value}"')
    text = re.sub(r"<integrator\b[^>]*?(/>|>.*?</integrator>)", "", text, flags=re.S)
    text = re.sub(r"(<film\b[^>]*>).*?</film>", film, text, flags=re.S)
    text = re.sub(r"<sampler\b[^>]*?(/>|>.*?</sampler>)", '<sampler type="independent"/>', text, flags=re.S)
    return FOREIGN.sub("", text)


def copied(name, out):
    """The scene's files in a folder of their own, and its file there."""
    (repo, pattern, _), scene = SCENES[name]
    source = repository(repo, out) / pattern.format(scene)
    inner = pattern.split("/")[0] == "docs"  # whose files lie in ../../common
    root = source.parents[2] if inner else source.parent
    folder = out / name.replace(" ", "-")
    shutil.copytree(root, folder, dirs_exist_ok=True, ignore=shutil.ignore_patterns("images", "*_creation"))
    for file in folder.rglob("*.xml"):
        file.write_text(made_small(file.read_text()))
    return folder, source.relative_to(root)


def measure(name, program, out, seconds):
    import mitsuba
    import numpy as np
    from layers import write_png
    licence = SCENES[name][0][2]
    folder, file = copied(name, out)
    scene = {"ours": str(file)}
    b, said, _ = ours(scene, folder, program, ("--seconds", str(seconds / os.cpu_count())))
    said = "; ".join(dict.fromkeys(re.sub(rf"(note: |nephroid: )|{re.escape(str(folder))}/\S*?:(\d+: )?", "", line)
                                   for line in said.splitlines()))
    if b is None:
        return print(f"| {name} | {licence} | refused | | | | {said} |", flush=True)
    mitsuba.set_variant("llvm_ad_rgb")
    try:
        loaded = mitsuba.load_file(str(folder / file))
    except RuntimeError as error:
        refusal = str(error).splitlines()[-1]
        return print(f"| {name} | {licence} | Mitsuba refuses it: {refusal} | | | | {said} |", flush=True)
    integrator = mitsuba.load_dict({"type": "path", "max_depth": 64, "rr_depth": 16})
    samples = their_samples(loaded, integrator, seconds)
    began = time.process_time()
    a = theirs(loaded, integrator, samples)
    their_seconds = (time.process_time() - began) / THEIR_SEEDS
    greys = [np.array(pictures).mean(-1) for pictures in (a, b)]
    parts = [blocks(grey) for grey in greys]
    variance = sum(p.var(0, ddof=1) / len(p) for p in parts)
    z = np.abs(parts[1].mean(0) - parts[0].mean(0)) / np.sqrt(variance + (.005 * parts[0].mean(0)) ** 2 + 1e-20)
    everywhere = np.ones(greys[0].shape[1:], bool)
    print(f"| {name} | {licence} | {compared(*greys)} | {100 * (z < 4).mean():.1f} % | {noise(b, everywhere):.3f} | "
          f"{noise(a, everywhere):.3f} ({their_seconds:.0f} s) | {said} |", flush=True)
    a, b = np.mean(a, 0), np.mean(b, 0)
    level = 2.5 * np.median(a.mean(-1)) + 1e-9
    write_png(out / f"{folder.name}.png", np.concatenate([a, b, .2 * level + 4 * (b - a)], 1) / level)


def main():
    if len(sys.argv) < 3 or not Path(sys.argv[1]).is_file():
        sys.exit("usage: field.py PROGRAM OUT [--seconds S] [SCENE...]; PROGRAM is build/release/bin/nephroid")
    out = Path(sys.argv[2]).absolute()
    out.mkdir(parents=True, exist_ok=True)
    in_venv(out)
    names = sys.argv[3:]
    seconds = 8.0
    if names[:1] == ["--seconds"]:
        seconds, names = float(names[1]), names[2:]
    if not set(names) <= set(SCENES):
        sys.exit(f"scenes: {', '.join(SCENES)}")
    print("| scene | licence | ours over theirs | blocks that agree | our noise | theirs | what the import said |\n"
          "|---|---|---|---|---|---|---|")
    for name in names or SCENES:
        measure(name, os.path.abspath(sys.argv[1]), out, seconds)


if __name__ == "__main__":
    main()
