#!/usr/bin/env python3
"""Measures how often `compare` is right about two sides of one build, and about a builder that is slowed by 10 %.

Usage: compare_trials.py <bvhbench> [--trials N] [--processes N] [--samples N] [--slow FACTOR] [--write FILE] [--keep FOLDER]

Takes about half an hour on two cores, which nothing else may use, so .ci/nightly runs it. A trial has three sides of several processes:
two sides are unchanged, and in the third the test hook BVHBENCH_SLOW slows a builder, another one in each trial. The sides' processes
sample by turns (`run --turns`). The first side is compared with the second and with the slowed one. Half of the trials run without load,
half beside busy loops. Exits with 1 unless

- of one build, at most one comparison in 20 has a cell that is SLOWER or FASTER, without load and beside any,
- the slowed cell is SLOWER in at least 90 % of the trials without load.

`--write` writes the verdicts of all trials, one line a trial.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
from collections import Counter

BUILDERS = ["perfect", "karras", "apetrei-fused", "lbvh-levels", "oibvh-single", "oibvh-multi"]
VERDICTS = ("SAME", "FASTER", "SLOWER", "UNSURE")
LOADS = (0.2, 1, 2, 4)  # busy loops; a fraction is the share of time in which one loop is busy
BUSY = "import sys, time\nshare = float(sys.argv[1])\nwhile True:\n    end = time.monotonic() + 0.01 * share\n" \
       "    while time.monotonic() < end:\n        pass\n    time.sleep(0.01 * (1 - share))"


def busy_loops(load: float) -> list[subprocess.Popen]:
    shares = [1.0] * int(load) + ([load % 1] if load % 1 else [])
    return [subprocess.Popen([sys.executable, "-c", BUSY, str(share)]) for share in shares]


def measure(program: pathlib.Path, folder: pathlib.Path, trial: int, options: argparse.Namespace, load: float) -> None:
    """Runs all processes of a trial."""
    slowed = f"{BUILDERS[trial % len(BUILDERS)]}:{options.slow}"
    loops = busy_loops(load)
    try:
        for process in range(options.processes):
            runs = []
            for name in ("before", "after", "slow"):
                environment = {**os.environ, "BVHBENCH_SLOW": slowed if name == "slow" else ""}
                runs.append(subprocess.Popen([program, "--quiet", "run", folder / "trial.json", "--out", folder / f"{name}-{trial}-{process}.json",
                                              "--turns", f"{folder / f'turns-{trial}-{process}'}:3"], env=environment,
                                             stdout=subprocess.DEVNULL))
            if any([run.wait() for run in runs]):
                sys.exit("a run failed")
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()


def verdicts(program: pathlib.Path, first: list[pathlib.Path], second: list[pathlib.Path]) -> dict[str, str]:
    """Returns the verdict of each cell, by its builder."""
    done = subprocess.run([program, "compare", *first, *second, "--all", "--allow-dirty", "--test-hooks"], capture_output=True, text=True)
    assert done.returncode in (0, 1), done
    found = {}
    for line in done.stdout.splitlines():
        words = line.split()
        if words and words[-1] in VERDICTS and ": " in line:
            found[line.split(": ", 1)[1].split("  ")[0].strip()] = words[-1]
    assert len(found) == len(BUILDERS), done.stdout
    return found


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--trials", type=int, default=20, help="without load, and as many beside loads")
    parser.add_argument("--processes", type=int, default=8)
    parser.add_argument("--samples", type=int, default=60)
    parser.add_argument("--slow", type=float, default=1.10)
    parser.add_argument("--write", type=pathlib.Path, help="write the verdicts to this file")
    parser.add_argument("--keep", type=pathlib.Path, help="folder of the runs; trials that are there are not run again")
    options = parser.parse_args()
    lines = []
    alarms, compared, found = Counter(), Counter(), 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        plan = {"experiment": "trial", "scenes": ["torus:20000"], "builders": BUILDERS, "samples": options.samples, "warm_up": 5}
        (folder / "trial.json").write_text(json.dumps(plan))
        for trial in range(2 * options.trials):
            load = 0 if trial < options.trials else LOADS[trial % len(LOADS)]
            files = {name: [folder / f"{name}-{trial}-{process}.json" for process in range(options.processes)]
                     for name in ("before", "after", "slow")}
            if not all(file.exists() for of_name in files.values() for file in of_name):
                measure(options.program, folder, trial, options, load)
            slowed = BUILDERS[trial % len(BUILDERS)]
            same, slower = (verdicts(options.program, files["before"], files[name]) for name in ("after", "slow"))
            changed = [cell for cell, verdict in same.items() if verdict in ("SLOWER", "FASTER")]
            kind = "beside a load" if load else "without load"
            compared[kind] += 1
            alarms[kind] += bool(changed)
            found += not load and slower[slowed] == "SLOWER"
            lines.append({"trial": trial, "load": load, "slowed": slowed, "is": slower[slowed], "of_one_build": same})
            print(f"trial {trial}, load {load}: {slowed} slowed {slower[slowed]};", "of one build", ", ".join(changed) or "none", "changed", flush=True)
    if options.write:
        options.write.write_text("".join(json.dumps(line) + "\n" for line in lines))
    for kind, count in compared.items():
        print(f"of one build, {kind}: {alarms[kind]} of {count} comparisons with an alarm (at most one in 20 allowed)")
    print(f"slowed by {options.slow}: found in {found} of {options.trials} trials without load (at least 90 % wanted)")
    return 0 if all(20 * alarms[kind] <= count for kind, count in compared.items()) and found >= 0.9 * options.trials else 1


if __name__ == "__main__":
    sys.exit(main())
