#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares caustics with those of Mitsuba 3: the same scene in `nephroid run` and in Mitsuba's particle tracer.

    tests/experiments/ptracer.py PROGRAM OUT [SCENE...]     of these scenes, or of ball and bunny

Mitsuba is installed from PyPI into OUT/venv. Its variant is llvm_ad_rgb, which uses all cores as Nephroid does. Its light is given twice:
as the scene has it, and aimed at the glass by hand. Nephroid has its defaults. The glass has one index, so that no program gains by
wavelengths; the floor reflects 5 %, so that light that meets it twice does not count.

Errors are of the pixels in the shadow of the glass: what they show came through it. Both programs work for the same seconds, compilers not
counted. Mitsuba has no bias: its error is its noise, from two seeds. Nephroid's is the distance to a long run of Mitsuba, less that run's
own noise. "times" is how long Mitsuba would need for Nephroid's error, over the seconds of Nephroid. Nothing else should run on the machine.
"""
import json
import subprocess
import sys
import time
from pathlib import Path

MITSUBA = "mitsuba==3.5.2"
SECONDS = [2, 10, 60]
LONG = 120       # seconds of the reference
SEEDS = [1, 2]
SIDE = 256       # pixels
BUNNY = "/usr/share/glmark2/models/bunny.obj"  # of Debian's glmark2-data
FLOOR = {"type": "diffuse", "reflectance": {"type": "constant", "value": 0.05}}


def glass(index):
    return {"type": "dielectric", "dispersion": {"type": "constant", "n": index}}


# What both programs read: the bodies of glass are a ball in the origin, or the bunny, moved.
SCENES = {
    "ball": {
        "camera": {"position": [4, 4, 4], "target": [0, -1, 0], "fov_deg": 34}, "index": 1.5168, "floor": [8, -2],
        "light": {"type": "directional", "spectrum": "D65", "irradiance_w_m2": 10, "direction": [0, -1, 0]}},
    "bunny": {
        "camera": {"position": [1.2, 7.2, 10.2], "target": [0.75, 0.75, 0.5], "fov_deg": 38}, "index": 1.8, "floor": [24, 0],
        "moved": {"scale": [2, 2, 2], "rotate_deg": [0, 20, 0], "translate": [-0.6, 1.983, -0.8]},
        "light": {"type": "point", "spectrum": "D65", "power_w": 10, "position": [-4, 5.6, -4.4]}},
}


def in_venv(out):
    """Runs this script again with the Python of OUT/venv, where it is not that one yet."""
    venv = out / "venv"
    python = venv / "bin" / "python"
    if Path(sys.prefix).resolve() == venv.resolve():
        return
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", str(venv)], check=True)
        subprocess.run([str(python), "-m", "pip", "-q", "install", MITSUBA, "numpy"], check=True)
    sys.exit(subprocess.run([str(python), *sys.argv]).returncode)


def preset_of(scene):
    body = {"name": "glass", "material": "glass"}
    if "moved" in scene:
        body |= {"mesh": BUNNY, "normals": "faceted", "transform": scene["moved"]}
    else:
        body |= {"shape": {"type": "sphere", "radius": 1}, "normals": "smooth"}
    size, height = scene["floor"]
    return {"engine": "spectral", "unit": "cm", "white": 1, "scene": {
        "camera": scene["camera"] | {"resolution": [SIDE, SIDE]},
        "materials": {"glass": glass(scene["index"]), "floor": FLOOR},
        "objects": [body, {"name": "floor", "shape": {"type": "quad", "size": [size, 1, size]}, "material": "floor",
                           "transform": {"translate": [0, height, 0]}}],
        "lights": [scene["light"]]}}


class Mitsuba:
    def __init__(self, scene, aimed):
        import mitsuba
        mitsuba.set_variant("llvm_ad_rgb")
        self.mi, self.T = mitsuba, mitsuba.ScalarTransform4f
        body = {"type": "sphere"}
        if "moved" in scene:
            m = scene["moved"]
            to_world = self.T.translate(m["translate"]).rotate([0, 1, 0], m["rotate_deg"][1]).scale(m["scale"])
            body = {"type": "obj", "filename": BUNNY, "face_normals": True, "to_world": to_world}
        size, height = scene["floor"]
        camera = scene["camera"]
        self.scene = self.mi.load_dict({
            "type": "scene", "integrator": {"type": "ptracer", "max_depth": 33, "rr_depth": 33, "hide_emitters": True},
            "sensor": {
                "type": "perspective", "fov": camera["fov_deg"],
                "to_world": self.T.look_at(camera["position"], camera["target"], [0, 1, 0]),
                "film": {"type": "hdrfilm", "width": SIDE, "height": SIDE, "rfilter": {"type": "box"}}},
            "glass": body | {"bsdf": {"type": "dielectric", "int_ior": scene["index"], "ext_ior": 1.0}},
            "floor": {
                "type": "rectangle", "to_world": self.T.translate([0, height, 0]).rotate([1, 0, 0], -90).scale(size / 2),
                "bsdf": {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": 0.05}}},
            "light": self.light(scene["light"], aimed)})

    def light(self, light, aimed):
        """By hand: a disc of parallel light as wide as the ball, or a cone around the bunny."""
        if light["type"] == "directional" and not aimed:
            return {"type": "directional", "direction": light["direction"], "irradiance": 1.0}
        if light["type"] == "directional":
            return {"type": "disk", "to_world": self.T.translate([0, 1.5, 0]).rotate([1, 0, 0], 90).scale(1.01),
                    "emitter": {"type": "directionalarea", "radiance": 1.0}}
        if not aimed:
            return {"type": "point", "position": light["position"], "intensity": 1.0}
        box = self.mi.load_dict({"type": "scene", "glass": {
            "type": "obj", "filename": BUNNY,
            "to_world": self.T.translate([-0.6, 1.983, -0.8]).rotate([0, 1, 0], 20).scale(2)}}).bbox()
        from numpy import arccos, array, degrees
        from numpy.linalg import norm
        eye, middle = array(light["position"]), (array(box.min).ravel() + array(box.max).ravel()) / 2
        lo, hi = array(box.min).ravel(), array(box.max).ravel()
        corners = [array([x, y, z]) - eye for x in (lo[0], hi[0]) for y in (lo[1], hi[1]) for z in (lo[2], hi[2])]
        axis = (middle - eye) / norm(middle - eye)
        angle = float(max(degrees(arccos(c @ axis / norm(c))) for c in corners))
        return {"type": "spot", "intensity": 1.0, "cutoff_angle": angle, "beam_width": angle - .001,
                "to_world": self.T.look_at(list(map(float, eye)), list(map(float, middle)), [0, 1, 0])}

    def floor_only(self):
        """Height x width: pixels that show nothing but the floor."""
        from numpy import array
        show = {"type": "aov", "aovs": "i:shape_index"}
        index = array(self.mi.render(self.scene, integrator=self.mi.load_dict(show), spp=64))[..., -1]
        floor = index[SIDE - 1, SIDE // 2]
        return abs(index - floor) < 1e-4

    def pictures(self, seed, marks):
        """Means of the samples up to each of these seconds, and how many a second."""
        from numpy import array
        spp = 32
        draw = lambda at: array(self.mi.render(self.scene, spp=spp, seed=1_000_000 * seed + at))[..., :3].astype(float)
        draw(0)  # compiles
        begin, total, count, found = time.monotonic(), 0, 0, []
        for mark in marks:
            while time.monotonic() - begin < mark:
                count += 1
                total = total + draw(count)
            found.append(total / count)
        return found, count * spp * SIDE * SIDE / marks[-1]


def nephroid(program, scene, folder, seed):
    """Pictures at SECONDS: all light, and the layer "direct" of the last."""
    from layers import read_layer
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "scene.json").write_text(json.dumps(preset_of(scene)))
    run = folder / f"seed-{seed}"
    subprocess.run([program, "run", str(folder / "scene.json"), "-o", str(run), "--seed", str(seed), "--seconds", str(SECONDS[-1]),
                    "--pictures-at", ",".join(map(str, SECONDS))], check=True, stdout=subprocess.DEVNULL)
    pictures = [sum(read_layer(run / f"at-{s:04}s.exr", layer) for layer in ("direct", "caustic")) for s in SECONDS]
    return pictures, read_layer(run / f"at-{SECONDS[-1]:04}s.exr", "direct")


def measure(program, out, name):
    from numpy import mean, sqrt
    from layers import write_png
    scene = SCENES[name]
    ours, directs = zip(*(nephroid(program, scene, out / name, seed) for seed in SEEDS))
    grey = lambda picture: picture.mean(axis=-1)
    theirs, rates = {}, {}
    for aimed in (False, True):
        mitsuba = Mitsuba(scene, aimed)
        theirs[aimed], rates[aimed] = zip(*(mitsuba.pictures(seed, SECONDS) for seed in SEEDS))
    halves = [mitsuba.pictures(seed, [LONG / 2])[0][0] for seed in (3, 4)]
    truth, truth_noise = grey(sum(halves) / 2), grey(halves[0] - halves[1]) / 2

    direct = grey(directs[0])
    floor = mitsuba.floor_only()
    lit = floor & (direct > .5 * direct[floor].max())
    shadow = floor & (direct == 0) & (truth > 0)
    # The programs' units: of the light as written from the floor in plain light, of the light aimed by hand from the shadow.
    written = grey(theirs[False][0][-1])
    unit = written[lit].mean() / grey(ours[0][-1])[lit].mean()
    agreement = unit * grey(ours[0][-1])[shadow].mean() / written[shadow].mean()
    unit = truth[shadow].mean() / grey(ours[0][-1])[shadow].mean()
    level = truth[shadow].mean()
    rel = lambda square: sqrt(max(0, mean(square[shadow]))) / level
    floor_of_truth = mean(truth_noise[shadow] ** 2)

    print(f"\n{name}: {shadow.sum()} pixels; light in the shadow, Nephroid over Mitsuba: {agreement:.4f}; "
          f"noise of the reference {rel(truth_noise ** 2):.4f}; "
          f"Mitsuba: {rates[False][0] / 1e6:.2f} million particles a second as written, {rates[True][0] / 1e6:.2f} aimed by hand")
    print("| seconds | error | noise of two seeds | Mitsuba as written | Mitsuba aimed by hand | times as written | times aimed |")
    print("| ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for at, seconds in enumerate(SECONDS):
        both = [unit * grey(picture[at]) for picture in ours]
        error = rel(mean([(p - truth) ** 2 for p in both], axis=0) - floor_of_truth)
        noise = rel((both[0] - both[1]) ** 2 / 2)
        mi = {aimed: rel(grey(theirs[aimed][0][at] - theirs[aimed][1][at]) ** 2 / 2) * level / grey(theirs[aimed][0][-1])[shadow].mean()
              for aimed in (False, True)}
        print(f"| {seconds} | {error:.4f} | {noise:.4f} | {mi[False]:.4f} | {mi[True]:.4f} | {(mi[False] / error) ** 2:.2f} | {(mi[True] / error) ** 2:.2f} |",
              flush=True)
        for title, picture in (("nephroid", ours[0][at]), ("mitsuba-written", theirs[False][0][at]), ("mitsuba-aimed", theirs[True][0][at])):
            write_png(out / name / f"{title}-{seconds}s.png", picture / (4 * grey(picture)[shadow].mean()))
    write_png(out / name / "reference.png", sum(halves) / (8 * level))


if __name__ == "__main__":
    if len(sys.argv) < 3 or not Path(sys.argv[1]).is_file() or not set(sys.argv[3:]) <= set(SCENES):
        sys.exit("usage: ptracer.py PROGRAM OUT [ball] [bunny], PROGRAM being the program, as build/release/bin/nephroid")
    folder = Path(sys.argv[2]).absolute()
    in_venv(folder)
    for name in sys.argv[3:] or SCENES:
        measure(sys.argv[1], folder, name)
