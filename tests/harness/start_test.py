#!/usr/bin/env python3
"""Tests what a start compiles, what a later start reuses, and how it handles caches that are broken, too large or read-only."""
import contextlib
import fcntl
import os
import pathlib
import re
import resource
import shutil
import sys

from program import ALL_CASES, PATIENCE_S, at_work, expect, main, only, run, valid

QUICK = ("build", "--builder", "median-split", "--scene", "soup:30", "--samples", "1")  # two kernels of one program


def test_a_build_compiles_the_kernels_that_it_launches_and_no_others():
    # Copy rate 1, empty launch 1, bounds 2, codes 1, sort 3, then the tree's kernels. PoCL takes about 0.1 s for each. The number
    # of programs is checked too, because each costs about as much again.
    builds = ((10, 6, "--builder", "oibvh-multi"), (9, 7, "--builder", "oibvh-multi", "--order", "kd"),
              (2, 1, "--builder", "median-split"), (9, 5, "--builder", "apetrei-fused"), (8, 4, "--builder", "oibvh-host"),
              (10, 6, "--builder", "oibvh-multi", "--leaves", "sorted"))
    for most, texts, *words in builds if ALL_CASES else builds[:3]:
        folder = pathlib.Path("pocl-" + "-".join(words[1:]))
        folder.mkdir()
        compiled = []
        for _ in range(2):  # the second start finds everything in the cache
            expect(0, "build", "--scene", "torus:2000", "--samples", "2", *words, says="agrees", POCL_CACHE_DIR=str(folder))
            compiled.append({path.name for path in folder.rglob("*.so")})
        assert compiled[0] == compiled[1] and 1 <= len(compiled[0]) <= most, (words, compiled)
        programs = len(list(folder.rglob("program.bc")))
        assert 1 <= programs <= texts, (words, programs)


def test_pocl_keeps_its_cache_with_us():
    expect(0, "list", "devices", XDG_CACHE_HOME=os.getcwd() + "/cache", POCL_CACHE_DIR="")
    assert pathlib.Path("cache/bvhbench/pocl").is_dir()


def kept_in(folder: str) -> dict[pathlib.Path, tuple[bytes, int]]:
    """Runs a start that keeps its kernels in the folder, and returns the content and time of each file."""
    expect(0, *QUICK, says="agrees", XDG_CACHE_HOME=os.path.abspath(folder), POCL_CACHE_DIR="")
    root = pathlib.Path(folder, "bvhbench/pocl")
    files = {path: (path.read_bytes(), path.stat().st_mtime_ns) for path in root.glob("??/**/*") if path.is_file()}
    return {path: content for path, content in files.items() if path.name != "last_accessed"}


def test_a_home_that_is_not_there_is_not_made():
    home = os.getcwd() + "/no-home"
    expect(0, *QUICK, says="agrees", HOME=home, XDG_CACHE_HOME="", POCL_CACHE_DIR="")
    assert not os.path.exists(home)


def test_what_is_broken_is_named_and_compiled_again_once_removed():
    whole = kept_in("broken")
    assert {path.name for path in whole} == {"program.bc", "copy_runs.so", "launch_empty.so"}, whole
    assert kept_in("broken") == whole  # nothing was compiled
    for path, (content, _) in whole.items():
        path.write_bytes(content[:1000])
    folder = os.path.abspath("broken/bvhbench/pocl")
    done = run(*QUICK, XDG_CACHE_HOME=os.path.abspath("broken"), POCL_CACHE_DIR="")
    assert done.returncode == 3 and done.stderr.splitlines()[-1].endswith(f"cache can be why: remove {folder}"), done
    shutil.rmtree(folder)
    assert set(kept_in("broken")) == set(whole)


def night_test_a_folder_that_is_too_large_is_emptied_unless_others_are_at_work():
    whole = kept_in("large")
    old = pathlib.Path("large/bvhbench/pocl/AA/OLD")
    old.mkdir(parents=True)
    with open(old / "program.bc", "wb") as large:
        large.truncate(80 << 20)
    with open("large/bvhbench/pocl/bvhbench.lock", "rb") as lock:
        fcntl.flock(lock, fcntl.LOCK_SH)
        kept_in("large")
        assert old.exists()
    assert set(kept_in("large")) == set(whole) and not old.exists()


def night_test_several_may_start_at_a_time():
    with contextlib.ExitStack() as stack:
        started = [stack.enter_context(at_work(*QUICK, XDG_CACHE_HOME=os.path.abspath("several"), POCL_CACHE_DIR="")) for _ in range(3)]
        for process in started:
            out, error = process.communicate(timeout=PATIENCE_S)
            assert process.returncode == 0 and "agrees" in out and not error, (process.returncode, out, error)
    assert kept_in("several") == kept_in("several")


def test_kernels_that_cannot_be_kept_are_compiled_all_the_same():
    pathlib.Path("file").touch()
    pathlib.Path("temporary").mkdir()
    for variable, folder in (("XDG_CACHE_HOME", os.path.abspath("file")), ("POCL_CACHE_DIR", "/dev/full")):
        environment = {"POCL_CACHE_DIR": "", variable: folder}
        done = run(*QUICK, TMPDIR=os.path.abspath("temporary"), **environment)
        assert done.returncode == 0 and "agrees" in done.stdout, (folder, done)
        assert done.stderr.startswith("bvhbench: kernels are compiled anew, for they cannot be kept in '" + folder), done
        assert done.stderr.count("\n") == 1, done.stderr
        assert not os.listdir("temporary"), os.listdir("temporary")
    expect(3, *QUICK, says="there is nowhere to put compiled kernels: they cannot be kept in '/proc/no/bvhbench/pocl': ",
           XDG_CACHE_HOME="/proc/no", POCL_CACHE_DIR="", TMPDIR="/proc/no")


def test_limits_and_settings_of_the_user_change_no_answer():
    """Limits of files and stack, one core, time zones and languages that do not exist, a home that is none, and no room for caches."""
    usual = only_of(QUICK)
    soft = {resource.RLIMIT_NOFILE: 16, resource.RLIMIT_STACK: 256 << 10}
    if "ASAN_OPTIONS" not in os.environ:  # the address sanitizer reserves more
        soft[resource.RLIMIT_AS] = 4 << 30
    kept, cores = {limit: resource.getrlimit(limit) for limit in soft}, os.sched_getaffinity(0)
    try:
        os.sched_setaffinity(0, {min(cores)})
        for limit, value in soft.items():
            resource.setrlimit(limit, (value, kept[limit][1]))
        assert only_of(QUICK) == usual
    finally:
        os.sched_setaffinity(0, cores)
        for limit, values in kept.items():
            resource.setrlimit(limit, values)
    for settings in ({"TZ": ":/nonsense", "LC_ALL": "xx_YY.UTF-8"},
                     {"TZ": "Pacific/Apia", "LC_ALL": "de_DE.UTF-8", "POCL_KERNEL_CACHE": "0"}):
        assert only_of(QUICK, **settings) == usual, settings


def only_of(words: tuple[str, ...], **settings: str) -> dict:
    """Runs a command of one cell and returns its check. Tests that nothing is complained of, and that the file's times are in UTC."""
    done = run(*words, "--json", "only.json", "--force", **settings)
    assert done.returncode == 0 and not done.stderr, (settings, done)
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?Z", valid("only.json")["run"]["started_at"])
    return only("only.json")["check"]


def night_test_settings_for_another_python_or_matplotlib_change_nothing():
    expect(0, "build", "--builder", "perfect", "--scene", "soup:30", "--samples", "12", "--json", "r.json")
    for name in ("numpy", "matplotlib", "statistics"):
        pathlib.Path("foreign").mkdir(exist_ok=True)
        pathlib.Path(f"foreign/{name}.py").write_text("raise ImportError('of another Python')")
    reads = [("show", "r.json"), ("compare", "r.json", "r.json", "--allow-dirty"), ("report", "r.json", "-o", "b.html", "--force"),
             ("plot", "r.json", "--out", "drawn"), ("list", "devices")]
    usual = [expect(0, *words) for words in reads]
    pictures = {path.name: path.read_bytes() for path in pathlib.Path("drawn").iterdir()}
    assert any(name.endswith(".png") for name in pictures) and any(name.endswith(".svg") for name in pictures), pictures.keys()
    pathlib.Path("foreign/matplotlibrc").write_text("font.family: NoSuchFont\nsavefig.dpi: 20\nbackend: QtAgg\n")
    pathlib.Path("matplotlibrc").write_text("text.usetex: True\nsavefig.transparent: True\nfont.size: 30\nfigure.facecolor: red\n"
                                            "savefig.format: pdf\n")
    for settings in ({"PYTHONHOME": "/nonexistent", "PYTHONPATH": os.getcwd() + "/foreign", "MPLBACKEND": "TkAgg", "DISPLAY": ":99"},
                     {"MATPLOTLIBRC": os.getcwd() + "/foreign/matplotlibrc", "MPLBACKEND": "nonsense"}):
        shutil.rmtree("drawn")
        assert [expect(0, *words, **settings) for words in reads] == usual, settings
        assert {path.name: path.read_bytes() for path in pathlib.Path("drawn").iterdir()} == pictures, settings


sys.exit(main(globals()))
