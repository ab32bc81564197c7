#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# %% [markdown]
# # A cloth's contacts, and what a tree costs that is rebuilt or refitted
# A cloth falls over a ball, frame by frame. The tree is built over the first frame, then either rebuilt or refitted. A cell is what lies
# between two `# %%`, as editors of notebooks read it. The plot is written where the first argument says, or to cloth.png.
import sys
import time

import matplotlib
import numpy as np

import bvhbench

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

# %% The cloth: a sheet of 2 * (SIDE - 1)^2 triangles, which wraps round a ball and folds onto itself.
SIDE, FRAMES = 120, 12
u, v = np.meshgrid(*2 * [np.linspace(-1, 1, SIDE)], indexing="ij")
corner = np.arange(SIDE * SIDE).reshape(SIDE, SIDE)
a, b, c, d = corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]
cloth = np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)


def frame(k: int) -> np.ndarray:
    """Returns the points of frame k, from 0."""
    fallen, far = (k + 1) / FRAMES, np.hypot(u, v)
    fold = 0.12 * fallen * np.sin(24 * u + 3 * v)
    return np.stack([u + fold, v * (1 - 0.5 * fallen), np.sqrt(np.clip(0.25 - far**2, 0, None)) * fallen - fallen * far], axis=-1).reshape(-1, 3)


# %% A tree of each kind. `adjacent=False` leaves neighbours in the cloth out, which always touch.
rebuilt, refitted = (bvhbench.Tree(frame(0), cloth, adjacent=False) for _ in range(2))

# %% All frames, four times, since the first pass compiles kernels and others are disturbed: the least time of each counts. The contacts are
# the same whichever tree finds them.
times = np.empty((4, FRAMES, 2, 2))
contacts = np.empty((FRAMES, 2), int)
for run, k in np.ndindex(4, FRAMES):
    points = frame(k).astype(np.float32)
    for which, (renew, tree) in enumerate(((rebuilt.update, rebuilt), (refitted.refit, refitted))):
        began = time.perf_counter()
        renew(points)
        renewed = time.perf_counter()
        contacts[k, which] = len(tree.contacts())
        times[run, k, which] = 1e3 * (renewed - began), 1e3 * (time.perf_counter() - renewed)
    assert contacts[k, 0] == contacts[k, 1]
tree_ms, contacts_ms = np.moveaxis(times.min(axis=0), -1, 0)

# %% The plot
figure, (above, below) = pyplot.subplots(2, sharex=True, figsize=(7, 6), layout="constrained")
for which, name in enumerate(("rebuilt", "refitted")):
    above.plot(tree_ms[:, which], "o-", color=f"C{which}", label=f"{name}: the tree")
    above.plot(contacts_ms[:, which], "s--", color=f"C{which}", label=f"{name}: its contacts")
above.set(ylabel="ms", ylim=(0, None))
above.set_title(f"{len(cloth):,} triangles, {bvhbench.devices()[0]}", fontsize=9)
above.legend()
below.plot(contacts[:, 0], "o-", color="C2")
below.set(xlabel="frame", ylabel="contacts", ylim=(0, None))
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "cloth.png", dpi=120)
