#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the pictures of the docs again: one command for all of them.

    tests/experiments/pictures.py PROGRAM [--docs FOLDER] [--work FOLDER] [--small] [NAME...]

PROGRAM is build/PRESET/bin/nephroid. NAME is a part of a picture's path below docs/ (`gallery`, `tours/`, `window-`);
without one, all that this machine can make, an hour and more. What a picture needs beside the program, and what lacks
here, is said.

--docs: where they go, the project's docs/ unless said. --work: keeps runs, so that one that was made is not made again.
--small: every step with tiny pictures, of which none is kept. tests/docs does that with some of them. It also fails
where a picture of the docs is made by nothing here, so that none grows old unseen.

ImageMagick puts pictures side by side; pictures of the window are taken under Xvfb. Look at each before you commit it.
"""

import argparse
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import tempfile
from functools import partial
from pathlib import Path

from animation import FILMS
from studio import ROOT, Studio
from thesis import BRUTE, DIFFERENCE_SCENES, OURS, PLAIN, SPEED_SIZE, THESIS, Experiments
from tours import TOURS

SIZE = 256
SCENES = ["bunny", "bunny-arbitrary-2", "diamond-arbitrary-1", "enclosed-bunny", "cylinders", "newton", "prism-f10"]
GALLERY = [
    "first-light",
    "spectral/on-wood",
    "spectral/gold-and-copper",
    "spectral/coatings",
    "spectral/frosted-bottle",
    "spectral/prism-macro",
    "spectral/thesis/cylinders",
    "spectral/thesis/bunny-arbitrary-2",
    "spectral/thesis/diamond-arbitrary-1",
    "spectral/glass-in-a-room",
    "spectral/evening-sun",
    "environment/glass",
]
OTHERS = ["staircase", "rhodamine-6G", "rhodamine-6G-absorption", "F8BT", "F8BT-absorption"]
RAINBOW = ["spectral.photons_per_pass=1048576"]
PEERS = {
    "ball": ["mitsuba-ptracer", "luxcore-bidirectional", "pov-ray-photons"],
    "bunny": ["mitsuba-ptracer", "luxcore-bidirectional", "pov-ray-photons"],
    "sky": ["mitsuba-path", "luxcore-path"],
    "room": ["mitsuba-path", "luxcore-path", "pov-ray-radiosity"],
}
DIFFERENCES = [
    "importance-brute-force-4",
    "radziszewski-brute-force-4",
    "threshold-0.5-threshold-0.1",
    "threshold-0.1-threshold-0.05",
    "threshold-0.05-threshold-0.01",
    "brute-force-1-brute-force-2",
    "brute-force-2-brute-force-4",
    "brute-force-4-brute-force-6",
]
OBJECTS = ["shapes", "words"]  # of peers_objects.py
SIDE = {"geometry": f"{SIZE}x{SIZE}"}


def front(s, name):
    s.keep(name, [s.render("front", "spectral/gold-and-copper", size=(840, 560), seconds=240)])


def first_light(s, name):
    s.keep(name, [s.render("first-light", "first-light")])


def materials(s, name):
    s.keep(name, [s.render("materials", "spectral/on-wood", size=(576, 384), seconds=120)])


def surfaces(s, name):
    """A bottle, films and coats, rings."""
    presets = ["frosted-bottle", "coatings", "gold-and-copper"]
    s.keep(name, [of_gallery(s, f"spectral/{preset}") for preset in presets], 3, 1)


def coatings(s, name):
    s.script("coatings.py", s.folder / "coatings")
    s.keep(name, [s.folder / "coatings" / "coatings.png"])


def camera(s, name):
    s.keep(name, [s.render("camera", "spectral/prism-macro")])


def pictures(s, name):
    """Clipped, as it comes, and with the lamp as white."""
    clipped = ["display.gamut=clip", "display.tone=clip"]
    lamp = ['scene.lights.0.spectrum={"type": "blackbody", "temperature_k": 2700}']
    scenes = {"prism": ("spectral/prism", []), "lamp": ("first-light", lamp)}
    shown = [clipped, [], ["display.white_balance=light"]]
    s.keep(
        name,
        [
            s.render(f"shown-{scene}-{i}", preset, *sets, *display, size=(400, 300), passes=8)
            for i, display in enumerate(shown)
            for scene, (preset, sets) in scenes.items()
        ],
        2,
    )


def of_gallery(s, preset):
    """A shipped preset as it comes, but for its size."""
    return s.render("gallery-" + preset.replace("/", "-"), preset, size=(342, 228), seconds=40)


def gallery(s, name):
    s.keep(name, [of_gallery(s, preset) for preset in GALLERY], 3, 1)


def thesis_scenes(s, name):
    """Whole pictures, splats."""
    splats = ["sweep=null", "spectral.estimator=splat", "spectral.photons_per_pass=262144", "spectral.direct=true"]
    pictures = [
        s.render(
            f"scene-{scene}",
            f"spectral/thesis/{scene}",
            *splats,
            size=(SIZE, SIZE),
            passes=64 if scene == "bunny" else 24,
        )
        for scene in SCENES
    ]
    pictures += [s.render(f"scene-{scene}", f"spectral/{scene}", *splats, passes=24) for scene in OTHERS]
    s.keep(name, pictures, 4, 0, **SIDE)


def thesis_caustics(s, name):
    """Figures 3.10 and 3.17 as in the thesis; the last one by our occlusion."""
    air = [f"environment.extinction={extinction}" for extinction in (0, 0.1)]
    runs = [("figure-3-10-lamp", value) for value in air] + [("figure-3-10", value) for value in air]
    runs += [("figure-3-17", f"environment.occlusion={occlusion}") for occlusion in ("thesis", "surface")]
    pictures = [
        s.render(f"caustics-{i}", f"environment/thesis/{preset}", value, size=(SIZE, SIZE), passes=8)
        for i, (preset, value) in enumerate(runs)
    ]
    s.keep(name, pictures, 3, 0, **SIDE)


def thesis_differences(s, name):
    """A row for each scene of figure 4.13: its pictures, their differences (4.14), those of 4.6 and of 4.9."""
    s.script("thesis.py", s.folder / "chapter-4", "differences")
    pictures = []
    for scene in DIFFERENCE_SCENES:
        folder = s.folder / "chapter-4" / "differences" / scene
        pictures += [folder / way / "image.png" for way in ("brute-force-4", "importance", "radziszewski")]
        for pair in DIFFERENCES:
            pictures.append(folder / f"cut-{pair}.png")  # without the scale
            cut = ["-crop", f"{SPEED_SIZE}x{SPEED_SIZE}+0+0", "+repage"]
            s.call("convert", folder / f"{pair}.png", *cut, pictures[-1])
    s.keep(name, pictures, 11, 1, quality=80, geometry="128x128")


def thesis_curves(s, name):
    s.script("inverse.py", s.folder / "chapter-5", "stages")
    s.script("thesis_curves.py", s.folder / "curves.png", s.folder / "chapter-5")
    s.keep(name, [s.folder / "curves.png"])


def smoothing(s, name):
    """Caustics of the bunny after 8 seconds of each way, and after 120 passes."""
    e = Experiments(s.program, s.folder)
    e.size = SIZE
    variants = [BRUTE, THESIS, PLAIN, OURS]
    folders = [
        e.run(f"smoothing/{index}", "spectral/thesis/bunny", spectral, seconds=8)[2]
        for index, spectral in enumerate(variants)
    ]
    folders.append(e.run("smoothing/long", "spectral/thesis/bunny", PLAIN, 120)[2])
    s.keep(name, [folder / "image.png" for folder in folders], 5, 1, quality=85, **SIDE)


def grazing_rainbow(s, name):
    """401 lines, 32 clusters, the same clusters stretched: as many photons each."""
    ways = {
        "lines": ["spectral.method=brute_force", "spectral.jitter=false"],
        "clusters": ["spectral.jitter=false"],
        "stretched": [],
    }
    s.keep(
        name,
        [
            s.render(f"rainbow-{way}", "spectral/grazing-rainbow", *RAINBOW, *sets, passes=16)
            for way, sets in ways.items()
        ],
        1,
        1,
    )


def meters_facade(s, name):
    """The map of a meter, not a picture of a run."""
    folder = s.folder / "meters-facade"
    s.call(s.program, "measure", "measuring/concave-facade", "--seconds", 0.1 if s.small else 60, "-o", folder)
    s.keep(name, [folder / "street.png"])


def map_of(s, name, preset, meter, first=None, until=1, settings=()):
    """The map of a tour's meter. first: a preset whose luminaire's file it needs. until: percent."""
    for each in [first, preset] if first else [preset]:
        time = ("--seconds", 0.1) if s.small else ("--until", until)
        s.call(s.program, "measure", each, *time, *settings, "-o", s.folder / "out" / each)
    s.keep(name, [s.folder / "out" / preset / f"{meter}.png"])


def gems(s, name):
    """The pictures of a report, not of a run."""
    folder = s.folder / "gems"
    stone = ROOT / "tests" / "experiments" / "gems" / "round-brilliant.asc"
    rays = 40000 if s.small else 600000
    s.call(s.program, "gem", stone, "--material", "materials/diamond-Peter.yml", "--rays", rays, "-o", folder)
    s.keep(name, [folder / f"{picture}.png" for picture in ("iso", "head", "colour", "fire")], 4)


def gems_table(s, name):
    stone = ROOT / "tests" / "experiments" / "gems" / "round-brilliant.asc"
    s.call(s.program, "import", stone, "-o", s.folder / "gem.json", "--replace")
    glass = ["scene.materials.stone.dispersion=materials/diamond-Peter.yml"]
    s.keep(name, [s.render("gems-table", str(s.folder / "gem.json"), glass, seconds=120)])


def inverse_glass(s, name):
    s.keep(
        name,
        [
            s.render(
                "shapes-as-glass", str(s.run("shapes", "inverse/shapes") / "view.json"), size=(1005, 600), seconds=120
            )
        ],
    )


def inverse_sundial(s, name):
    s.keep(name, [s.run("sundial", "inverse/sundial") / "image.png"])


def inverse_mirror(s, name):
    s.keep(name, [s.run("mirror", "inverse/mirror") / "image.png"])


def colour(s, name, facets):
    made = s.folder / name.removesuffix(".png")
    script = ROOT / "tests" / "experiments" / "colour.py"
    pictures = ["disc", "--steps", "2"] if s.small else ["letters-on-white", "pastel-letters"] if facets else []
    fans = ["--facets", "--fans", "8"] if facets else []
    s.call(sys.executable, script, *pictures, *fans, "--out", made)
    s.keep(name, [made / "sheet.png"])


def films(s, name):
    """Water, a torus and a jelly bunny, each at four moments of a film."""
    shown = [
        s.render(f"water-{i}", "spectral/pool", "animation=null", f"scene.objects.0.shape.time_s={i / 4}", seconds=30)
        for i in range(4)
    ]
    for film in ("torus", "jelly"):
        folder = s.folder / f"{film}-states"
        folder.mkdir(exist_ok=True)
        preset, make = FILMS[film]
        settings = make(folder.resolve())
        settings.pop("animation")
        sets = [f"{key}={json.dumps(value)}" for key, value in settings.items()]
        for i, weights in enumerate([(0, 0), (1, 0), (0.5, 0.5), (0, 1)]):
            weighted = [f"scene.objects.0.states.{k}.weight={weight}" for k, weight in enumerate(weights)]
            shown.append(s.render(f"{film}-{i}", preset, *sets, *weighted, size=(384, 256), seconds=30))
    s.keep(name, shown, 4, 1, geometry="288x192")


def inverse_mitsuba(s, name):
    s.script("peers.py", s.folder / "peers", "objects")
    s.keep(name, [s.folder / "peers" / "objects" / f"{preset}.png" for preset in OBJECTS], 2, quality=85)


def inverse_sets(s, name):
    s.script("inverse.py", s.folder / "inverse", "pictures")
    s.keep(name, [s.folder / "inverse" / "inverse-sets.jpg"])


def environment_shaded(s, name):
    s.script("environment.py", s.folder / "environment", "scenes", "--presets", "shaded-bunny")
    s.keep(name, [s.folder / "environment" / "shaded-bunny-sheet.png"])


def environment_film(s, name, film):
    s.script("environment_films.py", s.folder / "films", film)
    s.keep(name, [s.folder / "films" / f"{film}-sheet.png"])


def environment_states(s, name):
    s.script("environment_states.py", s.folder / "states", "--shapes", "torus")
    s.keep(name, [s.folder / "states" / "torus.png"])


def medium(s, name):
    s.call(
        tests_of(s, "environment"),
        "--gtest_filter=*Rayleigh*",
        env=os.environ | {"NEPHROID_VOLUME_PICTURES": str(s.folder)},
    )
    s.keep(name, sorted(s.folder.glob("*ayleigh*.png"))[:1])


def python_spectral(s, name):
    module = Path(s.program).parents[1] / "python"
    s.call(
        sys.executable,
        ROOT / "python" / "examples" / "spectral.py",
        env=os.environ | {"PYTHONPATH": str(module), "MPLBACKEND": "agg"},
    )
    s.keep(name, [s.folder / "spectral-pictures.png"])


def first_pictures(s, name):
    s.script(
        "after_edits.py", s.folder / "edits", Path(s.program).parents[1] / "tests" / "bench" / "nephroid_after_edit"
    )
    s.keep(name, [s.folder / "edits" / "strip-first-light-camera.jpg"])


def export_blender(s, name):
    s.script("blender.py", s.folder / "blender", "first-light")
    s.keep(name, [s.folder / "blender" / "first-light" / "both.png"], widest=1024)


def peers(s, name):
    s.script("peers.py", s.folder / "peers", *PEERS)
    made = s.folder / "peers"
    s.keep(
        name,
        [
            made / scene / f"{way}-3.png" if way else "null:"
            for scene, ways in PEERS.items()
            for way in ["nephroid", *ways, *[""] * (3 - len(ways))]
        ],
        4,
        **SIDE,
    )


def tests_of(s, group):
    return Path(s.program).parents[1] / "tests" / group / f"{group}_tests"


def by_window_tests(s, name):
    """Tests that move the mouse write their pictures, and the table of keys, into the docs themselves."""
    in_session = name.startswith("session-") or name in ("window-annealing-facet.png", "window-environment.png")
    test = "*Session.From*" if in_session else "PanelPictures.*:GizmoWindowTest.*"
    done = s.folder / test.replace("*", "").replace(":", "")
    if not done.exists():
        s.call(tests_of(s, "ui"), f"--gtest_filter={test}", env=os.environ | {"NEPHROID_PICTURES": str(s.docs)})
        done.touch()
    print(f"{name}: {(s.docs / name).stat().st_size} bytes", flush=True)


def by_tour(s, name, make):
    pictures, columns = make(s)
    s.keep(name, pictures, columns, widest=640, quality=85)


WINDOW = [
    "animation",
    "annealing-facet",
    "compared",
    "dispersion-dragged",
    "dispersion",
    "environment",
    "handles",
    "materials",
    "meters",
    "parameters",
    "spectra-relit",
    "spectra",
]
MAKERS = {
    "front.jpg": front,
    "first-light.png": first_light,
    "grazing-rainbow.png": grazing_rainbow,
    "meters-facade.png": meters_facade,
    "tours/facade.png": partial(
        map_of,
        preset="street",
        meter="street",
        until=2,
        settings=(
            *("--set", "scene.objects.0.material=silvered", "--set", "scene.environment.place.date=2026-04-09"),
            *("--set", "scene.meters.0.cell=0.5"),
        ),
    ),
    "tours/fire.png": partial(map_of, preset="ball", meter="paper"),
    "tours/luminaire.png": partial(map_of, preset="desk", meter="desk", first="luminaire"),
    "gems.png": gems,
    "gems-table.jpg": gems_table,
    "inverse-glass.png": inverse_glass,
    "gallery.jpg": gallery,
    "materials.jpg": materials,
    "surfaces.jpg": surfaces,
    "coatings.png": coatings,
    "pictures.jpg": pictures,
    "camera.jpg": camera,
    "thesis-scenes.jpg": thesis_scenes,
    "thesis-caustics.jpg": thesis_caustics,
    "thesis-differences.jpg": thesis_differences,
    "thesis-curves.png": thesis_curves,
    "smoothing.jpg": smoothing,
    "inverse-sets.jpg": inverse_sets,
    "inverse-mitsuba.jpg": inverse_mitsuba,
    "inverse-sundial.png": inverse_sundial,
    "inverse-mirror.png": inverse_mirror,
    "colour-bound.png": partial(colour, facets=False),
    "colour-facets.png": partial(colour, facets=True),
    "films.jpg": films,
    "environment-shaded.png": environment_shaded,
    "environment-turning.png": partial(environment_film, film="turning"),
    "environment-card.png": partial(environment_film, film="card"),
    "environment-states.jpg": environment_states,
    "medium.png": medium,
    "python-spectral.png": python_spectral,
    "first-pictures.jpg": first_pictures,
    "export-blender.jpg": export_blender,
    "peers.jpg": peers,
}
MAKERS |= {f"tours/{make.__name__.replace('_', '-')}.jpg": partial(by_tour, make=make) for make in TOURS}
MAKERS |= {f"session-{engine}.jpg": by_window_tests for engine in ("spectral", "environment", "inverse")}
MAKERS |= {f"window-{panel}.png": by_window_tests for panel in WINDOW}
# What a picture needs beside the program and ImageMagick: other programs, modules of Python, and what is built.
NEEDS = {"export-blender.jpg": ["blender"], "peers.jpg": ["povray"]}
MODULES = {"colour-bound.png": ["scipy", "PIL"], "colour-facets.png": ["scipy", "PIL", "embreex"]}


def lacks(name, small):
    programs = NEEDS.get(name, []) + ([] if small else ["montage", "convert"])
    if "window" in name or name.startswith("session-") or name == "tours/option-plan.jpg":
        programs += ["xvfb-run"]
    return [program for program in programs if not shutil.which(program)] + [
        module for module in MODULES.get(name, []) if not importlib.util.find_spec(module)
    ]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("names", nargs="*", metavar="NAME")
    arguments.add_argument("--docs", type=Path, default=ROOT / "docs")
    arguments.add_argument("--work", type=Path)
    arguments.add_argument("--small", action="store_true")
    chosen = arguments.parse_intermixed_args()
    shown = {
        str(file.relative_to(ROOT / "docs")) for file in (ROOT / "docs").rglob("*") if file.suffix in (".png", ".jpg")
    }
    if shown != set(MAKERS):
        sys.exit(
            "pictures of the docs that nothing makes, or that are made and not there: "
            + ", ".join(sorted(shown ^ set(MAKERS)))
        )
    failed = []
    names = [name for name in MAKERS if not chosen.names or any(part in name for part in chosen.names)]
    if not names:
        sys.exit(f"no picture is called so; there are: {' '.join(MAKERS)}")
    with tempfile.TemporaryDirectory(prefix="nephroid-pictures-") as scratch:
        folder = chosen.work or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        studio = Studio(chosen.program, folder.resolve(), chosen.docs.resolve(), chosen.small)
        for name in names:
            if missing := lacks(name, chosen.small):
                print(f"{name}: left out: there is no {' and no '.join(missing)}", flush=True)
            else:
                try:
                    MAKERS[name](studio, name)
                except (subprocess.CalledProcessError, OSError) as failure:
                    failed.append(name)
                    print(f"{name}: {failure}", flush=True)
    print(f"{len(names)} of {len(MAKERS)} pictures were to be made; {len(failed)} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
