#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests `cluster`: its lists, its file, its messages, and what is left when a rank is lost.

CLUSTER_KILLS says how often ranks are killed; 3 if not set.
"""
import contextlib
import json
import os
import pathlib
import signal
import subprocess
import sys
import time
import uuid

from program import ALL_CASES, PATIENCE_S, PROGRAM, SOURCE, at_work, copied_kernels, expect, main, run, small_disk, valid, wait_until

SHARED = ("--share-devices", "--force")
UNNAMED = ", and so were the others; mpirun does not say which\n"  # of a rank that is lost while it starts
HUNG = "bvhbench: mpirun or a rank ended, the others did not within 60 s, and all were ended\n"  # Open MPI, if one is lost as ranks connect
STAGES = ("partition", "build", "boxes", "select", "exchange", "self", "halo", "narrow", "gathering", "verdict")


def results(path: str) -> list[dict]:
    """Returns the cells of a result file, each with what it says of its ranks among its other keys."""
    return [cell | cell["cluster"] for cell in valid(path)["cells"]]


def result(path: str) -> dict:
    """Returns the only cell."""
    cell, = results(path)
    return cell


def processes_of(mark: str) -> list[tuple[int, str]]:
    """Returns the processes whose environment has the mark: their numbers and ranks."""
    found = []
    for entry in pathlib.Path("/proc").glob("[0-9]*"):
        words = []
        with contextlib.suppress(OSError):  # it has ended, or is another user's
            words = (entry / "environ").read_bytes().split(b"\0")
        if mark.encode() in words:
            rank = next((word.split(b"=")[1] for word in words if word.startswith(b"OMPI_COMM_WORLD_RANK=")), b"")
            found.append((int(entry.name), rank.decode()))
    return found


def begun(environment: dict[str, str], *words: str) -> tuple[subprocess.Popen, str]:
    """Starts two ranks, whose processes have the returned mark in their environment."""
    mark = f"CLUSTER_TEST={uuid.uuid4().hex}"
    return subprocess.Popen([PROGRAM, "cluster", *words, "--ranks", "2", "--share-devices"], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True, env={**os.environ, **environment, **dict([mark.split("=")])}), mark


def started(seconds: float, *words: str) -> tuple[subprocess.Popen, str]:
    """Starts ranks over frames that take long; returns when both have run for a while."""
    child, mark = begun({}, "torus:100000", "--samples", "5000", *words)
    wait_until(lambda: child.poll() is not None or {"0", "1"} <= {rank for _, rank in processes_of(mark)})
    time.sleep(seconds)  # only chooses where the signal strikes
    return child, mark


def ended(child: subprocess.Popen, mark: str) -> str:
    """Returns what the program said at its end, after which none of its processes may be left."""
    try:
        _, errors = child.communicate(timeout=PATIENCE_S)
        wait_until(lambda: not processes_of(mark))
    finally:
        for process, _ in processes_of(mark):
            os.kill(process, signal.SIGKILL)
    return errors


def with_mpirun(name: str, *lines: str) -> dict[str, str]:
    """Returns an environment in which mpirun is a script of these lines."""
    pathlib.Path(name).mkdir()
    mpirun = pathlib.Path(name, "mpirun")
    mpirun.write_text("".join(line + "\n" for line in ("#!/bin/sh", *lines)))
    mpirun.chmod(0o755)
    return {"PATH": f"{mpirun.parent.resolve()}:{os.environ['PATH']}"}


def night_test_an_mpirun_that_hangs_is_ended():
    deaf = "trap '' TERM"
    # Ranks that wait for their plan, without work for the processor, and end when it is empty.
    ranks = ("mkfifo $0.json", *[f"{PROGRAM} run $0.json >/dev/null 2>&1 &"] * 2, "sleep 10", ": >$0.json")
    hung = {"starts none": (3, "mpirun started 0 of 2 ranks within 30 s", with_mpirun("none", deaf, "sleep 1000")),
            "ends none": (4, "mpirun or a rank ended, the others did not within 30 s", with_mpirun("both", deaf, *ranks, "sleep 1000")),
            "says why": (4, "others did not within 30 s", with_mpirun("why", deaf, "echo bvhbench: rank 1 said why >&2", *ranks, "sleep 1000"))}
    begins = {name: begun(environment, "torus:2000", "--time-limit", "20") for name, (_, _, environment) in hung.items()}
    stopped, mark = begun(with_mpirun("deaf", deaf, "sleep 1000", "sleep 1000"), "torus:2000")
    wait_until(lambda: any(pathlib.Path(f"/proc/{process}/comm").read_text() == "sleep\n" for process, _ in processes_of(mark)))
    stopped.send_signal(signal.SIGTERM)
    assert ended(stopped, mark) == "bvhbench: stopped\n" and stopped.returncode == 143, stopped.returncode
    for name, (child, mark) in begins.items():
        code, says, _ = hung[name]
        errors = ended(child, mark)
        assert child.returncode == code and says in errors and errors.count("\n") == 1, (name, child.returncode, errors)
        assert ("rank 1 said why" in errors) == (name == "says why"), errors


def test_lists_are_those_of_collide():
    scenes = ["torus:20000", "n-body:6100:2"]
    if os.environ.get("BVHBENCH_DATA") and ALL_CASES:
        scenes.append("bunny_69451")
    ways = (("2", "rcb", "oibvh-multi"), ("3", "curve", "karras"))
    for scene in scenes:
        expect(0, "collide", "--collider", "leaf", "--scene", scene, "--objects", "one", "--pairs", "one.csv", "--force", "--samples", "1")
        wanted = pathlib.Path("one.csv").read_text()
        hashes = set()
        assert wanted.count("\n") > 1000
        for ranks, partition, builder in ways if ALL_CASES or scene == scenes[0] else ways[1:]:
            out = expect(0, "cluster", scene, "--ranks", ranks, "--partition", partition, "--builder", builder, *SHARED,
                         "--samples", "1", "--pairs", "c.csv", "--json", "c.json", says="verdict: agrees with one device")
            assert pathlib.Path("c.csv").read_text() == wanted, (scene, ranks)
            assert "clock" not in out and "ranks shared a device: there are no times" in out, out
            document = result("c.json")
            assert document["pairs_count"] == wanted.count("\n") - 1
            hashes.add(document["pairs_set_hash"])
            rows = document["ranks"]
            assert len(rows) == int(ranks) and all(row["samples"] == [] for row in rows)
            assert sum(row["triangles"] for row in rows) == document["scene"]["triangles"]
            assert sum(row["own_pairs_count"] + row["halo_pairs_count"] for row in rows) == document["pairs_count"]
            sent = sum(row["halo_sent_count"] for row in rows)
            assert sent == sum(row["halo_received_count"] for row in rows) > 0
            assert len(hashes) == 1
            assert abs(document["halo_share"] - sent / document["scene"]["triangles"]) < 1e-9


def night_test_contacts_and_pairs_within_a_distance_are_those_of_collide():
    for asked in (("--narrow", "exact"), ("--within", "1%")):
        narrow = (*asked, "--adjacent", "drop", "--samples", "1", "--force")
        expect(0, "collide", "--collider", "leaf", "--scene", "soup:5000", *narrow, "--contacts", "k1.csv")
        expect(0, "cluster", "soup:5000", "--ranks", "3", "--share-devices", *narrow, "--contacts", "kc.csv", "--json", "kc.json",
               says="agrees with one device")
        assert pathlib.Path("kc.csv").read_text() == pathlib.Path("k1.csv").read_text()
        document = result("kc.json")
        assert document["contacts_count"] == sum(row["contacts_count"] for row in document["ranks"]) > 100
        assert document["check"]["contacts_hash"] and ("within_distance" in document) == (asked[0] == "--within")
    words = ("cluster", "cloth-ball:3000:6", "--ranks", "2", *SHARED, "--within", "1%", "--adjacent", "drop")
    expect(0, *words, "--frames", "0:2", "--json", "k.json", says="agrees with one device")
    assert len({frame["contacts_count"] for frame in result("k.json")["frames"]}) == 2
    expect(0, *words, "--check", "partitions", says="agrees with the other partition")
    expect(2, *words[:2], "--simulate", "2", "--within", "1%", says="what ranks would send is counted for overlapping boxes")


def test_frames_keep_their_parts_until_work_is_uneven():
    words = ("cluster", "cloth-ball:3000:6", "--ranks", "2", *SHARED, "--narrow", "exact", "--adjacent", "drop", "--json", "f.json")
    expect(0, *words, "--frames", "0:", "--rebalance", "1000", says="agrees with one device")
    kept = result("f.json")
    expect(0, *words, "--frames", "0:6", "--rebalance", "1", says="agrees with one device")
    cut = result("f.json")
    assert [frame["frame"] for frame in kept["frames"]] == list(range(6))
    assert all(frame["moved_count"] == 0 for frame in kept["frames"])
    assert sum(frame["moved_count"] > 0 for frame in cut["frames"]) > 2 and cut["frames"][-1]["moved_count"] == 0
    for one, other in zip(kept["frames"], cut["frames"]):
        assert one["pairs_set_hash"] == other["pairs_set_hash"] and one["contacts_count"] == other["contacts_count"]
    worst = {name: max(frame["work_imbalance"] for frame in of["frames"][1:]) for name, of in (("kept", kept), ("cut", cut))}
    assert worst["cut"] < worst["kept"], worst
    expect(2, *words[:-2], "--frames", "0:9", says="--frames asks for 0:9, and cloth-ball:3000:6 has 6 frames")
    expect(2, *words[:-2], "--frames", "0:2", "--pairs", "p.csv", says="--pairs and --contacts write those of the first frame")


def test_a_rank_with_a_device_of_its_own_is_timed():
    out = expect(0, "cluster", "sphere:2000", "--ranks", "1", "--samples", "3", "--adjacent", "drop", "--json", "t.json", says="frame: ")
    document = result("t.json")
    row, = document["ranks"]
    assert len(row["samples"]) == 3 and document["frame_ns"] == sorted(sample["whole_ns"] for sample in row["samples"])[1]
    for sample in row["samples"]:
        assert sum(stage["host_ns"] for stage in sample["stages"]) == sample["whole_ns"], sample
    assert "build" in out and "exchange" in out and document["imbalance"] == 1


def test_a_wrong_answer_is_found():
    kernels = copied_kernels("planted", "cluster/leaving.cl", r"triangle < triangles", "triangle + 1u < triangles && triangle % 7u != 0u")
    out = run("cluster", "torus:20000", "--ranks", "2", *SHARED, "--samples", "1", "--kernels", kernels, "--json", "w.json")
    assert out.returncode == 1 and "verdict: DIFFERS from one device: it finds " in out.stdout and out.stderr == "", out
    assert result("w.json")["check"]["verdict"] == "differs"


def test_what_no_device_holds_is_held_to_another_partition_and_to_brute_force():
    words = ("cluster", "torus:20000", "--ranks", "2", *SHARED, "--samples", "1", "--check", "partitions", "--json", "p.json")
    expect(0, *words, says="verdict: agrees with the other partition, brute over a sample")
    document = result("p.json")
    assert document["check"]["verdict"] == "agrees" and "content_hash" not in document["scene"]
    expect(0, *words[:-4], "--pairs", "all.csv", says="agrees with one device")
    assert document["pairs_count"] == pathlib.Path("all.csv").read_text().count("\n") - 1
    kernels = copied_kernels("planted-halo", "cluster/halo_pairs.cl", r"k < halo_count", "k + 1u < halo_count")
    out = run(*words, "--kernels", kernels)
    assert out.returncode == 1 and "DIFFERS from the other partition, brute over a sample: " in out.stdout, out


def test_what_is_wrong_is_said_once():
    few = ("cluster", "torus:2000", "--ranks", "2")
    expect(3, *few, says=f"2 ranks on {os.uname().nodename} need a device each, and one matches")
    expect(2, "cluster", "torus:2000", says="--ranks says how many")
    expect(2, *few, "--partition", "rbc", says="no partition is called 'rbc'; there are: rcb, curve")
    expect(2, *few, "--contacts", "c.csv", says="--contacts takes a narrow phase: --narrow exact")
    expect(2, *few, "--within", "1%", "--pairs", "c.csv", says="--within finds pairs of triangles and none of boxes")
    expect(2, *few, "--check", "nothing", says="no check is called 'nothing'; there are: auto, one-device, partitions")
    expect(2, *few, "--builder", "karass", says="karras")
    expect(2, "cluster", "bunnny", "--ranks", "2", says="no scene is called 'bunnny'")
    expect(2, *few, *SHARED, "--builder", "sah-binned", says="leaves its tree in host memory")
    expect(2, *few, *SHARED, "--collider", "grid", says="queries no tree")
    expect(3, "cluster", "/none/x.obj", "--ranks", "2", *SHARED, says="rank 0 on ")
    pathlib.Path("there.json").write_text("{}")
    expect(2, *few, "--share-devices", "--json", "there.json", says="is there already")
    assert pathlib.Path("there.json").read_text() == "{}"
    pathlib.Path("empty").mkdir()
    expect(3, *few, PATH="empty", says="mpirun, which starts the ranks, is in no folder of PATH")


def test_experiments_write_one_file():
    tool = pathlib.Path("tools", "nvidia-smi")
    tool.parent.mkdir()
    tool.write_text("#!/bin/sh\n[ \"$*\" = 'topo -m' ] && printf '\\033[4mGPU0\\033[0m NV18\\n'")
    tool.chmod(0o755)
    expect(0, "scale", "strong", "--scene", "torus:2000", "--ranks", "1,2", "--samples", "2", "--out", "strong.json",
           PATH=f"{tool.parent.resolve()}:{os.environ['PATH']}")
    facts = valid("strong.json")["run"]
    assert facts["topology"] == "GPU0 NV18" and facts["libraries"]["MPI"], facts
    runs = results("strong.json")  # of two ranks, one has no device
    assert [(one["ranks_count"], one["status"]) for one in runs] == [(1, "measured"), (2, "failed")], runs
    assert "2 ranks on " in runs[1]["reason"] and "need a device each, and one matches" in runs[1]["reason"], runs[1]
    assert runs[0]["frame_ns"] > 0 and runs[0]["scene"]["triangles"] >= 2000
    expect(0, "scale", "strong", "--share-devices", "--scene", "torus:2000", "--ranks", "2", "--samples", "2", "--out", "shared.json")
    assert not results("shared.json")[0].get("frame_ns") and "its ranks shared a device" in run("plot", "shared.json").stderr
    expect(0, "scale", "halo", "--quick", "--ranks", "2", "--builder", "karras", "--out", "halo.json")
    shares = {(one["partition"], one["boxes_count"]): one["halo_share"] for one in results("halo.json")}
    assert set(shares) == {("rcb", 1), ("rcb", 64), ("curve", 1), ("curve", 64)} and min(shares.values()) > 0, shares
    assert "need a device each" in expect(0, "show", "strong.json", says="times one rank") and "curve" in expect(0, "show", "halo.json")
    expect(0, "cluster", "torus:2000", "--ranks", "1", "--samples", "10", "--json", "plain.json", "--force")
    assert "host memory" in expect(0, "show", "plain.json", says="agrees with one device")
    expect(0, "cluster", "torus:2000", "--ranks", "2", *SHARED, "--samples", "1", "--partition", "curve", "--json", "two.json")
    difference = expect(0, "compare", "plain.json", "two.json", "--allow-dirty", says="changed ranks 2, was 1")  # the pairs are the same
    assert "no regression\n" in difference and "changed partition curve, was rcb\n" in difference, difference
    expect(2, "compare", "plain.json", "halo.json", "--allow-dirty", says="plain.json and halo.json have no cell in common")
    expect(2, "compare", "plain.json", str(SOURCE / "results" / "h200" / "table1.json.xz"), says="is no file of `bvhbench cluster` or `scale`")
    expect(0, "plot", "strong.json", "halo.json", "plain.json", "--out", "figures")
    assert all(pathlib.Path("figures", f"{name}.png").stat().st_size > 10000 for name in ("strong", "halo", "plain-cluster"))
    expect(3, "plot", "two.json", "--out", "figures", says="its ranks shared a device, so there are no times")
    for words, says in ((("weak", "--scene", "torus:2000"), "weak needs a generator's name"), (("halo", "--ranks", "2,x"), "is a list of rank counts"),
                        (("weak", "--scene", "nothing"), "no scene is called 'nothing:33554432'")):
        expect(2, "scale", *words, "--out", "never.json", says=says)
    expect(2, "scale", "halo", "--quick", "--out", "halo.json", says="4 of 4 parts that are none of this plan")


def night_test_scale_goes_on_where_it_was_interrupted():
    words = ("scale", "halo", "--scene", "torus:20000", "--ranks", "2,3,4", "--partition", "rcb", "--samples", "2", "--out", "on.json")
    with at_work(*words) as process:
        next(line for line in process.stdout if line.startswith("[2/6]"))
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 130
    assert "finished_at" not in valid("on.json")["run"]
    kept = valid("on.json")["cells"]
    assert 2 <= len(kept) < 6, kept
    done = expect(0, *words, says="[6/6] torus:20000, 4 ranks, rcb, 64 boxes a rank: not_checked")
    assert done.count("/6] ") in (6 - len(kept), 7 - len(kept)), done  # interrupted between a cell and the end of its part
    whole = valid("on.json")["cells"]
    assert [{key: value for key, value in cell.items() if key != "run"} for cell in whole][:len(kept)] == kept and len(whole) == 6
    assert len({cell["run"] for cell in whole}) == 2
    assert "[" not in expect(0, *words, says="written: on.json")


def night_test_shares_of_a_plan_are_the_whole():
    asked = {"scene": "torus:2000", "samples": 1}
    entries = [{"ranks": 2, "share_devices": True}, {"simulate": 2, "boxes": 1}, {"ranks": 2}, {"simulate": 3, "partition": "curve"},
               {"ranks": 3, "share_devices": True, "builder": "karras", "narrow": "exact", "adjacent": "drop"}]
    pathlib.Path("mine.json").write_text(json.dumps({"experiment": "mine", "clusters": [asked | entry for entry in entries]}))
    expect(0, "run", "mine.json", "--out", "whole.json", "--quiet")
    for share in ("1", "2"):
        expect(0, "run", "mine.json", "--out", f"share-{share}.json", "--only", f"{share}/2", "--quiet")
    expect(0, "merge", "share-1.json", "share-2.json", "-o", "merged.json", says="5 cells of 2 runs")

    def told(path: str) -> dict[str, list]:
        keys = ("scene", "builder", "collider", "status", "check", "halo_share", "imbalance", "pairs_set_hash", "contacts_set_hash")
        return {cell["part"]: [cell.get(key) for key in keys] for cell in results(path)}

    whole = told("whole.json")
    assert whole == told("merged.json") and len(whole) == 5
    assert [cell["status"] for cell in results("whole.json")] == ["measured", "measured", "failed", "measured", "measured"]
    assert "need a device each, and one matches" in results("whole.json")[2]["reason"]
    expect(0, "run", "mine.json", "--out", "filtered.json", "--filter", "karras", "--quiet")
    assert [cell["ranks_count"] for cell in results("filtered.json")] == [3]


def night_test_what_is_simulated_is_what_ranks_send():
    for count, partition, builder in ((3, "rcb", "oibvh-multi"), (8, "curve", "karras")):
        words = ("--partition", partition, "--builder", builder, "--samples", "1", "--force")
        expect(0, "cluster", "torus:20000", "--simulate", str(count), *words, "--json", "s.json", says="simulated: ")
        expect(0, "cluster", "torus:20000", "--ranks", str(count), *words, "--share-devices", "--json", "r.json")
        simulated, ran = result("s.json"), result("r.json")
        halo_bytes = 40 * max(rank["halo_sent_count"] for rank in simulated["ranks"])
        modelled = simulated["part_ns"] + 5 * 20_000 + (halo_bytes + 24 * 64 * (count - 1)) / 5
        assert abs(simulated["model_ns"] - modelled) < 1 and simulated["part_ns"] > 0, simulated
        for key in "triangles", "halo_sent_count", "halo_received_count":
            assert [rank[key] for rank in simulated["ranks"]] == [rank[key] for rank in ran["ranks"]], key
        assert abs(simulated["halo_share"] - ran["halo_share"]) < 1e-9 and ran["halo_share"] > 0
    expect(0, "cluster", "torus:20000", "--simulate", "1", "--json", "one.json", says="torus:20000: 20,000 triangles on 1 rank, simulated")
    alone = result("one.json")
    assert alone["model_ns"] == alone["part_ns"] > 0 == alone["halo_share"], alone
    expect(2, "cluster", "torus:2000", "--simulate", "2", "--ranks", "2", says="--simulate runs no ranks")
    expect(2, "cluster", "torus:2000", "--ranks", "2", "--boxes", "63", says="boxes is a power of two, not 63")
    expect(2, "cluster", "torus:2000", "--ranks", "2", *SHARED, "--boxes", "32", "--builder", "oibvh-wide8", "--collider", "group",
           says="no level of trees with 8 children a node has 32 nodes")


def test_a_killed_rank_ends_all():
    kills, hung = int(os.environ.get("CLUSTER_KILLS", "3")), 0
    for kill in range(kills):
        rank = str(kill % 2)
        child, mark = started(3.0 * kill / kills)
        os.kill(max(process for process, of in processes_of(mark) if of == rank), signal.SIGKILL)
        hung += (errors := ended(child, mark)) == HUNG
        assert child.returncode == 4, (child.returncode, errors)
        which = f"rank {rank} on {os.uname().nodename}"
        if errors.endswith(UNNAMED):  # it was still starting
            which = "a rank"
        assert errors == HUNG or errors.startswith(f"bvhbench: {which} was ended by signal 9 (Killed)"), errors
        assert errors.count("\n") == 1 and hung <= 1, errors  # one signal may strike while ranks connect


def test_a_rank_that_mpirun_does_not_name_is_said_to_be_lost():
    environment = with_mpirun("fake", "echo 'Primary job  terminated normally, but 1 process returned' >&2", "exit 137")
    out = run("cluster", "torus:2000", "--ranks", "2", **environment)
    assert out.returncode == 4 and out.stderr == f"bvhbench: a rank was ended by signal 9 (Killed){UNNAMED}", out


def test_too_little_room_for_the_session_is_a_sentence_at_once():
    with small_disk(64) as disk:
        if disk is not None:
            expect(3, "cluster", "torus:2000", "--ranks", "2", "--share-devices", TMPDIR=str(disk),
                   says=f"mpirun keeps its session in '{disk}' (TMPDIR), which has room for 65536 bytes, and 16777216 are needed")


def stopped_rank(mark: str, rank: str) -> int | None:
    """Returns the process of this rank that a signal has stopped."""
    for process, of in processes_of(mark):
        try:
            state = pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
        except OSError:
            continue
        if of == rank and state == "T":
            return process
    return None


def test_a_rank_killed_in_any_stage_ends_all():
    pathlib.Path("killed").mkdir()
    begins = []
    for k, stage in enumerate(STAGES):  # all at once: most of the time is mpirun's, in which it waits
        rank = str(k % 2 if stage != "verdict" else 0)  # which rank 0 gives
        begins.append((stage, rank, *begun({"BVHBENCH_STOP": f"{stage}:{rank}"}, "torus:2000", "--narrow", "exact", "--samples", "1",
                                           "--json", f"killed/{stage}.json", "--pairs", f"killed/{stage}.csv",
                                           "--contacts", f"killed/{stage}.bin")))
    try:
        for stage, rank, child, mark in begins:
            wait_until(lambda: child.poll() is not None or stopped_rank(mark, rank))
            assert child.poll() is None, (stage, child.communicate())
            os.kill(stopped_rank(mark, rank), signal.SIGKILL)
        for stage, rank, child, mark in begins:
            errors = ended(child, mark)
            assert child.returncode == 4, (stage, child.returncode, errors)
            assert errors.startswith(f"bvhbench: rank {rank} on {os.uname().nodename} was ended by signal 9 (Killed)"), (stage, errors)
            assert errors.count("\n") == 1, (stage, errors)
            assert not any(pathlib.Path("killed", stage + end).exists() for end in (".json", ".csv", ".bin")), stage
    finally:
        for _, _, child, _ in begins:
            child.kill()


def test_a_rank_without_memory_ends_all():
    out = run("cluster", "torus:2000000", "--ranks", "2", *SHARED, "--samples", "1", "--memory-limit", "400M", "--json", "m.json")
    assert out.returncode == 3 and out.stderr.startswith("bvhbench: rank ") and ": out of host memory: " in out.stderr, out
    assert out.stderr.count("\n") == 1 and not pathlib.Path("m.json").exists(), out


def night_test_a_rank_that_hangs_ends_within_the_time_limit():
    child, mark = begun({"BVHBENCH_STOP": "build:1"}, "torus:2000", "--samples", "1", "--time-limit", "5")
    errors = ended(child, mark)
    assert child.returncode == 3 and "took longer than 5 s" in errors and errors.startswith("bvhbench: rank "), errors
    assert errors.count("\n") == 1, errors


def test_ranks_end_with_what_started_them():
    for which, code in (signal.SIGTERM, 143), (signal.SIGKILL, -9):
        child, mark = started(1)
        child.send_signal(which)
        ended(child, mark)
        assert child.returncode == code, child.returncode


sys.exit(main(globals(), at_a_time=3))
