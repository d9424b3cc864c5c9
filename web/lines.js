// Lines over a picture.

/** Colours of kinds of lines, on dark and bright pictures alike. @type {Record<string, string>} */
const COLOURS = { critical: "#35e0e6", orders: "#ff6ec7", equator: "#ffffff90", shift: "#7dff8a" };

/**
 * @param {HTMLCanvasElement} canvas
 * @param {{ kind: string, pieces: [number, number, number, number][] }[]} lines
 */
export function draw(canvas, lines) {
  const box = canvas.getBoundingClientRect();
  const scale = window.devicePixelRatio || 1;
  canvas.width = Math.max(1, Math.round(box.width * scale));
  canvas.height = Math.max(1, Math.round(box.height * scale));
  const context = canvas.getContext("2d");
  if (!context) return;
  canvas.dataset.pieces = String(lines.reduce((sum, { pieces }) => sum + pieces.length, 0));
  context.lineCap = "round";
  for (const { kind, pieces } of lines) {
    context.strokeStyle = COLOURS[kind] ?? "#ffffff";
    context.lineWidth = (kind === "critical" ? 1.6 : 1.1) * scale;
    context.beginPath();
    for (const [x0, y0, x1, y1] of pieces) {
      context.moveTo(x0 * canvas.width, y0 * canvas.height);
      context.lineTo(x1 * canvas.width, y1 * canvas.height);
    }
    context.stroke();
  }
}
