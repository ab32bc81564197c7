"""Shared by tests of a page: a report of golden files, one with faults, open in a browser, and ways to query it.

Tests run as `<test> <source root> <bvhbench>`; this module takes both arguments off the command line."""
import atexit
import copy
import functools
import json
import pathlib
import socket
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

ROOT = pathlib.Path(sys.argv.pop(1)).resolve()
PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
GOLDEN = ROOT / "tests" / "golden"
sys.path.insert(0, str(ROOT))

from plots.read import results  # noqa: E402
from browser import Browser  # noqa: E402

FILES = ("table1", "quality", "table2", "accuracy", "stress")
DETAIL = "=7 is not its children's box"  # begins like a formula


def with_faults(document: dict) -> dict:
    """Makes one cell wrong and one failed; one is already skipped in the golden file. Adds soups as large as its tori, and makes
    the copy rate so low that everything must have come from a cache."""
    document = copy.deepcopy(document)
    document["run"]["copy_rate_bytes_per_s"] = 1e6
    for cell in copy.deepcopy([cell for cell in document["cells"] if cell["scene"]["name"].startswith("torus")]):
        cell["scene"]["name"] = cell["scene"]["name"].replace("torus", "soup")
        document["cells"] += [cell] if cell["status"] == "measured" else []
    measured = [cell for cell in document["cells"] if cell["status"] == "measured"]
    measured[0]["check"] = {"verdict": "differs", "against": "contract", "detail": DETAIL}
    failed = measured[1]
    for key in ("samples", "counters", "check", "warm_up"):
        del failed[key]
    failed |= {"status": "failed", "reason": "out of device memory: 9 bytes"}
    return document


def golden(name: str) -> dict:
    return json.loads((GOLDEN / f"{name}.json").read_text(encoding="utf-8"))


def report(out: pathlib.Path, *files: pathlib.Path) -> subprocess.CompletedProcess:
    return subprocess.run([PROGRAM, "report", *files, "-o", out], capture_output=True, text=True, check=False,
                          env={"BVHBENCH_HOME": str(ROOT), "PATH": "/usr/bin:/bin"})


def by_address(host: str, *arguments: object, **more: object) -> list:
    """Replaces socket.getaddrinfo where no names are known, as in a container without /etc/hosts."""
    return look_up(host, *arguments, **more | {"flags": socket.AI_NUMERICHOST})


look_up = socket.getaddrinfo
unittest.mock.patch("socket.getaddrinfo", by_address).start()


class Opened:
    """A report and a browser, created on first use."""

    def __init__(self) -> None:
        self.holder = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.holder.name)
        self.faulty = with_faults(golden("table1"))
        (self.folder / "faulty.json").write_text(json.dumps(self.faulty), encoding="utf-8")
        self.files = [*(GOLDEN / f"{name}.json" for name in FILES), self.folder / "faulty.json"]
        self.page = self.folder / "a report.html"
        self.made = report(self.page, *self.files)
        if not self.page.exists():
            raise AssertionError(f"no page was made: {self.made}")
        self.browser = Browser()
        atexit.register(self.holder.cleanup)
        atexit.register(self.browser.close)


@functools.cache
def opened() -> Opened:
    return Opened()


class Page(unittest.TestCase):
    """A test that fails if the console printed anything, or if there was a network request."""

    def setUp(self) -> None:
        self.report = opened()
        self.browser = self.report.browser
        self.browser.resize(1280)

    def tearDown(self) -> None:
        self.assertEqual(self.browser.complaints(), [])
        self.assertEqual(self.browser.requests(), [])

    def show(self, name: str) -> results.Run | None:
        """Shows and draws a file's part. Returns the golden file as figures read it."""
        place = len(FILES) if name == "faulty" else FILES.index(name)
        self.browser.open(self.report.page, f"#file-{place}")
        self.browser.all_drawn()
        return results.load(GOLDEN / f"{name}.json") if name in FILES else None

    def chart(self, title: str, script: str, *arguments: object) -> object:
        """Runs `script` with the element `chart` and its Plotly `drawing`."""
        return self.browser.run(f"""const chart = [...document.querySelectorAll("section:not([hidden]) .chart")].find(
            (one) => one.querySelector("h3").textContent === {json.dumps(title)});
            const drawing = chart.querySelector(".drawing"); {script}""", *arguments)

    def choose(self, title: str, label: str, value: str) -> None:
        self.chart(title, """const named = [...chart.querySelectorAll("label")].find((one) => one.textContent.startsWith(arguments[0]));
            const select = named.querySelector("select");
            select.value = arguments[1];
            select.dispatchEvent(new Event("change"));""", label, value)

    def table(self, title: str, script: str, *arguments: object) -> object:
        return self.browser.run(f"""const titled = [...document.querySelectorAll("section:not([hidden]) .titled")].find(
            (one) => one.querySelector("h3").textContent === {json.dumps(title)});
            const cells = (row) => [...row.children].map((cell) => cell.innerText); {script}""", *arguments)

    def rows(self, title: str) -> list[list[str]]:
        return self.table(title, "return [...titled.querySelectorAll('tbody tr')].map(cells);")

    def per_second(self, title: str) -> float:
        """Returns the number of a table's time units in a second."""
        unit = self.table(title, "return titled.querySelector('thead .unit').textContent;")
        return {"ns": 1e9, "µs": 1e6, "ms": 1e3, "s": 1.0}[unit]

    def heads(self, title: str) -> list[str]:
        heads = self.table(title, "return [...titled.querySelectorAll('thead button')].map((head) => head.firstChild.data);")
        return [head.strip() for head in heads]
