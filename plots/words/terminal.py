"""How wide tables are and which colours they have: as the terminal allows; elsewhere whole and without colour."""
import os
import re
import shutil
import sys
import textwrap
from dataclasses import dataclass

# Stand for the start of a style and for its end in text on its way to standard output, which spells out control characters.
RED, GREEN, DIM, BOLD, PLAIN = (chr(0xF0000 + place) for place in range(5))
CODES = {RED: "\x1b[31m", GREEN: "\x1b[32m", DIM: "\x1b[2m", BOLD: "\x1b[1m", PLAIN: "\x1b[0m"}
STYLES = ((re.compile(r"differs|failed|NOT |-\d|.*\bwrong\b"), RED),
          (re.compile(r"agrees|right|the same|\d+ right$"), GREEN),
          (re.compile(r"skipped|refused|not checked|counted"), DIM))


@dataclass
class Screen:
    width: int | None = None  # columns of text; None: as wide as the tables are
    has_colour: bool = False


screen = Screen()


def set_up(is_wide: bool) -> None:
    """Takes width and colour from standard output and the environment. COLUMNS overrides the terminal's width."""
    is_terminal = sys.stdout.isatty()
    screen.width = None if is_wide or not is_terminal else max(40, shutil.get_terminal_size().columns)
    screen.has_colour = is_terminal and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"


def cleaned(text: str) -> str:
    """Returns the text without the letters that stand for styles: names from files have none."""
    return re.sub(f"[{RED}-{PLAIN}]", "", text)


def prose(text: str) -> str:
    """Returns the text with line breaks between words where a terminal is narrower."""
    return text if screen.width is None else textwrap.fill(text, screen.width, break_long_words=False, break_on_hyphens=False)


def of_verdict(entry: str) -> str:
    """Returns the style of a verdict, or "" for other entries."""
    return next((style for pattern, style in STYLES if pattern.match(entry)), "")


def dressed(text: str, style: str) -> str:
    return f"{style}{text}{PLAIN}" if style and text.strip() and screen.has_colour else text


def with_codes(text: str) -> str:
    """Returns the text with the terminal's codes in place of the letters that stand for styles."""
    return re.sub(f"[{RED}-{PLAIN}]", lambda letter: CODES[letter[0]] if screen.has_colour else "", text)
