"""The report in a browser: at three widths, in both colours, on paper, offline and for who cannot see it.

Chromium runs without a driver: a script behind the report writes what it found into the page, which is then dumped.
"""

from __future__ import annotations

import html
import importlib.util
import json
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

import made_up
from rwn.report import write_report
from rwn.report.diagnosis import Diagnosis

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
SECONDS = 240  # a busy machine is slow; one page takes three seconds on an idle one

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(CHROMIUM is None, reason="no Chromium here: make test-browser installs it"),
]
DRAWN = """
const drawn = async () => {
  while (!document.documentElement.dataset.drawn) await new Promise(r => setTimeout(r, 20)); };
const say = found => { const p = document.createElement('pre'); p.id = 'said'; p.textContent = JSON.stringify(found);
  document.body.append(p); };
const errors = []; addEventListener('error', e => errors.push(e.message));
addEventListener('securitypolicyviolation', e => errors.push('reached for ' + e.blockedURI));
"""
MEASURE = """drawn().then(() => axe.run(document)).then(judged => say({
  barriers: judged.violations.map(v => [v.id, v.nodes[0].html]), errors,
  width: innerWidth, wide: document.documentElement.scrollWidth,
  plots: [...document.querySelectorAll('.plot')].map(p => p.querySelectorAll('svg.main-svg .trace').length),
  buttons: [...new Set([...document.querySelectorAll('.modebar-btn')].map(b => b.dataset.title || b.ariaLabel))],
  buttonsOn: [...document.querySelectorAll('.modebar-group')].map(g => getComputedStyle(g).backgroundColor),
  tied: [...document.querySelectorAll('td[data-label]')].filter(e => innerWidth <= 780
    && getComputedStyle(e, '::before').whiteSpace === 'nowrap').map(e => e.dataset.label),
  cut: [...document.querySelectorAll('h1,h2,p,td,li,.fact b')].filter(e => e.scrollWidth > e.clientWidth + 1
    && getComputedStyle(e).display !== 'inline' && !e.classList.contains('unseen')).map(e => e.textContent),
}));"""

COLOUR = "drawn().then(() => say(getComputedStyle(document.body).backgroundColor));"


def run(*arguments: str) -> str:
    assert CHROMIUM is not None
    always = ["--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=60000"]
    done = subprocess.run([CHROMIUM, *always, *arguments], capture_output=True, text=True, timeout=SECONDS, check=True)
    return done.stdout


def axe() -> str:
    """The script of axe-core, which judges the page for who sees badly or uses no mouse."""
    found = importlib.util.find_spec("axe_core_python")
    if found is None or found.origin is None:
        pytest.skip("no axe here: pip install axe-core-python")
    return (Path(found.origin).parent / "axe.min.js").read_text(encoding="utf-8") + ";"


def asked(found: Diagnosis, folder: Path, script: str, *, width: int = 1280, dark: bool = False) -> Any:
    """What `script` says of the report of a diagnosis in a frame of this width (windows have a least one)."""
    page = folder / "report.html"
    write_report(found, page)
    (folder / "asked.html").write_text(
        page.read_text(encoding="utf-8").replace("<main>", f"<script>{DRAWN}</script><main>", 1)
        + f"<script>{script}</script>",
        encoding="utf-8",
    )
    (folder / "frame.html").write_text(
        f'<body style="margin:0"><iframe src="asked.html" style="width:{width}px;height:6000px;border:0"></iframe>'
        "<script>const copy = () => { const d = document.querySelector('iframe').contentDocument;"
        "const said = d.getElementById('said'); if (said) document.body.append(said.cloneNode(true));"
        "else setTimeout(copy, 50); }; copy();</script></body>"
    )
    scheme = "--blink-settings=preferredColorScheme=" + ("0" if dark else "1")
    window = f"--window-size={max(width, 600)},6000"
    text = run("--dump-dom", "--allow-file-access-from-files", scheme, window, (folder / "frame.html").as_uri())
    said = re.search(r'<pre id="said">(.*?)</pre>', text, re.DOTALL)
    assert said, "the report did not finish drawing"
    return json.loads(html.unescape(said.group(1)))


@pytest.mark.parametrize(
    ("state", "width", "dark"),
    [
        *((state, 360, False) for state in made_up.ALL),
        ("found", 800, True),
        *(("found", width, False) for width in (601, 781, 901)),  # the narrowest of each layout
        ("found", 1280, False),
        ("mistake", 1280, True),
    ],
)
def test_it_is_whole_and_without_barriers_at_three_widths(state: str, width: int, dark: bool, tmp_path: Path) -> None:
    said = asked(made_up.ALL[state](), tmp_path, axe() + MEASURE, width=width, dark=dark)
    assert said["errors"] == []
    assert said["width"] == width
    assert said["wide"] <= width
    assert said["cut"] == []
    assert said["plots"]
    assert all(lines > 0 for lines in said["plots"])
    assert set(said["buttons"]) == {"Zoom", "Pan", "Reset axes", "Download plot as a PNG"}
    assert set(said["buttonsOn"]) == {"rgba(0, 0, 0, 0)"}
    assert said["tied"] == [], "a label beside its value runs over it"
    assert said["barriers"] == []


def test_it_is_dark_where_the_reader_wants_it(tmp_path: Path) -> None:
    light, dark = (asked(made_up.found(), tmp_path, COLOUR, dark=d) for d in (False, True))
    brightness = [sum(int(n) for n in re.findall(r"\d+", colour)[:3]) for colour in (light, dark)]
    assert brightness[0] > 700
    assert brightness[1] < 100


def test_the_two_views_of_a_recording_and_the_map_are_linked(tmp_path: Path) -> None:
    script = """drawn().then(async () => {
      const pause = () => new Promise(r => setTimeout(r, 300));
      const [whole, close] = document.querySelectorAll('.plot[data-recording]');
      const range = () => close.layout.xaxis.range.slice();
      const ranges = [range()];
      await Plotly.relayout(whole, {'xaxis.range': [10, 12]});
      await pause(); ranges.push(range());
      const map = [...document.querySelectorAll('.plot')].find(p => p.data.some(l => l.meta));
      const {xaxis, yaxis} = map._fullLayout, points = map._fullData[0], at = 350;
      const box = map.getBoundingClientRect();
      const where = {bubbles: true, clientX: box.left + xaxis._offset + xaxis.l2p(points.x[at]),
                     clientY: box.top + yaxis._offset + yaxis.l2p(points.y[at])};
      for (const kind of ['mousemove', 'mousedown', 'mouseup', 'click']) {
        map.querySelector('.nsewdrag').dispatchEvent(new MouseEvent(kind, where)); await pause();
      }
      ranges.push(range());
      say({ranges, note: close.closest('figure').querySelector('.at').textContent});
    });"""
    said = asked(made_up.found(), tmp_path, script)
    whole, chosen, clicked = said["ranges"]
    assert whole == [4, 5.5]
    assert chosen == [10, 12]
    assert clicked[1] - clicked[0] == pytest.approx(1.5)
    instant = re.fullmatch(r"heldout_1\.csv, around ([\d.]+) s", said["note"])
    assert instant
    assert float(instant.group(1)) == pytest.approx(sum(clicked) / 2, abs=0.01)


@pytest.mark.parametrize("state", ["found", "unexplained"])
def test_it_is_printed_on_three_pages(state: str, tmp_path: Path) -> None:
    write_report(made_up.ALL[state](), tmp_path / "report.html")
    run("--no-pdf-header-footer", f"--print-to-pdf={tmp_path / 'report.pdf'}", (tmp_path / "report.html").as_uri())
    pages = len(re.findall(rb"/Type\s*/Page\b", (tmp_path / "report.pdf").read_bytes()))
    assert 1 <= pages <= 3
