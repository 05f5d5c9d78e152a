# SPDX-License-Identifier: Apache-2.0
"""How peers.py renders a scene with each program: a function each, that gives pictures of linear light (height x width
x 3, in a unit of the program's own) and the processor seconds that each took, user and system of all threads. What
Mitsuba and LuxCore take to start and to compile is not counted; what Nephroid and POV-Ray take to start is."""
import json
import resource
import subprocess
import sys
import time

import numpy as np

from peers_scenes import BUNNY, MOVED, SIDE, ball, bunny, cone_about_bunny, rectangle, reflectance, walls

DEEP = 33  # surfaces of the longest path


def run_measured(command, folder):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([str(c) for c in command], cwd=folder, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        sys.exit(f"{command[0]} failed: {done.stderr[-600:]}")
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


# --- Nephroid


# Normals of walls: how a quad, which lies flat with its front up, is turned to each, and which way its edges x and z
# then go.
TURNS = {(0, 1, 0): ([0, 0, 0], 0, 2), (0, -1, 0): ([180, 0, 0], 0, 2), (0, 0, 1): ([90, 0, 0], 0, 1),
         (1, 0, 0): ([0, 0, -90], 1, 2),
         (-1, 0, 0): ([0, 0, 90], 1, 2)}


def quad(index, middle, u, v):
    turn, x, z = TURNS[tuple(np.sign(np.cross(u, v)).astype(int).tolist())]
    edges = (np.abs(u) + np.abs(v)).astype(float).tolist()
    return {"name": f"wall {index}", "shape": {"type": "quad", "size": [edges[x], 1, edges[z]]}, "material": "matt",
            "transform": {"rotate_deg": turn, "translate": list(middle)}}


def preset_of(scene):
    light, about = dict(scene["light"]), {"spectrum": "D65"}
    made = {"camera": scene["camera"] | {"resolution": [SIDE, SIDE]},
            "materials": {"matt": {"type": "diffuse", "reflectance": {"type": "constant",
                                                                      "value": reflectance(scene)}}},
            "objects": [quad(i, *wall) for i, wall in enumerate(walls(scene))], "lights": []}
    if "body" in scene:
        made["materials"]["glass"] = {"type": "dielectric", "dispersion": {"type": "constant", "n": scene["index"]}}
        made["objects"].append(
            {"name": "glass", "material": "glass", "mesh": BUNNY, "normals": "faceted", "transform": MOVED}
            if scene["body"] == "bunny" else
            {"name": "glass", "material": "glass", "shape": {"type": "sphere", "radius": 1}, "normals": "smooth"})
    if light["type"] == "sky":
        made["environment"] = {"type": "constant", "colour": [1, 1, 1], "lights": True}
    elif light["type"] == "area":
        made["lights"] = [about | {"type": "area", "position": light["position"], "direction": [0, -1, 0],
                                   "size": [light["size"]] * 2}]
    else:
        made["lights"] = [about | light]
    return {"engine": "spectral", "unit": "m", "white": 1, "scene": made, "spectral": {"indirect": "box" in scene}}


def nephroid(scene, folder, budgets, program, settings=()):
    from layers import read_layer
    (folder / "scene.json").write_text(json.dumps(preset_of(scene)))
    pictures, seconds, direct = [], [], None
    for budget in budgets:
        out = folder / f"nephroid-{budget}"
        seconds.append(run_measured([program, "run", "scene.json", "-o", out, "--seconds", budget / 2, *settings],
                                    folder))
        names = ["direct", "indirect"] if "box" in scene else ["direct", "caustic"]
        layers = [read_layer(out / "image.exr", name) for name in names]
        direct = layers[0]
        pictures.append(sum(layers))
    return pictures, seconds, direct


# --- Mitsuba


class Mitsuba:
    """method: "ptracer", from the light, which then is aimed at the glass by hand; or "path", from the eye."""

    def __init__(self, scene, method):
        import mitsuba
        mitsuba.set_variant("llvm_ad_rgb")
        self.mi = mitsuba
        T = mitsuba.ScalarTransform4f
        camera = scene["camera"]
        parts = {
            "type": "scene", "integrator": {"type": method, "max_depth": DEEP, "rr_depth": DEEP, "hide_emitters": True},
            "sensor": {"type": "perspective", "fov": camera["fov_deg"],
                       "to_world": T().look_at(camera["position"], camera["target"], [0, 1, 0]),
                       "film": {"type": "hdrfilm", "width": SIDE, "height": SIDE, "rfilter": {"type": "box"}}},
            "light": self.light(scene, method)}
        if "body" in scene:
            m = MOVED
            body = {"type": "sphere"} if scene["body"] == "ball" else {
                "type": "obj", "filename": BUNNY, "face_normals": True,
                "to_world": T().translate(m["translate"]).rotate([0, 1, 0], m["rotate_deg"][1]).scale(m["scale"])}
            parts["glass"] = body | {"bsdf": {"type": "dielectric", "int_ior": scene["index"], "ext_ior": 1.0}}
        for i, (middle, u, v) in enumerate(walls(scene)):
            u, v = np.array(u) / 2, np.array(v) / 2
            n = np.cross(u, v) / np.linalg.norm(np.cross(u, v))
            matrix = np.eye(4)
            matrix[:3] = np.stack([u, v, n, middle], -1)
            parts[f"wall{i}"] = {"type": "rectangle", "to_world": T(matrix),
                                 "bsdf": {"type": "twosided",
                                          "bsdf": {"type": "diffuse", "reflectance": reflectance(scene)}}}
        self.floor_height = walls(scene)[0][0][1]
        self.scene = mitsuba.load_dict(parts)

    def light(self, scene, method):
        T, light = self.mi.ScalarTransform4f, scene["light"]
        if light["type"] == "sky":
            return {"type": "constant", "radiance": 1.0}
        if light["type"] == "area":
            return {"type": "rectangle",
                    "to_world": T().translate(light["position"]).rotate([1, 0, 0], 90).scale(light["size"] / 2),
                    "emitter": {"type": "area", "radiance": 1.0}}
        if light["type"] == "directional":
            if method == "ptracer":
                return {"type": "disk", "to_world": T().translate([0, 1.5, 0]).rotate([1, 0, 0], 90).scale(1.01),
                        "emitter": {"type": "directionalarea", "radiance": 1.0}}
            return {"type": "directional", "direction": light["direction"], "irradiance": 1.0}
        eye = light["position"]
        if method == "ptracer":
            middle, angle = cone_about_bunny(eye)
            return {"type": "spot", "intensity": 1.0, "cutoff_angle": angle, "beam_width": angle - .001,
                    "to_world": T().look_at(eye, list(map(float, middle)), [0, 1, 0])}
        return {"type": "point", "position": eye, "intensity": 1.0}

    def floor_only(self):
        """Height x width: pixels that show nothing but the floor."""
        show = {"type": "aov", "aovs": "at:position"}
        at = np.array(self.mi.render(self.scene, integrator=self.mi.load_dict(show), spp=64))[..., -3:]
        return abs(at[..., 1] - self.floor_height) < 1e-4

    def pictures(self, seed, budgets, spp=32):
        draw = lambda at: np.array(self.mi.render(self.scene, spp=spp,
                                                  seed=1_000_000 * seed + at))[..., :3].astype(float)
        draw(0)  # compiles
        begin, total, count, found, seconds = time.process_time(), 0, 0, [], []
        for budget in budgets:
            while count == 0 or time.process_time() - begin < budget:
                count += 1
                total = total + draw(count)
            found.append(total / count)
            seconds.append(time.process_time() - begin)
        return found, seconds


# --- LuxCore


def write_ply(path, vertices, triangles, normals=None):
    rows = vertices if normals is None else np.concatenate([vertices, normals], 1)
    names = "xyz" if normals is None else ["x", "y", "z", "nx", "ny", "nz"]
    header = "ply\nformat ascii 1.0\nelement vertex %d\n" % len(rows) + "".join(f"property float {n}\n" for n in names)
    header += "element face %d\nproperty list uchar int vertex_indices\nend_header\n" % len(triangles)
    with open(path, "w") as file:
        file.write(header)
        np.savetxt(file, rows, "%.7g")
        np.savetxt(file, np.concatenate([np.full((len(triangles), 1), 3), triangles], 1), "%d")


def luxcore(scene, folder, budgets, seed, settings):
    """settings: of the render engine, over what all scenes share."""
    import pyluxcore
    pyluxcore.Init(lambda line: None)
    camera, light = scene["camera"], scene["light"]
    words = lambda v: [float(x) for x in v]
    props = pyluxcore.Properties()

    def put(values):
        for name, value in values.items():
            props.Set(pyluxcore.Property(name, value))

    put({"scene.camera.type": "perspective", "scene.camera.lookat.orig": words(camera["position"]),
         "scene.camera.lookat.target": words(camera["target"]), "scene.camera.up": [0.0, 1.0, 0.0],
         "scene.camera.fieldofview": float(camera["fov_deg"]), "scene.camera.autovolume.enable": False})
    put({"scene.materials.matt.type": "matte", "scene.materials.matt.kd": [float(reflectance(scene))] * 3})
    for i, wall in enumerate(walls(scene)):
        write_ply(folder / f"wall{i}.ply", *rectangle(*wall))
        put({f"scene.objects.wall{i}.ply": str(folder / f"wall{i}.ply"), f"scene.objects.wall{i}.material": "matt"})
    if "body" in scene:
        vertices, triangles = ball() if scene["body"] == "ball" else bunny()
        write_ply(folder / "glass.ply", vertices, triangles, vertices if scene["body"] == "ball" else None)
        put({"scene.materials.glass.type": "glass", "scene.materials.glass.interiorior": float(scene["index"]),
             "scene.materials.glass.kr": [1.0] * 3, "scene.materials.glass.kt": [1.0] * 3,
             "scene.objects.glass.ply": str(folder / "glass.ply"), "scene.objects.glass.material": "glass"})
    if light["type"] == "sky":
        put({"scene.lights.l.type": "constantinfinite", "scene.lights.l.color": [1.0] * 3})
    elif light["type"] == "area":
        write_ply(folder / "lamp.ply", *rectangle(light["position"], [light["size"], 0, 0], [0, 0, light["size"]]))
        put({"scene.materials.lamp.type": "matte", "scene.materials.lamp.kd": [0.0] * 3,
             "scene.materials.lamp.emission": [1.0] * 3,
             "scene.objects.lamp.ply": str(folder / "lamp.ply"), "scene.objects.lamp.material": "lamp"})
    elif light["type"] == "directional":
        put({"scene.lights.l.type": "laser", "scene.lights.l.position": [0.0, 1.5, 0.0],
             "scene.lights.l.target": [0.0, 0.0, 0.0],
             "scene.lights.l.radius": 1.01, "scene.lights.l.color": [1.0] * 3})
    else:
        middle, angle = cone_about_bunny(light["position"])
        put({"scene.lights.l.type": "spot", "scene.lights.l.position": words(light["position"]),
             "scene.lights.l.target": words(middle),
             "scene.lights.l.coneangle": angle, "scene.lights.l.conedeltaangle": .001,
             "scene.lights.l.color": [1.0] * 3})
    made = pyluxcore.Scene()
    made.Parse(props)
    config = {"film.width": SIDE, "film.height": SIDE, "film.filter.type": "NONE",
              "film.imagepipelines.0.0.type": "NOP",
              "film.outputs.0.type": "RGB", "film.outputs.0.filename": "rgb.exr", "native.threads.count": 2,
              "renderengine.seed": seed}
    all_settings = pyluxcore.Properties()
    for name, value in (config | settings).items():
        all_settings.Set(pyluxcore.Property(name, value))
    session = pyluxcore.RenderSession(pyluxcore.RenderConfig(all_settings, made))
    begin, found, seconds = time.process_time(), [], []
    session.Start()
    for budget in budgets:
        while time.process_time() - begin < budget:
            time.sleep(.05)
            session.UpdateStats()
        picture = np.empty((SIDE, SIDE, 3), np.float32)
        session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB, picture, 0)
        found.append(np.roll(picture[::-1], -1, 0).astype(float))  # lines from below, a line too low
        seconds.append(time.process_time() - begin)
    session.Stop()
    return found, seconds


# --- POV-Ray


def povray(scene, folder, works, gather, read_picture):
    """works: photons, or of a room the rays of a radiosity sample."""
    v = lambda p: "<" + ",".join(f"{x:.7g}" for x in p) + ">"
    camera, light = scene["camera"], scene["light"]
    text = (f"camera {{ perspective location {v(camera['position'])} right <-1,0,0> up <0,1,0> angle "
            f"{camera['fov_deg']} "
            f"look_at {v(camera['target'])} }}\n")
    matt = f"texture {{ pigment {{ rgb 1 }} finish {{ ambient 0 diffuse {reflectance(scene)} }} }}"
    for middle, a, b in walls(scene):
        corners, triangles = rectangle(middle, a, b)
        for t in triangles:
            text += f"triangle {{ {', '.join(v(corners[i]) for i in t)} {matt} }}\n"
    if light["type"] == "area":
        corners, triangles = rectangle(light["position"], [light["size"], 0, 0], [0, 0, light["size"]])
        for t in triangles:
            text += (f"triangle {{ {', '.join(v(corners[i]) for i in t)} "
                     "texture { finish { ambient 0 diffuse 0 emission 1 } pigment { rgb 1 } } }\n")
    elif light["type"] == "directional":
        text += "light_source { <0,50,0> rgb 1 parallel point_at <0,0,0> photons { refraction on reflection on } }\n"
    else:
        text += (f"light_source {{ {v(light['position'])} rgb 100 fade_distance .1 fade_power 2 "
                 "photons { refraction on reflection on } }\n")
    if "body" in scene:
        glass = ("material { texture { pigment { rgbt 1 } finish { ambient 0 diffuse 0 reflection { 0 1 fresnel on } "
                 "conserve_energy } } "
                 f"interior {{ ior {scene['index']} }} }} photons {{ target reflection on refraction on }}")
        if scene["body"] == "ball":
            text += f"sphere {{ 0, 1 {glass} }}\n"
        else:
            vertices, triangles = bunny()
            text += "mesh {\n" + "".join(f"triangle {{ {', '.join(v(vertices[i]) for i in t)} }}\n" for t in triangles)
            text += f"inside_vector <0,1,0> {glass} }}\n"
    pictures, seconds = [], []
    for work in works:
        how = f"photons {{ count {work} autostop 0 {gather} max_trace_level {DEEP} }}" if "body" in scene else (
            f"radiosity {{ count {work} error_bound .5 recursion_limit 6 pretrace_end .01 nearest_count 10 "
            "low_error_factor .5 brightness 1 }")
        (folder / "scene.pov").write_text(f"#version 3.7;\nglobal_settings "
                                          f"{{ assumed_gamma 1 max_trace_level {DEEP} adc_bailout 0 {how} }}\n{text}")
        command = ["povray", "+Iscene.pov", "+Oscene.hdr", "+FH", f"+W{SIDE}", f"+H{SIDE}", "-D", "+WT2", "+A0.0",
                   "+AM1", "+R2"]
        seconds.append(run_measured(command, folder))
        pictures.append(read_picture(folder / "scene.hdr"))
    return pictures, seconds
