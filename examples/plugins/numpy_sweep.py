#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""A collider from outside: sweep and prune in NumPy, as a program that speaks bvhbench's protocol (docs/plugins.md).

    bvhbench --program examples/plugins/numpy_sweep.py collide --collider numpy-sweep,brute --scene torus:2000"""
import json
import sys
import time

import numpy

CANDIDATES = 1 << 22  # pairs that are compared at a time
METHOD = {"name": "numpy-sweep", "summary": "sweep and prune in NumPy, on a core of the host", "query": True, "pairs": True, "steps": True}


class Sweep:
    """Finds all pairs of triangles whose closed boxes overlap."""

    def prepare(self, request):
        self.faces = numpy.fromfile(request["faces"], numpy.uint32).reshape(-1, 3)
        self.first, self.drops_adjacent = request["first"], request["drops_adjacent"]

    def load(self, request):
        ends = [numpy.fromfile(request[key], numpy.float32).reshape(-1, 3) for key in ("points", "end_points") if key in request]
        self.points = numpy.stack(ends, axis=1)  # of a frame one each, of a step two

    def query(self, _request):
        begin = time.monotonic_ns()
        corners = self.points[self.faces]
        low, high = corners.min(axis=(1, 2)), corners.max(axis=(1, 2))
        order = numpy.argsort(low[:, 0], kind="stable")
        low, high = low[order], high[order]
        # The boxes that begin along x before box k ends follow it without a gap.
        first = numpy.arange(1, len(order) + 1)
        counts = numpy.searchsorted(low[:, 0], high[:, 0], side="right") - first
        found = [numpy.empty((0, 2), numpy.uint32)]
        for chunk in numpy.split(first - 1, numpy.flatnonzero(numpy.diff(numpy.cumsum(counts) // CANDIDATES)) + 1):
            a = numpy.repeat(chunk, counts[chunk])
            b = numpy.arange(len(a)) - numpy.repeat(numpy.cumsum(counts[chunk]) - counts[chunk], counts[chunk]) + a + 1
            meet = ((low[a, 1:] <= high[b, 1:]) & (low[b, 1:] <= high[a, 1:])).all(axis=1)
            pairs = numpy.sort(numpy.column_stack((order[a[meet]], order[b[meet]])), axis=1)
            if self.first:
                pairs = pairs[(pairs[:, 0] < self.first) & (pairs[:, 1] >= self.first)]
            if self.drops_adjacent:
                both = self.faces[pairs]
                pairs = pairs[(both[:, 0, :, None] != both[:, 1, None, :]).all(axis=(1, 2))]
            found.append(pairs.astype(numpy.uint32))
        self.found = numpy.concatenate(found)
        return {"stages": [{"name": "broad", "begin_ns": begin, "end_ns": time.monotonic_ns(), "device": False}]}

    def pairs(self, request):
        self.found.tofile(request["pairs"])
        return {"count": len(self.found)}


def reply(sweep, request):
    call = request["call"]
    if call == "hello":
        return {"protocol": 1, "library": "NumPy", "version": numpy.__version__, "licence": "BSD-3-Clause", "device": "host",
                "methods": [METHOD]}
    if call == "create":
        return {}
    if call == "bytes":
        return {"bytes": sum(array.nbytes for array in vars(sweep).values() if isinstance(array, numpy.ndarray))}
    return getattr(sweep, call)(request) or {}


if __name__ == "__main__":
    its_sweep = Sweep()
    for line in sys.stdin:
        asked = json.loads(line)
        if asked["call"] == "quit":
            break
        try:
            answer = {"ok": True, **reply(its_sweep, asked)}
        except Exception as error:  # the cell fails with this sentence
            answer = {"error": f"{type(error).__name__}: {error}"}
        print(json.dumps(answer), flush=True)
