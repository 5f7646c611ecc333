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
  const keys = mapped ? [] : [["turned away from the sun", css(theme().turnedAway)]];
  if (view instanceof ModelView && !mapped) keys.unshift(["darker: in shadow now", css(scaleColour(1).map((value) => 0.6 * value))]);
  if (kinds.has("opaque")) keys.push([mapped ? "casts shadows only, or has no map" : "casts shadows only", css(theme().caster)]);
  if (kinds.has("glass")) keys.push(["transmits", `#${theme().glass.toString(16)}80`]);
  if (kinds.has("foliage")) keys.push(["tree crown", `#${theme().foliage.toString(16)}80`]);
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
  part("moment").replaceChildren(`${dayText(day)}, ${hourText(hour)}`, sun);
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
    ["Beam of the run", `${numberText(beam, 1)} kWh/m\u00b2`], ["Beam in all", `${numberText(total, 1)} kWh`]];
  for (const [, title, unit, i] of map ? MAP_KINDS : []) {
    pairs.push([`${title}, ${mapDays()}`, `${numberText(map.means[i], 1)} ${unit}`]);
  }
  if (content.days.length > 0) {
    pairs.unshift(["Sunlit now", percentText(percentOf(receiver, state.day, state.hour))]);
    part("carpet-plot").replaceChildren(carpet(receiver, [state.day, state.hour], go));
  }
  addPairs(part("numbers"), pairs);
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

// The afternoon of the day nearest to the equinox, and a receiver that is partly shaded then.
function chooseBeginning() {
  const fromEquinox = (day) => Math.abs((day.month - 3) * 30 + day.day - 21);
  content.days.forEach((day, i) => {
    if (fromEquinox(day) < fromEquinox(content.days[state.day])) state.day = i;
  });
  const {hours} = content.days[state.day];
  state.hour = hours.reduce((best, [hour], i) => Math.abs(hour - 15) < Math.abs(hours[best][0] - 15) ? i : best, 0);
  const fromHalf = (receiver) => Math.abs(percentOf(receiver, state.day, state.hour) - 50);
  content.receivers.forEach((_, i) => {
    if (fromHalf(i) < fromHalf(state.receiver)) state.receiver = i;
  });
}

function addView() {
  const surfaces = readSurfaces();
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
  receiverTable = new ReceiverTable(part("receivers"), part("filter"), part("shown"), choose);
  if (content.days.length > 0) {
    chooseBeginning();
    showTime();
  } else {
    part("controls").hidden = part("carpet").hidden = part("moment").hidden = true;
  }
  if (content.receiverCount > 0) choose(state.receiver);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", refreshTheme);
  addEventListener("beforeprint", () => print(true));
  addEventListener("afterprint", () => print(false));
}

begin();
