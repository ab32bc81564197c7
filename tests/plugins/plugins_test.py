#!/usr/bin/env python3
"""Tests builders and colliders from outside, as shared libraries and as programs: right ones, and ones that are wrong in every way.
Most runs take several that are wrong, each of which fails by itself.

Usage: plugins_test.py <bvhbench> <result schema> <right plug-in> <shared library without the symbol>"""
import base64
import gzip
import json
import pathlib
import re
import shutil
import subprocess
import sys
from collections.abc import Iterable

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "harness"))
from program import PROGRAM, SOURCE, best, cells_after, expect, experiment, limit_for, main, ours, run, valid, wait_until  # noqa: E402

GOOD, NO_SYMBOL = (str(pathlib.Path(word).resolve()) for word in sys.argv[3:5])
PLAIN = str(SOURCE / "tests/plugins/program.py")
QUICK = ("--scene", "torus:200", "--samples", "3")


def wrong(option: str, *faults: str) -> tuple[str, ...]:
    """Returns the words that add copies of the right one, each of which is wrong in one way."""
    right, suffix = (GOOD, "so") if option == "--plugin" else (PLAIN, "py")
    return tuple(word for fault in faults for word in (option, shutil.copy(right, f"fault-{fault}.{suffix}")))


def named(method: str, faults: Iterable[str], *more: str) -> str:
    """Returns the list of the methods of wrong ones, and of others."""
    return ",".join((*(f"{method}-{fault}" for fault in faults), *more))


def cells(*words: str, code: int = 0) -> dict[str, dict]:
    """Returns the cells of a command, by their builder or collider. A command never leaves a process behind."""
    done = run(*words, "--out" if words[0] == "run" else "--json", "r.json", "--force")
    assert done.returncode == code, done
    wait_until(lambda: not ours())
    return {cell.get("collider", cell["builder"])["name"]: cell for cell in valid("r.json")["cells"]}


def agree(found: dict[str, dict], *names: str) -> None:
    """Tests that these cells agree."""
    assert {found[name]["check"]["verdict"] for name in names} == {"agrees"}, found


def refused(cell: dict, *words: str) -> None:
    """Tests that a cell failed, with one sentence of these words, and has no time."""
    assert cell["status"] == "failed" and "samples" not in cell, cell
    for word in words:
        assert word in cell["reason"], (word, cell["reason"])
    assert "\n" not in cell["reason"]


def differs(cell: dict, words: str = "") -> None:
    """Tests that a cell has a wrong answer, and no time."""
    assert cell["check"]["verdict"] == "differs" and words in cell["check"]["detail"] and not cell["samples"], cell


def test_a_builder_is_judged_measured_by_turns_and_marked():
    odd = ("on-device", "chatty", "double-free")  # what a library prints is no reply; one that crashes at its end keeps its time
    found = cells("build", "--plugin", GOOD, *wrong("--plugin", *odd), "--builder", named("halves", odd, "halves", "median-split"), *QUICK,
                  "--epo")
    agree(found, *found)
    halves = found["halves"]
    assert halves["check"]["against"] == "contract"
    assert halves["outside"] == {"name": "halves", "library": "Halves", "version": "1.0", "licence": "MIT", "device": "host",
                                 "file": pathlib.Path(GOOD).name, "as": "plugin"}
    assert "outside" not in found["median-split"]
    assert halves["counters"]["sah_cost"] > 0 and halves["counters"]["epo"] >= 0 and halves["counters"]["tree_bytes"] == 200 * 88
    for name, cell in found.items():
        assert len(cell["samples"]) == 3
        for sample in cell["samples"]:
            assert sample["wall_ns"] >= sum(stage.get("wall_ns", 0) for stage in sample["stages"]), (name, sample)
    assert [stage["stage"] for stage in halves["samples"][0]["stages"]] == ["build"]
    stage, = found["halves-on-device"]["samples"][0]["stages"]  # which has the device's clock
    assert stage["span_ns"] > 0 and stage["launches"] == 1 and "wall_ns" not in stage
    orders = [[sample["order"] for sample in found[name]["samples"]] for name in ("halves", "median-split")]
    assert max(orders[0]) > min(orders[1]) and max(orders[1]) > min(orders[0]), orders


def night_test_a_short_build_runs_once_before_it_is_timed():
    pathlib.Path("builds").unlink(missing_ok=True)
    agree(cells("build", *wrong("--plugin", "counted"), "--builder", "halves-counted", *QUICK), "halves-counted")
    assert len(pathlib.Path("builds").read_text()) > 7  # which are timed or checked


def test_a_collider_finds_the_pairs_of_the_oracle():
    found = cells("collide", "--plugin", GOOD, *wrong("--plugin", "on-device"), "--program", PLAIN, "--collider",
                  "halves,halves-refit,every-two,plain,brute,halves-on-device", "--scene", "cloth-ball:200:3", "--frames", "0:3", "--samples",
                  "2")
    agree(found, *found)
    assert len({cell["check"]["pairs_hash"] for cell in found.values()}) == 1
    stages = {name: [stage["stage"] for stage in cell["samples"][0]["stages"]] for name, cell in found.items()}
    assert stages.pop("halves-on-device") == ["build", "broad"]
    assert stages == {"halves": ["build", "broad"], "halves-refit": ["refit", "broad"], "every-two": ["broad"], "plain": ["broad"],
                      "brute": ["broad"]}
    assert found["plain"]["outside"]["as"] == "program" and found["plain"]["outside"]["library"] == "Plain"
    assert found["plain"]["counters"]["round_trip_ns"] > 0
    # Pairs that are written on a device are counted in each frame.
    frames = [cell for cell in valid("r.json")["cells"] if cell["collider"]["name"] == "halves-on-device"]
    counts = [cell["counters"]["pairs_count"] for cell in frames]
    moved = [{stage["moved_bytes"] for sample in cell["samples"] for stage in sample["stages"] if stage["stage"] == "broad"}
             for cell in frames]
    assert len(set(counts)) > 1 and moved == [{8 * count} for count in counts], (counts, moved)


def test_pairs_from_outside_go_through_our_narrow_phase():
    found = cells("collide", "--plugin", GOOD, "--collider", "halves,brute", "--narrow", "exact", *QUICK)
    agree(found, *found)
    assert len({cell["check"]["contacts_hash"] for cell in found.values()}) == 1


def test_a_refit_is_judged():
    plan = experiment("refit.json", scenes=["cloth-ball:300:2"], builders=["halves"], operations=["build", "refit"])
    both = cells_after("run", plan, "--plugin", GOOD)
    assert [(cell["operation"], cell["check"]["verdict"]) for cell in both] == [("build", "agrees"), ("refit", "agrees")]


def test_it_stands_in_lists_and_in_other_commands():
    for words, environment in ((("--plugin", GOOD), {}), ((), {"BVHBENCH_PLUGINS": f"{GOOD}:"})):
        assert "\nhalves " in expect(0, "list", "builders", *words, **environment)
    assert "\nhalves-refit " in expect(0, "list", "colliders", "--plugin", GOOD, says="from outside: Halves 1.0, MIT, on host")
    expect(0, "check", "--builder", "halves", "--plugin", GOOD, says="no violation")
    expect(0, "sweep", "--plugin", GOOD, "--scenes", "torus:200", "--builders", "halves,perfect", "--samples", "2", "--out", "swept")
    swept = valid("swept/sweep.json")
    assert [cell["check"]["verdict"] for cell in swept["cells"]] == ["agrees", "agrees"] and "outside" in swept["cells"][0]
    swept["cells"][0]["outside"]["version"] = "1.1"
    pathlib.Path("other.json").write_text(json.dumps(swept))
    expect(0, "compare", "swept/sweep.json", "other.json", "--allow-dirty", says="from outside: Halves 1.1 (MIT)")


def test_single_queries_are_counted_against_the_oracle():
    """A vertex passes through a face at half of the step, another beside it."""
    file, points = pathlib.Path("through_vf.csv"), ("0,1,0,1,0,1", "1,1,0,1,0,1", "0,1,1,1,0,1")
    file.write_text("".join("\n".join((f"{x},4,1,4,1,1", *points, f"{x},4,1,4,-1,1", *points)) + "\n" for x in (1, 7)))
    expect(0, "accuracy", "--axis", "queries", "--scene", str(file), "--plugin", GOOD, *wrong("--plugin", "misses"), "--samples", "2",
           "--filter", "at-the-start|ccd-f64-1e-6", "--out", "q", says="at-the-start-misses, vertex-face: 1 missed, 0 late and 1 false of 2 queries")
    ours, right, misses = valid("q/accuracy-queries.json")["cells"]
    counts = [[cell["counters"][key] for key in ("touching_count", "missed_count", "late_count", "false_count")] for cell in (ours, right, misses)]
    assert counts == [[1, 0, 0, 0], [1, 0, 0, 1], [1, 1, 0, 1]], counts
    assert abs(right["counters"]["gap_median"] - 0.5) < 1e-9 and right["counters"]["shortened_mean"] > 0.74, right
    assert right["outside"]["name"] == "at-the-start" and "outside" not in ours, right


def test_a_narrow_phase_is_counted_against_the_oracle():
    expect(0, "accuracy", "--axis", "narrow", "--plugin", GOOD, *wrong("--plugin", "no-contacts"), "--samples", "2", "--pairs", "2000",
           "--filter", "needles/(every-two|guigue-f64)", "--out", "n", says="every-two: 0 missed and ")
    ours, right, misses = valid("n/accuracy-narrow.json")["cells"]
    pairs, meet = (ours["counters"][key] for key in ("pairs_count", "meeting_count"))
    counts = [[cell["counters"][key] for key in ("missed_count", "false_count")] for cell in (right, misses)]
    assert counts == [[0, pairs - meet], [meet, 0]] and 0 < meet < pairs and right["samples"][0]["wall_ns"] > 0, counts
    assert right["outside"]["name"] == "every-two" and right["check"]["verdict"] == "counted", right


def facts_in(page: str) -> str:
    """Returns what a report shows of its first file, as JSON."""
    return gzip.decompress(base64.b64decode(re.search('id="blob-file-0">([^<]*)<', page)[1])).decode()


def night_test_nanoseconds_that_are_given_as_microseconds_do_not_win():
    """The program takes 50 times as long as `brute`, and says that it takes a twentieth of its time."""
    slip = wrong("--program", "microseconds")
    said = expect(0, "collide", *slip, "--plugin", GOOD, "--collider", "plain-microseconds,brute,halves", *QUICK[:-1], "5", "--json", "slip.json")
    assert re.match("take `(brute|halves)`: ", said) and " by the wall clock" in said.split("\n")[0], said
    warning = r"\nwarning: torus:200, frame 0: plain-microseconds: its stages take [\d.]+ us, and [\d.]+ ms pass by the wall clock\n"
    by = f"halves, from outside: Halves 1.0 (MIT) by {pathlib.Path(GOOD).name}, on host"
    for text in (said, expect(0, "show", "slip.json")):
        assert re.search(warning, text) and by in text, text
    expect(0, "report", "slip.json", "-o", "slip.html")
    page = pathlib.Path("slip.html").read_text()
    assert re.search("(brute|halves) is soonest on torus:200", page) and "halves: Halves 1.0 (MIT) by " in facts_in(page)
    assert '<p class="warning">torus:200, frame 0: plain-microseconds: its stages take ' in page
    said = best(0, "torus:200", *slip, "--builders", "oibvh-multi", "--orders", "hilbert30", "--colliders",
                  "plain-microseconds,group", "--out", "raced.json")
    assert "\ntake `group` over `oibvh-multi`" in said and re.search(warning, said), said
    # The race too goes by the wall clock: the slip does not drive all others out. Of `group` over the two kinds of leaves one may.
    raced = [cell for cell in valid("raced.json")["cells"] if "samples" in cell]
    slips = [cell for cell in raced if cell["collider"]["name"] == "plain-microseconds"]
    assert len(slips) == 1 and "outside" in slips[0] and slips[0]["sampling"]["stopped"] == "beaten", slips
    assert len(raced) == 3 and any(cell["sampling"]["stopped"] != "beaten" for cell in raced if cell not in slips), raced
    said = expect(0, "build", *wrong("--plugin", "microseconds"), "--builder", "halves-microseconds,median-split", "--scene", "torus:20000",
                  "--samples", "3")
    assert " a build by the wall clock" in said and "\nwarning: torus:20000: halves-microseconds: its stages take " in said, said


CALLS = {  # fault of the library: what the sentence of the builder's cell says
    "crash": "in `build`: it crashed (signal 11)",
    "exit": "in `build`: it ended with exit code 7; its last words: CUDA error 700",
    "ends": "in `build`: it ended with exit code 0",
    "silent": "in `build`: it says: it fails and does not say why",
    "loud": "in `build`: it says:  [31mred",
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
    found = cells("build", *wrong("--plugin", *CALLS), "--builder", named("halves", CALLS, "median-split"), *QUICK, "--memory-limit", "3G")
    for fault, words in CALLS.items():
        refused(found[f"halves-{fault}"], f"fault-{fault}.so", words)
    agree(found, "median-split")


def test_a_wrong_tree_has_no_time():
    faults = {"small-box": "does not contain", "lost-triangle": "is in two leaves"}
    found = cells("build", *wrong("--plugin", *faults), "--builder", named("halves", faults, "median-split"), *QUICK, code=1)
    for fault, words in faults.items():
        differs(found[f"halves-{fault}"], words)
    agree(found, "median-split")


def test_wrong_pairs_have_no_time():
    faults = ("missed-pair", "writes-points", "false-triangle", "no-array")
    found = cells("collide", *wrong("--plugin", *faults), *wrong("--program", "missed-pair"), "--collider",
                  named("halves", faults, "plain-missed-pair", "brute"), *QUICK, code=1)
    for name in ("halves-missed-pair", "halves-writes-points", "plain-missed-pair"):
        differs(found[name])
    refused(found["halves-false-triangle"], "it found a pair of 200 and ")
    refused(found["halves-no-array"], "in `pairs`: it says: it gives no array of pairs")
    agree(found, "brute")


def test_a_gate_runs_what_is_from_outside_or_says_that_it_does_not():
    for name, scene in (("smoke", "torus:2048"), ("agreement", "torus:5000")):
        cells("run", name, "--quick", "--filter", f"{scene}.*halves", "--plugin", GOOD, *wrong("--plugin", "missed-pair"), code=1)
        found = {cell["collider"]["name"]: cell for cell in valid("r.json")["cells"] if cell["builder"]["name"] == "none"}
        agree(found, "halves")
        differs(found["halves-missed-pair"])
    for words in (("check", "--builder", "perfect"), ("check", "--portable"), ("stress",)):
        expect(2, *words, "--plugin", GOOD, says=f"'{words[0]}")
    expect(2, "stress", BVHBENCH_PLUGINS=GOOD, says="takes no part: `smoke` and `run agreement` judge it")
    expect(2, "check", "--builder", "every-two", "--plugin", GOOD, says="every-two, from outside, is none")
    done = run("run", experiment("none.json", scenes=["torus:200"], builders=["halves"]), "--plugin", GOOD, "--out", "none-results.json")
    assert done.stderr.splitlines()[:2] == [f"{name}, from outside, takes no part in test" for name in ("every-two", "at-the-start")], done
    done = run("check", "--builder", "halves", "--plugin", GOOD)
    assert done.returncode == 0 and done.stderr.startswith("colliders from outside take no part in `check`"), done


def night_test_one_that_hangs_is_ended():
    for option, right, command, ours_too, faults in (
            ("--plugin", GOOD, "build", "median-split", {"hang": "build", "stopped": "build", "hangs-at-start": "hello"}),
            ("--program", PLAIN, "collide", "brute", {"hang": "query"})):
        method, kind = {GOOD: ("halves", "--builder"), PLAIN: ("plain", "--collider")}[right]
        limit = limit_for(command, option, right, kind, f"{method},{ours_too}", *QUICK)
        for fault, call in faults.items():
            found = cells(command, *wrong(option, fault), kind, f"{method}-{fault},{ours_too}", *QUICK, "--time-limit", str(limit))
            refused(found[f"{method}-{fault}"], f"in `{call}`: it took longer than {0.95 * limit:g} s and was ended; --time-limit")
            agree(found, ours_too)


def test_what_one_says_cannot_command_a_terminal_or_a_page():
    control = re.compile("[\0-\x09\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")
    faults = ("control", "control-error")
    plugins = wrong("--program", *faults)
    said = [run("collide", *plugins, "--collider", named("plain", faults, "brute"), *QUICK, "--json", "r.json", "--force"),
            run("list", "colliders", *plugins), run("show", "r.json")]
    for done in said:
        assert done.returncode == 0 and not control.search(done.stdout + done.stderr), done
    assert said[0].stdout.count("2Jname") > 1, said[0]
    expect(0, "report", "r.json", "-o", "page.html", "--force")
    page = pathlib.Path("page.html").read_text()
    assert "<img src=x>" in facts_in(page) and "<img src=x>" not in page  # page.js makes text of it


def test_one_that_takes_too_much_memory_is_ended_with_all_that_it_started():
    found = cells("collide", *wrong("--plugin", "memory"), *wrong("--program", "many-children"), "--collider",
                  "halves-memory,plain-many-children,brute", *QUICK, "--memory-limit", "500M")
    for name in ("halves-memory", "plain-many-children"):
        refused(found[name], "out of host memory: it takes ")
    agree(found, "brute")


STARTS = {  # fault of the library: what is said when it starts
    "abi": "it was made for version 4 of the interface, and this is version 3",
    "old-host": "it does not serve version 3 of the interface",
    "dies-at-start": "in `hello`: it crashed (signal 6)",
    "taken-name": "has a method 'karras', and there is a builder or collider of that name",
    "bad-name": "it calls a method 'Halves!'; a name is up to 64 small letters, digits and hyphens",
    "no-pairs": "its method every-two-no-pairs has `query` without `pairs`",
    "no-load": "its method every-two-no-load lacks `load`",
}


def test_one_that_does_not_start_fails_by_name_and_the_others_are_measured():
    pathlib.Path("text.so").write_text("no library")
    pathlib.Path("not-executable").write_text("no program")
    files = [word for option, names in (("--plugin", ("none.so", "text.so", NO_SYMBOL)), ("--program", ("nothing", "not-executable")))
             for name in names for word in (option, name)]
    found = cells("collide", *wrong("--plugin", *STARTS), *wrong("--program", "abi", "dies-at-start"), *files, "--collider", "halves,brute",
                  *QUICK)
    refused(found["halves"], "no collider is called 'halves', and a plug-in does not start: ",
            *(f"fault-{fault}.so {words}" if words.startswith(("in", "has")) else words for fault, words in STARTS.items()),
            "there is no file 'none.so'", "text.so in `hello`: it says: it cannot be loaded: ", "it has no symbol `bvhbench_plugin_entry`",
            "fault-abi.py in `hello`: it was made for version 2", "its last words: nothing works here",
            "there is no file 'nothing'", "it cannot be started: Permission denied")
    agree(found, "brute")
    done = run("list", "builders", "--plugin", "none.so", "--plugin", GOOD, "--plugin", GOOD)
    missing, twice = done.stderr.splitlines()
    assert done.returncode == 3 and missing == "bvhbench: there is no file 'none.so'" and "karras" in done.stdout, done
    assert "there is a builder or collider of that name" in twice, done


PROGRAMS = {  # fault of the program: what the sentence of its cell says
    "crash": "fault-crash.py in `query`: it crashed (signal 11)",
    "exit": "it ended with exit code 1; its last words: no such device",
    "close": "it closed its standard output",
    "leak": "longer than the",
    "count": "and it says that there are",
    "not-json": "its reply is malformed: 'Found some pairs!' is no JSON object",
    "no-stages": "its reply is malformed: there is no 'stages'",
    "endless": "its reply is malformed: it has more than",
    "error": "it says: there are too many pairs",
}


def test_a_wrong_program_fails_and_the_others_are_measured_and_nothing_that_one_started_is_left():
    daemons = ("children", "daemons")
    found = cells("collide", *wrong("--program", *PROGRAMS, *daemons), "--collider", named("plain", (*PROGRAMS, *daemons), "brute"), *QUICK)
    for fault, sentence in PROGRAMS.items():
        refused(found[f"plain-{fault}"], sentence)
    agree(found, "plain-children", "plain-daemons", "brute")


def test_our_colliders_query_the_tree_of_a_builder():
    agree(cells("collide", "--plugin", GOOD, "--builder", "halves", "--collider", "leaf,group,block,bvtt", *QUICK), "leaf", "group", "block", "bvtt")


def night_test_pairs_of_a_step_and_within_a_distance_are_held_to_the_oracles_and_skipped_where_a_method_does_not_say_it_can():
    rows = [f"v {x} {y} {z}" for x in (0, 1, 3, 6) for y, z in ((0, 0), (4, 0), (0, 4))] + ["v -0.5 1 1", "v 0.5 1 1", "v 0.5 1.2 1"]
    pathlib.Path("rows.obj").write_text("\n".join(rows + [f"f {k} {k + 1} {k + 2}\n" for k in range(1, 16, 3)]))
    wrong_ones = wrong("--plugin", *(faults := ("missed-pair", "false-pair", "contacts", "no-contacts")))
    step, rows = ("--scene", "cloth-ball:200:2", "--swept"), ("--scene", "rows.obj")
    for words, contacts, sentence in (((*step, "--pairs-of", "between"), "counted", "knows no swept boxes"),
                                      ((*step, "--pairs-of", "within"), "counted", "knows no swept boxes"),
                                      ((*rows, "--within", "2"), "agrees", "does not say that it finds pairs within a distance"),
                                      ((*rows, "--narrow", "exact", "--adjacent", "drop"), "agrees", "it takes no 'adjacent'"),
                                      ((*step[:2], "--pairs-of", "between"), "", "it takes no 'pairs_of'")):
        found = cells("collide", "--plugin", GOOD, *wrong_ones, "--collider", named("every-two", faults, "every-two", "halves", "brute"),
                      *words, "--samples", "1", code=1 if contacts else 0)
        assert found["halves"]["status"] == "skipped" and sentence in found["halves"]["reason"], found
        if contacts:
            agree(found, "every-two")
            assert found["every-two-contacts"]["check"]["verdict"] == contacts, found
            for fault in ("missed-pair", "false-pair", "no-contacts"):
                differs(found[f"every-two-{fault}"])
    wide = cells("collide", *wrong("--plugin", "wide"), "--collider", "every-two-wide", *step, "--pairs-of", "within")["every-two-wide"]
    assert wide["check"]["verdict"] == "counted" and wide["counters"]["false_pairs_count"] == 1 and wide["samples"], wide
    # An inexact narrow phase makes no claim about contacts that a method finds itself.
    inexact = ("--narrow", "guigue-f32", "--adjacent", "drop")
    agree(cells("collide", *wrong_ones, "--collider", "every-two-contacts", *rows, *inexact), "every-two-contacts")
    agree(cells("collide", *wrong("--plugin", "version-2"), "--collider", "every-two-version-2", *QUICK), "every-two-version-2")


def night_test_it_ends_with_the_program_that_started_it():
    for words in (("build", *wrong("--plugin", "hang"), "--builder", "halves-hang"),
                  ("collide", *wrong("--program", "hang"), "--collider", "plain-hang")):
        for happens in (lambda: any("--outside" in line or "fault-hang.py" in line for line in ours()), pathlib.Path("hangs").exists):
            pathlib.Path("hangs").unlink(missing_ok=True)
            with subprocess.Popen([PROGRAM, *words, *QUICK, "--time-limit", "1000"], stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL) as process:
                wait_until(happens)  # it starts, and it hangs
                process.kill()
            wait_until(lambda: not ours())


sys.exit(main(globals()))
