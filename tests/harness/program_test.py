#!/usr/bin/env python3
"""Tests the program's exit codes, output and result files."""
import json
import os
import pathlib
import re
import sys

from program import cells_after, expect, experiment, main, only, on_a_terminal, valid

PERFECT = "build --builder perfect --scene soup:5"
SENTENCES = (
    (2, "", "name a command: list, scene, "),
    (2, "paint", "paint"),
    (2, "list colours", "there are: builders, colliders, narrow, orders, formats, skips, tuning, scenes, devices, accuracy, experiments"),
    (2, "build --builder x --scene soup:5", "there are: perfect, "),
    (2, "build --builder perfect --scene no-such", "no-such"),
    (2, f"{PERFECT} --order x", "there are: morton30"),
    (2, f"{PERFECT} --sah-inner nan", "--sah-inner: must be a number from 0 to 1000000, not 'nan'"),
    (2, "collide --builder perfect --collider x --scene soup:5", "there are: leaf, "),
    (2, "collide --builder perfect --collider leaf --scene soup:5 --pairs p.txt", "to .csv or .bin"),
    (4, "collide --builder oibvh-wide4 --collider front-leaf --scene soup:5", "front-leaf needs a binary tree"),
    (2, "run nothing", "there are: agreement, builders, effects, equality"),
    (2, "run tabel1", "did you mean 'table1'?"),
    (2, "biuld", "no command is called 'biuld'; did you mean 'build'?"),
    (2, "build --bulider x", "there is no option --bulider; did you mean --builder?"),
    (2, "build --zzz x", "there is no option --zzz; `bvhbench build --help` lists them"),
    (2, "sweep --shcenes x", "there is no option --shcenes; did you mean --scenes?"),
    (2, "build --builder perfect,karras --scene soup:5 --dump d.json", "--dump writes one tree, and there are 2 builders"),
    (2, "check --builder x", "there are: perfect"),
    (3, "run mine.json", "mine.json"),
    (3, "show nothing.json", "nothing.json"),
    (3, f"{PERFECT} --device none-such", "no OpenCL device matches 'none-such'"),
    (3, f"{PERFECT} --kernels nowhere", "nowhere"),
    (3, f"{PERFECT} --json /proc/x/r.json", "cannot be written"),
    (3, "stress --quick --out /proc/no/x.json", "cannot be written"),
    (0, "--help", "reproduce"),
    (0, "help", "reproduce"),
    (0, "help sweep", "--dry-run"),
    (0, "--verbose help build", "--group-size"),
    (0, "--wide show --help", "result files"),
    (0, "build --help", "--group-size"),
    (0, "--version", "bvhbench "),
    (2, "help nosuch", "no command is called 'nosuch'; there are: list, "),
    (2, "collide --collider leaf", "--scene is required; `bvhbench help collide` says what it takes"),
    (2, "show", "FILE is required; `bvhbench help show` says what it takes"),
    (2, "build --builder Karras-2012 --scene soup:5", "did you mean one of: karras\n"),
    (2, "build --builder lbvh --scene soup:5", "did you mean one of: karras, apetrei, apetrei-fused, lbvh-levels, hploc, radix-reference\n"),
    (3, "list colliders --plugin ./nope.so", "there is no file './nope.so'"),
    (0, "list", "experiments  what"),
    (0, "list scenes", "\nsoup:"),
    (0, "list devices", "  index 0  "),
    (0, "list orders", "morton30 "),
    (0, "list experiments", "table1 "))


def test_exit_codes_and_sentences():
    for code, words, says in SENTENCES:
        expect(code, *words.split(), says=says)


def test_combinations_of_names_are_cells_of_one_run():
    cells = [(cell["scene"]["name"], cell["builder"]["name"], cell["builder"]["options"]["order"]) for cell in cells_after(
        "build", "--builder", "karras,perfect", "--order", "kd", "morton30", "--scene", "soup:0.3k", "--samples", "1")]
    assert cells == [("soup:300", builder, order) for builder in ("karras", "perfect") for order in ("kd", "morton30")], cells
    cells = [(cell["collider"]["name"], cell["builder"]["name"]) for cell in cells_after(
        "collide", "--builder", "karras,perfect", "--collider", "leaf,grid", "--scene", "soup:300", "--samples", "1")]
    assert cells == [("leaf", "karras"), ("leaf", "perfect"), ("grid", "none")], cells


def test_lists_put_the_name_first():
    known = ["perfect", "karras", "apetrei", "apetrei-fused", "lbvh-levels", "hploc", "oibvh-single", "oibvh-single-printed", "oibvh-multi", "oibvh-multi-printed",
             "oibvh-wide4", "oibvh-wide8", "oibvh-host", "oibvh-reference", "radix-reference", "hploc-reference"]
    first = [line.split()[0] for line in expect(0, "list", "builders").splitlines()]
    assert [name for name in first if name in known] == known, first  # whatever docs/adding-a-builder.md adds between them


def test_builders_with_an_order_of_their_own_make_one_tree_and_are_combined_once():
    order_of = {name: order for name, order, _ in json.loads(expect(0, "list", "builders", "--json"))}
    asked = [{"name": name, "order": order} for name in order_of for order in ("morton30", "hilbert30")]
    expect(0, "run", experiment("orders.json", scenes=["soup:300"], builders=asked, samples=1), "--out", "trees.json")
    trees = {}
    for cell in valid("trees.json")["cells"]:
        trees.setdefault(cell["builder"]["name"], set()).add(cell["check"]["tree_hash"])
    assert {name: len(hashes) for name, hashes in trees.items()} == {name: 1 + (order == "any order") for name, order in order_of.items()}
    expect(0, "build", "--builder", "karras,sah-binned", "--order", "kd,morton30", "--scene", "soup:300", "--samples", "1", "--json", "once.json")
    assert [cell["builder"]["name"] for cell in valid("once.json")["cells"]] == ["karras", "karras", "sah-binned"]


def test_what_nobody_names_is_the_fastest():
    fastest = ["group", "oibvh-multi", "hilbert30", "sorted"]  # of a processor, as the library takes it
    for words, chosen in [([], fastest), (["--builder", "karras"], ["group", "karras", "morton30", "mesh"]),
                          (["--collider", "leaf", "--order", "kd"], ["leaf", "oibvh-multi", "kd", "sorted"]),
                          (["--leaves", "mesh"], [*fastest[:3], "mesh"])]:
        said = expect(0, "collide", "--scene", "soup:300", *words, "--samples", "1", "--json", "best.json", "--force")
        builder = only("best.json")["builder"]
        assert [only("best.json")["collider"]["name"], builder["name"], builder["options"]["order"], builder["options"].get("leaves", "mesh")] == chosen
        assert "the fastest of ours on this device; --builder" in said, said


def lines_of(shown: str) -> list[str]:
    """Returns what a terminal shows line by line, with each state of the line of progress."""
    return re.split("[\r\n]+(?:\x1b\\[K)?", shown)


def night_test_a_terminal_has_narrow_lists_and_the_time_that_a_run_takes():
    for what in ("scenes", "builders", "devices", "experiments"):
        narrow, whole = lines_of(on_a_terminal("list", what)), expect(0, "list", what)
        assert max(map(len, narrow)) <= 80 < max(map(len, whole.splitlines())), narrow
        assert " ".join(narrow).replace(";", " ").split() == whole.replace(";", " ").split(), narrow  # nothing is left out
        assert lines_of(on_a_terminal("list", what, "--wide")) == whole.split("\n"), what
    shown = lines_of(on_a_terminal("collide", "--collider", "leaf", "--scene", "cloth-ball:2000:2", "--frames", "0:", "--samples", "1000",
                                   "--quiet"))
    assert max(map(len, shown)) < 80 and shown[0] == "" and shown[1] == "[1/1] cloth-ball:2000:2", shown
    assert any(re.fullmatch(r"\[1/1\] about \d+ s left: cloth-ball:2000:2, frame \d, sample \d+ of 1003", line) for line in shown), shown


def test_build_writes_a_valid_result_and_the_tree_as_it_was_asked_for():
    out = expect(0, "build", "--builder", "oibvh-multi", "--scene", "soup:300", "--samples", "4", "--leaves", "sorted",
                 "--group-size", "64", "--items", "2", "--sah-inner", "2", "--sah-triangle", "0.5", "--json", "b.json", "--dump", "d.json",
                 says="oibvh-multi, groups of 64, 2 items, sorted leaves on soup:300")
    for words in ("verdict: agrees", "costs in sah_cost and epo: an inner node 2, a triangle 0.5",
                  *(f"\n{stage} " for stage in ("bounds", "codes", "sort", "hierarchy", "all"))):
        assert words in out, (words, out)
    cell = only("b.json")
    assert len(cell["samples"]) == 4 and cell["check"]["verdict"] == "agrees"
    assert cell["builder"]["options"] == {"order": "morton30", "grid": "object", "group_size": 64, "items": 2,
                                          "leaves": "sorted", "boxes": "f32"}
    assert "gather" not in [stage["stage"] for stage in cell["samples"][0]["stages"]]
    counters = cell["counters"]
    assert counters["device_peak_bytes"] == counters["tree_bytes"] + counters["scratch_bytes"], counters
    assert set(counters) == {"nodes_count", "tree_bytes", "scratch_bytes", "device_peak_bytes", "sah_cost", "sah_inner",
                             "sah_leaf", "sibling_overlap", "depth_max", "depth_mean"}
    assert cell["left_out"] == {"epo": "not asked for: --epo"}
    assert valid("b.json")["run"]["node_costs"] == {"inner": 2, "triangle": 0.5}
    assert counters["sah_cost"] == 2 * counters["sah_inner"] + 0.5 * counters["sah_leaf"]
    nodes = json.loads(pathlib.Path("d.json").read_text())["nodes"]
    assert len(nodes) == counters["nodes_count"]
    assert sorted(n["primitive"] for n in nodes if n["primitive"] >= 0) == list(range(300))
    expect(0, "show", "b.json", says="verdict: agrees")


def test_quality_has_no_number_where_it_has_no_value():
    build = ("build", "--builder", "oibvh-multi", "--samples", "1", "--scene")
    cell, = cells_after(*build, "grid:300", "--epo", says="epo")
    assert {"epo", "epo_inner", "epo_leaf", "sibling_overlap", "sah_cost"} <= set(cell["counters"])
    assert "left_out" not in cell
    pathlib.Path("line.obj").write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 3 2 1\n")
    cell, = cells_after(*build, "line.obj", "--quality")
    assert not {"epo", "sibling_overlap", "sah_cost", "sah_inner", "sah_leaf"} & set(cell["counters"])
    assert set(cell["left_out"]) == {"epo", "sibling_overlap", "sah_cost"}
    assert cell["counters"]["depth_max"] == 1


def test_the_copy_rate_is_that_of_large_buffers_or_as_small_as_told():
    words = ("build", "--builder", "perfect", "--scene", "soup:5", "--samples", "1", "--json", "copied.json", "--force")
    for told, least, most in (("", 64 << 20, 512 << 20), ("4096", 4096, 4096)):
        expect(0, *words, BVHBENCH_COPY_BYTES=told)
        facts = valid("copied.json")["run"]
        assert least <= facts["copy_rate_buffer_bytes"] <= most and facts["copy_rate_bytes_per_s"] > 0, facts
    for wrong in ("15", "-1", "1M"):
        expect(2, *words, says=f"BVHBENCH_COPY_BYTES must be a number of bytes from 16 on, not '{wrong}'", BVHBENCH_COPY_BYTES=wrong)


def test_run_and_show_agree():
    experiment("few.json", scenes=["torus:2048", "soup:1000", "soup:1"], builders=["perfect", "karras", "oibvh-reference"], samples=2)
    pathlib.Path("folder").mkdir()
    out = expect(0, "run", "few.json", "--out", "folder/s.json", says="9 agree")
    result = valid("folder/s.json")
    assert len(result["cells"]) == 9 and "finished_at" in result["run"]
    assert result["run"]["copy_rate_bytes_per_s"] > 0 and result["run"]["compile_ns"] > 0
    for cell in result["cells"]:
        assert sum(cell["leaves_by_depth"]) == cell["scene"]["triangles"]
        assert len(cell["leaves_by_depth"]) - 1 == cell["counters"]["depth_max"]
        for counter in ("sah_cost", "sibling_overlap", "epo"):
            assert (counter in cell["counters"]) != (counter in cell["left_out"]), cell
    orders = [s["order"] for cell in result["cells"] for s in cell["samples"]]
    assert len(set(orders)) == len(orders)
    assert expect(0, "show", "folder/s.json") in out
    expect(0, "run", "few.json", "--filter", "soup:1/perfect", "--out", "f.json", says="verdict: agrees")
    assert os.listdir("folder") == ["s.json"]


def test_an_experiment_of_ones_own():
    experiment("mine.json", scenes=[{"scene": "soup:{t}", "t": {"from": 1, "to": 3}}], builders=["perfect"], stages=["hierarchy"],
               samples=2)
    cells = cells_after("run", "mine.json")
    assert [cell["scene"]["triangles"] for cell in cells] == [1, 2, 3]
    assert {s["stage"] for c in cells for m in c["samples"] for s in m["stages"]} == {"hierarchy"}
    expect(2, "run", experiment("wrong.json", scense=[]), says="'scense' is no key of an experiment")


def test_a_refit_is_timed_beside_the_rebuild_and_judged():
    experiment("moved.json", scenes=["bend:soup:700", "bend:soup:1", "soup:9"], operations=["build", "refit"], samples=3, builders=[
        "perfect", "karras", "apetrei", "apetrei-fused", "lbvh-levels", "hploc", "oibvh-single", {"name": "oibvh-multi", "leaves": "sorted"},
        "median-split"])
    out = expect(0, "run", "moved.json", "--out", "moved-out.json", says="rebuilding takes longer than refitting in ")
    assert expect(0, "show", "moved-out.json") in out
    cells = valid("moved-out.json")["cells"]
    for cell in cells:
        scene, builder, stages = cell["scene"], cell["builder"]["name"], {
            stage["stage"] for sample in cell.get("samples", []) for stage in sample["stages"]}
        if scene["name"] == "soup:9":
            assert "needs a second frame" in cell["reason"], cell
        elif builder == "median-split" and cell["operation"] == "refit":
            assert (cell["status"], cell["reason"]) == ("skipped", "median-split cannot refit"), cell
        else:
            assert (scene["frame"], scene["bend_of"]) == (1, scene["name"].removeprefix("bend:")), cell
            assert cell["check"]["verdict"] == "agrees" and len(cell["samples"]) == 3, cell
        if stages and cell["operation"] == "refit":
            assert cell["check"]["against"].endswith("-reference, refitted"), cell
            assert stages == {"bounds", "refit"} | ({"gather"} if builder == "oibvh-multi" else set()), cell
        elif stages:
            assert "hierarchy" in stages and "refit" not in stages, cell
    radix = ("karras", "apetrei", "apetrei-fused", "lbvh-levels")
    hashes = {operation: {cell["check"]["tree_hash"] for cell in cells if cell["scene"]["name"] == "bend:soup:700"
                          and cell["operation"] == operation and cell["builder"]["name"] in radix} for operation in ("build", "refit")}
    assert [len(found) for found in hashes.values()] == [1, 1] and hashes["build"] != hashes["refit"], hashes


def test_roofline_holds_stages_of_builds_and_queries_to_their_floors():
    out = expect(0, "run", "roofline", "--quick", "--samples", "2", "--out", "roofline.json", "--filter",
                 "torus:16384/(oibvh-multi|none)", says="floor: bytes at the copy rate, and launches at the launch cost")
    result = valid("roofline.json")
    assert result["run"]["launch_cost_ns"] > 0
    assert {cell["operation"] for cell in result["cells"]} == {"build", "collide"}
    rows = [line.split() for line in out.splitlines() if line.startswith("torus:16384 ") and line.split()[-2] in ("us", "ms")]
    assert len(rows) > 10 and all(float(row[-1]) > 0 for row in rows), rows
    for cell in result["cells"]:
        stages = {stage["stage"]: stage for stage in cell["samples"][0]["stages"]}
        if "broad" not in stages or cell["builder"]["name"] == "none":
            continue
        triangles, counters = cell["scene"]["triangles"], cell["counters"]
        read = (2 * triangles - 1) * 24 + 4 * triangles
        cleared = stages["broad"]["moved_bytes"] - read - 8 * counters["pairs_count"]
        assert 0 < cleared < 1024, (stages["broad"], counters)
        corners = stages["narrow"]["moved_bytes"] - 8 * (counters["pairs_count"] + counters["contacts_count"])
        assert 12000 < corners < 12 * (triangles + cell["scene"]["vertices"]) + 1024, (stages["narrow"], counters)
    assert "floor: " in expect(0, "show", "roofline.json")


def test_check_finds_no_violation():
    expect(0, "check", "--builder", "oibvh-single", "--scene", "soup:1000", says="no violation")


def night_test_stress_is_the_same_for_the_same_seed_and_shows_what_libraries_get_wrong():
    words = ("stress", "--quick", "--filter", "^scale/1e20/(oibvh-multi|leaf over karras|rtcCollide|FCL AABB)")
    for seed, path in (("3", "stress.json"), ("3", "again.json"), ("4", "other.json")):
        expect(0, *words, "--seed", seed, "--out", path, says="cells of ours, all right")
    cells = valid("stress.json")["stress"]
    assert cells == valid("again.json")["stress"] != valid("other.json")["stress"]
    systems = {cell["system"]: cell["findings"] for cell in cells}
    assert systems["leaf over karras"]["pairs"]["checked"] > 100
    if "rtcCollide" in systems:  # 1e20 is beyond Embree's range, and it drops everything silently
        lost = systems["rtcCollide"]["pairs"]
        assert lost["verdict"] == "broken" and 0 < lost["missed"] == lost["wrong"] <= lost["checked"], lost
    assert expect(0, "show", "stress.json").splitlines()[-1].endswith("cells of ours, all right")


sys.exit(main(globals()))
