#!/usr/bin/env python3
"""Fuzzes every command that reads result files with malformed ones: each must succeed or print one sentence with the reason.

Usage: results_fuzz.py <source root> [--cases N] [--seconds S] [--seed N] [--only COMMAND]

Each case is a small result file with some of its cells, or a file of `cluster`, changed in its values or in its bytes. Every
command reads each case, and `compare` the unchanged file too; figures are drawn of every tenth. An exit code that docs/commands.md
does not have for the command, or any output but one sentence, is a finding.
Findings are kept in build/fuzz/results; turn each into a test and then into a seed in tests/fuzz/results.
"""
import argparse
import collections
import contextlib
import copy
import io
import json
import os
import pathlib
import random
import shutil
import sys
import tempfile
import time
import traceback
from collections.abc import Callable
from typing import Any

ROOT = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(ROOT))

from plots.commands import compare, export, merge, plot, report, show  # noqa: E402
from plots.page import html  # noqa: E402
from plots.program import command  # noqa: E402

NUMBERS = (0, 1, -1, 2, 2**31, 2**53 + 1, 2**63, 2**64, 10**30, 10**400, 0.0, -0.0, 1e-320, 1e-17, 0.5, 1e99, 1e101, 1e308,
           -1e308, float("inf"), float("nan"))
TEXTS = ("", " ", "\ud800", "\0", "\n", "\x1b[31m", "$a$", "$\\frac$", "<script>", "</script>", "=1+1", "1.0", "2.0", "a" * 5000, "𝕊", "none",
         "build", "collide", "accuracy", "measured", "failed", "skipped", "differs", "counted", "karras", "leaf", "table1", "fig8")
OTHERS = (None, True, False, [], {}, [[]], {"": {}}, [None], [1, "a"])
KEPT = 4  # most cells in a case
FIGURES_EVERY = 10


def deep() -> Any:
    value: Any = []
    for _ in range(60):
        value = [value]
    return value


def nodes(value: Any) -> list[tuple[Any, Any]]:
    """Returns the container and key of every value in a JSON tree."""
    found = []
    waiting = [value]
    while waiting:
        container = waiting.pop()
        items = container.items() if isinstance(container, dict) else enumerate(container)
        for key, item in items:
            found.append((container, key))
            if isinstance(item, (dict, list)):
                waiting.append(item)
    return found


def of_its_kind(value: Any, chance: random.Random) -> Any:
    """Returns a random value of the same type, or one of OTHERS."""
    if isinstance(value, str):
        return chance.choice(TEXTS)
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return chance.choice((*NUMBERS, value * 10**6, -value))
    return copy.deepcopy(chance.choice(OTHERS))


def changed(document: Any, chance: random.Random) -> Any:
    """Changes one value, key or position in the document."""
    container, key = chance.choice(nodes(document) or [({"": document}, "")])
    way = chance.randrange(8)
    if way < 4:
        container[key] = of_its_kind(container[key], chance)
    elif way == 4:
        container[key] = copy.deepcopy(chance.choice((*NUMBERS, *TEXTS, *OTHERS, deep())))
    elif way == 5:
        del container[key]
    elif way == 6:
        other, place = chance.choice(nodes(document))
        container[key] = copy.deepcopy(other[place])
    elif isinstance(container, list):
        container += copy.deepcopy(container)
    else:
        container[chance.choice(TEXTS)] = container.pop(key)
    return document


def bytes_changed(text: bytes, chance: random.Random) -> bytes:
    first, last = sorted(chance.randrange(len(text) + 1) for _ in range(2))
    last = min(last, first + 200)
    return chance.choice((text[:first], text[:first] + text[last:], text[:last] + text[first:],
                          text[:first] + chance.randbytes(1 + chance.randrange(4)) + text[last:],
                          text[:first] + bytes([chance.choice(b"[]{},:\"\\-+e0")]) + text[first + 1:]))


def case(seed: dict[str, Any], chance: random.Random) -> bytes:
    document = copy.deepcopy(seed)
    for part in ("cells", "stress"):
        if document.get(part) and chance.random() < 0.8:
            document[part] = chance.sample(document[part], min(len(document[part]), chance.randint(1, KEPT)))
    for _ in range(chance.choice((1, 1, 1, 2, 4))):
        document = changed(document, chance)
    text = json.dumps(document).encode()
    return bytes_changed(text, chance) if chance.random() < 0.2 else text


def calls(folder: pathlib.Path, chance: random.Random) -> dict[str, tuple[Callable[[], int], list[str], set[int]]]:
    """Returns how each command reads the case: its main(), its words, and the codes that it may end with beside 0 and 3: 0 if it may say
    a sentence then."""
    file, before = str(folder / "case.json"), str(folder / "before.json")
    words = {"show": [file], "compare": [before, file, "--allow-dirty"], "merge": [file, "-o", str(folder / "m.json"), "--force"],
             "export": [file, "--format", chance.choice(list(export.FORMATS)), "--out", str(folder / "e.txt"), "--force"],
             "report": [file, "-o", str(folder / "r.html")], "plot": [file, "--out", str(folder / "pictures")]}
    return {name: (lambda read=read, name=name: command.run(read.main, words[name]), [name, *words[name]], codes) for name, read, codes in (
        ("show", show, set()), ("compare", compare, {1, 2}), ("merge", merge, {1, 2}), ("export", export, {0}),
        ("report", report, {1}), ("plot", plot, set()))}


def ended(main: Callable[[], int], words: list[str]) -> tuple[object, str]:
    """Runs main() as from a shell; returns the exit code (or the traceback of an exception) and standard error."""
    errors = io.TextIOWrapper(io.BytesIO(), encoding="utf-8", errors="surrogateescape")
    sys.argv = words
    with contextlib.redirect_stdout(io.TextIOWrapper(io.BytesIO(), encoding="utf-8")), contextlib.redirect_stderr(errors):
        try:
            code: object = main()
        except BaseException:
            code = traceback.format_exc()
    errors.seek(0)
    return code, errors.read()


def is_find(code: object, said: str, codes: set[int]) -> bool:
    is_sentence = said.count("\n") == 1 and len(said) > 20
    return not (code in {3, *(codes & {0, 2})} and is_sentence or code in {0, *(codes & {1})} and said == "")


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("root")
    parser.add_argument("--cases", type=int, default=10**9)
    parser.add_argument("--seconds", type=float, default=float("inf"))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="the command to fuzz; default: all")
    arguments = parser.parse_args()
    paths = [*sorted((ROOT / "tests" / "golden").glob("*.json")), *sorted((ROOT / "tests" / "fuzz" / "results").iterdir())]
    seeds = [json.loads(path.read_text(encoding="utf-8")) for path in paths]
    codes: collections.Counter[str] = collections.Counter()
    finds = 0
    end = time.monotonic() + arguments.seconds
    memory = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None  # a memory file system, where fsync costs no time
    with tempfile.TemporaryDirectory(dir=memory) as name:
        folder = pathlib.Path(name)
        (folder / "plotly.js").write_text("", encoding="utf-8")
        html.plotly_file = lambda: folder / "plotly.js"  # loading it would take most of a page's time
        for number in range(arguments.cases):
            if time.monotonic() > end:
                break
            chance = random.Random(f"{arguments.seed} {number}")
            seed = chance.choice(seeds)
            (folder / "before.json").write_text(json.dumps(seed), encoding="utf-8")
            (folder / "case.json").write_bytes(case(seed, chance))
            for what, (script, words, others) in calls(folder, chance).items():
                if arguments.only not in ("", what) or (what == "plot" and arguments.only == "" and number % FIGURES_EVERY != 0):
                    continue
                code, said = ended(script, words)
                codes[f"{what} {code if isinstance(code, int) else 'an exception'}"] += 1
                if is_find(code, said, others):
                    finds += 1
                    kept = ROOT / "build" / "fuzz" / "results" / f"{arguments.seed}-{number}.json"
                    kept.parent.mkdir(parents=True, exist_ok=True)
                    shutil.copy(folder / "case.json", kept)
                    shutil.copy(folder / "before.json", kept.with_suffix(".before.json"))
                    print(f"find: {what} of {kept}: {code}\n{said}", flush=True)
            for made in ("m.json", "r.html", "e.txt"):
                (folder / made).unlink(missing_ok=True)
            shutil.rmtree(folder / "pictures", ignore_errors=True)
    print(f"{sum(codes.values())} runs, {finds} finds: " + ", ".join(f"{count} {what}" for what, count in sorted(codes.items())))
    return 1 if finds else 0


if __name__ == "__main__":
    sys.exit(main())
