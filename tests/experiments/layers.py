# SPDX-License-Identifier: Apache-2.0
"""Layers of image.exr as arrays of numpy, and arrays as PNG. The one library that is asked for is numpy; ImageMagick
writes the PNG."""
import struct
import subprocess
import zlib

import numpy as np

ZIP, LINES_OF_A_BLOCK = 3, 16
SAMPLES = {1: np.dtype("<f2"), 2: np.dtype("<f4")}


def header_of(data):
    """The attributes of the header as bytes by name, and where what follows it begins."""
    attributes, at = {}, 8
    while data[at]:
        name, kind, rest = data[at:at + 512].split(b"\0", 2)
        at += len(name) + len(kind) + 2
        size = struct.unpack_from("<i", data, at)[0]
        attributes[name.decode()] = data[at + 4:at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def channels_of(text):
    """Names and types of channels, as they follow each other in a line."""
    found, at = [], 0
    while text[at]:
        end = text.index(b"\0", at)
        found.append((text[at:end].decode(), SAMPLES[struct.unpack_from("<i", text, end + 1)[0]]))
        at = end + 17
    return found


def unzip(block, size):
    """Undoes OpenEXR's ZIP: deflate, then differences, of even bytes and then odd ones. A block that would grow is
    stored as it is."""
    if len(block) == size:
        return block
    steps = np.frombuffer(zlib.decompress(block), np.uint8).astype(np.int64)
    steps[1:] -= 128
    parts = np.cumsum(steps).astype(np.uint8)
    whole, half = np.empty(size, np.uint8), (size + 1) // 2
    whole[0::2], whole[1::2] = parts[:half], parts[half:]
    return whole.tobytes()


def read_layer(path, layer):
    """Height x width x 3, linear sRGB, of a picture that Nephroid wrote: lines from above, ZIP."""
    data = path.read_bytes()
    header, at = header_of(data)
    if header["compression"][0] != ZIP:
        raise ValueError(f"{path}: is not ZIP-compressed; expected an image.exr of a run")
    left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    channels = channels_of(header["channels"])
    picture = np.empty((height, width, 3))
    blocks = -(-height // LINES_OF_A_BLOCK)
    for offset in struct.unpack_from(f"<{blocks}Q", data, at):
        y, size = struct.unpack_from("<2i", data, offset)
        lines = min(LINES_OF_A_BLOCK, bottom - y + 1)
        raw = unzip(data[offset + 8:offset + 8 + size], lines * width * sum(sample.itemsize for _, sample in channels))
        place = 0
        for line in range(y - top, y - top + lines):
            for name, sample in channels:
                if name[:-2] == layer and name[-1] in "RGB":
                    picture[line, :, "RGB".index(name[-1])] = np.frombuffer(raw, sample, width, place)
                place += width * sample.itemsize
    return picture


def write_png(path, picture):
    """Linear sRGB; 1 is white."""
    linear = np.clip(picture, 0, 1)
    encoded = np.where(linear <= .0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - .055)
    ppm = b"P6 %d %d 255\n" % (picture.shape[1], picture.shape[0]) + np.round(255 * encoded).astype(np.uint8).tobytes()
    subprocess.run(["convert", "ppm:-", str(path)], input=ppm, check=True)


def write_pfm(path, picture):
    """Linear, without loss. A PFM's lines go up."""
    path.write_bytes(b"PF\n%d %d\n-1.0\n" % (picture.shape[1], picture.shape[0])
                     + picture[::-1].astype("<f4").tobytes())


def read_mask(path):
    """Height x width, where a PNG is white."""
    done = subprocess.run(["convert", str(path), "-depth", "8", "rgb:-"], capture_output=True, check=True)
    size = subprocess.run(["identify", "-format", "%w %h", str(path)], capture_output=True, check=True,
                          text=True).stdout
    width, height = map(int, size.split())
    return np.frombuffer(done.stdout, np.uint8).reshape(height, width, 3)[..., 0] > 127


def side_by_side(files, columns, size, target):
    """One PNG of many, each `size` pixels wide and high."""
    names = map(str, files)
    subprocess.run(["montage", *names, "-tile", f"{columns}x", "-geometry", f"{size}x{size}+1+1", "-background",
                    "black", "-depth", "8", str(target)], check=True)


def lab(picture):
    """CIELAB under D65 of linear sRGB, as `nephroid compare` has it."""
    to_xyz = np.array([[.4124564, .3575761, .1804375], [.2126729, .7151522, .0721750], [.0193339, .1191920, .9503041]])
    ratio = picture @ (to_xyz / to_xyz.sum(axis=1, keepdims=True)).T
    f = np.where(ratio > (6 / 29) ** 3, np.cbrt(ratio), ratio * (29 / 6) ** 2 / 3 + 4 / 29)
    return np.stack([116 * f[..., 1] - 16, 500 * (f[..., 0] - f[..., 1]), 200 * (f[..., 1] - f[..., 2])], axis=-1)
