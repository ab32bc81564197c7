"""The look of every figure: one colour, marker and hatch for each builder, type sizes, and how pictures are written."""
import io
import pathlib
import warnings
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import matplotlib

matplotlib.use("Agg")
matplotlib.rcdefaults()  # a matplotlibrc of the user's changes nothing
import matplotlib.pyplot as plt  # noqa: E402  (the backend is chosen first)
from matplotlib.colors import to_rgb  # noqa: E402

from PIL import Image  # noqa: E402  (matplotlib needs it too)

from ..files import json_files, output  # noqa: E402
from ..read.results import Cell, Refused  # noqa: E402
from ..words import names  # noqa: E402

PAGE_WIDTH = 7.0  # inches: the text width of a two-column page
SMALL = 6.5  # points: the smallest type in any figure
DPI = 200


@dataclass(frozen=True)
class Look:
    colour: str
    marker: str
    hatch: str = ""


# In the order of legends. Colours are Okabe and Ito's, which are distinct for all kinds of colour vision, plus grey and brown.
# Builders that share a colour differ in marker and hatch. To add a builder, add its line here.
LOOKS = {
    "perfect": Look("#999999", "s"),
    "apetrei": Look("#E69F00", "^"),
    "apetrei-fused": Look("#D55E00", "v"),
    "karras": Look("#CC79A7", "D"),
    "lbvh-levels": Look("#7F0000", "p", "////"),
    "hploc": Look("#666600", "h", "...."),
    "oibvh-single": Look("#56B4E9", "o"),
    "oibvh-single-printed": Look("#008B8B", "^", "////"),
    "oibvh-multi": Look("#0072B2", "o"),
    "oibvh-multi-printed": Look("#5E3C99", "^", "////"),
    "oibvh-wide4": Look("#0072B2", "d", "...."),
    "oibvh-wide8": Look("#0072B2", "*", "xxxx"),
    "oibvh-wide8-q8": Look("#0072B2", "P", "++++"),
    "oibvh-host": Look("#0072B2", "h", "oo"),
    "oibvh-reference": Look("#000000", "x"),
    "radix-reference": Look("#000000", "+", "////"),
    "hploc-reference": Look("#000000", "P", "...."),
    "heap-median": Look("#8C510A", "s", "xxxx"),
    "median-split": Look("#8C510A", "^"),
    "sah-binned": Look("#8C510A", "v", "////"),
    "embree-low": Look("#009E73", "<"),
    "embree-medium": Look("#009E73", ">", "////"),
    "embree-high": Look("#009E73", "P", "...."),
    "fcl-aabb": Look("#F0E442", "h"),
    "fcl-obbrss": Look("#F0E442", "H", "////"),
}

# A builder measured with several options: the first variant has the builder's look, all others of a figure have these, in order.
# The colours are Tol's muted ones.
VARIANT_LOOKS = (Look("#332288", "s", "\\\\\\\\"), Look("#44AA99", "D", "xxxx"), Look("#882255", "^", "oooo"),
                 Look("#999933", "v", "////"), Look("#AA4499", "p", "++++"), Look("#117733", "<", "...."),
                 Look("#DDCC77", "P", "\\\\\\\\"), Look("#CC6677", ">", "xxxx"))

PAPER_MARK = {"marker": "d", "markersize": 4.5, "markerfacecolor": "white", "markeredgecolor": "black",
              "markeredgewidth": 0.8, "linestyle": "none"}

Series = tuple[str, tuple[tuple[str, str], ...]]  # a builder's name and its options


def look(builder: str) -> Look:
    if builder in names.OUTSIDE:
        return VARIANT_LOOKS[list(names.OUTSIDE).index(builder) % len(VARIANT_LOOKS)]
    if builder not in LOOKS:
        raise Refused(f"plots/draw/style.py has no look for the builder '{builder}': add a line to LOOKS")
    return LOOKS[builder]


def ink_on(colour: str) -> str:
    """Returns black or white, whichever is easier to read on the colour."""
    red, green, blue = (value**2.2 for value in to_rgb(colour))
    return "black" if 0.2126 * red + 0.7152 * green + 0.0722 * blue > 0.2 else "white"


def series_of(cell: Cell) -> Series:
    return (cell.builder, cell.options)


def in_order(cells: Iterable[Cell]) -> list[Series]:
    """Returns each series of the cells once, in the order of LOOKS."""
    builders = [*LOOKS, *names.OUTSIDE]
    return sorted({series_of(cell) for cell in cells}, key=lambda s: (builders.index(look(s[0]) and s[0]), s[1]))


def extras(among: list[Series]) -> list[Series]:
    """Returns all series but the first of each builder."""
    firsts = {name: (name, options) for name, options in reversed(among)}
    return [series for series in among if series != firsts[series[0]]]


def look_in(series: Series, among: list[Series], look_of: Callable[[str], Look] = look) -> Look:
    """Returns the look of a series in a figure that shows `among`: its builder's, or that of a further variant."""
    more = extras(among)
    return VARIANT_LOOKS[more.index(series) % len(VARIANT_LOOKS)] if series in more else look_of(series[0])


def label(series: Series, among: list[Series]) -> str:
    """Returns the builder's name, with the options in which it differs from its other variants."""
    others = [set(options) for name, options in among if name == series[0]]
    places = list(names.OPTIONS)
    differing = sorted((places.index(key) if key in places else len(places), names.option(key, value)) for key, value in series[1]
                       if any((key, value) not in options for options in others))
    return series[0] + (f" ({', '.join(words for _, words in differing)})" if differing else "")


def set_up() -> None:
    for kind in (UserWarning, RuntimeWarning):  # about panels without room, or numbers that overflow: there is no figure then
        warnings.simplefilter("error", kind)
    warnings.filterwarnings("ignore", "Glyph")  # a letter that the font lacks is drawn as a box
    plt.rcParams.update({
        "font.family": "DejaVu Sans", "font.size": 8, "axes.titlesize": 8, "axes.labelsize": 8,
        "xtick.labelsize": 7, "ytick.labelsize": 7, "legend.fontsize": 7, "legend.frameon": False,
        "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.6,
        "axes.axisbelow": True, "axes.grid.axis": "y", "axes.grid": True, "grid.linewidth": 0.4,
        "grid.color": "#dddddd", "hatch.linewidth": 0.5, "lines.linewidth": 1.2, "lines.markersize": 4,
        "svg.hashsalt": "bvhbench", "svg.fonttype": "none", "figure.dpi": 100,
    })


def stem(path: pathlib.Path, figure: str) -> str:
    """Returns the picture's name: the result file's name, followed by the figure's unless it contains that already."""
    name = json_files.name_of(path)
    return name if figure in name else f"{name}-{figure}"


def fix_layout(figure: plt.Figure) -> None:
    """Fixes the layout, rounded: the last digits depend on earlier drawings, and clip paths are named after them."""
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    for axes in figure.axes:
        axes.set_position([round(length, 5) for length in axes.get_position().bounds])


def with_palette(png: io.BytesIO) -> bytes:
    """Returns the picture with at most 256 colours, which takes a third of the bytes."""
    with Image.open(png) as picture, io.BytesIO() as smaller:
        picture.convert("RGB").quantize(256, dither=Image.Dither.NONE).save(smaller, "PNG", optimize=True, dpi=(DPI, DPI))
        return smaller.getvalue()


def content(figure: plt.Figure, kind: str) -> bytes:
    """Returns the picture as ".png" or ".svg". Equal numbers give equal bytes: no dates, no random names."""
    if figure.get_layout_engine() is not None:
        fix_layout(figure)
    how = {"dpi": DPI} if kind == ".png" else {"metadata": {"Date": None, "Creator": None}}
    with io.BytesIO() as made:
        figure.savefig(made, format=kind[1:], **how)
        return with_palette(made) if kind == ".png" else made.getvalue()


def save(figure: plt.Figure, folder: pathlib.Path, name: str, inputs: list[pathlib.Path], force: bool) -> list[pathlib.Path]:
    """Writes PNG and SVG. Raises what output raises."""
    paths = [folder / f"{name}{kind}" for kind in (".png", ".svg")]
    for path in paths:
        output.check(path, inputs, force, output.is_picture)
    contents = [content(figure, path.suffix) for path in paths]
    plt.close(figure)
    output.make_folder(folder)
    for path, made in zip(paths, contents, strict=True):
        output.write(path, made)
    return paths
