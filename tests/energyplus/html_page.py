"""Reads a page's tables, and looks at pages in a browser."""

import bisect
import csv
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


_NUMBER = re.compile(r"(?<![\w.])[+-]?\d+(?:\.\d+)?(?:e[+-]\d+)?(\s%)?")


def _numbers(text):
    """[(number as printed, its value, half a unit of its last digit, whether it is a percentage)]."""
    plain = re.sub(r"(?<=\d),(?=\d{3})", "", text.replace("\u2212", "-"))
    found = []
    for match in _NUMBER.finditer(plain):
        mantissa, _, exponent = match[0].removesuffix(match[1] or "").partition("e")
        half = 0.5 * 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
        found.append((match[0], abs(float(match[0].removesuffix(match[1] or ""))), half, bool(match[1])))
    return found


def _cells(table):
    with open(table, newline="", encoding="utf-8") as file:
        for row in csv.reader(file):
            yield from row


def not_in_tables(texts, tables):
    """The numbers in some texts that no CSV file has, to the digits that are printed; a percentage may be a fraction
    there, and a sign a word."""
    values = sorted({value for table in tables for cell in _cells(table) for _, value, _, _ in _numbers(cell)})

    def has(value, half):
        place = bisect.bisect_left(values, value - half * (1 + 1e-6))
        return place < len(values) and values[place] <= value + half * (1 + 1e-6)

    return [printed for text in texts for printed, value, half, is_percentage in _numbers(text)
            if not has(value, half) and not (is_percentage and has(value / 100, half / 100))]


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


# Chromium draws WebGL on the CPU.
SOFTWARE_WEBGL = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
DARK = ("--blink-settings=preferredColorScheme=0",)
# What a page must have for all its readers, as far as a program can tell: faults() lists what is missing.
FAULTS = """<script>
function luminance(colour) {
  const [r, g, b] = colour.map((value) => value / 255).map((value) =>
    value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
const numbers = (colour) => colour.match(/[\\d.]+/g).map(Number);
function background(element) {
  for (let at = element; at; at = at.parentElement) {
    const colour = numbers(getComputedStyle(at).backgroundColor);
    if (colour.length === 3 || colour[3] === 1) return colour;
  }
  return [255, 255, 255];
}
function contrast(element) {
  const style = getComputedStyle(element);
  const text = luminance(numbers(element.closest("svg") ? style.fill : style.color));
  const paper = luminance(background(element));
  return (Math.max(text, paper) + 0.05) / (Math.min(text, paper) + 0.05);
}
// What a reader sees, piece by piece, without charts and controls.
function texts() {
  const found = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const element = walker.currentNode.parentElement;
    const left = element.closest("svg, script, style, select, button, [aria-hidden=true]");
    const text = walker.currentNode.textContent.trim();
    if (text && !left && element.getClientRects().length > 0) found.push(text);
  }
  return found;
}
function faults() {
  const found = [];
  const tell = (what, element) => found.push(`${what}: ${element.outerHTML.slice(0, 120)}`);
  const seen = (element) => element.getClientRects().length > 0;
  for (const control of document.querySelectorAll("input, select, textarea")) {
    if (seen(control) && control.labels.length === 0 && !control.ariaLabel) tell("no label", control);
  }
  for (const button of document.querySelectorAll("button, a[href]")) {
    if (!button.textContent.trim() && !button.ariaLabel) tell("no name", button);
  }
  for (const picture of document.querySelectorAll("img, canvas[role=img], svg[role=img]")) {
    if (!picture.alt && !picture.getAttribute("aria-label")) tell("no description", picture);
  }
  for (const cell of document.querySelectorAll("th")) if (!cell.scope) tell("no scope", cell);
  const ids = [...document.querySelectorAll("[id]")].map((element) => element.id);
  ids.filter((id, i) => ids.indexOf(id) !== i).forEach((id) => found.push(`id ${id} stands twice`));
  const levels = [...document.querySelectorAll("h1, h2, h3, h4")].map((heading) => Number(heading.tagName[1]));
  levels.forEach((level, i) => level > (levels[i - 1] ?? 0) + 1 && found.push(`heading ${i} skips a level`));
  if (document.querySelectorAll("h1").length !== 1) found.push("not one h1");
  if (!document.documentElement.lang) found.push("no language");
  for (const element of document.querySelectorAll("body *")) {
    const says = [...element.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim());
    if (says && seen(element) && !element.closest("script, option, title") && contrast(element) < 4.5) {
      tell(`contrast ${contrast(element).toFixed(2)}`, element);
    }
  }
  return found;
}
</script>"""


def look_at(page, width, look, folder, *options, before=""):
    """What the JavaScript function `look` returns in the page, and troubles: all that went wrong in it. `before`: more
    elements for its head. Options are the browser's."""
    copy = folder / f"looked-at-{width}.html"
    text = page.read_text(encoding="utf-8").replace("<head>", "<head>" + WATCH + FAULTS + before, 1)
    copy.write_text(text.replace("</body>", REPORT.replace("LOOK", f"({look})") + "</body>"), encoding="utf-8")
    content = _run(folder, width, 900, "--virtual-time-budget=10000", *options, "--dump-dom", copy.as_uri())
    found = re.search(r'<pre id="looked-at">(.*?)</pre>', content, re.DOTALL)
    assert found, "the page did not load"
    return json.loads(html.unescape(found[1]))


def content_of(page):
    """What the page of a run is about."""
    text = page.read_text(encoding="utf-8")
    return json.loads(re.search(r'<script type="application/json" id="content">(.*?)</script>', text, re.DOTALL)[1])


def screenshot(page, width, height, picture, *options):
    _run(picture.parent, width, height, *options, f"--screenshot={picture}", page.as_uri())


def print_page(page, file, *options):
    """As a PDF."""
    _run(file.parent, 1200, 900, *options, "--no-pdf-header-footer", f"--print-to-pdf={file}", page.as_uri())
