#!/usr/bin/env python3
"""Tests builders and colliders from outside, as shared libraries and as programs: right ones, and ones that are wrong in every way.

Usage: plugins_test.py <bvhbench> <result schema> <right plug-in> <shared library without the symbol>"""
import json
import os
import pathlib
import re
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "harness"))
from program import PROGRAM, SOURCE, expect, experiment, limit_for, main, only, ours, run, valid, wait_until  # noqa: E402

GOOD, NO_SYMBOL = (str(pathlib.Path(word).resolve()) for word in sys.argv[3:5])
PLAIN = str(SOURCE / "tests/plugins/program.py")
QUICK = ("--scene", "torus:200", "--samples", "3")
BUILD = ("build", "--plugin", GOOD, "--builder", "halves,median-split", *QUICK)
COLLIDE = ("collide", "--plugin", GOOD, "--collider", "halves,brute", *QUICK)


def cells(*words: str, code: int = 0, **environment: str) -> dict[str, dict]:
    """Returns the cells of a command, by their builder or collider. A command never leaves a process behind."""
    key = "--out" if words[0] == "run" else "--json"
    done = run(*words, key, "r.json", "--force", **environment)
    assert done.returncode == code, done
    wait_until(lambda: not ours())
    return {cell.get("collider", cell["builder"])["name"]: cell for cell in valid("r.json")["cells"]}


def refused(cell: dict, *words: str) -> None:
    """Tests that a cell failed, with one sentence of these words, and has no time."""
    assert cell["status"] == "failed" and "samples" not in cell, cell
    for word in words:
        assert word in cell["reason"], (word, cell["reason"])
    assert "\n" not in cell["reason"]


def test_a_builder_is_judged_measured_and_marked():
    found = cells(*BUILD, "--epo")
    halves = found["halves"]
    assert halves["check"]["verdict"] == "agrees" and halves["check"]["against"] == "contract"
    assert halves["outside"] == {"name": "halves", "library": "Halves", "version": "1.0", "licence": "MIT", "device": "host",
                                 "file": pathlib.Path(GOOD).name, "as": "plugin"}
    assert "outside" not in found["median-split"]
    assert halves["counters"]["sah_cost"] > 0 and halves["counters"]["epo"] >= 0 and halves["counters"]["tree_bytes"] == 200 * 88
    for name, cell in found.items():
        assert len(cell["samples"]) == 3
        for sample in cell["samples"]:
            assert sample["wall_ns"] >= sum(stage["wall_ns"] for stage in sample["stages"]), (name, sample)
    assert [stage["stage"] for stage in halves["samples"][0]["stages"]] == ["build"]


def test_samples_are_taken_by_turns():
    orders = [[sample["order"] for sample in cell["samples"]] for cell in cells(*BUILD).values()]
    assert max(orders[0]) > min(orders[1]) and max(orders[1]) > min(orders[0]), orders


def test_a_collider_finds_the_pairs_of_the_oracle():
    found = cells("collide", "--plugin", GOOD, "--program", PLAIN, "--collider", "halves,halves-refit,every-two,plain,brute",
                  "--scene", "cloth-ball:200:3", "--frames", "0:3", "--samples", "2")
    assert {cell["check"]["verdict"] for cell in found.values()} == {"agrees"}
    assert len({cell["check"]["pairs_hash"] for cell in found.values()}) == 1
    stages = {name: [stage["stage"] for stage in cell["samples"][0]["stages"]] for name, cell in found.items()}
    assert stages == {"halves": ["build", "broad"], "halves-refit": ["refit", "broad"], "every-two": ["broad"], "plain": ["broad"],
                      "brute": ["broad"]}
    assert found["plain"]["outside"]["as"] == "program" and found["plain"]["outside"]["library"] == "Plain"
    assert found["plain"]["counters"]["round_trip_ns"] > 0


def test_written_pairs_are_counted_in_each_frame():
    run("collide", "--plugin", GOOD, "--collider", "halves", "--scene", "cloth-ball:200:3", "--frames", "0:3", "--samples", "2", "--json",
        "counted.json", PLUGIN_FAULT="on-device")
    frames = valid("counted.json")["cells"]
    counts = [cell["counters"]["pairs_count"] for cell in frames]
    moved = [{stage["moved_bytes"] for sample in cell["samples"] for stage in sample["stages"] if stage["stage"] == "broad"}
             for cell in frames]
    assert len(set(counts)) > 1 and moved == [{8 * count} for count in counts], (counts, moved)


def test_pairs_from_outside_go_through_our_narrow_phase():
    found = cells("collide", "--plugin", GOOD, "--collider", "halves,brute", "--narrow", "exact", *QUICK)
    assert {cell["check"]["verdict"] for cell in found.values()} == {"agrees"}
    assert len({cell["check"]["contacts_hash"] for cell in found.values()}) == 1


def test_a_refit_is_judged():
    plan = experiment("refit.json", scenes=["cloth-ball:300:2"], builders=["halves"], operations=["build", "refit"])
    run("run", plan, "--plugin", GOOD, "--out", "refit-result.json")
    both = valid("refit-result.json")["cells"]
    assert [(cell["operation"], cell["check"]["verdict"]) for cell in both] == [("build", "agrees"), ("refit", "agrees")]


def test_stages_on_a_device_have_the_devices_clock():
    stage, = cells(*BUILD, PLUGIN_FAULT="on-device")["halves"]["samples"][0]["stages"]
    assert stage["span_ns"] > 0 and stage["launches"] == 1 and "wall_ns" not in stage


def test_it_stands_in_lists_and_in_other_commands():
    for words in (("--plugin", GOOD), ()):
        environment = {} if words else {"BVHBENCH_PLUGINS": f"{GOOD}:"}
        for what in ("builders", "colliders"):
            assert "\nhalves " in expect(0, "list", what, *words, **environment)
    assert "\nhalves-refit " in expect(0, "list", "colliders", "--plugin", GOOD, says="from outside: Halves 1.0, MIT, on host")
    expect(0, "check", "--builder", "halves", "--plugin", GOOD, says="no violation")
    expect(0, "sweep", "--plugin", GOOD, "--scenes", "torus:200", "--builders", "halves,perfect", "--samples", "2", "--out", "swept")
    swept = valid("swept/sweep.json")["cells"]
    assert [cell["check"]["verdict"] for cell in swept] == ["agrees", "agrees"] and "outside" in swept[0]
    expect(0, "best", "torus:200", "--plugin", GOOD, "--builders", "oibvh-multi", "--orders", "hilbert30",
           "--colliders", "halves,group", says="halves")
    assert any("outside" in cell for cell in valid("best.json")["cells"])
    expect(0, "show", "swept/sweep.json", says="halves, from outside: Halves 1.0 (MIT) by " + pathlib.Path(GOOD).name + ", on host")
    expect(0, "compare", "swept/sweep.json", "swept/sweep.json", "--allow-dirty", says="2 cells: ")
    expect(0, "report", "swept/sweep.json", "-o", "page.html")
    assert "halves: Halves 1.0 (MIT) by " in pathlib.Path("page.html").read_text()
    other = json.loads(pathlib.Path("swept/sweep.json").read_text())
    other["cells"][0]["outside"]["version"] = "1.1"
    pathlib.Path("other.json").write_text(json.dumps(other))
    expect(0, "compare", "swept/sweep.json", "other.json", "--allow-dirty", says="from outside: Halves 1.1 (MIT)")


def test_nanoseconds_that_are_given_as_microseconds_do_not_win():
    """The program takes 50 times as long as `brute`, and says that it takes a twentieth of its time."""
    words = ("collide", "--program", PLAIN, "--collider", "plain,brute", *QUICK, "--json", "slip.json")
    said = expect(0, *words, PLUGIN_FAULT="microseconds")
    assert said.startswith("take `brute`: ") and " by the wall clock" in said.split("\n")[0], said
    warning = r"\nwarning: torus:200, frame 0: plain: its stages take [\d.]+ us, and [\d.]+ ms pass by the wall clock\n"
    for text in (said, expect(0, "show", "slip.json")):
        assert re.search(warning, text), text
    expect(0, "report", "slip.json", "-o", "slip.html")
    page = pathlib.Path("slip.html").read_text()
    assert "brute is soonest on torus:200" in page and '<p class="warning">torus:200, frame 0: plain: its stages take ' in page
    said = expect(0, "best", "torus:200", "--program", PLAIN, "--builders", "oibvh-multi", "--orders", "hilbert30", "--colliders",
                  "plain,group", "--out", "raced.json", PLUGIN_FAULT="microseconds")
    assert "\ntake `group` over `oibvh-multi`" in said and re.search(warning, said), said
    # The race too goes by the wall clock: the slip does not drive all others out.
    stopped = {cell["collider"]["name"]: cell["sampling"]["stopped"] for cell in valid("raced.json")["cells"] if "samples" in cell}
    assert stopped["plain"] == "beaten" and stopped["group"] != "beaten", stopped
    said = expect(0, "build", "--plugin", GOOD, "--builder", "halves,median-split", "--scene", "torus:20000", "--samples", "3",
                  PLUGIN_FAULT="microseconds")
    assert " a build by the wall clock" in said and "\nwarning: torus:20000: halves: its stages take " in said, said


CALLS = {  # fault of the library: what the sentence of the builder's cell says
    "crash": "in `build`: it crashed (signal 11)",
    "exit": "in `build`: it ended with exit code 7; its last words: CUDA error 700",
    "ends": "in `build`: it ended with exit code 0",
    "silent": "in `build`: it says: it fails and does not say why",
    "all-ones": "it gives 4294967295 stages, and 16 are allowed",
    "wild-name": "in `build`: it crashed (signal 11)",
    "leak": "longer than the",
    "stages": "it gives 17 stages, and 16 are allowed",
    "unknown-stage": "no stage is called 'magic'",
    "create": "in `create`: it says: there is no device for it",
    "fails": "in `prepare`: it says: it does not like this mesh",
    "wild-entry": "names entries that are not there",
    "device-memory": "are allowed",
}


def test_a_wrong_builder_fails_and_the_others_are_measured():
    for fault, words in CALLS.items():
        limit = ("--memory-limit", "3G") if fault == "device-memory" else ()
        found = cells(*BUILD, *limit, PLUGIN_FAULT=fault)
        refused(found["halves"], pathlib.Path(GOOD).name, words)
        assert found["median-split"]["check"]["verdict"] == "agrees"


def test_a_wrong_tree_has_no_time():
    for fault, words in {"small-box": "does not contain", "lost-triangle": "is in two leaves"}.items():
        found = cells(*BUILD, code=1, PLUGIN_FAULT=fault)
        check = found["halves"]["check"]
        assert check["verdict"] == "differs" and words in check["detail"] and not found["halves"]["samples"], found["halves"]


def test_wrong_pairs_have_no_time():
    for fault in ("missed-pair", "writes-points"):
        found = cells(*COLLIDE, code=1, PLUGIN_FAULT=fault)
        assert found["halves"]["check"]["verdict"] == "differs" and not found["halves"]["samples"]
        assert found["brute"]["check"]["verdict"] == "agrees"
    refused(cells(*COLLIDE, PLUGIN_FAULT="false-triangle")["halves"], "it found a pair of 200 and ")
    refused(cells(*COLLIDE, PLUGIN_FAULT="no-array")["halves"], "in `pairs`: it says: it gives no array of pairs")


def test_a_gate_runs_what_is_from_outside_or_says_that_it_does_not():
    for words, of in ((("run", "smoke", "--filter", "halves"), "halves"), (("run", "agreement", "--quick", "--filter", "halves"), "halves")):
        done = run(*words, "--plugin", GOOD, "--out", "gate.json", "--force")
        assert done.returncode == 0, done
        assert any(of in (cell["builder"]["name"], cell.get("collider", {}).get("name")) for cell in valid("gate.json")["cells"])
        done = run(*words, "--plugin", GOOD, "--out", "gate.json", "--force", PLUGIN_FAULT="missed-pair")
        assert done.returncode == 1, done
    for words in (("check", "--builder", "perfect"), ("check", "--portable"), ("stress",)):
        expect(2, *words, "--plugin", GOOD, says=f"'{words[0]}")
        expect(2, *words, BVHBENCH_PLUGINS=GOOD, says="takes no part: `smoke` and `run agreement` judge it")
    done = run("check", "--builder", "halves", "--plugin", GOOD)
    assert done.returncode == 0 and done.stderr.startswith("colliders from outside take no part in `check`"), done


def test_one_that_hangs_is_ended():
    limit = limit_for(*BUILD)
    for fault, call in (("hang", "build"), ("stopped", "build"), ("hangs-at-start", "hello")):
        found = cells(*BUILD, "--time-limit", str(limit), PLUGIN_FAULT=fault)
        refused(found["halves"], f"in `{call}`: it took longer than {0.95 * limit:g} s and was ended; --time-limit")
        assert found["median-split"]["check"]["verdict"] == "agrees"


def test_one_that_crashes_at_its_end_keeps_its_time():
    assert cells(*BUILD, PLUGIN_FAULT="double-free")["halves"]["check"]["verdict"] == "agrees"


def test_what_one_says_cannot_command_a_terminal_or_a_page():
    control = re.compile("[\0-\x09\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")
    words = ("collide", "--program", PLAIN, "--collider", "plain,brute", *QUICK, "--json", "r.json", "--force")
    for fault in ("control", "control-error"):
        said = [run(*words, PLUGIN_FAULT=fault), run("list", "colliders", "--program", PLAIN, PLUGIN_FAULT=fault), run("show", "r.json")]
        for done in said:
            assert done.returncode == 0 and not control.search(done.stdout + done.stderr), (fault, done)
        assert "2Jname" in said[0].stdout, said[0]
        expect(0, "report", "r.json", "-o", "page.html", "--force")
        page = pathlib.Path("page.html").read_text()
        assert "&lt;img src=x&gt;" in page and "<img src=x>" not in page
    refused(cells(*BUILD, PLUGIN_FAULT="loud")["halves"], "in `build`: it says: ", "red")


def test_one_that_takes_too_much_memory_is_ended():
    refused(cells(*BUILD, "--memory-limit", "500M", PLUGIN_FAULT="memory")["halves"], "out of host memory: it takes ")


def test_what_a_library_prints_is_no_reply():
    assert cells(*BUILD, PLUGIN_FAULT="chatty")["halves"]["check"]["verdict"] == "agrees"


STARTS = {  # fault of the library: what is said when it starts
    "abi": "it was made for version 2 of the interface, and this is version 1",
    "old-host": "it does not serve version 1 of the interface",
    "dies-at-start": "in `hello`: it crashed (signal 6)",
    "taken-name": "has a method 'karras', and there is a builder or collider of that name",
    "bad-name": "it calls a method 'Halves!'; a name is up to 64 small letters, digits and hyphens",
    "no-pairs": "its method every-two has `query` without `pairs`",
    "no-load": "its method every-two lacks `load`",
}


def test_one_that_does_not_start_fails_by_name_and_the_others_are_measured():
    for fault, words in STARTS.items():
        found = cells(*BUILD, PLUGIN_FAULT=fault)
        refused(found["halves"], "no builder is called 'halves', and a plug-in does not start: ", words)
        assert found["median-split"]["check"]["verdict"] == "agrees"
    pathlib.Path("text.so").write_text("no library")
    for file, words in (("none.so", "there is no file 'none.so'"), ("text.so", "text.so in `hello`: it says: it cannot be loaded: "),
                        (NO_SYMBOL, "it has no symbol `bvhbench_plugin_entry`")):
        found = cells("build", "--plugin", file, "--builder", "halves,median-split", *QUICK)
        refused(found["halves"], words)
        assert found["median-split"]["check"]["verdict"] == "agrees"
    done = run("list", "builders", "--plugin", "none.so")
    assert done.returncode == 0 and done.stderr == "bvhbench: there is no file 'none.so'\n" and "karras" in done.stdout, done


def test_two_plugins_of_one_name_are_refused():
    done = run("list", "builders", "--plugin", GOOD, "--plugin", GOOD)
    assert done.stderr.count("\n") == 1 and "there is a builder or collider of that name" in done.stderr, done


PROGRAMS = {  # fault of the program: what the sentence of its cell says
    "crash": "program.py in `query`: it crashed (signal 11)",
    "exit": "it ended with exit code 1; its last words: no such device",
    "close": "it closed its standard output",
    "leak": "longer than the",
    "count": "and it says that there are",
    "not-json": "its reply is malformed: 'Found some pairs!' is no JSON object",
    "no-stages": "its reply is malformed: there is no 'stages'",
    "endless": "its reply is malformed: it has more than",
    "error": "it says: there are too many pairs",
}


def test_a_wrong_program_fails_and_the_others_are_measured():
    words = ("collide", "--program", PLAIN, "--collider", "plain,brute", *QUICK)
    for fault, sentence in PROGRAMS.items():
        found = cells(*words, PLUGIN_FAULT=fault)
        refused(found["plain"], sentence)
        assert found["brute"]["check"]["verdict"] == "agrees"
    limit = limit_for(*words)
    refused(cells(*words, "--time-limit", str(limit), PLUGIN_FAULT="hang")["plain"], f"it took longer than {0.95 * limit:g} s")
    assert cells(*words, code=1, PLUGIN_FAULT="missed-pair")["plain"]["check"]["verdict"] == "differs"
    for fault, sentence in (("abi", "it was made for version 2"), ("dies-at-start", "its last words: nothing works here")):
        refused(cells(*words, PLUGIN_FAULT=fault)["plain"], sentence)
    pathlib.Path("not-executable").write_text("no program")
    for file, sentence in (("nothing", "there is no file 'nothing'"), ("not-executable", "it cannot be started: Permission denied")):
        refused(cells("collide", "--program", file, "--collider", "plain,brute", *QUICK)["plain"], sentence)


def test_nothing_that_a_program_started_is_left_and_its_memory_counts():
    words = ("collide", "--program", PLAIN, "--collider", "plain", *QUICK)
    for fault in ("children", "daemons"):
        assert cells(*words, PLUGIN_FAULT=fault)["plain"]["check"]["verdict"] == "agrees"
        wait_until(lambda: not ours())
    found = cells("collide", "--program", PLAIN, "--collider", "plain,brute", *QUICK, "--memory-limit", "700M", PLUGIN_FAULT="many-children")
    refused(found["plain"], "out of host memory: it takes ")


def test_what_a_method_cannot_do_is_skipped():
    done = run("collide", "--plugin", GOOD, "--builder", "halves,perfect", "--collider", "leaf", *QUICK)
    assert "leaf needs a tree in device memory" in done.stdout and "\nhalves, from outside: " in done.stdout, done
    cases = ((("--adjacent", "drop"), "takes neither 'pairs_of' nor 'adjacent'"), (("--swept",), "knows no swept boxes"))
    for words, sentence in cases:
        done = run("collide", "--plugin", GOOD, "--collider", "halves,brute", "--scene", "cloth-ball:200:2", "--samples", "1", *words,
                   "--json", "r.json", "--force")
        assert done.returncode == 0, done
        one = next(cell for cell in valid("r.json")["cells"] if cell["collider"]["name"] == "halves")
        assert one["status"] == "skipped" and (sentence in one["reason"] or words == ("--swept",)), one


def test_it_ends_with_the_program_that_started_it():
    program = ("collide", "--program", PLAIN, "--collider", "plain", *QUICK)
    for words, seconds in ((BUILD, 0), (BUILD, 2), (program, 0), (program, 2)):  # while it starts, and while it hangs
        with subprocess.Popen([PROGRAM, *words, "--time-limit", "1000"], env={**os.environ, "PLUGIN_FAULT": "hang"},
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            wait_until(lambda: any("--outside" in line or "program.py" in line for line in ours()))
            time.sleep(seconds)  # only chooses where the kill strikes
            process.kill()
        wait_until(lambda: not ours())


sys.exit(main(globals()))
