// A value of a receiver by day (to the right) and hour (up).

const SVG = "http://www.w3.org/2000/svg";

function svg(name, attributes, text) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  return element;
}

function hourRange(days) {
  const hours = days.flatMap((day) => day.hours.map((hour) => hour[0]));
  return [Math.min(...hours), Math.max(...hours)];
}

// The SVG element; onGo(day, hour): a click on a field. `now`: the day and hour that are shown, or null. `about`: what it
// shows; `days`: the page's, or others with hours; `value`(day, hour): 0 .. 1, null behind the receiver; `text`(day, hour):
// in words.
function carpet(now, onGo, {about, value, text, days = content.days}) {
  const left = 40;
  const width = 366;
  const row = 11;
  const [first, last] = hourRange(days);
  const column = (width - left - 2) / days.length;
  const bottom = (last - first + 1) * row + 4;
  const x = (day) => left + day * column;
  const y = (hour) => 4 + (last - hour) * row;
  const plot = svg("svg", {viewBox: `0 0 ${width} ${bottom + 20}`, role: "img",
    "aria-label": about});
  const name = `away-${about.replace(/\W/g, "")}`;
  const pattern = svg("pattern", {id: name, class: "away-pattern", width: 5, height: 5, patternUnits: "userSpaceOnUse"});
  pattern.append(svg("path", {d: "M0 5 L5 0"}));
  // Filled once: on paper, each filling is a picture.
  const away = svg("path", {fill: `url(#${name})`});
  plot.append(pattern, away);
  const hatched = [];
  days.forEach((day, d) => day.hours.forEach(([hour], h) => {
    const share = value(d, h);
    const field = svg("rect", {x: x(d).toFixed(2), y: y(hour), width: column.toFixed(2), height: row,
      class: share === null ? "field away" : "field"});
    if (share !== null) field.setAttribute("fill", css(scaleColour(share)));
    else hatched.push(`M${x(d).toFixed(2)} ${y(hour)}h${column.toFixed(2)}v${row}h${-column.toFixed(2)}z`);
    field.append(svg("title", {}, `${dayText(day)}, ${hourText(hour)}: ${text(d, h)}`));
    field.addEventListener("click", () => onGo(d, h));
    plot.append(field);
  }));
  away.setAttribute("d", hatched.join(""));
  plot.append(svg("rect", {x: left, y: 4, width: width - left - 2, height: bottom - 4, class: "frame"}));
  for (let hour = first; hour <= last; ++hour) {
    if (hour % 3 === 0) plot.append(svg("text", {x: left - 4, y: y(hour) + row - 2, "text-anchor": "end"}, hourText(hour)));
  }
  monthTicks(days).forEach(([day, text]) => plot.append(svg("text", {x: x(day), y: bottom + 14}, text)));
  if (!now) return plot;
  const {hours} = days[now[0]];
  plot.append(svg("rect", {x: (x(now[0]) - 1).toFixed(2), y: y(hours[now[1]][0]) - 1,
    width: (Math.max(column, 4) + 2).toFixed(2), height: row + 2, class: "now"}));
  return plot;
}

// The first day of each month that has room for its name: [day, text].
function monthTicks(days) {
  const room = Math.ceil(34 / (330 / days.length));
  const ticks = [];
  days.forEach((day, d) => {
    const begins = d === 0 || days[d - 1].month !== day.month;
    if (begins && (ticks.length === 0 || d - ticks[ticks.length - 1][0] >= room)) {
      ticks.push([d, MONTHS[day.month - 1].slice(0, 3)]);
    }
  });
  return ticks;
}
