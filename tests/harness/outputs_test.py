#!/usr/bin/env python3
"""Tests that a command leaves existing files unchanged, unless it was told to replace them."""
import contextlib
import json
import os
import pathlib
import resource
import shutil
import stat
import subprocess
import sys
import threading

from program import PATIENCE_S, PROGRAM, at_work, expect, experiment, main, on_a_terminal, run, valid, wait_until

BUILD = ("build", "--builder", "median-split", "--scene", "soup:50", "--samples", "1")
COLLIDE = ("collide", "--collider", "brute", "--scene", "soup:50", "--samples", "1")
MESH = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def begin() -> None:
    """Prepares the folder of each test."""
    if not pathlib.Path("../good.json").exists():
        expect(0, *BUILD, "--json", "../good.json")
    shutil.copy("../good.json", "good.json")
    pathlib.Path("a.obj").write_text(MESH)


def state() -> dict:
    """Returns all files below the working folder: their contents and modes, and the targets of links."""
    return {str(path): (path.lstat().st_mode, path.lstat().st_ino,
                        os.readlink(path) if path.is_symlink() else path.read_bytes() if path.is_file() else b"")
            for path in pathlib.Path().rglob("*")}


def refused(*words: str, codes: tuple = (2,), says: str = "") -> None:
    """Tests that the command exits with one of the codes and one sentence, and changes nothing."""
    before = state()
    done = run(*words)
    assert done.returncode in codes, (words, done)
    assert done.stderr.startswith("bvhbench: ") and done.stderr.count("\n") == 1, (words, done)
    assert says in done.stderr, (words, done)
    assert state() == before, (words, set(state()) ^ set(before), done)


def of_scenes(path: str, *scenes: object) -> str:
    return experiment(path, experiment=pathlib.Path(path).stem, scenes=scenes, builders=["median-split"])


def test_a_command_that_fails_leaves_the_result_that_was_there():
    for words in (("build", "--builder", "karras", "--scene", "nofile.obj", "--json", "good.json"),
                  ("build", "--builder", "karas", "--scene", "torus:1000", "--json", "good.json"),
                  ("collide", "--collider", "leaf", "--scene", "torus:1000", "--order", "mortn", "--json", "good.json"),
                  ("collide", "--collider", "leaf", "--scene", "nofile.obj", "--json", "good.json", "--pairs", "p.csv"),
                  ("run", "peers", "--quick", "--filter", "zzz", "--out", "good.json"),
                  ("stress", "--quick", "--filter", "zzz", "--out", "good.json"),
                  (*BUILD, "--device", "none such", "--json", "good.json"),
                  ("run", "good.json", "--out", "good.json"), ("run", "nofile.json", "--out", "good.json"),
                  ("merge", "good.json", "a.obj", "-o", "merged.json"), ("merge", "nofile.json", "-o", "good.json")):
        refused(*words, "--force", codes=(2, 3, 4))


def test_a_result_is_replaced_with_force_only():
    for name in ("accuracy.json", "table1.json", "kept.csv", "kept.html"):
        shutil.copy("good.json", name)
    for says, words in (("good.json is a result of 1 cell; --force", (*BUILD, "--json", "good.json")),
                        ("good.json", (*BUILD, "--dump", "good.json")), ("good.json", (*COLLIDE, "--json", "good.json")),
                        ("good.json", ("run", "peers", "--quick", "--out", "good.json")),
                        ("good.json", ("stress", "--quick", "--out", "good.json")),
                        ("good.json", ("smoke", "--out", "good.json")), ("good.json", ("smoke", "--update", "--baseline", "good.json")),
                        ("good.json", ("report", "good.json", "-o", "good.json")), ("accuracy.json", ("accuracy", "--out", ".")),
                        ("table1.json", ("merge", "good.json", "-o", "table1.json")),
                        ("table1.json is a result of 1 cell; --force", ("reproduce", "table1", "--quick", "--out", ".")),
                        ("table1.json", ("reproduce", "all", "--quick", "--out", ".")),
                        ("kept.html", ("report", "good.json", "-o", "kept.html")), ("kept.csv", (*COLLIDE, "--pairs", "kept.csv")),
                        ("kept.csv", (*COLLIDE, "--adjacent", "drop", "--narrow", "exact", "--contacts", "kept.csv"))):
        refused(*words, says=says)
    refused("tune", "sort", "--scene", "soup:50", "--quick", "--out", "good.json", codes=(2, 3), says="good.json")
    shutil.copy("good.json", "kept.png")
    refused("accuracy", "--out", ".", says="kept.png")
    refused("plot", "good.json", "--out", ".", says="kept.png")
    expect(0, *BUILD, "--json", "good.json", "--force")
    assert valid("good.json")["run"]["command"][-1] == "--force"
    expect(0, *COLLIDE, "--pairs", "kept.csv", "--force")
    assert not pathlib.Path("kept.csv").read_bytes().startswith(b"{")


def night_test_tuned_values_of_other_targets_are_kept():
    device = valid("good.json")["run"]["device"]["name"]
    pathlib.Path("t.json").write_text(json.dumps({"format": "tuning 1", "device": device,
                                                  "values": {"walk.task_leaves": {"value": 8}}}))
    for force in ((), ("--force",)):
        expect(0, "tune", "sort", "--scene", "soup:50", "--quick", "--samples", "3", "--out", "t.json", *force)
        assert json.loads(pathlib.Path("t.json").read_text())["values"]["walk.task_leaves"]["value"] == 8


def night_test_a_sweep_replaces_no_result_of_others():
    sweep = ("sweep", "--name", "s", "--scenes", "soup:50", "--builders", "median-split", "--samples", "1", "--out", ".")
    for _ in range(2):
        shutil.copy("good.json", "s.json")
        expect(2, *sweep, says="s.json")
        assert pathlib.Path("s.json").read_bytes() == pathlib.Path("good.json").read_bytes()
        os.remove("s.json")
        expect(0, *sweep)
        expect(0, *sweep)  # resumes its own sweep


def test_an_experiment_file_is_not_its_own_result():
    mine = of_scenes("mine.json", "soup:50", "soup:60")
    before = pathlib.Path(mine).read_bytes()
    expect(0, "run", mine, says="written: mine-results.json")
    assert pathlib.Path(mine).read_bytes() == before and len(valid("mine-results.json")["cells"]) == 2
    refused("run", mine, says="mine-results.json is a result of 2 cells; --force")
    refused("run", mine, "--out", mine, "--force", says="mine.json is read by this command")
    expect(0, "run", mine, "--force")
    assert sorted(os.listdir()) == ["a.obj", "good.json", "mine-results.json", "mine.json"]


def test_an_input_is_no_output_by_whatever_name():
    os.link("a.obj", "hard.obj")
    os.symlink("a.obj", "soft.obj")
    pathlib.Path("frames").mkdir()
    for frame in range(2):
        shutil.copy("a.obj", f"frames/f{frame}.obj")
    pathlib.Path("axis").mkdir()
    shutil.copy("a.obj", "axis/accuracy.json")
    mine = of_scenes("mine.json", "refine:a.obj:10")
    for words in ((*BUILD[:3], "--scene", "a.obj", "--json", "a.obj"), (*BUILD[:3], "--scene", "a.obj", "--json", "hard.obj"),
                  (*BUILD[:3], "--scene", "soft.obj", "--dump", "a.obj"), (*BUILD[:3], "--scene", "bend:a.obj", "--json", "soft.obj"),
                  ("collide", "--collider", "leaf", "--scene", "frames", "--json", "frames/f1.obj"),
                  ("run", mine, "--out", "a.obj"), ("tune", "sort", "--scene", "a.obj", "--out", "a.obj"),
                  ("report", "good.json", "-o", "good.json"), ("report", "--scene", "a.obj", "-o", "a.obj"),
                  ("merge", "good.json", "-o", "good.json"), ("accuracy", "--scene", "axis/accuracy.json", "--out", "axis")):
        refused(*words, "--force", says="is read by this command")


def test_links_are_followed_and_modes_kept():
    pathlib.Path("real").mkdir()
    shutil.copy("good.json", "real/r.json")
    os.chmod("real/r.json", 0o600)
    os.symlink("real/r.json", "r.json")
    before = pathlib.Path("real/r.json").read_bytes()
    refused(*BUILD, "--json", "r.json", says="1 cell")
    expect(0, *BUILD, "--json", "r.json", "--force")
    assert os.readlink("r.json") == "real/r.json" and os.listdir("real") == ["r.json"]
    assert pathlib.Path("real/r.json").read_bytes() != before
    assert stat.S_IMODE(os.stat("real/r.json").st_mode) == 0o600
    os.symlink("real/new.json", "new.json")
    mask = os.umask(0o027)
    expect(0, *BUILD, "--json", "new.json")
    os.umask(mask)
    assert os.readlink("new.json") == "real/new.json"
    assert stat.S_IMODE(os.stat("real/new.json").st_mode) == 0o640


def night_test_devices_and_pipes_are_written_to():
    os.mkfifo("pipe")
    read = []
    reader = threading.Thread(target=lambda: read.append(pathlib.Path("pipe").read_bytes()), daemon=True)
    reader.start()
    expect(0, *BUILD, "--json", "pipe")
    reader.join(PATIENCE_S)
    assert len(json.loads(read[0])["cells"]) == 1 and stat.S_ISFIFO(os.stat("pipe").st_mode)
    os.symlink("/proc/self/fd/1", "stdout")
    assert '"cells"' in expect(0, *BUILD, "--json", "stdout")
    with open("all.txt", "wb") as out:
        assert subprocess.run([PROGRAM, *BUILD, "--json", "stdout"], stdout=out, timeout=PATIENCE_S).returncode == 0
    text = pathlib.Path("all.txt").read_text()
    assert text.startswith('{"format"') and "agrees" in text
    assert os.path.islink("stdout")
    with contextlib.suppress(PermissionError):  # a private /dev/null, which only root may create
        os.mknod("null", stat.S_IFCHR | 0o666, os.makedev(1, 3))
        with contextlib.suppress(OSError):
            open("null", "w").close()
            expect(0, *BUILD, "--json", "null", "--dump", "null")
        assert stat.S_ISCHR(os.stat("null").st_mode)


def test_a_folder_is_not_made_for_a_file():
    for words in ((*BUILD, "--json", "new/r.json"), (*BUILD, "--dump", "new/r.json"), (*COLLIDE, "--pairs", "new/p.csv"),
                  ("run", "peers", "--quick", "--out", "new/r.json"), ("stress", "--quick", "--out", "new/r.json"),
                  ("report", "good.json", "-o", "new/r.html"), ("merge", "good.json", "-o", "new/r.json"),
                  ("tune", "sort", "--scene", "soup:50", "--quick", "--out", "new/t.json")):
        refused(*words, codes=(3,), says="there is no folder new")
    refused(*BUILD, "--json", ".", says="is a folder")
    refused("plot", "good.json", "--out", "a.obj", codes=(3,), says="a.obj")


def test_an_empty_name_is_wrong_usage():
    for words in ((*BUILD, "--json", ""), (*BUILD, "--dump", ""), (*COLLIDE, "--pairs", ""), (*COLLIDE, "--contacts", ""),
                  ("run", "peers", "--out", ""), ("accuracy", "--out", ""), ("stress", "--out", ""), ("plot", "good.json", "--out", ""),
                  ("report", "good.json", "-o", ""), ("merge", "good.json", "-o", ""), ("tune", "--scene", "soup:50", "--out", "")):
        refused(*words)


def test_two_commands_do_not_write_one_file():
    long = of_scenes("long.json", {"scene": "soup:{t}", "t": {"from": 1, "to": 100000}})
    with at_work("run", long, "--out", "r.json"):
        journal = pathlib.Path("r.json.journal")
        wait_until(lambda: journal.exists() and '"cell"' in journal.read_text())
        os.symlink("r.json", "link.json")
        for words in ((*BUILD, "--json", "r.json"), ("run", long, "--out", "r.json"), ("merge", "good.json", "-o", "r.json"),
                      (*BUILD, "--json", "link.json")):
            expect(3, *words, "--force", says=f"{words[-1]} is being written by another process")
    expect(2, *BUILD, "--json", "r.json", says="r.json.journal has cells of a run that did not end")
    expect(0, *BUILD, "--json", "r.json", "--force")  # a killed process does not hold the lock
    assert len(valid("r.json")["cells"]) == 1
    expect(3, *BUILD, "--json", "new.json", "--dump", "new.json")
    left = [name for name in sorted(os.listdir()) if not name.startswith("r.json.tmp")]  # a kill may leave one
    assert left == ["a.obj", "good.json", "link.json", "long.json", "r.json"], left


def test_a_temporary_file_cannot_be_put_there_before():
    script = 'for p in good.json.tmp$$ .good.json.tmp$$; do ln -s a.obj $p; done; exec "$0" "$@"'
    words = [PROGRAM, *BUILD, "--json", "good.json", "--force"]
    assert subprocess.run(["sh", "-c", script, *words], capture_output=True, timeout=PATIENCE_S).returncode == 0
    assert pathlib.Path("a.obj").read_text() == MESH
    valid("good.json")


def test_a_limit_on_file_sizes_leaves_what_was_there():
    shutil.copy("good.json", "old.json")
    before = state()
    done = subprocess.run([PROGRAM, "merge", "good.json", "-o", "old.json", "--force"], capture_output=True, text=True,
                          timeout=PATIENCE_S, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (512, 512)))
    assert done.returncode == 3 and done.stderr == "bvhbench: old.json cannot be written: File too large\n", done
    assert state() == before


def test_a_standard_output_that_fails_is_an_error():
    for words in (("--help",), ("list", "builders"), ("show", "good.json"), ("compare", "good.json", "good.json", "--allow-dirty"),
                  BUILD, (*BUILD, "--json", "r.json", "--force")):
        with open("/dev/full", "w") as full:
            for changed in ({"stdout": full}, {"preexec_fn": lambda: os.close(1)}):
                done = subprocess.run([PROGRAM, *words], stderr=subprocess.PIPE, text=True, timeout=PATIENCE_S, **changed)
                assert done.returncode == 3, (words, done)
                assert done.stderr.startswith("bvhbench: standard output cannot be written"), (words, done)
    assert len(valid("r.json")["cells"]) == 1


def test_names_cannot_command_a_terminal():
    for name, spelled in (("\x1b[31mred\x07.obj", "\\x1b[31mred\\x07.obj"), ("sc\x9b31m\u202eY\u2066.obj", "sc\\x9b31m\\u202eY\\u2066.obj")):
        done = run("build", "--builder", "median-split", "--scene", name)
        assert done.returncode and spelled in done.stderr and name not in done.stderr, done
        pathlib.Path(name).write_text(MESH)
        for words in (("build", "--builder", "median-split", "--scene", name, "--samples", "1", "--json", "named.json", "--force"),
                      ("show", "named.json"), ("scene", name)):
            out = expect(0, *words)
            assert spelled in out and name not in out, (words, out)
    name = "\x1b[31mred\x07.obj"
    shown = on_a_terminal("run", of_scenes("x.json", name), "--out", "r.json")
    assert "\x1b[31m" not in shown and "\\x1b[31mred" in shown, shown


sys.exit(main(globals(), begin))
