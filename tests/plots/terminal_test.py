"""Tests that tables fit a terminal and have colours there, and are whole and plain elsewhere."""
import contextlib
import os
import pty
import re
import subprocess
import sys
import unittest

from base import ROOT, InFolder, cell, document  # first: it adds the source root to sys.path

from plots.files import output
from plots.words import terminal
from plots.words.tables import Table

CODES = re.compile("\x1b\\[[0-9;]*m")


def on_a_terminal(words: list[object], **environment: str) -> str:
    """Returns what a command that succeeds writes to a terminal."""
    own, child = pty.openpty()
    with subprocess.Popen(words, stdout=child, env={**os.environ, **environment}) as process, os.fdopen(own, "rb", buffering=0) as reader:
        os.close(child)
        shown = b""
        with contextlib.suppress(OSError):  # the terminal's other end is closed
            while part := reader.read(4096):
                shown += part
    assert process.returncode == 0, shown
    return shown.decode().replace("\r\n", "\n")


class Letters(InFolder):
    def test_that_a_terminal_obeys_are_spelled_out(self) -> None:
        self.assertEqual(output.printable("a\tb\n\x1b[31m\x9b31m\x85\u202ec\u2066d\udc9b\udce4 äß"),
                         "a\tb\n\\x1b[31m\\x9b31m\\x85\\u202ec\\u2066d\\x9b\udce4 äß")

    def test_of_an_export_reach_a_file_and_no_terminal(self) -> None:
        path, out = self.written(document(cell("a\x9bb\u202ec\x1b]0;d"))), self.folder / "e.csv"
        words = [sys.executable, ROOT / "plots", "export", path, "--format", "csv"]
        subprocess.run([*words, "--out", out], check=True, capture_output=True)
        self.assertIn("a\x9bb\u202ec\x1b]0;d", out.read_text(encoding="utf-8"))
        self.assertIn("a\\x9bb\\u202ec\\x1b]0;d", on_a_terminal(words))


class Tables(unittest.TestCase):
    def setUp(self) -> None:
        before = terminal.screen
        self.addCleanup(setattr, terminal, "screen", before)

    def text(self, width: int | None, has_colour: bool = False) -> str:
        table = Table("<scene", "triangles", "<builder", "median", "p10", "p90", "n", "<verdict")
        for builder, ns, verdict in (("oibvh-multi, hilbert30, sorted leaves", 2, "agrees"), ("karras", 1, "agrees"),
                                     ("perfect", 3, "differs: node 3 is lost"), ("apetrei", 4, "skipped")):
            table.row("bunny", "144,046", builder, f"{ns} us", "1 us", f"{ns + 1} us", "20", verdict, among="bunny", value=ns)
        terminal.screen = terminal.Screen(width, has_colour)
        return table.text()

    def test_are_whole_without_a_width(self) -> None:
        self.assertEqual(self.text(None).splitlines()[0],
                         "scene  triangles  builder                                median   p10   p90   n  verdict")

    def test_fit_any_usual_width(self) -> None:
        for width in (40, 60, 80, 120):
            lines = self.text(width).splitlines()
            self.assertLessEqual(max(map(len, lines)), width, lines)

    def test_wrap_titles_and_break_no_word(self) -> None:
        table = Table("<scene", *(f"<a library with a long name {number}" for number in range(3)))
        table.row("hairball:2880000", "right", "wrong", "19 wrong")
        terminal.screen = terminal.Screen(64)
        lines = table.text().splitlines()
        self.assertLessEqual(max(map(len, lines)), 64, lines)
        self.assertIn("hairball:2880000", "".join(lines))

    def test_say_what_all_rows_share_once_above_them(self) -> None:
        above, titles, *rows = self.text(120).splitlines()
        self.assertEqual(above, "scene: bunny; triangles: 144,046; p10: 1 us; n: 20")
        self.assertEqual(titles.split(), ["builder", "median", "p90", "verdict"])
        self.assertEqual(len(rows), 4)

    def test_wrap_names_and_name_the_columns_that_are_left_out(self) -> None:
        self.assertNotIn("left out", self.text(80))
        narrow = self.text(40).splitlines()
        self.assertIn("left out: p90", " ".join(narrow[-2:]))
        self.assertIn("--wide", " ".join(narrow[-2:]))
        self.assertGreater(len(narrow), 2 + 4 + 1)
        words = " ".join(" ".join(narrow).split())
        self.assertIn("median", words)
        for word in ("oibvh-multi,", "hilbert30,", "differs:", "lost"):
            self.assertIn(word, words)

    def test_colour_verdicts_and_the_best(self) -> None:
        plain, coloured = self.text(None), self.text(None, has_colour=True)
        self.assertEqual(terminal.cleaned(coloured), plain)
        right, best, wrong, skipped = coloured.splitlines()[1:]
        self.assertIn(f"{terminal.GREEN}agrees", right)
        self.assertNotIn(terminal.BOLD, right)
        self.assertIn(f"{terminal.BOLD}karras", best)
        self.assertIn(f"{terminal.RED}differs", wrong)
        self.assertIn(f"{terminal.DIM}skipped", skipped)

    def test_take_no_colour_from_names(self) -> None:
        terminal.screen = terminal.Screen(None, True)
        table = Table("<scene", "n")
        table.row(f"a{terminal.RED}b", "1")
        self.assertNotIn(terminal.RED, table.text())


class Show(InFolder):
    def shown(self, *words: str, columns: str = "80", **environment: str) -> str:
        """Returns what `show` writes to a terminal."""
        builders = ("oibvh-multi", "oibvh-single", "karras")
        file = self.written(document(*(cell(builder, 100_000 * (place + 1)) for place, builder in enumerate(builders))))
        return on_a_terminal([sys.executable, ROOT / "plots", "show", file, *words],
                             **{"TERM": "xterm", "COLUMNS": columns, "NO_COLOR": "", **environment})

    def piped(self, **environment: str) -> str:
        return subprocess.run([sys.executable, ROOT / "plots", "show", self.folder / "table1.json"], capture_output=True, text=True,
                              check=True, env={**os.environ, **environment}).stdout

    def widest(self, text: str) -> int:
        return max(len(CODES.sub("", line)) for line in text.splitlines() if "median" in line or "karras" in line)

    def test_fits_the_terminal_and_is_whole_with_wide_and_in_a_pipe(self) -> None:
        narrow = self.shown()
        self.assertLessEqual(self.widest(narrow), 80)
        self.assertIn(terminal.CODES[terminal.GREEN], self.shown("--wide"))
        whole = CODES.sub("", self.shown("--wide"))
        self.assertGreater(self.widest(whole), 80)
        self.assertEqual(self.piped(COLUMNS="40", TERM="xterm"), whole)

    def test_has_no_colour_with_no_color(self) -> None:
        self.assertIn("\x1b[", self.shown())
        self.assertNotIn("\x1b[", self.shown(NO_COLOR="1"))
        self.assertNotIn("\x1b[", self.shown(TERM="dumb"))

    def test_spells_out_control_characters_of_names(self) -> None:
        made = document(cell(), cell("karras"))
        made["cells"][0]["scene"]["name"] = "\x1b[31mred"
        self.written(made)
        self.assertIn("\\x1b[31mred", self.piped())
