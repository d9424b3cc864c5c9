// Numbers of the hole, and how good the picture is.

import { make, shown } from "./panel.js";

/** @param {HTMLElement} list @param {any} facts */
export function readouts(list, facts) {
  /** @type {[string, string][]} */
  const rows = [];
  const { hole, theta_g_uas: theta } = facts;
  const lengths = (/** @type {number} */ length) => `${length.toFixed(3)} M`;
  if (hole) {
    rows.push(["Horizon", lengths(hole.horizon)], ["ISCO", lengths(hole.isco)]);
    rows.push(["Photon orbits", `${hole.photon_prograde.toFixed(3)}, ${lengths(hole.photon_retrograde)}`]);
    const angle = theta ? ` = ${(hole.shadow_diameter * theta).toFixed(1)} µas` : "";
    rows.push(["Shadow diameter", `${lengths(hole.shadow_diameter)}${angle}`]);
  }
  if (theta) rows.push(["M on the sky", `${shown(theta)} µas`]);
  rows.push(["Traced by", facts.engine]);
  list.replaceChildren(...rows.flatMap(([name, value]) => [make("dt", { textContent: name }), make("dd", { textContent: value })]));
}

/** @param {import("./link.js").Frame} frame @param {number} perSecond */
export function status(frame, perSecond) {
  const size = `${frame.width} × ${frame.height}`;
  const words = [size];
  if (frame.last) words.push(frame.samples === 1 ? "1 ray a pixel" : `${frame.samples} rays a pixel`);
  else if (frame.width !== frame.wanted[0]) words.push(`of ${frame.wanted[0]} × ${frame.wanted[1]}`);
  words.push(`${frame.milliseconds.toFixed(0)} ms`, `${shown(Number((frame.rate / 1e6).toPrecision(2)))} M rays/s`);
  if (perSecond > 0) words.push(`${perSecond} frames/s`);
  if (frame.error > 0) words.push(`error ${frame.error.toExponential(0)} rad`);
  if (frame.givenUp > 0) words.push(`${frame.givenUp} rays given up`);
  return words.join(" · ");
}
