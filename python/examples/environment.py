# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # A sky as a few lights, and what they make of a glass ball
# The sky is made here, as an array. `segment` cuts it into directional lights. Then the environment engine shows a
# ball's caustics under the sky of a preset, and we watch the error fall.

# %%
import matplotlib.pyplot as plt
import numpy as np

import nephroid

# %% A sky: blue above, pale at the horizon, a low sun. Row 0 looks up; the middle column looks along -z.
height, width = 128, 256
up = np.cos((np.arange(height) + 0.5) / height * np.pi)[:, None, None]
sky = np.where(up > 0, (1 - up) * np.array([0.9, 0.8, 0.7]) + up * np.array([0.25, 0.4, 0.8]), 0.12).astype(np.float32)
sky = np.repeat(sky, width, axis=1)
sky[48:53, 60:65] = [900, 700, 400]

figure, axis = plt.subplots(figsize=(8, 4), constrained_layout=True)
axis.imshow(np.clip(sky, 0, 1) ** (1 / 2.2), extent=(-180, 180, -90, 90))
for lights, style in ((24, "wo"), (96, "r.")):
    made = nephroid.segment(sky, lights)
    x, y, z = made.directions.T
    axis.plot(np.degrees(np.arctan2(x, -z)), np.degrees(np.arcsin(y)), style, fillstyle="none",
              label=f"{len(made.directions)} lights")
axis.set(title=f"all lights together: {made.flux.sum(axis=0).round(1)}", xlabel="degrees to the right of -z",
         ylabel="degrees up")
axis.legend(loc="lower right")
figure.savefig("environment-lights.png", dpi=110)

# %% The ball on its table: a first picture at once, a better one while we watch.
preset = nephroid.Preset("environment/ball", {"scene.camera.resolution": [160, 120], "stop": {"passes": 48}})
with nephroid.start(preset) as run:
    first = run.picture()
    for _ in run.watch(0.5):
        print(f"{run.work_seconds:.1f} s, error {run.error}")
    last, history = run.picture(), run.history()

# %%
figure, axes = plt.subplots(1, 3, figsize=(12, 3), constrained_layout=True)
for axis, picture, title in ((axes[0], first, "the first picture"), (axes[1], last, "the last")):
    axis.imshow(np.clip(picture, 0, 1) ** (1 / 2.2))
    axis.set(title=title, xticks=[], yticks=[])
axes[2].plot(history["seconds"], history["estimated_lab_mean"], "o-")
axes[2].set(title="its own estimate of the error", xlabel="seconds of work", ylabel="CIELAB, mean", ylim=(0, None))
figure.savefig("environment-pictures.png", dpi=110)
