// The pattern that screens are drawn with: their holes, larger than they are, with the same open fraction.

const PATTERN_REPEAT = 0.4; // m of the model; smaller holes would blur at the distance of a building

function drawHole(context, style, x, y, width) {
  context.beginPath();
  if (style.hole === "square") {
    context.rect(x - width / 2, y - width / 2, width, width);
  } else if (style.hole === "slotted") {
    const length = width * Math.max(style.length / style.size, 1);
    context.rect(x - length / 2, y - width / 2, length, width);
  } else if (style.hole === "hexagonal") {
    for (let i = 0; i < 6; ++i) {
      const angle = Math.PI / 3 * i + Math.PI / 6;
      context.lineTo(x + width / Math.sqrt(3) * Math.cos(angle), y + width / Math.sqrt(3) * Math.sin(angle));
    }
  } else {
    context.arc(x, y, width / 2, 0, 2 * Math.PI);
  }
  context.fill();
}

// White where the sheet is, black where it is open: the width of two holes, or of one where a row is the next one's copy.
function patternCanvas(style) {
  const canvas = document.createElement("canvas");
  const size = 128;
  canvas.width = canvas.height = size;
  const context = canvas.getContext("2d");
  context.fillStyle = "#fff";
  context.fillRect(0, 0, size, size);
  context.fillStyle = "#000";
  const pitch = size / 2;
  const open = Math.min(Math.max(style.passes, 0.03), 0.8);
  // A round hole of that share of its cell, or the one of the sheet.
  const width = style.hole === "texture" ? pitch * Math.sqrt(open / 0.785)
    : Math.min(pitch * (style.hole === "round" ? Math.sqrt(open / 0.785) : Math.sqrt(open)), pitch * 0.94);
  const staggered = style.arrangement.startsWith("staggered");
  for (let row = -1; row <= 2; ++row) {
    for (let column = -1; column <= 2; ++column) {
      const shift = staggered && (row & 1) ? 0.5 : 0;
      drawHole(context, style.hole === "slotted" ? {...style, length: style.size * 1.4} : style,
        (column + 0.5 + shift) * pitch, (row + 0.5) * pitch, width);
    }
  }
  return canvas;
}

function patternTexture(style) {
  const texture = new THREE.CanvasTexture(patternCanvas(style));
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.anisotropy = 8;
  return texture;
}
