# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # One piece of acrylic, three pictures
# The inverse engine designs an object whose facets cast a ring, a cross and a disc at three distances. We watch the
# search, look at what its mesh really casts, and save the mesh.

# %%
import matplotlib.pyplot as plt
import numpy as np

import nephroid

preset = nephroid.Preset("inverse/shapes")
with nephroid.start(preset) as run:
    for _ in run.watch(0.5):
        print(f"{run.passes} sweeps, {100 * run.progress:.0f} %")
    pictures, cost, figures = run.pictures(), run.curves()["cost"], run.figures()
    run.save("shapes")  # with object.stl, object.obj, print_1.svg, ...

# %% What was wanted, what falls there by rays through the finished mesh, and how the search went.
figure, axes = plt.subplots(2, 4, figsize=(11, 5.4), constrained_layout=True)
for row, kind in enumerate(("target", "receiver")):
    for column in range(3):
        axes[row, column].imshow(np.clip(pictures[f"{kind}_{column + 1}"], 0, 1) ** (1 / 2.2))
        axes[row, column].set(xticks=[], yticks=[], title=f"{kind} {column + 1}")
axes[0, 3].plot(cost["seconds"], cost["rel_l2"], "o-")
axes[0, 3].set(xlabel="seconds", ylabel="rel_l2, believed")
axes[1, 3].imshow(np.clip(pictures["slopes"], 0, 1))
axes[1, 3].set(title="facets' slopes", xticks=[], yticks=[])
figure.savefig("inverse-pictures.png", dpi=110)
