// What hides which part of the sky from a receiver, with the sun's positions of the page's days.

// Okabe and Ito (2008), as gpu_shading mask has them: [what it says, colour].
const SHADE_KINDS = {building: ["the building itself", [120, 124, 130]], shades: ["shades", [86, 180, 233]],
  geometry: ["imported geometry", [204, 121, 167]], trees: ["trees", [0, 158, 115]], neighbours: ["neighbours and site shades", [213, 94, 0]],
  terrain: ["terrain", [150, 110, 60]]};
const CLEAR_SKY = [240, 247, 255];
const BEHIND = [214, 216, 219];

function skyOf(receiver) { return content.skies.list.find((sky) => sky.receiver === receiver); }

// From degrees to the place in a drawing of 360 x 360, or 360 x 200 for a cylinder.
function skyPlace(projection, azimuth, altitude) {
  if (projection === "cylindrical") return [20 + 320 * (azimuth / 360), 180 - 160 * altitude / 90];
  const fromZenith = (90 - altitude) * Math.PI / 180;
  const radius = 150 * (projection === "equidistant" ? fromZenith / (Math.PI / 2) : Math.tan(fromZenith / 2));
  const a = azimuth * Math.PI / 180;
  return [180 + radius * Math.sin(a), 180 - radius * Math.cos(a)];
}

// The kind that hides most of a cell, and the share that is hidden.
function hiddenBy(code) {
  const {levels, kinds} = content.skies;
  return [kinds[Math.floor(code / levels)], code % levels / (levels - 1)];
}

function skyColour(code) {
  if (code === content.skies.behind) return css(BEHIND);
  const [kind, share] = hiddenBy(code);
  const colour = SHADE_KINDS[kind][1];
  return css(CLEAR_SKY.map((clear, i) => Math.round(clear + share * (colour[i] - clear))));
}

function skyCells(codes, projection) {
  const {step} = content.skies;
  const columns = 360 / step;
  const cells = [];
  for (let row = 0; row < 90 / step; ++row) {
    for (let from = 0, to = 1; from < columns; from = to, to = from + 1) {
      const code = codes[row * columns + from];
      while (to < columns && codes[row * columns + to] === code) ++to;
      const edge = [];
      for (let i = from; i <= to; ++i) edge.push(skyPlace(projection, i * step, row * step));
      for (let i = to; i >= from; --i) edge.push(skyPlace(projection, i * step, (row + 1) * step));
      const cell = svg("path", {fill: skyColour(code), class: "sky-cell",
        d: `M${edge.map((point) => point.map((value) => value.toFixed(1)).join(" ")).join("L")}Z`});
      const [kind, share] = code === content.skies.behind ? [] : hiddenBy(code);
      cell.append(svg("title", {}, code === content.skies.behind ? "behind the receiver"
        : share === 0 ? "clear sky" : `${Math.round(100 * share)} % hidden, most by ${SHADE_KINDS[kind][0]}`));
      cells.push(cell);
    }
  }
  return cells;
}

function skyAxes(projection) {
  const marks = [];
  for (const altitude of [0, 30, 60]) {
    const ring = [];
    for (let azimuth = 0; azimuth <= 360; azimuth += 5) ring.push(skyPlace(projection, azimuth, altitude));
    marks.push(svg("path", {d: `M${ring.map((point) => point.map((value) => value.toFixed(1)).join(" ")).join("L")}`,
      class: altitude === 0 ? "sky-horizon" : "sky-ring"}));
  }
  for (const [letter, azimuth] of [["N", 0], ["E", 90], ["S", 180], ["W", 270]]) {
    const [x, y] = projection === "cylindrical" ? [20 + 320 * azimuth / 360, 194]
      : [180 + 164 * Math.sin(azimuth * Math.PI / 180), 184 - 164 * Math.cos(azimuth * Math.PI / 180)];
    marks.push(svg("text", {x, y, "text-anchor": "middle"}, letter));
  }
  return marks;
}

// The sun at the hours of the page's days, by the receiver's sunlit fraction; `now`: the day and hour that are shown.
function skySuns(receiver, now, projection, onGo) {
  const suns = [];
  // Of many days some, so that dots do not cover each other.
  const stride = Math.ceil(content.days.length / 26);
  const shown = content.days.map((day, d) => [day, d]).filter(([, d]) => d === now[0] || d % stride === 0);
  shown.forEach(([day, d]) => day.hours.forEach(([hour, azimuth, altitude], h) => {
    const percent = percentOf(receiver, d, h);
    const here = d === now[0] && h === now[1];
    if (percent === content.turnedAway && !here) return;
    const [cx, cy] = skyPlace(projection, azimuth, altitude);
    const sun = svg("circle", {cx: cx.toFixed(1), cy: cy.toFixed(1), r: here ? 6 : d === now[0] ? 4 : 2.6,
      fill: percent === content.turnedAway ? "none" : css(scaleColour(percent / 100)),
      class: here ? "sky-now" : d === now[0] ? "sky-today" : "sky-sun"});
    sun.append(svg("title", {}, `${dayText(day)}, ${hourText(hour)}: ${percentText(percent)}`));
    sun.addEventListener("click", () => onGo(d, h));
    if (d === now[0]) suns.push(sun);
    else suns.unshift(sun);
  }));
  return suns;
}

function skyMask(receiver, now, projection, onGo) {
  const sky = skyOf(receiver);
  const plot = svg("svg", {viewBox: projection === "cylindrical" ? "0 0 360 200" : "0 0 360 360", role: "img",
    "aria-label": `What hides the sky from ${content.names[receiver]}, and the sun's positions`});
  plot.append(...skyCells(bytesOf(sky.codes), projection), ...skyAxes(projection),
    ...skySuns(receiver, now, projection, onGo));
  return plot;
}

// The colours of the kinds that hide some of a receiver's sky.
function skyKeys(receiver) {
  const {behind} = content.skies;
  const kinds = new Set([...bytesOf(skyOf(receiver).codes)].filter((code) => code !== behind).map(hiddenBy)
    .filter(([, share]) => share > 0.04).map(([kind]) => kind));
  const keys = [["clear sky", CLEAR_SKY], ...[...kinds].map((kind) => SHADE_KINDS[kind]), ["behind the receiver", BEHIND]];
  return keys.map(([text, colour]) => {
    const item = document.createElement("li");
    const box = document.createElement("span");
    box.className = "key";
    box.style.background = css(colour);
    item.append(box, text);
    return item;
  });
}
