# SPDX-License-Identifier: Apache-2.0
"""Scenes in the words of Mitsuba, PBRT and glTF, each of which turns on one thing that files of others have. A scene is
its files by name, which of them Nephroid imports, which Mitsuba loads, and the integrator that finds its light."""
import json
import struct
import zlib

import numpy as np

SIZE = 96
FLOOR_HEIGHT = -1.5


def sensor(width=SIZE, height=SIZE, more=""):
    return f"""<sensor type="perspective"><float name="fov" value="40"/>{more}
<transform name="to_world"><lookat origin="0, 6, 8" target="0, 0, 0" up="0, 1, 0"/></transform>
<film type="hdrfilm"><integer name="width" value="{width}"/><integer name="height" value="{height}"/>
<rfilter type="box"/></film></sensor>"""


def grey(value):
    return f'<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="{value}"/></bsdf></bsdf>'


FLOOR = f"""<shape type="rectangle"><transform name="to_world"><scale value="4"/><rotate x="1" angle="-90"/>
<translate y="-1.5"/></transform>{grey(.6)}</shape>"""
LAMP = """<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="90"/>
<translate x="1" y="4"/></transform><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>
<emitter type="area"><rgb name="radiance" value="10"/></emitter></shape>"""
SMALL_LAMP = LAMP.replace('<translate x="1"', '<scale value="0.1"/><translate x="1"').replace(
    'value="10"', 'value="1000"')
POINT = '<emitter type="point"><point name="position" x="1" y="4" z="0.5"/><rgb name="intensity" value="20"/></emitter>'


def glass(inside=1.5, outside=1.0):
    return (f'<bsdf type="dielectric"><float name="int_ior" value="{inside}"/>'
            f'<float name="ext_ior" value="{outside}"/></bsdf>')


def ball(radius=1.0, material=None, more=""):
    return f'<shape type="sphere"><float name="radius" value="{radius}"/>{material or glass()}{more}</shape>'


def whole(*parts, camera=None, floor=FLOOR):
    return '<scene version="3.0.0">' + "\n".join((camera or sensor(), floor, *parts)) + "</scene>"


CUBE = ([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)],
        [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
         [1, 5, 7], [1, 7, 3]])


def obj_of(points, triangles):
    return "".join(f"v {x} {y} {z}\n" for x, y, z in points) + "".join(
        f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles)


def ply_of(points, triangles):
    return (f"ply\nformat ascii 1.0\nelement vertex {len(points)}\n"
            "property float x\nproperty float y\nproperty float z\n"
            f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
            + "".join(f"{x} {y} {z}\n" for x, y, z in points) + "".join(f"3 {a} {b} {c}\n" for a, b, c in triangles))


def serialized_of(*meshes):
    """Mitsuba's own format: a stream of zlib a mesh, and where each begins."""
    data, begins = b"", []
    for points, triangles in meshes:
        begins.append(len(data))
        body = struct.pack("<I", 0x1000) + b"cube\0" + struct.pack("<QQ", len(points), len(triangles))  # float
        body += np.array(points, "<f4").tobytes() + np.array(triangles, "<u4").tobytes()
        data += struct.pack("<HH", 0x041C, 4) + zlib.compress(body)
    return data + struct.pack(f"<{len(begins)}Q", *begins) + struct.pack("<I", len(begins))


def placed(kind, file, transform, material, more=""):
    return (f'<shape type="{kind}"><string name="filename" value="{file}"/>{more}'
            f'<transform name="to_world">{transform}</transform>{material}</shape>')


TURNED = '<scale value="0.8"/><rotate y="1" angle="25"/><rotate x="1" angle="20"/>'
# A grid of directions with a bright patch, 32 x 16, as a Radiance file without run lengths.
SKY = np.full((16, 32, 3), .5)
SKY[2:5, 20:24] = 8


def radiance_of(picture):
    mantissa, exponent = np.frexp(picture.max(-1))
    scale = np.ldexp(256., -exponent)
    rgbe = np.concatenate([np.floor(picture * scale[..., None]), exponent[..., None] + 128], -1).astype(np.uint8)
    return b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % picture.shape[:2] + rgbe.tobytes()


def png_of(values):
    """Rows of red, green and blue, 0 to 1, as a picture of 8 bits."""
    rows = np.round(255 * np.asarray(values)).astype(np.uint8)
    height, width = rows.shape[:2]
    lines = b"".join(b"\0" + row.tobytes() for row in rows)
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in ((b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)),
                           (b"IDAT", zlib.compress(lines)), (b"IEND", b"")))


def bitmap(name, file, raw):
    return (f'<texture type="bitmap" name="{name}"><string name="filename" value="{file}"/>'
            f'<boolean name="raw" value="{raw}"/></texture>')


def pbrt(body, camera='LookAt 0 6 8  0 0 0  0 1 0\nCamera "perspective" "float fov" 40'):
    """PBRT is left-handed: the lamp, which stands at x = 1 elsewhere, is at -1."""
    return (f'Film "rgb" "integer xresolution" {SIZE} "integer yresolution" {SIZE}\n{camera}\nWorldBegin\n'
            'Material "diffuse" "rgb reflectance" [ .6 .6 .6 ]\n'
            'Shape "trianglemesh" "point3 P" [ -4 -1.5 -4  4 -1.5 -4  4 -1.5 4  -4 -1.5 4 ] '
            '"integer indices" [ 0 1 2 0 2 3 ]\n'
            'AttributeBegin\nMaterial "diffuse" "rgb reflectance" [ 0 0 0 ]\n'
            'AreaLightSource "diffuse" "rgb L" [ 10 10 10 ]\n'
            'Shape "trianglemesh" "point3 P" [ -2 4 -1  0 4 -1  0 4 1  -2 4 1 ] "integer indices" [ 0 1 2 0 2 3 ]\n'
            f'AttributeEnd\n{body}\n')


def gltf(lamp):
    """A box of glass above a floor, and a lamp of KHR_lights_punctual."""
    points, triangles = CUBE
    floor = ([[-4, -1.5, 4], [4, -1.5, 4], [4, -1.5, -4], [-4, -1.5, -4]], [[0, 1, 2], [0, 2, 3]])
    data, views, accessors, meshes = b"", [], [], []
    for index, (p, t) in enumerate(((floor), (points, triangles))):
        for array, kind, component in ((np.array(p, "<f4"), "VEC3", 5126),
                                       (np.array(t, "<u4").ravel(), "SCALAR", 5125)):
            views.append({"buffer": 0, "byteOffset": len(data), "byteLength": array.nbytes})
            accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": len(array),
                              "type": kind} | ({"min": np.min(p, 0).tolist(), "max": np.max(p, 0).tolist()}
                                               if kind == "VEC3" else {}))
            data += array.tobytes()
        meshes.append({"primitives": [{"attributes": {"POSITION": 2 * index}, "indices": 2 * index + 1,
                                       "material": index}]})
    eye = [1, 0, 0, 0, 0, .8, -.6, 0, 0, .6, .8, 0, 0, 6, 8, 1]  # looks along (0, -.6, -.8)
    return {"scene.gltf": json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2, 3]}],
        "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_transmission", "KHR_materials_ior",
                           "KHR_materials_volume"],
        "extensions": {"KHR_lights_punctual": {"lights": [lamp]}},
        "cameras": [{"type": "perspective", "perspective": {"yfov": np.radians(40), "aspectRatio": 1, "znear": .1}}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [.6, .6, .6, 1], "metallicFactor": 0},
                       "doubleSided": True},
                      {"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0},
                       "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
                                      "KHR_materials_ior": {"ior": 1.5},
                                      "KHR_materials_volume": {"thicknessFactor": 1}}}],
        "nodes": [{"mesh": 0}, {"mesh": 1, "scale": [.8, .8, .8], "rotation": [0, np.sin(.2), 0, np.cos(.2)]},
                  {"camera": 0, "matrix": eye},
                  {"translation": [1, 4, .5], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "meshes": meshes, "accessors": accessors, "bufferViews": views,
        "buffers": [{"byteLength": len(data), "uri": "scene.bin"}]}), "scene.bin": data}


def mitsuba(text, integrator="path", variant="llvm_ad_rgb", **files):
    return {"files": {"scene.xml": text} | files, "ours": "scene.xml", "theirs": "scene.xml", "integrator": integrator,
            "variant": variant}


def beside(files, ours, theirs, integrator="path"):
    """A file of another program, and the same scene in Mitsuba's words."""
    return {"files": files | {"theirs.xml": theirs}, "ours": ours, "theirs": "theirs.xml", "integrator": integrator}


def rough(kind, alpha, more):
    return (f'<bsdf type="{kind}"><string name="distribution" value="ggx"/><float name="alpha" value="{alpha}"/>'
            f'{more}</bsdf>')


# Johnson and Christy 1972.
GOLD = ('<bsdf type="conductor">'
        '<spectrum name="eta" value="367.9:1.48, 381.5:1.46, 397.4:1.47, 413.3:1.46, 430.5:1.45, '
        '450.9:1.38, 471.4:1.31, 495.9:1.04, 520.9:0.62, 548.6:0.43, 582.1:0.29, 616.8:0.21, 659.5:0.14, '
        '704.5:0.13, 756.0:0.14, 821.1:0.16"/>'
        '<spectrum name="k" value="367.9:1.895, 381.5:1.933, 397.4:1.952, 413.3:1.958, 430.5:1.948, '
        '450.9:1.914, 471.4:1.849, 495.9:1.833, 520.9:2.081, 548.6:2.455, 582.1:2.863, 616.8:3.272, '
        '659.5:3.697, 704.5:4.103, 756.0:4.542, 821.1:5.083"/>'
        '</bsdf>')
SKY_LIGHT = '<emitter type="constant"><rgb name="radiance" value="1"/></emitter>'
PANE = """<shape type="rectangle"><transform name="to_world"><scale value="2"/><rotate x="1" angle="-60"/>
<translate y="0.5"/></transform><bsdf type="thindielectric"><float name="int_ior" value="1.7"/>
<float name="specular_transmittance" value="0.8"/></bsdf></shape>"""

CHECKED = FLOOR.replace('<rgb name="reflectance" value="0.6"/>', """<texture type="checkerboard" name="reflectance">
<rgb name="color0" value=".8 .6 .4"/><rgb name="color1" value=".2 .3 .4"/>
<transform name="to_uv"><scale value="4"/></transform></texture>""")
VARNISHED = FLOOR.replace(grey(.6), """<bsdf type="plastic"><rgb name="diffuse_reflectance" value=".6"/>
<boolean name="nonlinear" value="true"/></bsdf>""")
FROSTED = ball(material=rough("roughdielectric", .1, '<float name="int_ior" value="1.5"/>'
                              '<float name="ext_ior" value="1"/>'))
SUN_AND_SKY = """<emitter type="sunsky"><float name="turbidity" value="3"/>
<vector name="sun_direction" x=".4" y=".8" z=".45"/></emitter>"""

# Normals that lean by up to 25 degrees, a roughness alpha of .05 to .3, and panes of colours.
CHANCE = np.random.default_rng(46)
LEANS = CHANCE.uniform(-.3, .3, (8, 8, 2))
NORMALS = np.concatenate([LEANS, np.sqrt(1 - (LEANS ** 2).sum(-1, keepdims=True))], -1) / 2 + .5
ALPHAS = np.repeat(CHANCE.uniform(.05, .3, (8, 8, 1)), 3, -1)
COLOURS = CHANCE.uniform(.1, .9, (4, 4, 3))
BUMPY = FLOOR.replace(grey(.6), f"""<bsdf type="twosided"><bsdf type="normalmap">{bitmap("normalmap", "n.png", "true")}
<bsdf type="diffuse"><rgb name="reflectance" value=".6"/></bsdf></bsdf></bsdf>""")
ETCHED = PANE[:PANE.index("<bsdf")] + '<bsdf type="twosided">' + rough(
    "roughconductor", .1, '<string name="material" value="none"/>').replace(
        '<float name="alpha" value="0.1"/>', bitmap("alpha", "a.png", "true")) + "</bsdf></shape>"
STAINED = PANE.replace('<float name="specular_transmittance" value="0.8"/>',
                       bitmap("specular_transmittance", "c.png", "false"))

ABSORBS = ('<medium name="interior" type="homogeneous"><rgb name="sigma_t" value="0.5"/><rgb name="albedo" value="0"/>'
           '</medium>')

SCENES = {
    "matt floor": mitsuba(whole(LAMP)),
    "room": mitsuba(whole(LAMP, f"""<shape type="cube"><boolean name="flip_normals" value="true"/>
<transform name="to_world"><scale value="12"/><translate y="9"/></transform>{grey(.5)}</shape>""")),
    "glass ball": mitsuba(whole(LAMP, ball())),
    "mirror": mitsuba(whole(
        LAMP, ball(material='<bsdf type="conductor"><string name="material" value="none"/></bsdf>'))),
    "bubble": mitsuba(whole(LAMP, ball(), ball(.6, glass(1, 1.5)))),
    "water in glass": mitsuba(whole(LAMP, ball(), ball(.8, glass(1.33, 1.5)))),
    "grey glass": mitsuba(whole(LAMP, ball(more=ABSORBS)), "volpath"),
    "null boundary": mitsuba(whole(LAMP, ball(1.3, '<bsdf type="null"/>'), ball())),
    "lamp by reference": mitsuba(whole(
        LAMP.replace('<emitter type="area"><rgb name="radiance" value="10"/></emitter>', '<ref id="shine"/>').replace(
            "<shape", '<emitter type="area" id="shine"><rgb name="radiance" value="10"/></emitter><shape', 1), ball())),
    "flipped lamp": mitsuba(whole(
        LAMP.replace('angle="90"', 'angle="-90"').replace(
            "<emitter", '<boolean name="flip_normals" value="true"/><emitter', 1), ball())),
    "forward reference": mitsuba(whole(
        LAMP, '<shape type="sphere"><ref id="later"/></shape><bsdf type="dielectric" id="later">'
              '<float name="int_ior" value="1.7"/></bsdf>')),
    "flat sides": mitsuba(whole(LAMP, placed("obj", "cube.obj", TURNED, glass(),
                                             '<boolean name="face_normals" value="true"/>')),
                          **{"cube.obj": obj_of(*CUBE)}),
    "smooth cube": mitsuba(whole(LAMP, placed("ply", "cube.ply", TURNED, glass())), **{"cube.ply": ply_of(*CUBE)}),
    "serialized": mitsuba(whole(LAMP, placed("serialized", "two.serialized", TURNED, glass(),
                                             '<integer name="shape_index" value="1"/>'
                                             '<boolean name="face_normals" value="true"/>')),
                          **{"two.serialized": serialized_of(([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]), CUBE)}),
    "includes": {"files": {
        "main/scene.xml": whole('<default name="n" value="1.6"/><path value="../parts"/>'
                                '<include filename="glass.xml"/>', LAMP,
                                placed("obj", "cube.obj", TURNED, '<ref id="glass"/>',
                                       '<boolean name="face_normals" value="true"/>')),
        "parts/glass.xml": '<scene version="3.0.0"><bsdf type="dielectric" id="glass">'
                           '<float name="int_ior" value="$n"/></bsdf></scene>',
        "parts/cube.obj": obj_of(*CUBE)}, "ours": "main/scene.xml", "theirs": "main/scene.xml", "integrator": "path"},
    "instances": mitsuba(whole(
        LAMP, '<shape type="shapegroup" id="group">' + ball(.6) + "</shape>",
        *[f'<shape type="instance"><ref id="group"/><transform name="to_world"><translate x="{x}"/></transform></shape>'
          for x in (-1, 1)])),
    "wide picture": mitsuba(whole(LAMP, ball(), camera=sensor(128, 64, '<string name="fov_axis" value="larger"/>'))),
    "matrix": mitsuba(whole(LAMP, placed("obj", "cube.obj", '<rotate z="1" angle="30"/>'
                                         '<matrix value="1 0 0 .3  0 .7 0 0  0 0 .5 0  0 0 0 1"/><scale value="1.2"/>',
                                         glass(), '<boolean name="face_normals" value="true"/>')),
                      **{"cube.obj": obj_of(*CUBE)}),
    "even sky": mitsuba(whole(SKY_LIGHT, ball())),
    "gold ball": mitsuba(whole(SKY_LIGHT, ball(material=GOLD)), variant="llvm_ad_spectral"),
    "tinted ball": mitsuba(whole(SKY_LIGHT, ball(material=glass().replace(
        "</bsdf>", '<float name="specular_transmittance" value="0.7"/></bsdf>')))),
    "thin pane": mitsuba(whole(SKY_LIGHT, PANE)),
    "rough glass": mitsuba(whole(SKY_LIGHT, FROSTED)),
    "rough glass, lamp": mitsuba(whole(LAMP, FROSTED)),
    "rough glass, small lamp": mitsuba(whole(SMALL_LAMP, FROSTED)),
    "textured floor, small lamp": mitsuba(whole(SMALL_LAMP, ball(), floor=CHECKED)),
    "textured floor": mitsuba(whole(LAMP, ball(), floor=CHECKED)),
    "plastic floor": mitsuba(whole(LAMP, ball(), floor=VARNISHED)),
    "sun and sky": mitsuba(whole(SUN_AND_SKY, ball())),
    "shining ball": mitsuba(whole(ball(.7, '<bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>'
                                       '<emitter type="area"><rgb name="radiance" value="4"/></emitter>'))),
    "thin lens": mitsuba(whole(LAMP, ball(), camera=sensor(more='<float name="aperture_radius" value="0.3"/>'
                                                           '<float name="focus_distance" value="9"/>').replace(
                                                               "perspective", "thinlens"))),
    "rough mirror": mitsuba(whole(SKY_LIGHT, ball(material=rough("roughconductor", .1,
                                                                 '<string name="material" value="none"/>')))),
    "normal map": mitsuba(whole(LAMP, ball(), floor=BUMPY), **{"n.png": png_of(NORMALS)}),
    "etched mirror": mitsuba(whole(SKY_LIGHT, ETCHED), **{"a.png": png_of(ALPHAS)}),
    "stained pane": mitsuba(whole(SKY_LIGHT, STAINED), **{"c.png": png_of(COLOURS)}),
    "sky of a picture": mitsuba(whole('<emitter type="envmap"><string name="filename" value="sky.hdr"/>'
                                      '<float name="scale" value="2"/><transform name="to_world">'
                                      '<rotate y="1" angle="70"/></transform></emitter>', ball()),
                                **{"sky.hdr": radiance_of(SKY)}),
    "point": mitsuba(whole(POINT, ball()), "ptracer"),
    "spot": mitsuba(whole('<emitter type="spot"><rgb name="intensity" value="20"/>'
                          '<float name="cutoff_angle" value="20"/><float name="beam_width" value="19.9"/>'
                          '<transform name="to_world">'
                          '<lookat origin="1, 4, 0.5" target="0, 0, 0" up="0, 1, 1"/></transform></emitter>', ball()),
                    "ptracer"),
    "PBRT ball": beside(
        {"scene.pbrt": pbrt('Material "dielectric" "float eta" 1.5\nShape "sphere"')}, "scene.pbrt",
        whole(LAMP, ball())),
    "PBRT instances": beside(
        {"scene.pbrt": pbrt('MakeNamedMaterial "g" "string type" "dielectric" "float eta" 1.4\nObjectBegin "one"\n'
                            'NamedMaterial "g"\nShape "sphere" "float radius" .6\nObjectEnd\nAttributeBegin\n'
                            'Translate -1 0 0\nObjectInstance "one"\nAttributeEnd\nAttributeBegin\nTranslate 1 .3 0\n'
                            'Scale 1.2 1.2 1.2\nObjectInstance "one"\nAttributeEnd')}, "scene.pbrt",
        whole(LAMP, ball(.6, glass(1.4), '<transform name="to_world"><translate x="1"/></transform>'),
              ball(.6, glass(1.4),
                   '<transform name="to_world"><scale value="1.2"/><translate x="-1" y="0.3"/></transform>'))),
    "PBRT grey glass": beside(
        {"scene.pbrt": pbrt('MakeNamedMedium "ink" "string type" "homogeneous" "rgb sigma_a" [ .5 .5 .5 ] '
                            '"rgb sigma_s" [ 0 0 0 ]\nMediumInterface "ink" ""\n'
                            'Material "dielectric" "float eta" 1.5\nShape "sphere"')}, "scene.pbrt",
        whole(LAMP, ball(more=ABSORBS)), "volpath"),
    "glTF box": beside(gltf({"type": "point", "intensity": 20}), "scene.gltf",
                       whole(POINT, placed("obj", "cube.obj", '<scale value="0.8"/><rotate y="1" angle="22.9183118"/>',
                                           glass(), '<boolean name="face_normals" value="true"/>')), "ptracer")
    }
SCENES["glTF box"]["files"]["cube.obj"] = obj_of(*CUBE)
