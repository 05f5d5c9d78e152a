# SPDX-License-Identifier: Apache-2.0
"""The scenes of peers.py, and meshes for programs that have no ball or rectangle. y is up. Glass has one index, so no
program gains by wavelengths. Where light comes through glass the floor reflects 5 %, so that light that meets it twice
does not count."""
import numpy as np

SIDE = 256  # pixels
BUNNY = "/usr/share/glmark2/models/bunny.obj"  # of Debian's glmark2-data
MOVED = {"scale": [2, 2, 2], "rotate_deg": [0, 20, 0], "translate": [-.6, 1.983, -.8]}

# body: a ball of radius 1 in the origin, or the bunny, moved. floor: edge, height, reflectance. box: edge and height of
# a room without its front. aimed: what a program that lets its user aim light is given.
SCENES = {
    "ball": {
        "title": "a glass ball in sunlight", "body": "ball", "index": 1.5168, "floor": [8, -2, .05],
        "camera": {"position": [4, 4, 4], "target": [0, -1, 0], "fov_deg": 34},
        "light": {"type": "directional", "direction": [0, -1, 0]}},
    "bunny": {
        "title": "a faceted glass bunny under a lamp", "body": "bunny", "index": 1.8, "floor": [24, 0, .05],
        "camera": {"position": [1.2, 7.2, 10.2], "target": [.75, .75, .5], "fov_deg": 38},
        "light": {"type": "point", "position": [-4, 5.6, -4.4]}},
    "sky": {
        "title": "a glass ball under an even sky", "body": "ball", "index": 1.5168, "floor": [8, -1, .05],
        "camera": {"position": [4, 4, 4], "target": [.5, -1, 0], "fov_deg": 40},
        "light": {"type": "sky"}},
    "room": {
        "title": "a matt room", "box": [4, 3], "reflectance": .7,
        "camera": {"position": [0, 1.5, 5], "target": [0, 1.4, 0], "fov_deg": 42},
        "light": {"type": "area", "position": [0, 2.99, 0], "size": 1}},
}


def read_obj(path):
    """Vertices and triangles of a file without other faces."""
    vertices, triangles = [], []
    for line in open(path):
        words = line.split()
        if words and words[0] == "v":
            vertices.append([float(w) for w in words[1:4]])
        if words and words[0] == "f":
            triangles.append([int(w.split("/")[0]) - 1 for w in words[1:4]])
    return np.array(vertices), np.array(triangles)


def bunny():
    vertices, triangles = read_obj(BUNNY)
    turn = np.radians(MOVED["rotate_deg"][1])
    about_y = np.array([[np.cos(turn), 0, np.sin(turn)], [0, 1, 0], [-np.sin(turn), 0, np.cos(turn)]])
    return vertices * MOVED["scale"] @ about_y.T + MOVED["translate"], triangles


def ball(around=512):
    """Vertices, which are normals too, and triangles."""
    polar, turn = np.meshgrid(np.linspace(0, np.pi, around // 2 + 1), np.linspace(0, 2 * np.pi, around + 1),
                              indexing="ij")
    vertices = np.stack([np.sin(polar) * np.cos(turn), np.cos(polar), np.sin(polar) * np.sin(turn)], -1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(around // 2), np.arange(around), indexing="ij")
    a = (i * (around + 1) + j).ravel()
    b, c = a + 1, a + around + 1
    upper = np.stack([a, b, c], -1)[around:]
    lower = np.stack([b, c + 1, c], -1)[:-around]
    return vertices, np.concatenate([upper, lower])


def rectangle(middle, edge_u, edge_v):
    """u x v is the front."""
    m, u, v = (np.array(x, float) / s for x, s in ((middle, 1), (edge_u, 2), (edge_v, 2)))
    return np.array([m - u - v, m + u - v, m + u + v, m - u + v]), np.array([[0, 1, 2], [0, 2, 3]])


def walls(scene):
    """Rectangles of floor or room as (middle, edge u, edge v), fronts inwards."""
    if "floor" in scene:
        size, height, _ = scene["floor"]
        return [([0, height, 0], [0, 0, size], [size, 0, 0])]
    w, h = scene["box"]
    return [([0, 0, 0], [0, 0, w], [w, 0, 0]), ([0, h, 0], [w, 0, 0], [0, 0, w]),
            ([0, h / 2, -w / 2], [w, 0, 0], [0, h, 0]),
            ([-w / 2, h / 2, 0], [0, 0, -w], [0, h, 0]), ([w / 2, h / 2, 0], [0, 0, w], [0, h, 0])]


def reflectance(scene):
    return scene["floor"][2] if "floor" in scene else scene["reflectance"]


def cone_about_bunny(eye):
    """The bunny's middle, and half the angle in degrees of the cone about it from there."""
    vertices, _ = bunny()
    low, high, eye = vertices.min(0), vertices.max(0), np.array(eye)
    middle = (low + high) / 2
    ways = vertices - eye
    axis = (middle - eye) / np.linalg.norm(middle - eye)
    return middle, float(np.degrees(np.arccos((ways @ axis / np.linalg.norm(ways, axis=1)).min())) + .01)
