# SPDX-License-Identifier: Apache-2.0
"""How pictures.py makes each picture of docs/tours, from the presets and files that stand in the tours themselves."""

GLASS = "scene.materials.glass.dispersion"
STRIPES = ["spectral.threshold_deg=1"]
NEWTON = ["scene.camera.target=[9.3,0,0]", "scene.camera.fov_deg=30"]


def dispersion_glasses(s):
    return [
        s.render("flint", "first-light", size=(320, 320), passes=8),
        s.render("crown", "first-light", f"{GLASS}=materials/N-BK7.yml", size=(320, 320), passes=8),
    ], 2


def dispersion_window(s):
    return [
        s.window("newton", "spectral/thesis/newton", "dispersion", "scene.camera.resolution=[256,256]", "stop.passes=8")
    ], 1


def dispersion_designed(s):
    return [
        s.render("n-sf11", "spectral/thesis/newton", *NEWTON, size=(640, 200), passes=8),
        s.render("wavy", "wavy", *NEWTON, size=(640, 200), passes=8),
    ], 1


def hdri_lights(s):
    s.call(s.program, "segment", "sky.hdr", "-q", 24, "-o", "lights.png")
    return [s.folder / "lights.png"], 1


def hdri_glass(s):
    return [s.render("drink", "drink", size=(480, 360), seconds=30)], 1


def hdri_window(s):
    return [s.window("drink-window", "drink", "environment", "scene.camera.resolution=[256,192]", "stop.seconds=15")], 1


def three_sheet(s):
    return [s.run("shapes", "inverse/shapes") / "image.png"], 1


def three_view(s):
    return [s.render("view", str(s.run("shapes", "inverse/shapes") / "view.json"), size=(560, 350), seconds=20)], 1


def three_window(s):
    return [s.window("mine-window", "mine", "annealing")], 1


def runs_of_sweep(s):
    folder = s.runs("glasses")
    glasses = ("N-BK7", "N-SF11", "N-SF66")
    return [folder / f"dispersion={glass}.yml,threshold_deg={fine}" for fine in (0.05, 1) for glass in glasses]


def batch_sweep(s):
    return [run / "image.png" for run in runs_of_sweep(s)], 3


def batch_window(s):
    return [
        s.window(
            "glasses-window",
            "glasses",
            "runs",
            "scene.camera.resolution=[256,256]",
            "spectral.photons_per_pass=65536",
            "stop.passes=4",
            pinned=sorted(runs_of_sweep(s)),
        )
    ], 1


def batch_frames(s):
    return [s.runs("tilt") / f"frame_{number:04}.png" for number in range(2 if s.small else 8)], 4


def material_window(s):
    return [
        s.window("heavy-window", "heavy-bunny", "dispersion", "scene.camera.resolution=[320,320]", "stop.passes=8")
    ], 1


def material_colour(s):
    return [
        s.render("clear", "heavy-bunny", size=(320, 320), passes=8),
        s.render("green", "heavy-bunny", f"{GLASS}=green.yml", size=(320, 320), passes=8),
    ], 2


def option_stripes(s):
    return [
        s.render(
            f"jitter-{on}",
            "spectral/thesis/newton",
            *NEWTON,
            *STRIPES,
            f"spectral.jitter={on}",
            size=(640, 200),
            passes=4,
        )
        for on in ("false", "true")
    ], 1


def option_plan(s):
    return [s.window("plan", "first-light", "plan", "scene.camera.resolution=[256,256]", "stop.passes=8")], 1


TOURS = [
    dispersion_glasses,
    dispersion_window,
    dispersion_designed,
    hdri_lights,
    hdri_glass,
    hdri_window,
    three_sheet,
    three_view,
    three_window,
    batch_sweep,
    batch_window,
    batch_frames,
    material_window,
    material_colour,
    option_stripes,
    option_plan,
]
