import { ISOMETRIC } from "./pathviews.js";
import { markText, scaleMarks } from "./quantities.js";

/** @typedef {import("./reduction.js").PlaneWindow} PlaneWindow */
/** @typedef {import("./palette.js").Palette} Palette */

/**
 * Draws the scales of a plane: lines, and marks at the left and lower edge.
 * @param {CanvasRenderingContext2D} context
 * @param {PlaneWindow} view
 * @param {Palette} palette
 * @param {[string, string]} captions of the horizontal and the vertical direction
 */
export function drawScales(context, { x0, y0, scaleX, scaleY, width, height }, palette, captions) {
  const [halfX, halfY] = [width / 2 / scaleX, height / 2 / scaleY];
  const across = scaleMarks(x0 - halfX, x0 + halfX, width / 110);
  const upward = scaleMarks(y0 - halfY, y0 + halfY, height / 70);
  context.beginPath();
  for (const x of across.values) {
    const right = Math.round(width / 2 + (x - x0) * scaleX) + 0.5;
    context.moveTo(right, 0);
    context.lineTo(right, height);
  }
  for (const y of upward.values) {
    const down = Math.round(height / 2 - (y - y0) * scaleY) + 0.5;
    context.moveTo(0, down);
    context.lineTo(width, down);
  }
  context.strokeStyle = palette.colour("line");
  context.lineWidth = 1;
  context.stroke();
  scaleStyle(context, palette);
  context.textAlign = "left";
  for (const x of across.values) {
    const right = width / 2 + (x - x0) * scaleX;
    // The lower corners belong to the captions.
    if (right > 40 && right < width - 140) context.fillText(markText(x, across.step), right + 3, height - 6);
  }
  for (const y of upward.values) {
    const down = height / 2 - (y - y0) * scaleY;
    if (down > 40 && down < height - 24) context.fillText(markText(y, upward.step), 4, down - 4);
  }
  context.fillStyle = palette.colour("text");
  context.fillText(captions[1], 4, 16);
  context.textAlign = "right";
  context.fillText(captions[0], width - 6, height - 6);
}

/**
 * Draws the directions of the axes of space, and a length.
 * @param {CanvasRenderingContext2D} context
 * @param {PlaneWindow} view
 * @param {Palette} palette
 * @param {import("./series.js").SeriesGroup} group
 */
export function drawDirections(context, { scaleX, width, height }, palette, group) {
  const [right, down, length] = [48, height - 62, 40];
  context.beginPath();
  for (const [x, y] of ISOMETRIC) {
    context.moveTo(right, down);
    context.lineTo(right + x * length, down - y * length);
  }
  const { step } = scaleMarks(0, width / scaleX, 6);
  context.moveTo(width - 16 - step * scaleX, height - 24);
  context.lineTo(width - 16, height - 24);
  context.strokeStyle = palette.colour("faint");
  context.lineWidth = 1.5;
  context.stroke();
  scaleStyle(context, palette);
  context.textAlign = "center";
  group.axes.forEach((axis, k) => {
    const [x, y] = ISOMETRIC[k];
    context.fillText(axis.name, right + x * length * 1.3, down - y * length * 1.3 + 4);
  });
  context.textAlign = "right";
  context.fillText(`${markText(step, step)} ${group.unit}`, width - 16, height - 8);
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {Palette} palette
 */
function scaleStyle(context, palette) {
  context.font = "12px system-ui, sans-serif";
  context.textBaseline = "alphabetic";
  context.fillStyle = palette.colour("faint");
}
