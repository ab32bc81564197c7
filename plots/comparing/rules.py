"""How strictly two result files are compared."""
from dataclasses import dataclass


@dataclass(frozen=True)
class Rules:
    threshold: float = 0.05  # the smallest change of time that counts, as a share
    error: float = 0.05  # chance that any cell of two runs of one program is called faster or slower
    allow_missing: bool = False
    allow_dirty: bool = False
    other_devices: bool = False  # compare only ratios between the cells of a scene
    allow_test_hooks: bool = False
