#!/usr/bin/env python3
"""Tests the program on a device that is neither PoCL's nor NVIDIA's: Mesa's llvmpipe, through Rusticl."""
import os
import sys

from program import ALL_CASES, SOURCE, expect, main, run, valid

os.environ["RUSTICL_ENABLE"] = "llvmpipe"
LLVMPIPE = ("--device", "rusticl llvmpipe", "--clock", "host")  # its own clock is not to be believed
BASELINE = SOURCE / "results/baseline/smoke-llvmpipe.json"
ENDS_LOOPS = "ends early"


# Takes a minute. The tests below do the same for one cell of each kind, and for all that `check --portable` tries.
if ALL_CASES:
    def test_smoke_agrees_in_every_cell_that_is_not_refused_by_name():
        expect(0, "smoke", *LLVMPIPE, "--baseline", str(BASELINE), "--out", "smoke.json", says="as before")
        cells = valid("smoke.json")["cells"]
        refused = [cell for cell in cells if cell["status"] != "measured"]
        for cell in refused:
            assert cell["status"] == "skipped" and cell["reason"].endswith(ENDS_LOOPS), cell
            assert cell["collider"]["name"] in ("leaf", "group", "front-leaf") and cell["builder"]["name"] in ("karras", "hploc"), cell
        assert len(refused) == 12 and len(cells) > 100, (len(refused), len(cells))
        assert {cell["check"]["verdict"] for cell in cells if cell["status"] == "measured"} == {"agrees"}


def test_a_pipeline_is_right_or_refused_by_name():
    expect(0, "collide", "--builder", "oibvh-multi", "--collider", "bvtt", "--scene", "torus:500", "--samples", "1", *LLVMPIPE,
           says="verdict: agrees")
    done = run("collide", "--builder", "karras", "--collider", "leaf", "--scene", "torus:500", "--samples", "1", *LLVMPIPE)
    assert done.returncode == 4 and ENDS_LOOPS in done.stderr, done  # Mesa may warn there too


def test_a_scene_whose_loops_would_be_too_long_is_refused():
    expect(3, "build", "--builder", "oibvh-multi", "--scene", "torus:20000", *LLVMPIPE,
           says="ends loops after 65,535 steps, so it is given up to 16384 triangles, not 20000")


def test_without_the_variable_the_device_is_pocl():
    del os.environ["RUSTICL_ENABLE"]
    done = run("build", "--builder", "perfect", "--scene", "soup:10", "--samples", "1", "--json", "pocl.json")
    assert done.returncode == 0 and not done.stderr, done
    assert valid("pocl.json")["run"]["device"]["platform"] == "Portable Computing Language"
    expect(3, "build", "--builder", "perfect", "--scene", "soup:10", *LLVMPIPE, says="no OpenCL device matches 'rusticl llvmpipe'")


def test_a_report_on_the_device_names_every_verdict():
    report = expect(0, "check", "--portable")
    for words in ("device ", "driver ", "extensions ", "OpenCL ", "local_memory_bytes ", "end by themselves", "oibvh-multi", "karras", "guigue",
                  "agrees"):
        assert words in report, (words, report)
    assert "differs" not in report and "failed" not in report, report


sys.exit(main(globals()))
