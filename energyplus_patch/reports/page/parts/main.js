// Puts the page together: what is shown (day, hour, receiver) and what the user changes.

const part = (id) => document.getElementById(id);
const state = {day: 0, hour: 0, receiver: 0};
let view = null;
let receiverTable = null;

function addPairs(list, pairs) {
  list.replaceChildren(...pairs.map(([name, value]) => {
    const group = document.createElement("div");
    const term = document.createElement("dt");
    const definition = document.createElement("dd");
    term.textContent = name;
    definition.textContent = value;
    group.append(term, definition);
    return group;
  }));
}

function addKeys() {
  const kinds = new Set(view.surfaces.map((surface) => content.styles[surface.style].kind));
  const mapped = Boolean(part("colouring").value);
  const keys = mapped ? [] : [["faces away from the sun", css(theme().turnedAway)]];
  if (view instanceof ModelView && !mapped) keys.unshift(["dark: shaded at this hour", css(scaleColour(1).map((value) => 0.6 * value))]);
  if (kinds.has("opaque")) keys.push([mapped ? "casts shadows only, or has no map" : "casts shadows only", css(theme().caster)]);
  if (kinds.has("glass")) keys.push(["transmits", `#${theme().glass.toString(16)}80`]);
  if (content.terrain && view instanceof ModelView) keys.push(["terrain", css(theme().ground)]);
  if (kinds.has("foliage")) keys.push(["tree crown, brown where bare", `#${theme().foliage.toString(16)}80`]);
  part("keys").replaceChildren(...keys.map(([text, colour]) => {
    const item = document.createElement("li");
    const box = document.createElement("span");
    box.className = "key";
    box.style.background = colour;
    item.append(box, text);
    return item;
  }));
  if (kinds.has("screen") && view instanceof ModelView) {
    const item = document.createElement("li");
    const box = patternCanvas(content.styles.find((style) => style.kind === "screen"));
    box.className = "key";
    box.style.filter = isDark() && !printing ? "none" : "brightness(0.9)";
    item.append(box, "screen, holes not to scale");
    part("keys").append(item);
  }
}

function showTime() {
  const day = content.days[state.day];
  const [hour, azimuth, altitude] = day.hours[state.hour];
  part("day-text").textContent = dayText(day);
  part("hour-text").textContent = hourText(hour);
  part("day").setAttribute("aria-valuetext", dayText(day));
  part("hour").setAttribute("aria-valuetext", hourText(hour));
  part("day").value = state.day;
  part("hour").max = day.hours.length - 1;
  part("hour").value = state.hour;
  const sun = document.createElement("small");
  sun.textContent = `sun at azimuth ${numberText(azimuth, 1)}\u00b0, altitude ${numberText(altitude, 1)}\u00b0`;
  const shades = document.createElement("small");
  shades.textContent = content.motions.map((motion) =>
    `${motion.name} at ${motion.positions[positionAt(motion, state.day, state.hour)]} ${motion.unit}`).join(", ");
  part("moment").replaceChildren(`${dayText(day)}, ${hourText(hour)}`, sun, shades);
  view?.showHour(state.day, state.hour);
  showReceiver();
}

function showReceiver() {
  const {receiver} = state;
  if (content.receiverCount === 0) return;
  const [area, , tilt, mean, beam, total] = content.receivers[receiver];
  part("receiver").value = receiver;
  part("chosen-name").textContent = content.names[receiver];
  const map = content.maps.list.find((one) => one.receiver === receiver);
  const pairs = [["Area", `${numberText(area, 3)} m\u00b2`], ["Faces", facingText(receiver)],
    ["Tilt", `${numberText(tilt, 1)}\u00b0`], ["Mean sunlit fraction", numberText(mean, 4)],
    ["Beam per m\u00b2", `${numberText(beam, 1)} kWh/m\u00b2`], ["Total beam", `${numberText(total, 1)} kWh`]];
  const sky = skyOf(receiver);
  if (sky) pairs.push([`Sky view factor${content.skies.state && `, ${content.skies.state}`}`, `${numberText(sky.view, 3)} of ${numberText(sky.unshaded, 3)}`]);
  for (const [, title, unit, i] of map ? MAP_KINDS : []) {
    pairs.push([`${title}, ${mapDays()}`, `${numberText(map.means[i], 1)} ${unit}`]);
  }
  if (content.days.length > 0) {
    pairs.unshift(["Sunlit now", percentText(percentOf(receiver, state.day, state.hour))]);
    showCharts();
  }
  addPairs(part("numbers"), pairs);
}

// A chart is drawn when it is seen, and all on paper.
function showCharts() {
  const {receiver} = state;
  const now = [state.day, state.hour];
  const name = content.names[receiver];
  const drawn = (panel) => printing || !part(`panel-${panel}`).hidden;
  if (drawn("hours")) {
    part("carpet-plot").replaceChildren(carpet(now, go, {about: `Sunlit fraction of ${name} by day and hour`,
      value: (d, h) => percentOf(receiver, d, h) === content.turnedAway ? null : percentOf(receiver, d, h) / 100,
      text: (d, h) => percentText(percentOf(receiver, d, h))}));
    const most = mostBeam(receiver);
    part("beam-scale").textContent = `blue 0, yellow ${most} W/m\u00b2`;
    part("beam-plot").replaceChildren(carpet(now, go, {about: `Beam on ${name} by day and hour`,
      value: (d, h) => beamOf(receiver, d, h) === null ? null : beamOf(receiver, d, h) / most,
      text: (d, h) => beamOf(receiver, d, h) === null ? percentText(content.turnedAway)
        : `${Math.round(beamOf(receiver, d, h))} W/m\u00b2`}));
  }
  if (drawn("months")) showMonths();
  if (drawn("sky")) showSky(now);
}

function showMonths() {
  const {receiver} = state;
  part("months-plot").replaceChildren(monthBars(receiver));
  const known = content.receivers[receiver][MEAN_DAYS].length > 0;
  part("mean-days").hidden = !known;
  if (!known) return;
  const [most, plot] = meanDayCarpet(receiver, Number(part("light").value));
  part("mean-days-scale").textContent = `blue 0, yellow ${most} W/m\u00b2`;
  part("mean-days-plot").replaceChildren(plot);
}

function showSky(now) {
  const known = Boolean(skyOf(state.receiver));
  part("sky-caption").textContent = known
    ? `What hides the sky from the receiver${content.skies.state && ` (${content.skies.state})`}, and the sun at the hours of the page's days, by sunlit fraction.`
    : "This receiver has no mask on the page; gpu_shading mask draws one.";
  part("sky-form").hidden = !known;
  part("sky-plot").replaceChildren(...(known ? [skyMask(state.receiver, now, part("projection").value, go)] : []));
  part("sky-keys").replaceChildren(...(known ? skyKeys(state.receiver) : []));
}

const PANELS = ["hours", "months", "sky"];

function openPanel(panel) {
  for (const one of PANELS) {
    part(`panel-${one}`).hidden = one !== panel;
    part(`tab-${one}`).setAttribute("aria-selected", String(one === panel));
    part(`tab-${one}`).tabIndex = one === panel ? 0 : -1;
  }
  if (content.days.length > 0 && content.receiverCount > 0) showCharts();
}

function addPanels() {
  PANELS.forEach((panel, i) => {
    part(`tab-${panel}`).addEventListener("click", () => openPanel(panel));
    part(`tab-${panel}`).addEventListener("keydown", (event) => {
      const step = {ArrowRight: 1, ArrowLeft: -1}[event.key];
      if (!step) return;
      const next = PANELS[(i + step + PANELS.length) % PANELS.length];
      openPanel(next);
      part(`tab-${next}`).focus();
    });
  });
  part("of-diffuse").hidden = lightCount() === 1;
  part("light").append(...KINDS_OF_LIGHT.slice(0, lightCount()).map((name, kind) => new Option(name, kind)));
  part("light").value = lightCount() - 1;
  part("light").addEventListener("change", showCharts);
  part("projection").addEventListener("change", showCharts);
  part("save-chart").addEventListener("click", () => saveChart(document.querySelector(".panel:not([hidden]) svg"),
    content.names[state.receiver]));
  part("save-picture").addEventListener("click", () => savePicture(part("view")));
  const animation = part("save-animation");
  animation.hidden = !canRecord();
  animation.addEventListener("click", () => {
    animation.disabled = true;
    saveAnimation(part("view"), () => { animation.disabled = false; });
  });
  openPanel("hours");
}

// A surface's name under the pointer, with a receiver's sunlit fraction.
function addHover() {
  const hover = part("hover");
  let waiting = null;
  const show = (event) => {
    waiting = null;
    const number = view.numberAt(event);
    hover.hidden = number === undefined || !content.names[number];
    if (hover.hidden) return;
    const lit = number < content.receiverCount && content.days.length > 0
      ? `: ${percentText(percentOf(number, state.day, state.hour))}` : "";
    hover.textContent = content.names[number] + lit;
    const box = part("stage").getBoundingClientRect();
    hover.style.left = `${Math.min(event.clientX - box.left + 14, box.width - 150)}px`;
    hover.style.top = `${event.clientY - box.top + 14}px`;
  };
  part("view").addEventListener("pointermove", (event) => {
    if (event.buttons || waiting) return;
    waiting = requestAnimationFrame(() => show(event));
  });
  part("view").addEventListener("pointerleave", () => { hover.hidden = true; });
}

function go(day, hour) {
  state.day = day;
  state.hour = Math.min(hour, content.days[day].hours.length - 1);
  showTime();
}

// The same hour of another day, or the nearest with the sun up.
function goToDay(day) {
  const [wanted] = content.days[state.day].hours[state.hour];
  const {hours} = content.days[day];
  const nearest = hours.reduce((best, [hour], i) =>
    Math.abs(hour - wanted) < Math.abs(hours[best][0] - wanted) ? i : best, 0);
  go(day, nearest);
}

function choose(receiver) {
  state.receiver = receiver;
  view?.choose(receiver);
  receiverTable.mark(receiver);
  showReceiver();
}

// The title and the numbers of the scale.
function showScale(title, most) {
  part("legend-title").textContent = title;
  part("ticks").replaceChildren(...[0, 0.25, 0.5, 0.75, 1].map((share) => {
    const mark = document.createElement("span");
    mark.textContent = most < 10 ? numberText(share * most, 1) : Math.round(share * most);
    return mark;
  }));
}

function colourBy(kind) {
  const [, title, unit, i] = MAP_KINDS.find(([key]) => key === kind) || [];
  if (title) showScale(`${title}, ${unit}, ${mapDays()}`, content.maps.most[i]);
  else showScale("Sunlit fraction, %", 100);
  view.colourBy(kind);
  addKeys();
}

function addColourings() {
  if (content.maps.list.length === 0) return;
  part("colouring").append(new Option("sunlit fraction now", ""),
    ...MAP_KINDS.map(([kind, title]) => new Option(`map: ${title.toLowerCase()}`, kind)));
  part("colourings").hidden = part("of-maps").hidden = false;
  part("colouring").addEventListener("change", () => colourBy(part("colouring").value));
}

let playing = null;
function play() {
  if (playing) {
    clearInterval(playing);
    playing = null;
  } else {
    playing = setInterval(() => go(state.day, (state.hour + 1) % content.days[state.day].hours.length), 700);
  }
  part("play").textContent = playing ? "Stop" : "Play the day";
}

// The largest window, or the largest receiver without windows, in the afternoon of the day nearest to the equinox, or
// before the sun goes behind it.
function chooseBeginning() {
  const fromEquinox = (day) => Math.abs((day.month - 3) * 30 + day.day - 21);
  content.days.forEach((day, i) => {
    if (fromEquinox(day) < fromEquinox(content.days[state.day])) state.day = i;
  });
  const rank = ([area, , , , , , window]) => window ? 1e9 + area : area;
  content.receivers.forEach((receiver, i) => {
    if (rank(receiver) > rank(content.receivers[state.receiver])) state.receiver = i;
  });
  const {hours} = content.days[state.day];
  const isBehind = (hour) => percentOf(state.receiver, state.day, hour) === content.turnedAway;
  const away = (hour) => Math.abs(hours[hour][0] - 15) + (content.receiverCount > 0 && isBehind(hour) ? 24 : 0);
  state.hour = hours.reduce((best, _, i) => away(i) < away(best) ? i : best, 0);
}

// From the side that a receiver faces; from the south if it faces up.
function facingView(receiver) {
  const [, azimuth = 180, tilt = 90] = content.receivers[receiver] || [];
  const north = tilt > 1 && Math.cos(azimuth * Math.PI / 180) > 0.01;
  return `${north ? "north" : "south"}-${azimuth > 180 ? "west" : "east"}`;
}

function addView() {
  const surfaces = readSurfaces();
  readMotions(surfaces);
  if (canDrawModel()) {
    view = new ModelView(part("view"), surfaces);
  } else {
    view = new PlainDrawing(part("view"), surfaces);
    part("view-missing").hidden = false;
    part("view-missing").textContent = typeof THREE === "undefined"
      ? "A plain drawing without shadows: this build has no library for drawings in 3D."
      : "A plain drawing without shadows: this browser has no WebGL.";
    part("view-help").hidden = part("path-label").hidden = true;
  }
  view.onChoose = choose;
}

function addControls() {
  part("day").max = content.days.length - 1;
  part("day").addEventListener("input", () => goToDay(Number(part("day").value)));
  part("hour").addEventListener("input", () => go(state.day, Number(part("hour").value)));
  part("play").addEventListener("click", play);
  part("from").addEventListener("change", () => view.lookFrom(part("from").value));
  part("casters").addEventListener("change", () => view.setCasters(part("casters").checked));
  part("path").addEventListener("change", () => view.setPath(part("path").checked));
  part("controls").addEventListener("submit", (event) => event.preventDefault());
  part("receiver").append(...content.receivers.map((_, i) => new Option(content.names[i], i)));
  part("receiver").addEventListener("change", () => choose(Number(part("receiver").value)));
}

function refreshTheme() {
  addKeys();
  view.refreshTheme();
}

// On paper everything is in the light theme, the model is a copy in a shape that fits a page, and the table is shorter.
function print(begins) {
  printing = begins;
  refreshTheme();
  receiverTable.fill();
  if (content.days.length > 0 && content.receiverCount > 0) showCharts();
  if (begins) view.copyTo?.(part("paper-view"));
}

function begin() {
  addPairs(part("facts"), content.facts);
  part("notes").replaceChildren(...content.notes.map((note) => {
    const paragraph = document.createElement("p");
    paragraph.textContent = note;
    return paragraph;
  }));
  part("scale").style.background = scaleGradient();
  showScale("Sunlit fraction, %", 100);
  addView();
  addKeys();
  addControls();
  addColourings();
  addPanels();
  addModules();
  addHover();
  receiverTable = new ReceiverTable(part("receivers"), part("filter"), part("shown"), choose);
  if (content.days.length > 0) {
    chooseBeginning();
    showTime();
    part("from").value = facingView(state.receiver);
    view.lookFrom(part("from").value);
  } else {
    part("controls").hidden = part("charts").hidden = part("moment").hidden = true;
  }
  if (content.receiverCount > 0) choose(state.receiver);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", refreshTheme);
  addEventListener("beforeprint", () => print(true));
  addEventListener("afterprint", () => print(false));
}

begin();
