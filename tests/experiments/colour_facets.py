# SPDX-License-Identifier: Apache-2.0
"""The slopes of a real object's facets for colour.py, and a tracer that judges them."""
import math

import numpy
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh

from colour import (BLUE, CELLS, COLOURS, GREEN, MATCHING, NM, RED, SUN, descend, fan, index, perceived, tilt)


def transmitted(angle, inner, outer):
    """Fresnel's share of unpolarized light that goes on."""
    sine = numpy.sin(angle) * inner / outer
    c, d = numpy.cos(angle), numpy.sqrt(1 - sine ** 2)
    s = ((inner * c - outer * d) / (inner * c + outer * d)) ** 2
    p = ((inner * d - outer * c) / (inner * d + outer * c)) ** 2
    return 1 - (s + p) / 2


class Facets:
    """A real object before the frame: COUNT x COUNT facets, each as large as a cell and with a slope of its own."""

    COUNT = 128
    BINS = numpy.clip((NM - 400) // 10, 0, 29)

    def __init__(self, spots, limit):
        self.distance = spots.distance
        middles = numpy.arange(self.COUNT) + 0.5 - self.COUNT / 2
        self.place = numpy.stack(numpy.meshgrid(middles, middles), -1).reshape(-1, 2)
        self.weights = numpy.array([numpy.bincount(self.BINS, c) for c in COLOURS])
        nm = [(NM[self.BINS == b] * MATCHING.sum(0)[self.BINS == b]).sum() / MATCHING.sum(0)[self.BINS == b].sum()
              for b in range(30)]
        self.slopes = numpy.linspace(0, math.tan(tilt(math.radians(limit))), 1000)  # of facets, by their tilt's tangent
        a = numpy.arctan(self.slopes)
        self.throws = numpy.tan(numpy.arcsin(index(nm)[:, None] * numpy.sin(a)) - a) * self.distance
        self.sent = transmitted(numpy.zeros(1), 1, float(index(GREEN))) * transmitted(a, float(index(GREEN)), 1)
        disc = spots.offsets(math.radians(20), 0, SUN)[NM == GREEN][0]
        self.blur = numpy.zeros((3, 3))
        for dy in (-1, 0, 1):
            for dx in (-1, 0, 1):
                self.blur[dy + 1, dx + 1] = numpy.prod(numpy.clip(1 - abs(disc - [dx, dy]), 0, 1), 1).mean()

    def blurred(self, picture):
        padded = numpy.pad(picture, ((0, 0), (1, 1), (1, 1)))
        return sum(self.blur[j, i] * padded[:, j:j + picture.shape[1], i:i + picture.shape[2]]
                   for j in range(3) for i in range(3))

    def drawn(self, light, spots, directions, lengths, limit, seed=1):
        """Slopes by lot: each facet takes a landing that still lacks light of the fan that it would give. Also the
        light of a facet, where white on a cell is 1."""
        random = numpy.random.default_rng(seed)
        cells = numpy.arange(spots.size) + 0.5 - spots.size / 2
        landing = numpy.stack(numpy.meshgrid(cells, cells), -1).reshape(-1, 2)
        longest = fan(math.radians(limit)) * self.distance
        fans = self.fans()
        need = light.reshape(len(light), -1).copy()
        each = need.sum() / len(self.place) / 0.8  # a fifth of the facets finds nothing to do
        slopes = numpy.zeros_like(self.place)
        columns = numpy.arange(len(landing))
        green = self.green()
        for facet in random.permutation(len(self.place)):
            way = landing - self.place[facet]
            throw = numpy.hypot(*way.T)
            ring = numpy.rint(numpy.interp(throw, green, fans) / longest * lengths).astype(int)
            turn = numpy.arctan2(way[:, 1], way[:, 0]) / (2 * math.pi)
            spoke = numpy.rint(turn * directions).astype(int) % directions
            kind = numpy.where(ring > 0, 1 + (ring - 1) * directions + spoke, 0)
            lack = numpy.where(throw <= green[-1], need[kind, columns], 0)
            total = lack.sum()
            if total < each / 4:  # beside the frame, the way that is nearest
                outward = self.place[facet] / max(abs(self.place[facet]).max(), 1e-9)
                slopes[facet] = outward * 0.35 if abs(self.place[facet]).max() < CELLS / 2 + 2 else 0
                continue
            taken = random.choice(len(landing), p=lack / total)
            need[kind[taken], taken] = max(0, need[kind[taken], taken] - each)
            jitter = landing[taken] + random.random(2) - 0.5 - self.place[facet]
            length = numpy.hypot(*jitter)
            slopes[facet] = jitter / length * numpy.interp(length, green, self.slopes)
        return slopes, each / self.sent.mean()

    def green(self):
        a = numpy.arctan(self.slopes)
        return numpy.tan(numpy.arcsin(index(GREEN) * numpy.sin(a)) - a) * self.distance

    def fans(self):
        a = numpy.arctan(self.slopes)[:, None]
        blue, red = numpy.tan(numpy.arcsin(index([BLUE, RED]) * numpy.sin(a)) - a).T
        return (blue - red) * self.distance

    def cast(self, slopes, each, measure=None, target=None):
        """X, Y, Z of the frame; with a measure, its value and derivative by the slopes."""
        size = numpy.maximum(numpy.hypot(*slopes.T), 1e-9)
        way = slopes / size[:, None]
        sent = each * numpy.interp(size, self.slopes, self.sent)
        frame = numpy.zeros((3, CELLS + 2, CELLS + 2))
        kept = []
        for b, throws in enumerate(self.throws):
            at = self.place + numpy.interp(size, self.slopes, throws)[:, None] * way + CELLS / 2 + 0.5
            low = numpy.floor(at).astype(int)
            inside = numpy.all((low >= 0) & (low <= CELLS), 1)
            part, low = (at - low)[inside], low[inside]
            index_of = low[:, 1] * (CELLS + 2) + low[:, 0]
            x, y = part.T
            kept.append((inside, index_of, x, y))
            for step, share in ((0, (1 - x) * (1 - y)), (1, x * (1 - y)), (CELLS + 2, (1 - x) * y),
                                (CELLS + 3, x * y)):
                sums = numpy.bincount(index_of + step, share * sent[inside], (CELLS + 2) ** 2).reshape(frame[0].shape)
                frame += self.weights[:, b, None, None] * sums
        seen = self.blurred(frame)[:, 1:-1, 1:-1]
        if measure is None:
            return seen
        value, by_seen = measure(seen, target)
        by_frame = self.blurred(numpy.pad(by_seen, ((0, 0), (1, 1), (1, 1)))).reshape(3, -1)
        derivative = numpy.zeros_like(slopes)
        for b, throws in enumerate(self.throws):
            inside, index_of, x, y = kept[b]
            g = self.weights[:, b] @ by_frame
            g00, g10, g01, g11 = (g[index_of + step] for step in (0, 1, CELLS + 2, CELLS + 3))
            pull = numpy.stack([(g10 - g00) * (1 - y) + (g11 - g01) * y, (g01 - g00) * (1 - x) + (g11 - g10) * x], -1)
            pull *= sent[inside, None]
            s, w = size[inside], way[inside]
            along = (pull * w).sum(1)
            steep = numpy.interp(s, self.slopes, numpy.gradient(throws, self.slopes))
            across = numpy.interp(s, self.slopes, throws) / s
            derivative[inside] += (steep - across)[:, None] * along[:, None] * w + across[:, None] * pull
        return value, derivative

    def improved(self, slopes, each, target, steps):
        """Slopes and the light of a facet, by the mean Delta E."""
        def function(flat):
            some = each * math.exp(flat[-1])
            value, derivative = self.cast(flat[:-1].reshape(slopes.shape), some, perceived, target)
            seen = self.cast(flat[:-1].reshape(slopes.shape), some)
            return value, numpy.append(derivative.ravel(), (perceived(seen, target)[1] * seen).sum())
        found = descend(function, numpy.append(slopes.ravel(), 0.0), steps)
        each, found = each * math.exp(found[-1]), found[:-1].reshape(slopes.shape)
        size = numpy.hypot(*found.T)[:, None]
        return found * numpy.minimum(1, self.slopes[-1] / numpy.maximum(size, 1e-9)), each


def traced(slopes, distance, rays=32):
    """X, Y, Z of the frame by rays through the facets and their walls, and the share of the light that walls stop or
    bend. Nothing of Facets: Snell's law by vectors, Fresnel's for each wavelength."""
    count = Facets.COUNT
    random = numpy.random.default_rng(2)
    corner = numpy.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
    x, y = numpy.meshgrid(numpy.arange(count), numpy.arange(count))
    low = numpy.stack([x, y], -1).reshape(-1, 1, 2)
    height = ((corner - 0.5) * slopes[:, None]).sum(-1)
    quads = numpy.concatenate([low + corner - count / 2, height[..., None]], -1)
    grid = quads.reshape(count, count, 4, 3)
    walls = [numpy.stack([a[:, :, i], a[:, :, j], b[:, :, k], b[:, :, m]], 2).reshape(-1, 4, 3)
             for a, b, (i, j, k, m) in ((grid[:, :-1], grid[:, 1:], (1, 2, 3, 0)),
                                        (grid[:-1], grid[1:], (2, 3, 0, 1)))]
    every = numpy.concatenate([quads, *walls])
    scene = rtcore_scene.EmbreeScene(robust=True)
    TriangleMesh(scene, every[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3, 3).astype("f4"))
    frame, stopped, all_light = numpy.zeros((3, CELLS * CELLS)), 0.0, 0.0
    steps = 1.1347241384015194 ** -numpy.arange(1, 6)  # an even sequence in five dimensions, shifted for each facet
    sequence = (numpy.arange(rays ** 2)[:, None, None] * steps)
    for part in numpy.array_split(numpy.arange(count * count), 16):
        lot = ((sequence + random.random((len(part), 5))) % 1).reshape(-1, 5)
        at = numpy.tile(low[part, 0], (rays ** 2, 1)) + lot[:, :2] - count / 2
        which = (lot[:, 2] * len(NM)).astype(int)
        n = index(NM)[which]
        radius, angle = numpy.sqrt(lot[:, 3]) * SUN / 2, lot[:, 4] * 2 * math.pi
        way = numpy.stack([radius * numpy.cos(angle) / n, radius * numpy.sin(angle) / n], -1)
        way = numpy.concatenate([way, numpy.sqrt(1 - (way ** 2).sum(1))[:, None]], 1)
        points = numpy.concatenate([at, numpy.full((len(at), 1), -2.0)], 1)
        points[:, :2] -= way[:, :2] / way[:, 2:] * 2
        hit = scene.run(points.astype("f4"), way.astype("f4"), output=True)
        light = (transmitted(numpy.zeros(len(at)), 1, n))[None] * COLOURS[:, which]
        all_light += COLOURS[1, which].sum()
        good = (hit["primID"] >= 0) & (hit["primID"] < 2 * len(quads))
        slope = slopes[numpy.where(good, hit["primID"] // 2, 0)]
        normal = numpy.concatenate([-slope, numpy.ones((len(at), 1))], 1)
        normal /= numpy.linalg.norm(normal, axis=1)[:, None]
        cosine = (way * normal).sum(1)
        under = 1 - n ** 2 * (1 - cosine ** 2)
        good &= under > 0
        points += numpy.where(good, hit["tfar"], 0)[:, None] * way
        out = n[:, None] * way + (numpy.sqrt(numpy.maximum(under, 0)) - n * cosine)[:, None] * normal
        light *= transmitted(numpy.arccos(numpy.where(good, cosine, 1)), n, 1)[None]
        good &= scene.run((points + 1e-4 * normal).astype("f4"), out.astype("f4"), output=True)["primID"] < 0
        stopped += COLOURS[1, which][~good].sum()
        landing = points[:, :2] + out[:, :2] / out[:, 2:] * (distance - points[:, 2:])
        cell = numpy.floor(landing + CELLS / 2).astype(int)
        good &= numpy.all((cell >= 0) & (cell < CELLS), 1)
        for c in range(3):
            frame[c] += numpy.bincount(cell[good, 1] * CELLS + cell[good, 0], light[c, good], CELLS * CELLS)
    return frame.reshape(3, CELLS, CELLS) * count ** 2 / all_light, stopped / all_light
