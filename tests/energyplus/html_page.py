"""Reads a page's tables, and looks at pages in a browser."""

import html.parser
import json
import re
import shutil
import subprocess

import pytest

BROWSERS = ("chromium-headless-shell", "chromium", "google-chrome")

# Runs in the page before its own scripts, and at the end of them.
WATCH = """<script>
const troubles = [];
addEventListener("error", (event) => troubles.push(event.message || event.target.outerHTML.slice(0, 200)), true);
console.error = console.warn = (...words) => troubles.push(words.join(" "));
</script>"""
REPORT = """<script>
addEventListener("load", () => {
  const result = LOOK();
  const element = document.createElement("pre");
  element.id = "looked-at";
  element.textContent = JSON.stringify({...result, troubles});
  document.body.append(element);
});
</script>"""


class Tables(html.parser.HTMLParser):
    """tables[id] is a list of rows of texts; references all that src and href name."""

    def __init__(self, text):
        super().__init__()
        self.tables, self.references, self._rows, self._cell = {}, [], None, None
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        named = dict(attributes)
        self.references += [named[name] for name in ("src", "href", "xlink:href") if name in named]
        if tag == "table":
            self._rows = self.tables[named.get("id", "")] = []
        elif tag == "tr" and self._rows is not None:
            self._rows.append([])
        elif tag in ("td", "th") and self._rows is not None:
            self._cell = ""

    def handle_data(self, data):
        if self._cell is not None:
            self._cell += data

    def handle_endtag(self, tag):
        if tag in ("td", "th") and self._cell is not None:
            self._rows[-1].append(" ".join(self._cell.split()))
            self._cell = None
        elif tag == "table":
            self._rows = None


def number(text):
    """The value of a cell, nan of one that says there is none."""
    return float(text.replace("–", "nan").replace("\u2212", "-").replace(",", ""))


def browser():
    """A headless Chromium; skips where there is none."""
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if not found:
        pytest.skip(f"none of {', '.join(BROWSERS)} is installed: scripts/setup installs the first")
    return found


def _run(folder, width, height, *options):
    command = [browser(), "--no-sandbox", "--hide-scrollbars", f"--user-data-dir={folder / 'profile'}",
               "--disable-gpu", f"--window-size={width},{height}", *options]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return done.stdout


def look_at(page, width, look, folder):
    """What the JavaScript function `look` returns in the page, and troubles: all that went wrong in it."""
    copy = folder / f"looked-at-{width}.html"
    text = page.read_text(encoding="utf-8").replace("<head>", "<head>" + WATCH, 1)
    copy.write_text(text.replace("</body>", REPORT.replace("LOOK", f"({look})") + "</body>"), encoding="utf-8")
    content = _run(folder, width, 900, "--virtual-time-budget=10000", "--dump-dom", copy.as_uri())
    found = re.search(r'<pre id="looked-at">(.*?)</pre>', content, re.DOTALL)
    assert found, "the page did not load"
    return json.loads(html.unescape(found[1]))


def screenshot(page, width, height, picture):
    _run(picture.parent, width, height, f"--screenshot={picture}", page.as_uri())
