// What the page is about: the JSON in it, with its arrays of bytes decoded.

function bytesOf(text) {
  const plain = atob(text);
  const bytes = new Uint8Array(plain.length);
  for (let i = 0; i < plain.length; ++i) bytes[i] = plain.charCodeAt(i);
  return bytes;
}

function shortsOf(text) {
  const bytes = bytesOf(text);
  const shorts = new Uint16Array(bytes.length / 2);
  for (let i = 0; i < shorts.length; ++i) shorts[i] = bytes[2 * i] | bytes[2 * i + 1] << 8;
  return shorts;
}

const content = JSON.parse(document.getElementById("content").textContent);
content.percents = bytesOf(content.percents);
content.receiverCount = content.receivers.length;

// The first row of each day in content.percents.
content.firstHours = [];
content.days.reduce((first, day) => {
  content.firstHours.push(first);
  return first + day.hours.length;
}, 0);

content.shares = content.shares.map(bytesOf);

const MONTHS = ["January", "February", "March", "April", "May", "June", "July", "August", "September", "October",
  "November", "December"];

// Without a day: the month's mean day.
function dayText(day) { return `${day.day || "mean day of"} ${MONTHS[day.month - 1]}`; }
function hourText(hour) { return `${String(hour).padStart(2, "0")}:00`; }

// Percent, or content.turnedAway.
function percentOf(receiver, day, hour) {
  return content.percents[(content.firstHours[day] + hour) * content.receiverCount + receiver];
}

function percentText(percent) { return percent === content.turnedAway ? "faces away from the sun" : `${percent} %`; }

// How far a style is deployed, leaved or transmits at [day, hour], 0 to 1; without a time, fully.
function shareNow(style, time) {
  return style.share === null || !time ? 1 : content.shares[style.share][content.firstHours[time[0]] + time[1]] / 100;
}

// Leaves and wood weaken the beam one after the other; other shades pass it beside what is deployed.
function passesNow(style, time) {
  const share = shareNow(style, time);
  return style.kind === "foliage" ? style.without ** (1 - share) * style.passes ** share
    : style.without + share * (style.passes - style.without);
}

// Of the drawing. The holes of a screen are drawn.
function opacityNow(style, time) {
  return style.kind === "screen" ? shareNow(style, time) : 0.15 + 0.5 * (1 - passesNow(style, time));
}

// null: there is none.
function numberText(value, digits) {
  if (value === null) return "\u2013";
  return value.toLocaleString("en", {minimumFractionDigits: digits, maximumFractionDigits: digits});
}

// Where a surface faces, in words.
function facingText(receiver) {
  const [, azimuth, tilt] = content.receivers[receiver];
  if (tilt < 0.5) return "up";
  if (tilt > 179.5) return "down";
  const points = ["N", "NE", "E", "SE", "S", "SW", "W", "NW"];
  return `${points[Math.round(azimuth / 45) % 8]} ${numberText(azimuth, 1)}\u00b0`;
}
