"""Oi-BVHs over arrays of NumPy: pairs of triangles that overlap, intersect or are near, on a processor or a GPU by OpenCL.

    tree = bvhbench.Tree(points, faces)
    contacts = tree.contacts()

docs/python.md is the guide. Errors are bvhbench.Error, whose text is one sentence; those of wrong input are ValueError, too.
"""
from ._core import BadInput, Error, Unavailable
from ._core import device_names as devices
from ._core import version as _version
from .answers import best, read
from .check import WrongPairs, verify
from .scene import Scene
from .tree import Tree

__version__ = _version()
__all__ = ["BadInput", "Error", "Scene", "Tree", "Unavailable", "WrongPairs", "best", "devices", "read", "verify"]
