"""Assembles a page: one HTML file that needs no other file and no network.

Markup, style and scripts from plots/page/web/ are embedded as plain text, so they can be read in the page's source. Libraries, data
and samples are gzip in base64; plots/page/web/unpack.js unpacks them, samples only on request."""
import base64
import gzip
import html
import importlib.util
import json
import pathlib
from typing import Any

from ..read import results

PARTS = pathlib.Path(__file__).resolve().parent / "web"
STYLES = ("base.css", "tables.css", "charts.css", "samples.css", "view.css")
SCRIPTS = ("unpack.js", "format.js", "theme.js", "table.js", "legend.js", "compared.js", "chart.js", "chart_size.js",
           "chart_stages.js", "chart_pareto.js", "chart_frames.js", "samples.js", "view.js", "page.js")
DEBIAN = pathlib.Path("/usr/share")


def plotly_file() -> pathlib.Path:
    """Returns Debian's plotly.js, or that of the Python package. Raises results.Refused if there is none."""
    debian = DEBIAN / "python3-plotly" / "plotly.js"
    package = importlib.util.find_spec("plotly")
    folders = package.submodule_search_locations or [] if package else []
    for path in (debian, *(pathlib.Path(folder) / "package_data" / "plotly.min.js" for folder in folders)):
        if path.exists():
            return path
    raise results.Refused(f"charts need plotly.js, and neither {debian} nor a Python package plotly is there: "
                          "on Debian, install python3-plotly")


def three_files() -> list[pathlib.Path]:
    folder = DEBIAN / "javascript" / "three"
    files = [folder / "three.min.js", folder / "examples" / "js" / "controls" / "OrbitControls.js"]
    if missing := [path for path in files if not path.exists()]:
        raise results.Refused(f"a scene in three dimensions needs three.js, and {missing[0]} is not there: on Debian, install libjs-three")
    return files


def blob(name: str, content: bytes) -> str:
    """Returns bytes packed for unpack.js. Equal bytes give equal text, since no time is stored."""
    text = base64.b64encode(gzip.compress(content, 9, mtime=0)).decode("ascii")
    return f'<script type="text/plain" id="blob-{name}">{text}</script>'


def json_blob(name: str, value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    return blob(name, text.encode("utf-8"))


def inlined(names: tuple[str, ...]) -> str:
    return "\n".join(f"/* plots/page/web/{name} */\n" + (PARTS / name).read_text(encoding="utf-8") for name in names)


def finding(found: dict[str, Any], head: str = "") -> str:
    """Returns a question and its answer."""
    lines = [f'<p class="{name}">{html.escape(found[name])}</p>' for name in ("question", "answer") if found[name]]
    return f'<div class="finding">{head}{"".join(lines)}</div>' if lines else ""


def findings(devices: list[str], files: list[tuple[str, list[dict[str, Any]]]]) -> str:
    """Returns what devices the files are of, and what was found in each file, with links to the files."""
    def head(number: int, title: str, experiment: str) -> str:
        more = f" <span>{html.escape(experiment)}</span>" if experiment not in title else ""
        return f'<h4><a href="#file-{number}">{html.escape(title)}</a>{more}</h4>'

    said = "".join(finding(found, head(number, title, found["experiment"])) for number, (title, all_found) in enumerate(files)
                   for found in all_found)
    measured = f'<p class="note">Measured on {html.escape(", ".join(dict.fromkeys(devices)))}.</p>' if devices else ""
    return measured + (f'<h3>What was found</h3><div class="findings">{said}</div>' if said else "")


def section(number: int, title: str, sentence: str, warnings: list[str], findings: list[dict[str, Any]]) -> str:
    """Returns the part of a file's section that is visible without scripts."""
    said = "".join(f'<p class="warning">{html.escape(warning)}</p>' for warning in warnings)
    return (f'<section id="file-{number}" class="file" hidden><h2>{html.escape(title)}</h2>'
            f'<p class="note">{html.escape(sentence)}</p>{said}{"".join(map(finding, findings))}'
            f'<details class="circumstances"><summary>What was run on what</summary></details>'
            '<div class="verdicts"></div><div class="charts"></div><div class="tables"></div></section>')


def libraries(scenes: bool) -> list[str]:
    """Returns the libraries that a page, or one with scenes, needs. Raises results.Refused if one is not there."""
    return [blob("plotly", plotly_file().read_bytes())] + ([blob("three", b"\n".join(path.read_bytes() for path in three_files()))] if scenes else [])


def page(title: str, found: str, note: str, sections: list[str], blobs: list[str]) -> str:
    filled = {"TITLE": html.escape(title), "STYLE": inlined(STYLES), "FINDINGS": found, "NOTE": html.escape(note),
              "SECTIONS": "\n".join(sections), "BLOBS": "\n".join(blobs), "SCRIPT": inlined(SCRIPTS)}
    text = (PARTS / "page.html").read_text(encoding="utf-8")
    for name, content in filled.items():
        text = text.replace(f"<!--{name}-->", content)
    return text
