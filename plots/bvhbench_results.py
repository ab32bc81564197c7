"""Reads result files into a pandas table, for notebooks and scripts; plots must be on PYTHONPATH.

    import bvhbench_results
    samples = bvhbench_results.read("run.json")
    samples[samples.stage == "hierarchy"].groupby(["scene", "builder"]).ns.median()
"""
import importlib.util
import pathlib
import sys

# The package gets a name of its own, so that nothing of it can be taken for a module of the user's.
_about = importlib.util.spec_from_file_location("_bvhbench_plots", pathlib.Path(__file__).resolve().parent / "__init__.py")
sys.modules[_about.name] = importlib.util.module_from_spec(_about)
_about.loader.exec_module(sys.modules[_about.name])

from _bvhbench_plots.files.json_files import Refused  # noqa: E402, F401
from _bvhbench_plots.read.sample_rows import CELL, SAMPLE, read  # noqa: E402, F401
