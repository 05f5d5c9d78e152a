#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures what films and coats of spectral/coatings reflect at 30 degrees, wavelength by wavelength, and holds it
against Airy's formula. Prints the largest difference; draws coatings.png. Needs numpy and matplotlib.

    tests/experiments/coatings.py PROGRAM FOLDER [PHOTONS]

Each run is a pencil of light of one wavelength onto a block. What comes back to a plane, over what was sent, is the
reflectance. PHOTONS of them leave its noise, sqrt(R (1 - R) / PHOTONS). Light from the block's other sides misses the
plane.
"""
import json
import subprocess
import sys
from pathlib import Path

import numpy as np

ANGLE_DEG, PHOTONS = 30, 1 << 19
WAVELENGTHS_NM = np.arange(380, 781, 10)
# Of each: index of the body, and of the layer with its thickness in nm.
SURFACES = {
    "soap film of 500 nm": (1, 1.33, 500),
    "soap film of 200 nm": (1, 1.33, 200),
    "glass of n = 1.8": (1.8, None, 0),
    "the same with a coat": (1.8, 1.38, 100),
}


def airy(body, layer, thickness_nm, wavelength_nm):
    """The mean reflectance of both polarisations (Born and Wolf, Principles of Optics, 7.6)."""
    indices = [1, layer, body] if layer else [1, body]
    cosines = [np.sqrt(1 - (np.sin(np.radians(ANGLE_DEG)) / n) ** 2) for n in indices]
    total = 0
    for across in (True, False):
        admittances = [n * c if across else n / c for n, c in zip(indices, cosines)]
        faces = [(a - b) / (a + b) for a, b in zip(admittances, admittances[1:])]
        if layer:
            turn = np.exp(4j * np.pi * layer * thickness_nm * cosines[1] / wavelength_nm)
            faces = [(faces[0] + faces[1] * turn) / (1 + faces[0] * faces[1] * turn)]
        total = total + np.abs(faces[0] * np.ones(np.shape(wavelength_nm))) ** 2 / 2
    return total


def preset(photons):
    way = np.array([np.sin(np.radians(ANGLE_DEG)), np.cos(np.radians(ANGLE_DEG))])
    x, y = 10 * way
    materials = {"receiver": {"type": "diffuse"}}
    for name, (body, layer, thickness_nm) in SURFACES.items():
        materials[name] = {"type": "dielectric", "dispersion": body}
        if layer:
            materials[name]["coating"] = {"dispersion": layer, "thickness_nm": thickness_nm}
    return {
        "engine": "spectral",
        "scene": {
            "camera": {"position": [x, 1, 0], "target": [x, y, 0], "up": [0, 0, 1], "resolution": [8, 8]},
            "materials": materials,
            "objects": [
                {
                    "shape": {"type": "box", "size": [40, 40, 40]},
                    "material": "receiver",
                    "transform": {"translate": [0, -20, 0]},
                },
                {
                    "shape": {"type": "quad", "size": [4, 1, 4]},
                    "material": "receiver",
                    "transform": {"rotate_deg": [180, 0, 0], "translate": [x, y, 0]},
                },
            ],
            "lights": [{"type": "spot", "position": [-x, y, 0], "direction": [x, -y, 0], "half_angle_deg": 0.1}],
        },
        "spectral": {"photons_per_pass": photons, "direct": False},
        "stop": {"passes": 1},
        "sweep": {"scene.objects.0.material": list(SURFACES)},
    }


def reflected(program, folder, wavelength_nm):
    """Of each surface. Every wavelength has photons of its own."""
    runs = folder / f"{wavelength_nm}"
    spectrum = f'scene.lights.0.spectrum={{"type": "lines", "table": [[{wavelength_nm}, 1]]}}'
    subprocess.run([program, "run", folder / "film.json", "-o", runs, "--set", spectrum, "--set",
                    f"seed={wavelength_nm}"], check=True, capture_output=True)
    energies = [json.loads((runs / run / "run.json").read_text())["energy"]
                for run in json.loads((runs / "sweep.json").read_text())["runs"]]
    return [energy["deposited_w"] / energy["emitted_w"] for energy in energies]


def main(program, folder, photons):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "film.json").write_text(json.dumps(preset(photons)))
    measured = np.transpose([reflected(program, folder, nm) for nm in WAVELENGTHS_NM])
    differences, spreads = [], []
    for name, values in zip(SURFACES, measured):
        truth = airy(*SURFACES[name], WAVELENGTHS_NM)
        noise = np.sqrt(truth * (1 - truth) / photons)
        differences.append(np.abs(values - truth).max())
        spreads.append((values - truth) / noise)
        print(f"{name}: {truth.min():.4f} to {truth.max():.4f}; largest difference {differences[-1]:.5f}, "
              f"noise to {noise.max():.5f}")
    spread = np.concatenate(spreads)
    print(f"all: {max(differences):.5f}; in units of the noise {np.sqrt((spread ** 2).mean()):.2f} in the mean square, "
          f"{np.abs(spread).max():.2f} at most, of {spread.size}")
    draw(measured, folder / "coatings.png")


def draw(measured, file):
    import matplotlib
    matplotlib.use("agg")
    import matplotlib.pyplot as plt
    figure, axis = plt.subplots(figsize=(8.2, 3.2), constrained_layout=True)
    fine = np.linspace(380, 780, 801)
    for i, (name, surface) in enumerate(SURFACES.items()):
        axis.plot(fine, 100 * airy(*surface, fine), color=f"C{i}", linewidth=1)
        axis.plot(WAVELENGTHS_NM, 100 * measured[i], ".", color=f"C{i}", label=name)
    axis.set(xlabel="wavelength (nm)", ylabel="reflected (%)", xlim=(380, 780), ylim=(0, None))
    axis.legend(fontsize="small", loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
    figure.savefig(file, dpi=110)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], Path(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else PHOTONS)
