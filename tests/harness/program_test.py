#!/usr/bin/env python3
"""Run the program and hold it to its exit codes, its output and the result schema.

Usage: program_test.py <bvhbench> <result schema>
"""
import array
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

try:
    import jsonschema
except ImportError:
    jsonschema = None

PROGRAM, SCHEMA = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()


def run(*words: str, **environment: str) -> subprocess.CompletedProcess:
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=300,
                          env={**os.environ, **environment})


def expect(code: int, *words: str, says: str = "", **environment: str) -> str:
    """The program's standard output; an error is one line on stderr that contains `says`."""
    done = run(*words, **environment)
    assert done.returncode == code, (words, done)
    assert says in (done.stderr if code else done.stdout), (words, done)
    if code in (2, 3):
        assert done.stderr.startswith("bvhbench: ") and done.stderr.count("\n") == 1, done.stderr
    return done.stdout


def valid(path: str) -> dict:
    text = pathlib.Path(path).read_text()
    assert "NaN" not in text
    result = json.loads(text)
    if jsonschema:
        jsonschema.validate(result, json.loads(SCHEMA.read_text()))
    return result


def test_memory_that_will_not_do_is_told_before_it_is_taken():
    build = ("build", "--builder", "oibvh-multi", "--scene", "torus:500000", "--samples", "1", "--memory-limit")
    expect(3, *build, "1M", says="scene 'torus:500000' takes about 8 MiB of memory, and the limit is 1")
    expect(3, *build, "60M", says="out of host memory: checking the tree takes about 204000000 bytes, and the host "
                                  "gives 62914560")
    expect(0, *build, "1G", says="agrees")
    expect(2, *build, "much", says="--memory-limit")
    pathlib.Path("memory.json").write_text(json.dumps({
        "experiment": "memory", "question": "?", "scenes": ["torus:115000", "torus:1000"],
        "builders": ["oibvh-multi", "perfect", "karras", "sah-binned", "oibvh-single",
                     {"name": "oibvh-wide8", "order": "morton63"}, {"name": "apetrei", "order": "morton63"}],
        "samples": 1, "warm_up": 0}))
    expect(0, "run", "memory.json", "--memory-limit", "48M", "--out", "memory-out.json", says="14 cells, 13 agree")
    cells = {(cell["scene"]["name"], cell["builder"]["name"]): cell for cell in valid("memory-out.json")["cells"]}
    # There is room beside the scene for some trees, for no more of that size with so much scratch, and for what is small.
    failed = cells["torus:115000", "apetrei"]
    assert failed["status"] == "failed" and "out of device memory: " in failed["reason"], failed
    assert " taken, " in failed["reason"] and failed["reason"].endswith(" gives 50331648"), failed
    assert all(cell["status"] == "measured" for cell in cells.values() if cell is not failed), cells


def kernels_compiled(folder: pathlib.Path, *words: str) -> int:
    """How many kernels PoCL compiles into an empty cache for a build; a second one must find all of them there."""
    build = ("build", "--scene", "torus:2000", "--samples", "2", *words)
    expect(0, *build, says="agrees", POCL_CACHE_DIR=str(folder))
    compiled = {path.name for path in folder.rglob("*.so")}
    expect(0, *build, says="agrees", POCL_CACHE_DIR=str(folder))
    again = {path.name for path in folder.rglob("*.so")}
    assert again == compiled, again - compiled
    return len(compiled)


def test_a_build_compiles_the_kernels_that_it_launches_and_no_others():
    # The copy rate 1, an empty launch 1, bounds 2, codes 1, the sort 3; and then the tree's own. Each takes PoCL a tenth of a second or so.
    # Their texts are as many programs, of which each costs as much again.
    for most, texts, *words in ((10, 5, "--builder", "oibvh-multi"),
                                (10, 5, "--builder", "oibvh-multi", "--order", "hilbert63"),
                                (10, 6, "--builder", "oibvh-multi", "--leaves", "sorted"),
                                (8, 4, "--builder", "oibvh-host"), (9, 5, "--builder", "apetrei-fused"),
                                (9, 6, "--builder", "oibvh-multi", "--order", "kd"),
                                (2, 1, "--builder", "median-split")):
        folder = pathlib.Path("pocl-" + "-".join(words[1:]))
        folder.mkdir()
        compiled = kernels_compiled(folder, *words)
        assert 1 <= compiled <= most, (words, compiled)
        programs = len(list(folder.rglob("program.bc")))
        assert 1 <= programs <= texts, (words, programs)


def test_exit_codes():
    expect(2, says="name a command: list, build")
    expect(2, "paint", says="paint")
    expect(2, "list", "colours", says="there are: builders, colliders, orders, skips, tuning, scenes, devices, experiments")
    expect(2, "build", "--builder", "x", "--scene", "soup:5", says="there are: perfect, ")
    expect(2, "build", "--builder", "perfect", "--scene", "no-such", says="no-such")
    expect(2, "build", "--builder", "perfect", "--scene", "soup:5", "--order", "x",
           says="there are: morton30")
    expect(2, "collide", "--builder", "perfect", "--collider", "x", "--scene", "soup:5", says="there are: leaf, ")
    expect(2, "collide", "--builder", "perfect", "--collider", "leaf", "--scene", "soup:5", "--pairs", "p.txt",
           says="to .csv or .bin")
    expect(2, "collide", "--builder", "median-split", "--collider", "leaf", "--scene", "soup:5",
           says="leaf needs a tree in device memory")
    expect(2, "run", "tabel1", says="there are: table1, table4, fig8, fig13, peers, quality")
    expect(2, "run", "smoke", "--filter", "[", says="no regular expression")
    expect(2, "check", "--builder", "x", says="there are: perfect")
    for value in ("nan", "-1", "many"):
        expect(2, "build", "--builder", "perfect", "--scene", "soup:5", "--sah-inner", value,
               says=f"--sah-inner: must be a number from 0 to 1000000, not '{value}'")
    expect(3, "run", "mine.json", says="mine.json")
    expect(3, "show", "nothing.json", says="nothing.json")
    expect(3, "build", "--builder", "perfect", "--scene", "soup:5", "--device", "no such device",
           says="no OpenCL device matches 'no such device'")
    expect(3, "build", "--builder", "perfect", "--scene", "soup:5", "--kernels", "nowhere",
           says="nowhere")
    expect(3, "build", "--builder", "perfect", "--scene", "soup:5", "--json", "/proc/x/r.json",
           says="cannot be written")
    expect(0, "--help", says="reproduce")
    expect(0, "build", "--help", says="--group-size")
    expect(0, "--version", says="bvhbench ")


def test_lists_put_the_name_first():
    first = [line.split()[0] for line in expect(0, "list", "builders").splitlines()]
    assert first[:13] == ["perfect", "karras", "apetrei", "apetrei-fused", "lbvh-levels", "oibvh-single",
                          "oibvh-multi", "oibvh-wide4", "oibvh-wide8", "oibvh-wide8-q8", "oibvh-host", "oibvh-reference",
                          "radix-reference"], first
    assert expect(0, "list", "orders").startswith("morton30 ")
    expect(0, "list", "scenes", says="\nsoup:")
    assert expect(0, "list", "experiments").startswith("table1 ")
    expect(0, "list", "devices", says="  index 0  ")


def test_build_writes_a_valid_result_and_the_tree():
    out = expect(0, "build", "--builder", "oibvh-multi", "--scene", "soup:300", "--samples", "4",
                 "--json", "b.json", "--dump", "d.json", says="verdict: agrees")
    for stage in ("bounds", "codes", "sort", "hierarchy", "all"):
        assert f"\n{stage} " in out, out
    cell, = valid("b.json")["cells"]
    assert len(cell["samples"]) == 4 and cell["check"]["verdict"] == "agrees"
    assert set(cell["counters"]) == {"nodes_count", "tree_bytes", "scratch_bytes", "sah_cost", "sah_inner",
                                     "sah_leaf", "sibling_overlap", "depth_max", "depth_mean"}
    assert cell["left_out"] == {"epo": "not asked for: --epo"}
    nodes = json.loads(pathlib.Path("d.json").read_text())["nodes"]
    assert len(nodes) == cell["counters"]["nodes_count"]
    assert sorted(n["primitive"] for n in nodes if n["primitive"] >= 0) == list(range(300))
    expect(0, "show", "b.json", says="verdict: agrees")


def test_collide_writes_a_valid_result_and_the_pairs():
    common = ("--scene", "sphere:700", "--samples", "3")
    hashes = set()
    listed = expect(0, "list", "colliders").splitlines()
    present = [line.split()[0] for line in listed if "built without" not in line]
    for collider in [name for name in present if not name.startswith("fcl")]:  # which finds contacts instead
        for builder in ("oibvh-multi", "karras"):
            if (builder, collider) == ("karras", "block"):
                expect(2, "collide", "--builder", builder, "--collider", collider, *common,
                       says="block needs a binary implicit tree")
                continue
            out = expect(0, "collide", "--builder", builder, "--collider", collider, *common, "--json", "c.json",
                         "--pairs", "p.csv", says="verdict: agrees with brute, pairs ")
            cell, = valid("c.json")["cells"]
            assert cell["operation"] == "collide" and cell["collider"]["name"] == collider, cell
            has_tree = cell["builder"]["name"] != "none"
            assert has_tree == (collider not in ("grid", "brute", "embree")), cell
            assert "\nbroad " in out and (not has_tree or "\nhierarchy " in out), out
            lines = pathlib.Path("p.csv").read_text().splitlines()
            assert lines[0] == "a,b" and len(lines) == 1 + cell["counters"]["pairs_count"]
            assert cell["counters"]["pairs_count"] > 700, cell
            hashes.add(cell["check"]["pairs_hash"])
            expect(0, "show", "c.json", says=f"{collider} over {builder}" if has_tree else f"{collider} on sphere")
    assert len(hashes) == 1, hashes
    expect(0, "collide", "--builder", "perfect", "--collider", "leaf", *common, "--pairs", "p.bin", "--json", "c.json")
    words = array.array("I", pathlib.Path("p.bin").read_bytes())
    assert [f"{a},{b}" for a, b in zip(words[::2], words[1::2])] == lines[1:]
    expect(0, "collide", "--builder", "perfect", "--collider", "leaf", *common, "--adjacent", "drop", "--json", "d.json",
           says="leaf, adjacent dropped over perfect on sphere:700")
    dropped, = valid("d.json")["cells"]
    assert dropped["counters"]["pairs_count"] < len(lines) - 1


def test_collide_goes_through_frames_and_objects_to_contacts():
    common = ("--scene", "n-body:6100:3", "--samples", "2", "--adjacent", "drop", "--narrow", "exact")
    expect(0, "collide", "--collider", "leaf", *common, "--frames", "1:", "--between", "1", "--json", "b.json")
    assert [cell["scene"]["frame"] for cell in valid("b.json")["cells"]] == [1, 2, 3, 4]
    shown = expect(0, "collide", "--collider", "group", *common, "--pairs-of", "between", "--frames", "0:",
           "--json", "f.json", "--pairs", "p.csv", "--contacts", "k.csv", "--skips", says="skips:")
    cells = valid("f.json")["cells"]
    assert {cell["scene"]["frame"] for cell in cells} == {0, 1, 2}, cells
    assert {cell["scene"]["objects"] for cell in cells} == {305}
    assert all(cell["check"]["verdict"] == "agrees" for cell in cells), cells
    last = [cell for cell in cells if cell["scene"]["frame"] == 2]
    assert len({cell["check"]["contacts_hash"] for cell in last}) == 1
    assert any(cell["counters"]["refitted_objects_count"] > 1 for cell in last), last
    assert any(cell["counters"]["rebuilt_objects_count"] > 1 and "rigid" in cell["collider"]["options"]["no_skip"]
               for cell in last), last
    for cell in cells:  # in the last frame more than half of the triangles are near
        near = cell["scene"]["frame"] < 2 and cell["collider"]["options"]["no_skip"] != "near"
        assert near == ("entered_count" in cell["counters"]), cell
        assert near == any(stage["stage"] == "near" for stage in cell["samples"][0]["stages"]), cell
        assert not near or 0 < cell["counters"]["entered_count"] < cell["scene"]["triangles"] / 2, cell
    rows = [line.split() for line in shown.splitlines() if line.split()[2:3] == ["near"]]
    assert [int(row[3].replace(",", "")) > 3050 for row in rows] == [True, True, False], shown
    expect(0, "collide", "--collider", "leaf", *common, "--pairs-of", "between", "--no-skip", "near", "--json", "n.json")
    whole, = valid("n.json")["cells"]
    assert whole["collider"]["options"]["no_skip"] == "near" and "entered_count" not in whole["counters"], whole
    assert whole["check"]["contacts_hash"] == next(cell for cell in cells if cell["scene"]["frame"] == 0)["check"]["contacts_hash"]
    pairs, contacts = (pathlib.Path(name).read_text().splitlines() for name in ("p.csv", "k.csv"))
    assert set(contacts[1:]) <= set(pairs[1:]) and len(contacts) - 1 == last[0]["counters"]["contacts_count"]
    one = expect(0, "collide", "--collider", "leaf", *common, "--objects", "one", "--json", "o.json",
                 says="verdict: agrees with brute, CGAL")
    assert "tasks_count" not in one
    whole, = valid("o.json")["cells"]
    assert whole["scene"]["objects"] == 1
    expect(2, "collide", "--collider", "leaf", *common, "--frames", "2:9", says="has frames 0 to 2, not 2 to before 9")
    expect(2, "collide", "--collider", "leaf", *common, "--no-skip", "lunch", says="there are: unchanged, rigid, ")
    expect(2, "collide", "--collider", "leaf", "--scene", "soup:9", "--contacts", "k.csv", says="--narrow exact")
    expect(2, "collide", "--collider", "leaf", "--scene", "soup:9", "--order", "kd", "--objects", "components",
           says="order kd lines up one object, not 9")


def test_collide_numbers_pairs_as_the_file_does_whatever_its_objects_are():
    corners = [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (4, 0), (4, 4 - z), (0, 4))]
    faces = [(1, 2, 3), (5, 6, 7), (1, 3, 4), (5, 7, 8)]  # of two squares in turns
    pathlib.Path("turns.obj").write_text("".join(f"v {x} {y} {0.5 * z * x}\n" for x, y, z in corners)
                                         + "".join(f"f {a} {b} {c}\n" for a, b, c in faces))
    for objects in ("one", "components"):
        expect(0, "collide", "--collider", "leaf", "--scene", "turns.obj", "--objects", objects, "--samples", "1",
               "--narrow", "exact", "--pairs", f"{objects}.csv", "--contacts", f"{objects}-contacts.csv")
    for name in (".csv", "-contacts.csv"):
        one, components = (pathlib.Path(objects + name).read_text() for objects in ("one", "components"))
        assert one == components and len(one.splitlines()) > 2, (name, one, components)


def test_quality_has_no_number_where_it_has_no_value():
    expect(0, "build", "--builder", "oibvh-multi", "--scene", "grid:300", "--samples", "1", "--epo",
           "--json", "q.json", says="epo")
    cell, = valid("q.json")["cells"]
    assert {"epo", "epo_inner", "epo_leaf", "sibling_overlap", "sah_cost"} <= set(cell["counters"])
    assert "left_out" not in cell
    pathlib.Path("line.obj").write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 3 2 1\n")
    expect(0, "build", "--builder", "oibvh-multi", "--scene", "line.obj", "--samples", "1", "--quality",
           "--json", "q.json")
    cell, = valid("q.json")["cells"]
    assert not {"epo", "sibling_overlap", "sah_cost", "sah_inner", "sah_leaf"} & set(cell["counters"])
    assert set(cell["left_out"]) == {"epo", "sibling_overlap", "sah_cost"}
    assert cell["counters"]["depth_max"] == 1


def test_costs_reach_the_file():
    expect(0, "build", "--builder", "oibvh-multi", "--scene", "soup:300", "--samples", "1", "--sah-inner", "2",
           "--sah-triangle", "0.5", "--json", "c.json", says="costs in sah_cost and epo: an inner node 2, a triangle 0.5")
    result = valid("c.json")
    assert result["run"]["node_costs"] == {"inner": 2, "triangle": 0.5}
    counters = result["cells"][0]["counters"]
    assert counters["sah_cost"] == 2 * counters["sah_inner"] + 0.5 * counters["sah_leaf"]


def test_options_reach_the_builder():
    expect(0, "build", "--builder", "oibvh-multi", "--scene", "soup:300", "--leaves", "sorted",
           "--group-size", "64", "--items", "2", "--samples", "2", "--json", "o.json",
           says="oibvh-multi, groups of 64, 2 items, sorted leaves on soup:300")
    cell, = valid("o.json")["cells"]
    assert cell["builder"]["options"] == {"order": "morton30", "group_size": 64, "items": 2,
                                          "leaves": "sorted"}
    assert "gather" in [stage["stage"] for stage in cell["samples"][0]["stages"]]


def test_run_and_show_agree():
    out = expect(0, "run", "smoke", "--samples", "2", "--out", "folder/s.json", says="27 agree")
    result = valid("folder/s.json")
    assert len(result["cells"]) == 27 and "finished_at" in result["run"]
    assert result["run"]["copy_rate_bytes_per_s"] > 0 and result["run"]["compile_ns"] > 0
    for cell in result["cells"]:
        assert sum(cell["leaves_by_depth"]) == cell["scene"]["triangles"]
        assert len(cell["leaves_by_depth"]) - 1 == cell["counters"]["depth_max"]
        for counter in ("sah_cost", "sibling_overlap", "epo"):
            assert (counter in cell["counters"]) != (counter in cell["left_out"]), cell
    orders = [s["order"] for cell in result["cells"] for s in cell["samples"]]
    assert len(set(orders)) == len(orders)
    assert expect(0, "show", "folder/s.json") in out
    expect(0, "run", "smoke", "--filter", "soup:1/perfect", "--out", "f.json", says="1 cells, 1 agree")
    assert os.listdir("folder") == ["s.json"]


def test_an_experiment_of_ones_own():
    pathlib.Path("mine.json").write_text(json.dumps({
        "experiment": "mine", "scenes": [{"scene": "soup:{t}", "t": {"from": 1, "to": 3}}],
        "builders": ["perfect"], "stages": ["hierarchy"], "samples": 2, "warm_up": 0}))
    expect(0, "run", "mine.json", "--out", "m.json")
    cells = valid("m.json")["cells"]
    assert [cell["scene"]["triangles"] for cell in cells] == [1, 2, 3]
    assert {s["stage"] for c in cells for m in c["samples"] for s in m["stages"]} == {"hierarchy"}
    pathlib.Path("wrong.json").write_text('{"experiment": "a", "scense": []}')
    expect(2, "run", "wrong.json", says="'scense' is no key of an experiment")


def test_a_refit_is_timed_beside_the_rebuild_and_judged():
    pathlib.Path("moved.json").write_text(json.dumps({
        "experiment": "moved", "scenes": ["bend:soup:700", "bend:soup:1", "soup:9"],
        "builders": ["perfect", "karras", "apetrei", "apetrei-fused", "lbvh-levels", "oibvh-single",
                     {"name": "oibvh-multi", "leaves": "sorted"}, "median-split"],
        "operations": ["build", "refit"], "samples": 3, "warm_up": 1}))
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
    hashes = {(c["scene"]["name"], c["builder"]["name"], c["operation"]): c["check"]["tree_hash"]
              for c in cells if c["status"] == "measured"}
    radix = ("karras", "apetrei", "apetrei-fused", "lbvh-levels")
    for operation in ("build", "refit"):
        assert len({hashes["bend:soup:700", name, operation] for name in radix}) == 1, hashes
    assert hashes["bend:soup:700", "karras", "build"] != hashes["bend:soup:700", "karras", "refit"], hashes


def test_a_stopped_run_keeps_its_finished_cells():
    pathlib.Path("long.json").write_text(json.dumps({
        "experiment": "long", "scenes": [{"scene": "soup:{t}", "t": {"from": 1, "to": 100000}}],
        "builders": ["perfect"], "samples": 1, "warm_up": 0}))
    for sent, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGKILL, -9)):
        path = pathlib.Path(f"stopped{code}.json")
        with subprocess.Popen([PROGRAM, "run", "long.json", "--out", str(path)],
                              stderr=subprocess.PIPE, text=True) as process:
            for _ in range(600):
                time.sleep(0.1)
                if path.exists():
                    break
            time.sleep(0.3)
            process.send_signal(sent)
            assert process.wait(60) == code, (process.returncode, process.stderr.read())
        result = valid(str(path))
        assert result["cells"] and "finished_at" not in result["run"]


def tuned_file(folder: str, **values: int) -> pathlib.Path:
    """A tuning file of the device there is, in a folder."""
    device = expect(0, "list", "devices").splitlines()[0].split("  ")[0].split("/", 1)[1]
    slug = "-".join(filter(None, "".join(c if c.isascii() and c.isalnum() else " " for c in device.lower()).split(" ")))
    path = pathlib.Path(folder, f"{slug}.json")
    path.parent.mkdir(exist_ok=True)
    path.write_text(json.dumps({"format": "tuning 1", "device": device, "values": {
        name.replace("__", "."): {"value": value} for name, value in values.items()}}))
    return path


def test_tune_searches_checks_and_writes_what_is_then_used():
    tune = ("tune", "--scene", "torus:2000", "--quick", "--samples", "3", "--out", "tuned/t.json")
    for target, parameter in (("sort", "sort.chunk_digit_bits"), ("oibvh-multi", "chunks.per_core"),
                              ("leaf", "walk.task_leaves")):
        out = expect(0, *tune, target, says=f"tuned: {target} over torus:2000")
        assert f"\n{parameter} " in out and " current\n" in out, out
        file = json.loads(pathlib.Path("tuned/t.json").read_text())
        assert set(file) == {"format", "device", "driver", "values"}, file
        kept = {line.split()[0] for line in out.splitlines() if line.endswith("better, kept")}
        assert {name for name in file["values"] if file["values"][name]["target"] == target} <= kept, (file, out)
    expect(2, *tune, "sotr", says="nothing that could be tuned is called 'sotr'; there are: sort, perfect, ")
    expect(2, *tune, "median-split", says="there is nothing to tune")
    expect(2, "tune", "sort", says="--scene is required")
    expect(2, *tune, "sort", "--samples", "2", says="--samples")


def test_tuned_values_are_used_named_and_turned_off():
    path = tuned_file("mine", sort__chunk_digit_bits=11, chunks__per_core=2)
    build = ("build", "--builder", "oibvh-multi", "--scene", "soup:3000", "--samples", "1", "--json", "t.json")

    def launches(*words: str, **environment: str) -> tuple[int, dict]:
        expect(0, *build, *words, says="verdict: agrees", **environment)
        result = valid("t.json")
        stages = result["cells"][0]["samples"][0]["stages"]
        return next(s["launches"] for s in stages if s["stage"] == "sort"), result["run"]["tuning"]

    values = {"chunks.per_core": 2, "sort.chunk_digit_bits": 11}
    assert launches("--tuning", "mine") == (9, {"from": str(path), "values": values})
    assert launches(BVHBENCH_TUNING="mine") == (9, {"from": str(path), "values": values})
    none = (12, {"from": "none", "values": {}})
    assert launches("--tuning", "", BVHBENCH_TUNING="mine") == none
    assert launches(BVHBENCH_TUNING="") == none
    shown = expect(0, "list", "tuning", "--tuning", "mine")
    row = next(line for line in shown.splitlines() if line.startswith("sort.chunk_digit_bits "))
    assert row.split()[1:3] == ["11", str(path)], row
    rest = [line.split()[2] for line in shown.splitlines() if line.split()[0] not in values]
    assert set(rest) == {"default"} and len(rest) > 30, rest
    expect(0, *build, "--tuning", "mine", says="tuned by mine/")


def test_tuning_files_that_cannot_be_end_with_a_sentence():
    build = ("build", "--builder", "oibvh-multi", "--scene", "soup:30", "--samples", "1", "--tuning")
    expect(3, *build, "nowhere", says="tuning: there is no folder 'nowhere'")
    path = tuned_file("bad", sort__keys_per_item=4)
    expect(3, *build, "bad", says=f"{path}: sort.keys_per_item must be odd, not 4")
    expect(3, "tune", "sort", "--scene", "soup:30", "--out", str(path), says="must be odd")
    tuned_file("bad", sort__speed=1)
    expect(3, *build, "bad", says="no parameter is called 'sort.speed'")
    path.write_text("{")
    expect(3, *build, "bad", says=f"{path}: ")
    path.write_text(json.dumps({"format": "tuning 1", "device": "another", "values": {"chunks.per_core": {"value": 2}}}))
    expect(3, *build, "bad", says="its values are of 'another', and the device is '")


def test_a_stopped_search_keeps_what_it_has_found():
    with subprocess.Popen([PROGRAM, "tune", "oibvh-multi", "--scene", "torus:20000", "--samples", "2000", "--out",
                           "stopped.json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        time.sleep(4)
        process.send_signal(signal.SIGINT)
        out, error = process.communicate(timeout=60)
    assert process.returncode == 130 and "stopped" in error, (process.returncode, error)
    assert out.startswith("tuned: oibvh-multi over torus:20000"), out
    assert json.loads(pathlib.Path("stopped.json").read_text())["format"] == "tuning 1"


def test_roofline_holds_stages_of_builds_and_queries_to_their_floors():
    out = expect(0, "run", "roofline", "--quick", "--samples", "2", "--out", "roofline.json", "--filter",
                 "torus:16384/(oibvh-multi|none)", says="floor: bytes at the copy rate, and launches at the launch cost")
    result = valid("roofline.json")
    assert result["run"]["launch_cost_ns"] > 0
    assert {cell["operation"] for cell in result["cells"]} == {"build", "collide"}
    rows = [line.split() for line in out.splitlines() if line.startswith("torus:16384 ") and line.split()[-2] in ("us", "ms")]
    assert len(rows) > 10 and all(float(row[-1]) > 0.2 for row in rows), rows
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


def test_check_finds_every_promise_kept():
    expect(0, "check", "--builder", "oibvh-single", "--scene", "soup:1000",
           says="every promise is kept")


def test_pocl_keeps_its_cache_with_us():
    expect(0, "list", "devices", XDG_CACHE_HOME=os.getcwd() + "/cache", POCL_CACHE_DIR="")
    assert pathlib.Path("cache/bvhbench/pocl").is_dir()
    left = pathlib.Path("cache/bvhbench/pocl/tempfile_old")
    left.touch()
    os.utime(left, (0, 0))
    expect(0, "list", "devices", XDG_CACHE_HOME=os.getcwd() + "/cache", POCL_CACHE_DIR="")
    assert not left.exists()


def main() -> int:
    tests = [value for name, value in globals().items() if name.startswith("test_")]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for test in tests:
            test()
            print("passed:", test.__name__.removeprefix("test_").replace("_", " "))
        os.chdir("/")
    if not jsonschema:
        print("not held to the schema: there is no jsonschema for this Python")
    return 0


if __name__ == "__main__":
    sys.exit(main())
