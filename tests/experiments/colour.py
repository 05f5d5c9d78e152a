#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Bounds how near to a picture in colours a clear object can come whose only colours are those of its dispersion.

    tests/experiments/colour.py [PICTURE...] [--fans CELLS...] [--bend DEGREES] [--facets] [--ways] [--out FOLDER]

Sunlight meets the flat front of a block of N-SF66, facets of its other side bend it. A facet's light lands as a short
rainbow, a fan, along its bend. How much light lands where, with which fan, is free: the least squares over that bound
every arrangement of facets. --facets finds the slopes of a real object and traces it by Embree. --ways compares suns,
bends and fans. docs/notebook/colour.md has the model and what came out. Needs numpy, scipy, pillow and embreex.
"""
import argparse
import csv
import math
import time
from pathlib import Path

import numpy
from PIL import Image, ImageDraw, ImageFont
from scipy.fft import irfft2, next_fast_len, rfft2
from scipy.optimize import brentq, minimize

ROOT = Path(__file__).resolve().parents[2]
CELLS = 32
SUN = 0.0093  # the disc's angle in radians
NM = numpy.arange(380, 781)
BLUE, GREEN, RED = 430, 550, 650  # a fan is as long as from BLUE to RED; it lies where its GREEN lands
PICTURES = ["disc", "letters-on-white", "pastel-letters", "letters-on-black", "sunset", "rainbow"]


def table(name, column):
    """A column of one of the program's tables, at NM."""
    with (ROOT / "app/optics/data" / name).open() as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return numpy.interp(NM, [float(row["wavelength_nm"]) for row in rows], [float(row[column]) for row in rows])


def index(nm):
    """n of N-SF66 by its Sellmeier coefficients."""
    text = (ROOT / "presets/materials/N-SF66.yml").read_text().split("coefficients:")[1].split("\n")[0]
    first, *rest = map(float, text.split())
    square = (numpy.asarray(nm) / 1000.0) ** 2
    return numpy.sqrt(1 + first + sum(b * square / (square - c) for b, c in zip(rest[::2], rest[1::2])))


MATCHING = numpy.stack([table("cie-1931-2deg-1nm.csv", c) for c in ("xbar", "ybar", "zbar")])
COLOURS = MATCHING * table("illuminants.csv", "D65")  # X, Y, Z a wavelength; each sums to 1: white is 1, 1, 1
WHITE = COLOURS.sum(1) / COLOURS[1].sum()
COLOURS /= COLOURS.sum(1)[:, None]
TO_SRGB = numpy.array([[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560],
                       [0.0556434, -0.2040259, 1.0572252]])
FROM_SRGB = numpy.linalg.inv(TO_SRGB)
FROM_SRGB /= FROM_SRGB.sum(1)[:, None]  # to X, Y, Z over those of white


def tilt(bend):
    """The facet's tilt that bends GREEN by this angle: n sin a = sin(a + bend)."""
    return math.atan2(math.sin(bend), float(index(GREEN)) - math.cos(bend))


def bends(bend, nm=NM):
    a = tilt(bend)
    return numpy.arcsin(index(nm) * math.sin(a)) - a


def fan(bend):
    """The fan's length on a receiver at distance 1."""
    blue, red = numpy.tan(bends(bend, numpy.array([BLUE, RED])))
    return blue - red


def lab(xyz):
    """CIELAB [3][...] and its derivative, of X, Y, Z over white's."""
    edge = 6 / 29
    xyz = numpy.maximum(xyz, 0)
    low = xyz < edge ** 3
    f = numpy.where(low, xyz / (3 * edge ** 2) + 4 / 29, numpy.cbrt(xyz))
    slope = numpy.where(low, 1 / (3 * edge ** 2), 1 / (3 * numpy.maximum(f, edge) ** 2))
    return numpy.stack([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])]), slope


class Spots:
    """What each kind of light does where it lands: [kind][3][cell]; kinds are fans, or coloured spots without one."""

    def __init__(self, length, limit, directions=12, lengths=4, sun=SUN, kinds="all"):
        """length: that of the longest fan, in cells, at the bend `limit` in degrees."""
        longest = math.radians(limit)
        self.distance = length / fan(longest)
        around = [2 * math.pi * k / directions for k in range(directions)]
        sizes = [(k + 1) / lengths for k in range(lengths)]
        offsets = [self.offsets(0, 0, sun)]
        self.lands = [(0.0, 0.0)]  # beside the place that each kind leaves
        if kinds == "all":
            for size in sizes:
                bend = brentq(lambda b, part=size: fan(b) - part * fan(longest), 1e-4, longest + 1e-9)
                offsets += [self.offsets(bend, turn, sun) for turn in around]
                throw = self.distance * math.tan(bend)
                self.lands += [(throw * math.cos(turn), throw * math.sin(turn)) for turn in around]
        elif kinds == "one":
            offsets = [self.offsets(longest, 0, sun)]
        reach = max(int(numpy.ceil(numpy.abs(o).max() + 0.5)) for o in offsets)
        self.size = next_fast_len(CELLS + 2 * reach, real=True)
        self.reach = reach
        images = [self.image(o) for o in offsets]
        if kinds == "any":  # lamps of sRGB's primaries behind the same blur
            images = [images[0] * FROM_SRGB[:, [c], None] for c in range(3)]
        self.spectra = rfft2(numpy.array(images))

    def offsets(self, bend, turn, sun):
        """Where light lands beside its GREEN, in cells: [wavelength][place of the sun's disc][axis]."""
        a, out = tilt(bend), tilt(bend) + bend
        along = self.distance * (numpy.tan(bends(bend)) - math.tan(bend))
        k = numpy.arange(300) + 0.5
        radius, angle = numpy.sqrt(k / 300) * sun / 2 * self.distance, k * math.pi * (3 - math.sqrt(5))
        x = radius * numpy.cos(angle) * math.cos(a) / math.cos(out) / math.cos(bend) ** 2
        y = radius * numpy.sin(angle) / math.cos(bend)
        x = along[:, None] + x[None]
        y = numpy.broadcast_to(y, x.shape)
        return numpy.stack([x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)], -1)

    def image(self, offsets):
        cell = numpy.rint(offsets).astype(int) % self.size
        at = (cell[..., 1] * self.size + cell[..., 0]).ravel()
        weights = numpy.repeat(COLOURS / offsets.shape[1], offsets.shape[1], axis=1)
        return numpy.array([numpy.bincount(at, w, self.size ** 2) for w in weights]).reshape(3, self.size, self.size)

    def from_within(self, side):
        """Whether light [kind][cell] leaves an object that is so many cells wide, behind the frame's middle."""
        at = numpy.arange(self.size) + 0.5 - self.size / 2
        x, y = numpy.meshgrid(at, at)
        return numpy.array([(abs(x - dx) < side / 2) & (abs(y - dy) < side / 2) for dx, dy in self.lands])

    def cast(self, light):
        """X, Y, Z of the frame from light [kind][cell], whose middle is the frame."""
        sums = numpy.einsum("kcyx,kyx->cyx", self.spectra, rfft2(light))
        return irfft2(sums, s=(self.size, self.size))[:, self.reach:self.reach + CELLS, self.reach:self.reach + CELLS]

    def gathered(self, frame):
        """The adjoint of cast."""
        whole = numpy.zeros((3, self.size, self.size))
        whole[:, self.reach:self.reach + CELLS, self.reach:self.reach + CELLS] = frame
        return irfft2(numpy.einsum("kcyx,cyx->kyx", self.spectra.conj(), rfft2(whole)), s=(self.size, self.size))


def letters(words):
    """A mask a letter, side by side: [(CELLS x CELLS)], eight samples a cell and axis."""
    font = ImageFont.load_default(size=13 * 8)
    masks = []
    for k, word in enumerate(words):
        picture = Image.new("L", (CELLS * 8, CELLS * 8))
        ImageDraw.Draw(picture).text(((6 + 10 * k) * 8, CELLS * 4), word, fill=255, font=font, anchor="mm",
                                     stroke_width=4)
        masks.append(numpy.asarray(picture.resize((CELLS, CELLS), Image.BOX), float) / 255)
    return masks


def wanted(name):
    """A picture in linear sRGB: [3][CELLS][CELLS]."""
    fine = (numpy.arange(CELLS * 8) + 0.5) / 8
    x, y = numpy.meshgrid(fine, fine)

    def on(inside, colour, ground):
        inside = inside.reshape(CELLS, 8, CELLS, 8).mean((1, 3))
        return inside * numpy.reshape(colour, (3, 1, 1)) + (1 - inside) * ground

    radius = numpy.hypot(x - CELLS / 2, y - CELLS / 2)
    if name == "disc":
        return on((radius < 10).astype(float), [1, 1, 1], numpy.zeros((3, CELLS, CELLS)))
    if name == "sunset":
        stops = numpy.array([[0.10, 0.12, 0.45], [0.40, 0.18, 0.50], [0.85, 0.30, 0.25], [1.0, 0.55, 0.12]])
        sky = numpy.stack([numpy.interp(numpy.arange(CELLS) + 0.5, numpy.linspace(0, CELLS, 4), stops[:, c])
                           for c in range(3)])[:, :, None] ** 1.6 * numpy.ones((1, 1, CELLS))
        return on((numpy.hypot(x - 20, y - 22) < 5).astype(float), [1, 0.85, 0.45], sky)
    if name == "rainbow":  # the hues from red to blue, no purple
        hue = numpy.clip((x - 4) / 24, 0, 1) * 240
        band = numpy.stack([numpy.clip(2 - abs(hue - peak) / 60, 0, 1) for peak in (0, 120, 240)])
        return (band * ((abs(x - 16) < 12) & (abs(y - 16) < 6))).reshape(3, CELLS, 8, CELLS, 8).mean((2, 4))
    ground = 0.0 if name == "letters-on-black" else 1.0
    picture = numpy.full((3, CELLS, CELLS), ground)
    part = 0.25 if name == "pastel-letters" else 1.0
    for mask, colour in zip(letters("RGB"), numpy.eye(3)):
        picture = mask * (1 - part + part * colour)[:, None, None] + (1 - mask) * picture
    return picture


def differences(seen, target):
    return numpy.sqrt(((lab(seen)[0] - lab(target)[0]) ** 2).sum(0))


def perceived(seen, target):
    """The mean Delta E (CIE 1976), rounded below .5 so that it has a derivative, and that derivative."""
    colours, slope = lab(seen)
    way = colours - lab(target)[0]
    length = numpy.sqrt((way ** 2).sum(0) + 0.25)
    way /= length * CELLS ** 2
    by_f = numpy.stack([500 * way[1], 116 * way[0] - 500 * way[1] + 200 * way[2], -200 * way[2]])
    return length.mean(), by_f * slope


def squares(seen, target):
    miss = seen - target
    return 0.5 * (miss ** 2).sum(), miss


def descend(function, start, steps, bounds=None):
    return minimize(function, start, jac=True, method="L-BFGS-B", bounds=bounds,
                    options={"maxiter": steps, "maxfun": 2 * steps, "maxcor": 20, "ftol": 1e-9, "gtol": 1e-9}).x


def solve(spots, target, steps, allowed=None, tiny=1e-6):
    """The light [kind][cell] by least squares in X, Y, Z, from there by the mean Delta E; the root of the mean square
    of the first, and the least that no light can come below of ten times the picture's or less."""
    shape = (len(spots.spectra), spots.size, spots.size)
    most = numpy.full(shape, numpy.inf) if allowed is None else numpy.where(allowed, numpy.inf, 0.0)
    bounds = numpy.stack([numpy.zeros(most.size), most.ravel()], 1)

    def by(measure):
        def function(flat):
            value, slope = measure(spots.cast(flat.reshape(shape)), target)
            return value + tiny * flat.sum(), (spots.gathered(slope) + tiny).ravel()
        return function

    start = numpy.where(most > 0, 0.002, 0.0)
    frame = slice(spots.reach, spots.reach + CELLS)
    start[0, frame, frame] += numpy.where(most[0, frame, frame] > 0, target.min(0), 0)
    first = descend(by(squares), start.ravel(), steps, bounds)
    value, slope = squares(spots.cast(first.reshape(shape)), target)
    slope = spots.gathered(slope).ravel()  # the sum is convex: it is above its tangent plane
    proved = value - slope @ first - 10 * target[1].sum() * max(0, -slope[most.ravel() > 0].min())
    second = descend(by(perceived), first, steps, bounds)
    rms = numpy.sqrt(2 * numpy.array([value, max(0, proved)]) / target.size)
    return first.reshape(shape), second.reshape(shape), rms


def encoded(xyz):
    """sRGB bytes."""
    linear = numpy.clip(numpy.tensordot(numpy.linalg.inv(FROM_SRGB), xyz, 1), 0, 1)
    curve = numpy.where(linear < 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return numpy.uint8(255 * curve + 0.5).transpose(1, 2, 0)


def exposed(seen, target):
    """The picture at the exposure that is nearest to what is wanted."""
    scale = (seen * target).sum() / (seen ** 2).sum()
    best = minimize(lambda e: differences(seen * scale * math.exp(e[0]), target).mean(), [0.0], method="Nelder-Mead")
    return seen * scale * math.exp(best.x[0]), scale * math.exp(best.x[0])


def row(name, what, seen, target, inside, squared=""):
    delta = differences(seen, target)
    colours = lab(target)[0]
    coloured = numpy.hypot(colours[1], colours[2]) > 20
    part = f"{delta[coloured].mean():6.1f}" if coloured.any() else "     -"
    print(f"{name:17} {what:34} {delta.mean():6.2f} {part} {numpy.percentile(delta, 95):6.1f} {1 - inside:6.2f}",
          squared, flush=True)


def closed_forms(limit):
    """What the model must give where the answer is known."""
    print("bend, tilt, bend of 430 nm less that of 650 nm, the same in discs of the sun: degrees")
    for bend in (10, 20, 25, 30, 35):
        a = tilt(math.radians(bend))
        parted = numpy.diff(bends(math.radians(bend), [RED, BLUE]))[0]
        spread = float(numpy.diff(index([RED, BLUE]))[0])
        print(f"{bend:4} {math.degrees(a):6.2f} {math.degrees(parted):6.3f} {spread * math.tan(a) / SUN:6.2f}")
    spots = Spots(8, limit, 4, 1, sun=0)
    light = numpy.zeros((len(spots.spectra), spots.size, spots.size))
    light[1, :, :spots.reach + CELLS // 2] = 1  # a half-plane of the fan along x
    seen = spots.cast(light)[:, CELLS // 2]
    along = spots.distance * (numpy.tan(bends(math.radians(limit))) - math.tan(math.radians(limit)))
    edge = numpy.array([COLOURS[:, numpy.rint(along) + CELLS // 2 - 1 >= k].sum(1) for k in range(CELLS)]).T
    print(f"a half-plane's coloured edge differs from sums over wavelengths by {abs(seen - edge).max():.1e}")
    turns = numpy.linspace(0, 1, 201)  # fans a period
    place = (numpy.tan(bends(math.radians(limit))) - math.tan(math.radians(limit))) / fan(math.radians(limit))
    x, y, z = COLOURS @ numpy.exp(-2j * math.pi * numpy.outer(place, turns))
    for fans in (16, 8, 4, 2, 1):
        near = turns <= 1 / fans
        print(f"a grating of {fans:2} fans: |X - Y| at most {abs(x - y)[near].max():.3f} of the mean light, |Z - Y| "
              f"{abs(z - y)[near].max():.3f}")
    colour = numpy.array([0.6, 0.4, 0.1])
    target = numpy.broadcast_to(colour[:, None, None], (3, CELLS, CELLS))
    known = math.sqrt((colour ** 2).mean() - colour.mean() ** 2)
    for length in (0.5, 2, 8):
        spots = Spots(length, limit, 8, 2)
        miss = (spots.cast(solve(spots, target, 100)[0]) - target)[:, 12:20, 12:20]
        print(f"an even orange, fan {length:3}: rms {math.sqrt((miss ** 2).mean()):.4f} in the middle; without edges "
              f"{known:.4f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pictures", nargs="*", metavar="PICTURE", help=", ".join(PICTURES))
    parser.add_argument("--fans", type=float, nargs="+", default=[1, 2, 4, 8, 16])
    parser.add_argument("--bend", type=float, default=35)
    parser.add_argument("--steps", type=int, default=200, help="of each descent")
    parser.add_argument("--facets", action="store_true")
    parser.add_argument("--ways", action="store_true")
    parser.add_argument("--out", type=Path, default=Path("out/colour"))
    args = parser.parse_args()
    if unknown := set(args.pictures) - set(PICTURES):
        parser.error(f"no picture {', '.join(sorted(unknown))}; choose from {', '.join(PICTURES)}")
    if not 5 <= args.bend <= 38 or min(args.fans) < 0.25 or max(args.fans) > 32:
        parser.error("--bend is 5 to 38 degrees, beyond which violet does not leave the glass; --fans .25 to 32 cells")
    args.out.mkdir(parents=True, exist_ok=True)
    closed_forms(args.bend)
    print("picture, light: mean Delta E, that of coloured cells, 95 % of cells below; part outside the frame; rms by "
          "least squares, proved")
    rows, began = [], time.time()
    for name in args.pictures or PICTURES:
        target = numpy.tensordot(FROM_SRGB, wanted(name), 1)
        shown = [target]

        def bound(what, spots, allowed=None):
            _, light, rms = solve(spots, target, args.steps, allowed)
            seen = spots.cast(light)
            row(name, what, seen, target, seen[1].sum() / light.sum(), f"{rms[0]:7.4f} {rms[1]:7.4f}")
            return light, seen

        bound("white light", Spots(1, args.bend, kinds="white"))
        if args.ways:
            for what, options in (("fan 8, a point for a sun", {"sun": 0}), ("fan 8, one fan alone", {"kinds": "one"}),
                                  ("fan 8, 16 directions, 4 lengths", {"directions": 16, "lengths": 4})):
                bound(what, Spots(8, args.bend, **({"directions": 8, "lengths": 2} | options)))
            bound("fan 8, a bend of 25", Spots(8, 25, 8, 2))
            spots = Spots(8, args.bend, 8, 2)
            for side in (32, 64, 128):
                bound(f"fan 8, an object of {side}", spots, spots.from_within(side))
        elif args.facets:
            from colour_facets import Facets, traced
            for length in args.fans:
                spots = Spots(length, args.bend, 16, 4)
                light, seen = bound(f"fan {length:g}, bound", spots, spots.from_within(Facets.COUNT))
                facets = Facets(spots, args.bend)
                slopes, each = facets.improved(*facets.drawn(light, spots, 16, 4, args.bend), target, 200)
                believed = facets.cast(slopes, each)
                row(name, f"fan {length:g}, facets", believed, target, believed[1].sum() / each / len(slopes))
                rays, stopped = traced(slopes, spots.distance)
                judged, scale = exposed(rays, target)
                row(name, f"fan {length:g}, traced", judged, target, rays[1].sum() / len(slopes))
                print(f"    walls stop {stopped:.3f}; white is {1 / scale:.2f} of the sunlight")
                numpy.save(args.out / f"{name}-{length:g}.npy", slopes)
                shown += [seen, believed, judged]
        else:
            shown += [bound(f"fan {length:g}", Spots(length, args.bend, 8, 2))[1] for length in args.fans]
        rows.append(numpy.concatenate([numpy.pad(encoded(s), ((1, 1), (1, 1), (0, 0)), constant_values=128)
                                       for s in shown], 1))
    sheet = Image.fromarray(numpy.concatenate(rows))
    sheet.resize((sheet.width * 4, sheet.height * 4), Image.NEAREST).save(args.out / "sheet.png", optimize=True)
    print(f"{time.time() - began:.0f} s")


if __name__ == "__main__":
    main()
