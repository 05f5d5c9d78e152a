#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes presets/textures/oak.png, a board that repeats: yearly rings seen from the side, fibres, pores. Needs numpy."""
import pathlib
import struct
import zlib

import numpy as np

SIZE = 384
DARK, LIGHT = np.array([96, 58, 30.0]), np.array([190, 138, 86.0])  # sRGB, 0 to 255


def noise(random, across, along):
    """Smooth and periodic, from -1 to 1: so many waves at most in each direction."""
    spectrum = np.zeros((SIZE, SIZE), complex)
    waves = random.normal(size=(along, across)) + 1j * random.normal(size=(along, across))
    spectrum[:along, :across] = waves
    field = np.fft.ifft2(spectrum).real
    return field / np.abs(field).max()


def main():
    random = np.random.default_rng(7)
    v, u = np.mgrid[0:SIZE, 0:SIZE] / SIZE
    rings = 9 * u + 0.5 * noise(random, 3, 3) + 0.12 * noise(random, 12, 4)
    ring = rings % 1
    late = np.where(ring < 0.8, (ring / 0.8) ** 3, (1 - ring) / 0.2)  # wood of summer is darker, and ends sharply
    fibres = 0.5 * noise(random, 160, 4) + 0.5 * noise(random, 90, 12)
    pores = np.clip(noise(random, 150, 20) - 0.45, 0, 1) * 2
    light = np.clip(0.85 - 0.55 * late + 0.35 * fibres - pores, 0, 1)[..., None]
    pixels = np.round(DARK + (LIGHT - DARK) * light).astype(np.uint8)
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    file = pathlib.Path(__file__).resolve().parents[2] / "presets" / "textures" / "oak.png"
    file.parent.mkdir(exist_ok=True)
    header = struct.pack(">IIBBBBB", SIZE, SIZE, 8, 2, 0, 0, 0)
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9))
                     + chunk(b"IEND", b""))


if __name__ == "__main__":
    main()
