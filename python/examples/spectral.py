# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # How fine must clusters of wavelengths be?
# A prism of dense flint glass spreads a beam of white light. Wavelengths that the glass bends nearly alike share a
# path. Here the threshold of that likeness varies, and each picture is held against one of 401 single wavelengths.

# %%
import matplotlib.pyplot as plt
import numpy as np
from numpy.typing import NDArray

import nephroid

nm = nephroid.wavelengths_nm()
glass = nephroid.dispersion("N-SF11")
thresholds = [2.0, 0.5, 0.1]
made = {t: nephroid.clusters(glass, t) for t in thresholds}

# %% The curve, and what each threshold makes of it.
figure, axes = plt.subplots(1, 2, figsize=(9, 3.2), constrained_layout=True)
axes[0].plot(nm, glass.n(nm), "k")
axes[0].set(xlabel="wavelength (nm)", ylabel="n", title="N-SF11")
for row, t in enumerate(thresholds):
    for number, cluster in enumerate(made[t].clusters):
        axes[1].plot(cluster.wavelengths_nm, np.full(len(cluster.wavelengths_nm), row), ".", color=f"C{number % 10}")
axes[1].set(xlabel="wavelength (nm)", yticks=range(len(thresholds)),
            yticklabels=[f"{t}°: {len(made[t].clusters)}" for t in thresholds],
            title="clusters by threshold")
figure.savefig("spectral-clusters.png", dpi=110)

# %% One run for each, of the same number of photons. The caustic alone is compared.
scene = nephroid.Preset("spectral/prism", {"scene.camera.resolution": [160, 120], "stop": {"passes": 12}})


def caustic(preset: nephroid.Preset) -> NDArray[np.float32]:
    with nephroid.run(preset) as run:
        return run.layers()["caustic"]


reference = caustic(scene.with_values({"spectral.method": "brute_force", "spectral.step_nm": 1}))
# By default each path has a wavelength of its own, drawn from its cluster, so that no threshold is wrong. In the
# thesis, as here, one stands for all.
pictures = {t: caustic(scene.with_values({"spectral.threshold_deg": t, "spectral.jitter": False})) for t in thresholds}

# %% Errors: of the picture's light, in the mean square.
figure, axes = plt.subplots(1, len(thresholds) + 1, figsize=(12, 2.8), constrained_layout=True)
for axis, (title, picture) in zip(axes, [("401 wavelengths", reference)] + [
        (f"{t}°: rel_l2 {nephroid.compare(pictures[t], reference)['rel_l2']:.3f}", pictures[t]) for t in thresholds]):
    axis.imshow(np.clip(picture / np.percentile(reference, 99.7), 0, 1) ** (1 / 2.2))
    axis.set(title=title, xticks=[], yticks=[])
figure.savefig("spectral-pictures.png", dpi=110)
