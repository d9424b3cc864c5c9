// One ray: what it meets, and a view of it from the side.

import { make, shown } from "./panel.js";

const SVG = "http://www.w3.org/2000/svg";

/** @param {string} name @param {Record<string, string | number>} attributes @param {string} [text] */
function shape(name, attributes, text) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  if (text) element.textContent = text;
  return element;
}

/** What a fate is called. @type {Record<string, string>} */
const FATES = {
  escaped: "comes from infinity", captured: "comes from the horizon: dark", hit: "comes from a thing",
  "step-limit": "was given up",
};

/**
 * @param {HTMLElement} box
 * @param {{ at: [number, number], horizon: number, ray: any }} content
 * @param {[number, number]} size
 * @param {() => void} leave
 */
export function showRay(box, { at, horizon, ray }, size, leave) {
  const pixel = at.map((share, k) => Math.min(size[k] - 1, Math.floor(share * size[k])));
  const head = make("div", { className: "head" });
  const close = make("button", { type: "button", textContent: "×", title: "Close (Esc)" });
  close.setAttribute("aria-label", "Close");
  close.onclick = leave;
  head.append(make("h2", { textContent: `Ray of pixel ${pixel.join(", ")}` }), close);
  const list = make("dl");
  const row = (/** @type {string} */ name, /** @type {string} */ value) =>
    list.append(make("dt", { textContent: name }), make("dd", { textContent: value }));
  row("Light", FATES[ray.fate] ?? ray.fate);
  if (ray.direction) {
    const degrees = (/** @type {number} */ angle) => `${((angle * 180) / Math.PI).toFixed(2)}°`;
    const { theta, phi } = ray.direction;
    row("From", `θ ${degrees(theta)}, φ ${degrees(phi - 2 * Math.PI * Math.round(phi / (2 * Math.PI)))}`);
  }
  if (ray.hit) row("Thing", `number ${ray.hit.object}`);
  const { lambda, eta } = ray.conserved;
  if (lambda !== null) row("λ, η", `${shown(lambda)} M${eta === null ? "" : `, ${shown(eta)} M²`}`);
  row("Traced", `${ray.engine}${ray.error_estimate ? `, error ${ray.error_estimate.toExponential(0)}` : ""}`);
  const parts = [head, list];
  if (ray.crossings.length > 0) {
    const table = make("table");
    table.append(make("caption", { textContent: "Crossings of the equatorial plane" }));
    const cells = (/** @type {"td" | "th"} */ kind, /** @type {string[]} */ texts) => {
      const line = make("tr");
      line.append(...texts.map((textContent) => make(kind, { textContent })));
      return line;
    };
    table.append(cells("th", ["order", "r (M)", "φ (°)", "t (M)", "g"]));
    for (const { order, r, phi, t, g } of ray.crossings) {
      const number = (/** @type {number | null} */ x, digits = 3) => (x === null ? "–" : x.toFixed(digits));
      table.append(cells("td", [String(order), number(r), number(phi === null ? null : (phi * 180) / Math.PI, 1), number(t, 2), number(g)]));
    }
    parts.push(table);
  } else {
    parts.push(make("p", { textContent: "It does not cross the equatorial plane." }));
  }
  box.replaceChildren(...parts);
  if (ray.path && ray.path.length > 1) box.append(sideView(ray.path, horizon));
  box.hidden = false;
}

/**
 * The way seen at right angles to the camera's direction, as `kerrscope trace --format svg` has it: z up.
 * @param {[number, number, number, number][]} path @param {number} horizon
 */
function sideView(path, horizon) {
  const [, x0, y0] = path[0];
  const width = Math.hypot(x0, y0) || 1;
  const points = path.map(([, x, y, z]) => [(x * x0 + y * y0) / width, z]);
  // What is far behind the hole says nothing.
  const reach = Math.max(1.15 * Math.hypot(...points[0]), 6);
  const near = points.filter(([x, z]) => Math.hypot(x, z) < reach);
  const svg = /** @type {SVGSVGElement} */ (shape("svg", { role: "img", "aria-label": "The ray from the side" }));
  const [xs, zs] = [near.map(([x]) => x), near.map(([, z]) => z)];
  const edge = Math.max(3 * Math.max(horizon, 1), 3);
  const [left, right] = [Math.min(-edge, ...xs), Math.max(edge, ...xs)];
  const [low, high] = [Math.min(-edge, ...zs), Math.max(edge, ...zs)];
  const unit = (right - left) / 100;
  svg.setAttribute("viewBox", `${left - 2 * unit} ${-high - 2 * unit} ${right - left + 4 * unit} ${high - low + 4 * unit}`);
  svg.append(shape("path", { d: `M${left} 0H${right}`, class: "plane", "stroke-width": 0.4 * unit }));
  // r₊² + a² = 2r₊ around a Kerr hole: half-axes in Kerr–Schild coordinates.
  if (horizon > 0) svg.append(shape("ellipse", { cx: 0, cy: 0, rx: Math.sqrt(2 * horizon), ry: horizon, class: "hole", "stroke-width": 0.4 * unit }));
  svg.append(shape("polyline", { points: near.map(([x, z]) => `${x.toFixed(4)},${(-z).toFixed(4)}`).join(" "), class: "way", "stroke-width": 0.6 * unit }));
  svg.append(shape("circle", { cx: points[0][0], cy: -points[0][1], r: 1.4 * unit, class: "eye" }));
  return svg;
}
