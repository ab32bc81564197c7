#!/usr/bin/env python3
"""Tests that too little memory gives an error sentence or a failed cell as in docs/counters.md, that later scenes are measured,
that the limit is kept, and that the kernel ends no process.

MEMORY_SIZES=full includes sizes that take minutes."""
import contextlib
import os
import pathlib
import re
import resource
import struct
import subprocess
import time

from program import PROGRAM, SOURCE, children, expect, experiment, main, only, valid, wait_until

FULL = os.environ.get("MEMORY_SIZES") == "full"
MIB = 1 << 20
LIMIT = 500 * MIB
# Memory allowed above a limit: parts of the program's own files, which the kernel maps and drops freely.
BEYOND = 70 * MIB
peaks: list[tuple[str, int, int]] = []
standing: list[int] = []  # of each run, VmHWM of its process that measures, in bytes, while that waited for its tables; 0 if never seen


def copies(count: int) -> str:
    """Writes a binary PLY file of `count` equal triangles without shared vertices, all of which intersect."""
    path = f"copies-{count}.ply"
    if not os.path.exists(path):
        header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {3 * count}\nproperty float x\nproperty float y\n"
                  f"property float z\nelement face {count}\nproperty list uchar int vertex_indices\nend_header\n")
        faces = b"".join(struct.pack("<Biii", 3, 3 * k, 3 * k + 1, 3 * k + 2) for k in range(count))
        pathlib.Path(path).write_bytes(header.encode() + struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) * count + faces)
    return path


def own_limit() -> pathlib.Path | None:
    """Returns the file with the memory limit of this process's control group."""
    for line in pathlib.Path("/proc/self/cgroup").read_text().splitlines():
        _, controllers, path = line.split(":", 2)
        file = {"memory": f"/sys/fs/cgroup/memory{path}/memory.limit_in_bytes", "": f"/sys/fs/cgroup{path}/memory.max"}.get(controllers)
        if file and os.path.exists(file):
            return pathlib.Path(file)
    return None


@contextlib.contextmanager
def group_of(limit: int):
    """Yields a control group with `limit` bytes of memory, or None if none can be created."""
    file = own_limit()
    group = file.parent / f"bvhbench-test-{os.getpid()}" if file else None
    with contextlib.ExitStack() as stack:
        try:
            if group:
                group.mkdir()
                stack.callback(removed, group)
                (group / file.name).write_text(str(limit))
        except OSError:
            group = None
        yield group


def removed(group: pathlib.Path) -> None:
    def is_gone() -> bool:
        with contextlib.suppress(OSError):
            group.rmdir()
        return not group.exists()

    wait_until(is_gone)  # processes leave a group shortly after they end


TABLES = """import pathlib, time
while not pathlib.Path("seen").exists():
    time.sleep(0.01)
"""  # in place of the program's tables, for which it waits at its end: waits until its memory has been seen


def peak_of_waiting(program: int) -> int:
    """Returns VmHWM, in bytes, of the program's child if that has a child itself, else 0. VmHWM only grows, and the last child
    prints the tables after the last write of the file: so the largest value seen is that of a process that has nothing left to do
    but to end. What its end adds is not counted: on Linux 6.18 wait4 tells 3 MiB more."""
    for child in children(program):
        with contextlib.suppress(OSError):
            told = re.search(r"VmHWM:\s+(\d+) kB", pathlib.Path(f"/proc/{child}/status").read_text())
            if told and children(child):
                return int(told[1]) * 1024
    return 0


def measured(*words: str, limit: int = 0, group: pathlib.Path | None = None, ulimit: int = 0):
    """Runs the program, and returns its result and its peak memory, which must be within `limit`."""
    def enter():
        if group:
            (group / "cgroup.procs").write_text(str(os.getpid()))
        if ulimit:
            resource.setrlimit(resource.RLIMIT_AS, (ulimit, ulimit))
    with open("out.txt", "w+") as out, open("err.txt", "w+") as err:
        process = subprocess.Popen([PROGRAM, *words], stdout=out, stderr=err, preexec_fn=enter)
        standing.append(0)
        while True:
            ended_pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if ended_pid:
                break
            if peak := peak_of_waiting(process.pid):
                standing[-1] = peak
                pathlib.Path("seen").touch()
            time.sleep(0.01)
        process.returncode = code = os.waitstatus_to_exitcode(status)
        out.seek(0), err.seek(0)
        done = subprocess.CompletedProcess(words, code, out.read(), err.read())
    peaks.append((" ".join(words), usage.ru_maxrss // 1024, limit // MIB))
    assert code >= 0, ("a signal ended it", done)
    if limit:
        assert usage.ru_maxrss * 1024 < limit + BEYOND, (usage.ru_maxrss // 1024, done)
    return done


def limited(*words: str) -> subprocess.CompletedProcess:
    return measured(*words, "--memory-limit", "500M", limit=LIMIT)


def refused(done: subprocess.CompletedProcess, *says: str):
    assert done.returncode in (3, 4), done
    *notices, sentence = done.stderr.splitlines()
    assert sentence.startswith("bvhbench: ") and all(line.startswith("scene ") for line in notices), done
    assert any(words in done.stderr for words in says), done


def test_a_limit_must_be_a_number_of_bytes():
    build = ("build", "--builder", "perfect", "--scene", "soup:5", "--samples", "1", "--memory-limit")
    for wrong in ("much", "-1", "0", "18446744073709551616", "17179869184G", "1.5G", "5X", ""):
        expect(2, *build, wrong, says=f"--memory-limit: must be a number of bytes from 1 on, as 512M or 2G, not '{wrong}'")
    for right in ("4000000000", "4g", "4GB", "2T"):
        expect(0, *build, right, says="agrees")


def test_what_the_program_takes_itself_is_within_its_limit():
    done = measured("build", "--builder", "perfect", "--scene", "soup:5", "--memory-limit", "1000")
    refused(done, "out of host memory: the program itself takes ")
    assert done.stderr.endswith(" bytes, and the limit is 1000\n"), done
    for limit in (60, 100, 150, 200):  # too little for part of a run, and for PoCL, which would end the process
        done = measured("build", "--builder", "karras", "--scene", "soup:5", "--samples", "1", "--memory-limit", f"{limit}M",
                        limit=limit * MIB)
        if done.returncode:
            refused(done, "out of host memory: ", "out of device memory: ")


def test_a_scene_is_refused_before_it_is_made():
    done = limited("build", "--builder", "karras", "--scene", "torus:60000000")
    refused(done, "out of host memory: scene 'torus:60000000' takes about ")
    assert re.search(r"about \d+ bytes, and the host gives \d+\n$", done.stderr), done


def test_pairs_are_counted_before_they_are_listed():
    collide, too_many = ("collide", "--samples", "1", "--scene"), "a query holds at most 4294967295"
    for count in (10000, 30000, 100000) if FULL else (10000,):
        refused(limited(*collide, copies(count), "--collider", "leaf"), "out of ", too_many)
    for collider in ("brute", "embree"):
        done = limited(*collide, copies(10000), "--collider", collider)
        if "built without" not in done.stderr:
            refused(done, "out of host memory", too_many)
    # With enough memory the pairs are listed.
    done = limited(*collide, copies(2000), "--collider", "leaf", "--json", "room.json")
    assert done.returncode == 0 and "agrees" in done.stdout, done
    assert only("room.json")["counters"]["pairs_count"] == 2000 * 1999 / 2
    if FULL:
        measured(*collide, copies(10000), "--collider", "leaf", "--memory-limit", "1G", limit=1024 * MIB)
        refused(measured(*collide, copies(100000), "--collider", "leaf", "--memory-limit", "2G", limit=2048 * MIB), "out of ", too_many)


def around_one_too_large(*words: str, **limits) -> dict:
    """Returns the result of a run over three scenes, the second of which is too large."""
    plan = experiment("three.json", scenes=["torus:1000", copies(10000), "torus:1200"],
                      pipelines=[{"builder": "karras", "collider": collider} for collider in ("leaf", "grid")])
    done = measured("run", plan, "--out", "three-out.json", "--force", *words, **limits)
    result = valid("three-out.json")
    states = [(cell["scene"]["name"], cell["status"]) for cell in result["cells"]]
    assert states == [("torus:1000", "measured")] * 2 + [(copies(10000), "failed")] * 2 + [("torus:1200", "measured")] * 2, (states, done)
    assert "finished_at" in result["run"], done
    return result


def test_a_run_goes_on_behind_a_scene_that_is_too_large():
    pathlib.Path("home/plots").mkdir(parents=True)
    pathlib.Path("home/plots/__main__.py").write_text(TABLES)
    pathlib.Path("seen").unlink(missing_ok=True)
    os.environ["BVHBENCH_HOME"] = os.path.abspath("home")
    result = around_one_too_large("--memory-limit", "500M", limit=LIMIT)
    os.environ["BVHBENCH_HOME"] = str(SOURCE)
    assert all("out of " in cell["reason"] and " memory: " in cell["reason"] for cell in result["cells"][2:4]), result["cells"]
    memory = result["run"]["host_memory"]
    assert 64 * MIB < memory["predicted_bytes"] <= LIMIT and memory["given_bytes"] == LIMIT, memory
    # The kernel's counters are approximate: each processor adds to them in batches of pages.
    assert abs(standing[-1] - memory["peak_bytes"]) < memory["peak_bytes"] / 4, (memory, standing[-1])
    assert f"memory: {memory['peak_bytes'] // MIB} MiB at most, " in expect(0, "show", "three-out.json")


def night_test_every_command_keeps_its_limit():
    many = copies(10000)
    for words in (("sweep", "--scenes", f"{many},torus:1000", "--builders", "karras", "--colliders", "leaf", "--samples", "1",
                   "--out", "swept"),
                  ("tune", "leaf", "--scene", many, "--builder", "karras", "--quick", "--samples", "3", "--out", "tuned.json"),
                  ("accuracy", "--axis", "codes", "--scene", many, "--samples", "1", "--out", ".")):
        done = limited(*words)
        assert done.returncode in (0, 3, 4) and "memory" in done.stderr + done.stdout, done


def test_files_are_refused_by_their_size():
    sizes = {"3G": 3 << 30, "6G": 6 << 30} if FULL else {"3G": 3 << 30}
    for name, size in sizes.items():
        for ending in ("obj", "ply", "stl", "off", "gltf", "json"):
            path = f"sparse-{name}.{ending}"
            with open(path, "wb") as file:
                file.truncate(size)
            words = ("show", path) if ending == "json" else ("build", "--builder", "perfect", "--scene", path)
            says = f"out of host memory: reading '{path}' takes about "
            refused(limited(*words), says)
            with group_of(2 << 30) as group:
                refused(measured(*words, group=group, ulimit=0 if group else 2 << 30), says)


def test_files_of_numbers_that_are_short_meet_the_limit():
    # 150 MB of text, in which a vertex takes 8 bytes; in memory it takes 36, and more while arrays grow.
    with open("short.obj", "w") as file:
        for _ in range(20):
            file.write("v 1 2 3\n" * 400000)
        file.write("f 1 2 3\n")
    done = limited("build", "--builder", "perfect", "--scene", "short.obj")
    refused(done, "out of host memory", "there is not enough memory for scene 'short.obj'")


def night_test_a_group_of_processes_limits_without_being_asked():
    limit, scene = (1536, "torus:6000000") if FULL else (800, "torus:3000000")
    for limit, words in ((limit, ("build", "--builder", "karras", "--scene", scene, "--samples", "1")),
                         (450, ("collide", "--collider", "leaf", "--scene", copies(10000), "--samples", "1"))):
        with group_of(limit * MIB) as group:
            # Address space exceeds memory, because drivers map much that they hardly use.
            done = measured(*words, group=group, ulimit=0 if group else (limit + 600) * MIB)
            refused(done, "out of host memory: ", "out of device memory: ")
    with group_of(500 * MIB) as group:
        around_one_too_large(group=group, ulimit=0 if group else 1100 * MIB)
        if not group:
            print("  no control group can be made here: RLIMIT_AS in its place")


ended = main(globals())
for words, peak, limit in peaks if FULL else []:
    print(f"{peak:6} MiB of {limit or '-':>5}  {words}")
raise SystemExit(ended)
