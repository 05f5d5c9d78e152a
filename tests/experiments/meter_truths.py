# SPDX-License-Identifier: Apache-2.0
"""What the meters of meters.py should tell: closed forms, and rays and patches of the sun followed by themselves."""
import math

import numpy


def solid_angle(corners, eye):
    """Of a triangle, signed (Van Oosterom and Strackee 1983)."""
    a, b, c = (numpy.asarray(p, float) - eye for p in corners)
    la, lb, lc = (numpy.linalg.norm(p) for p in (a, b, c))
    return 2 * math.atan2(a @ numpy.cross(b, c), la * lb * lc + (a @ b) * lc + (a @ c) * lb + (b @ c) * la)


def of_point(lamp, right, up, cell, watts=1.0):
    """The mean over square cells along right and up of a point's light."""
    lamp, right, up = (numpy.asarray(v, float) for v in (lamp, right, up))

    def cells(row):
        c = numpy.array([float(row[k]) for k in "xyz"])
        a, b, d, e = (c + cell / 2 * (i * right + j * up) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
        flux = -(solid_angle((a, b, d), lamp) + solid_angle((a, d, e), lamp)) * watts / (4 * math.pi)
        return max(flux, 0) / cell ** 2
    return cells


def of_area_lamp(lamp_y, edge, watts, normal, window=0.0, steps=120):
    """A square lamp that faces down above the origin, on square windows: by quadrature."""
    lamp = (numpy.arange(steps) + 0.5) / steps * edge - edge / 2
    x, z = (v.ravel() for v in numpy.meshgrid(lamp, lamp))
    normal = numpy.asarray(normal, float)
    places = ((numpy.arange(16) + 0.5) / 16 - 0.5) * window if window else numpy.zeros(1)
    radiance = watts / (math.pi * edge ** 2)

    def at(p, right, up):
        total = 0.0
        for i in places:
            for j in places:
                q = p + i * right + j * up
                way = numpy.stack([x - q[0], numpy.full_like(x, lamp_y - q[1]), z - q[2]], 1)
                r2 = (way ** 2).sum(1)
                total += (numpy.maximum(way @ normal, 0) * numpy.maximum(way[:, 1], 0) / r2 ** 2).mean() * edge ** 2
        return radiance * total / len(places) ** 2
    return at


def fresnel(cosine, n):
    """Of both polarisations, from air into n."""
    sine2 = (1 - cosine ** 2) / n ** 2
    inner = math.sqrt(1 - sine2)
    s = ((cosine - n * inner) / (cosine + n * inner)) ** 2
    p = ((n * cosine - inner) / (n * cosine + inner)) ** 2
    return [s, p]


def through_pane(angle_deg, n=1.5, is_thin=False):
    """Of unpolarised light. At each face of a body reflectances are averaged, as the program does; a thin pane keeps
    polarisations apart."""
    kinds = fresnel(math.cos(math.radians(angle_deg)), n)
    if not is_thin:
        kinds = [sum(kinds) / 2]
    return sum((1 - r) / (1 + r) for r in kinds) / len(kinds)


# Panes of a glazing: (n, the part that a straight way through the glass leaves) or, coated, (transmittance, front and
# back reflectance) straight on.
CLEAR_TWO = ((1.5, 1), (1.5, 1))
SOLAR_CONTROL = ((0.5, 0.3, 0.25), (1.52, 0.93))


def through_face(r):
    return numpy.array([[1 - 2 * r, r], [-r, 1]]) / (1 - r)


def glazing(panes, cosine):
    """What passes and what comes back from the front: by matrices of the light that goes on and back, each polarisation
    through all panes. Coated: regressions on clear or bronze glass (EnergyPlus, Engineering Reference)."""
    parts = numpy.zeros(2)
    for polarisation in (0, 1):
        unit = numpy.eye(2)  # (on, back) before the panes of those behind
        for pane in panes:
            if len(pane) == 2:
                n, left = pane
                face = through_face(fresnel(cosine, n)[polarisation])
                left = left ** (1 / math.sqrt(1 - (1 - cosine ** 2) / n ** 2))
                # A face as seen from its other side is the same, as its reflectance is.
                unit = unit @ numpy.linalg.inv(face @ numpy.diag((left, 1 / left)) @ face)
                continue
            t, front, back = pane
            of_t = (-0.0015, 3.355, -3.84, 1.46, 0.0288) if t > 0.645 else (-0.002, 2.813, -2.341, -0.05725, 0.599)
            of_sum = (0.999, -0.563, 2.043, -2.532, 1.054) if t > 0.645 else (0.997, -1.868, 6.513, -7.862, 3.225)
            fall, total = (numpy.polynomial.polynomial.polyval((cosine, 1), a) for a in (of_t, of_sum))
            rise = total - fall
            grows = max((rise[0] - rise[1]) / (1 - rise[1]), 0)
            t, front, back = t * max(fall[0] / fall[1], 0), front + (1 - front) * grows, back + (1 - back) * grows
            unit = unit @ numpy.linalg.inv(numpy.array([[t * t - front * back, back], [-front, 1]]) / t)
        parts += numpy.array((1, unit[1, 0])) / unit[0, 0] / 2
    return parts


def glazing_material(panes):
    return {"type": "glazing", "panes": [
        {"type": "glass", "dispersion": pane[0], "tint": pane[1]} if len(pane) == 2 else
        {"type": "measured", "transmittance": pane[0], "front_reflectance": pane[1], "back_reflectance": pane[2]}
        for pane in panes]}


def under_ball(radius, n, floor, half, cells, orders=5, steps=6000):
    """W/m^2 on square cells under a ball in sunlight from above: every way with up to so many reflections inside."""
    b = (numpy.arange(steps) + 0.5) / steps  # impact over the radius
    flux = numpy.pi * radius ** 2 * (((numpy.arange(steps) + 1) ** 2 - numpy.arange(steps) ** 2) / steps ** 2)
    i, r = numpy.arcsin(b), numpy.arcsin(b / n)
    ci, cr = numpy.cos(i), numpy.cos(r)
    reflected = (((ci - n * cr) / (ci + n * cr)) ** 2 + ((n * ci - cr) / (n * ci + cr)) ** 2) / 2
    image = numpy.zeros((cells, cells))
    turns = (numpy.arange(720) + 0.5) / 720 * 2 * numpy.pi
    # Angles in the plane of the ray: it falls along -y at x = b. A chord moves the place by pi - 2 r around.
    for order in range(-1, orders + 1):
        part = reflected if order < 0 else (1 - reflected) ** 2 * reflected ** order
        place = numpy.pi / 2 - i  # of the entry, from +x
        if order >= 0:
            place = place - (order + 1) * (numpy.pi - 2 * r)
        way = place - i
        x, y = radius * numpy.cos(place), radius * numpy.sin(place)
        dx, dy = numpy.cos(way), numpy.sin(way)
        down = dy < -1e-9
        t = (floor - y[down]) / dy[down]
        on = x[down] + t * dx[down]
        for turn in turns:
            c = numpy.floor((on * math.cos(turn) + half) / (2 * half) * cells).astype(int)
            s = numpy.floor((on * math.sin(turn) + half) / (2 * half) * cells).astype(int)
            good = (c >= 0) & (c < cells) & (s >= 0) & (s < cells)
            numpy.add.at(image, (s[good], c[good]), (part * flux)[down][good] / len(turns))
    return image / (2 * half / cells) ** 2


def disc_of(sun, disc_deg, count=400):
    """Ways of a sun's light, spread evenly over its disc. sun: the way of its middle."""
    golden = numpy.arange(count) + 0.5
    r, turn = numpy.sqrt(golden / count) * math.tan(math.radians(disc_deg / 2)), golden * math.pi * (3 - math.sqrt(5))
    sun = numpy.asarray(sun, float) / numpy.linalg.norm(sun)
    aside = numpy.cross(sun, (0, 0, 1.0))
    aside /= numpy.linalg.norm(aside)
    rays = sun + (r * numpy.cos(turn))[:, None] * aside + (r * numpy.sin(turn))[:, None] * numpy.cross(sun, aside)
    return rays / numpy.linalg.norm(rays, axis=1)[:, None]


def under_facade(width, height, arc_deg, columns, rows, gap, middle, sun, disc_deg, reflectance, corner, cell, counts,
                 pillow=0.0):
    """W/m^2 on square cells of the ground, of panes on an arc or a line: each a mirror patch of the sun's disc. A
    pane's middle stands out by pillow. reflectance: of the cosine."""
    cosines = numpy.linspace(0.001, 1, 2000)
    reflectances = numpy.array([reflectance(c) for c in cosines])
    image = numpy.zeros(counts[0] * counts[1])
    arc, along = math.radians(arc_deg), width / columns
    radius = width / arc if arc else 0
    chord = 2 * radius * math.sin(arc / columns / 2) if arc else along
    pane = (chord - gap, height / rows - gap)
    rays = disc_of(sun, disc_deg)
    depth = radius * (1 - math.cos(arc / 2))
    up = numpy.array((0, 1.0, 0))
    u, v = (a.ravel() for a in numpy.meshgrid((numpy.arange(40) + 0.5) / 20 - 1, (numpy.arange(40) + 0.5) / 20 - 1))
    for column in range(columns):
        angle = arc * ((column + 0.5) / columns - 0.5)
        out = numpy.array((-math.sin(angle), 0, math.cos(angle)))
        right = numpy.array((math.cos(angle), 0, math.sin(angle)))
        foot = numpy.array((0, 0, radius - depth / 2)) - radius * math.cos(arc / columns / 2) * out
        if not arc:
            foot = numpy.array(((column + 0.5) * along - width / 2, 0, 0))
        slope_x, slope_y = -4 * pillow / pane[0] * u * (1 - v * v), -4 * pillow / pane[1] * v * (1 - u * u)
        normal = out - slope_x[:, None] * right - slope_y[:, None] * up  # its part along out is 1
        length2 = (normal ** 2).sum(1)
        falls = normal @ rays.T  # by the area across `out`
        away = rays - 2 * (falls / length2[:, None])[:, :, None] * normal[:, None, :]
        for row in range(rows):
            at = middle + foot + numpy.array((0, height / 2 - (row + 0.5) * height / rows, 0))
            places = at + u[:, None] * pane[0] / 2 * right + v[:, None] * pane[1] / 2 * up
            t = places[:, None, 1] / -away[:, :, 1]
            x = places[:, None, 0] + t * away[:, :, 0]
            z = places[:, None, 2] + t * away[:, :, 2]
            i = numpy.floor((x - corner[0]) / cell).astype(int)
            j = numpy.floor((z - corner[1]) / cell).astype(int)
            good = (i >= 0) & (i < counts[0]) & (j >= 0) & (j < counts[1]) & (t > 0) & (falls < 0)
            reflected = numpy.interp(-falls / numpy.sqrt(length2)[:, None], cosines, reflectances)
            flux = numpy.maximum(-falls, 0) * reflected * pane[0] * pane[1] / (len(u) * len(rays))
            image += numpy.bincount((j * counts[0] + i)[good], flux[good], len(image))
    return image.reshape(counts[1], counts[0]) / cell ** 2
