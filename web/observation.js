// A picture of anybody's: dropped here, measured, fitted, and shown under its fit as that goes on.

import { decode } from "./link.js";
import { make, shown } from "./panel.js";

/** The largest file that the program takes. */
const LARGEST = 32 * 2 ** 20;

const NAMES = ["observed", "fitted", "difference"];

export class Observation {
  /**
   * @param {HTMLDialogElement} dialog
   * @param {(set: Record<string, any>) => void} use  Takes what was found as a scene.
   */
  constructor(dialog, use) {
    this.dialog = dialog;
    this.use = use;
    const find = (/** @type {string} */ part) => /** @type {any} */ (dialog.querySelector(part));
    this.words = /** @type {HTMLElement} */ (find("output"));
    this.file = /** @type {HTMLInputElement} */ (find("input[type=file]"));
    this.model = /** @type {HTMLSelectElement} */ (find("select"));
    this.pictures = /** @type {HTMLElement} */ (find(".pictures"));
    this.measured = /** @type {HTMLElement} */ (find(".measured"));
    this.fitted = /** @type {HTMLElement} */ (find(".fitted"));
    this.take = /** @type {HTMLButtonElement} */ (find("[name=take]"));
    /** @type {WebSocket | null} */
    this.socket = null;
    /** @type {any} */
    this.report = null;
    /** Pixels of the picture. @type {[number, number]} */
    this.size = [1, 1];
    /** @type {File | null} */
    this.last = null;
    this.file.onchange = () => this.file.files?.[0] && this.open(this.file.files[0]);
    this.model.onchange = () => this.last && this.open(this.last);
    find("[name=close]").onclick = () => dialog.close();
    dialog.addEventListener("close", () => this.stop());
    this.take.onclick = () => this.adopt();
  }

  /** Shows the dialogue, with a picture if there is one. @param {File} [file] */
  async open(file) {
    if (!this.dialog.open) this.dialog.showModal();
    if (!file) return;
    this.stop();
    this.last = file;
    this.pictures.replaceChildren();
    this.measured.replaceChildren();
    this.fitted.replaceChildren();
    this.take.hidden = true;
    if (file.size > LARGEST) {
      this.words.textContent = `${file.name} has ${(file.size / 2 ** 20).toFixed(0)} MiB: 32 at most are taken here; use kerrscope fit`;
      return;
    }
    this.words.textContent = `Reading ${file.name} …`;
    const bytes = await file.arrayBuffer();
    const model = this.model.value ? `?model=${this.model.value}` : "";
    const socket = new WebSocket(`ws://${location.host}/observation${model}`);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.onopen = () => socket.send(bytes);
    socket.onmessage = (event) => this.socket === socket && this.receive(event.data);
    socket.onerror = () => (this.words.textContent = "The program does not answer");
  }

  stop() {
    this.socket?.close();
    this.socket = null;
  }

  /** @param {string | ArrayBuffer} data */
  receive(data) {
    if (typeof data !== "string") {
      const frame = decode(data);
      if (!frame) return;
      const canvas = make("canvas", { width: frame.width, height: frame.height });
      canvas.getContext("2d")?.putImageData(frame.image, 0, 0);
      const name = NAMES[frame.generation] ?? "";
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", `Picture: ${name}`);
      if (name === "fitted") this.cover(canvas);
      else this.show(name, canvas);
      return;
    }
    const { kind, content } = JSON.parse(data);
    if (kind === "fitting") {
      this.words.textContent = `Fitting: ${content.text}`;
    } else if (kind === "measured") {
      this.words.textContent = "Measured; fitting …";
      this.showMeasured(content);
    } else if (kind === "estimated") {
      this.fitted.replaceChildren(this.table("So far", content.parameters));
    } else if (kind === "fitted") {
      this.showFit(content.report);
    } else {
      this.words.textContent = content.text;
    }
  }

  /** @param {string} name @param {HTMLCanvasElement} canvas */
  show(name, canvas) {
    const figure = make("figure");
    const over = make("div", { className: "over" });
    over.append(canvas);
    figure.append(over, make("figcaption", { textContent: name }));
    figure.dataset.name = name;
    this.pictures.append(figure);
  }

  /** Lays the fit as it is by now over the picture, from a line on that a slider moves. @param {HTMLCanvasElement} canvas */
  cover(canvas) {
    const over = /** @type {HTMLElement | null} */ (this.pictures.querySelector("[data-name=observed] .over"));
    if (!over) return;
    canvas.className = "fit";
    const before = over.querySelector(".fit");
    if (before) {
      before.replaceWith(canvas);
      return;
    }
    over.append(canvas);
    const slider = make("input", { type: "range", min: "0", max: "100", value: "50", ariaLabel: "Where the fit begins, from the left" });
    slider.oninput = () => over.style.setProperty("--from", `${slider.value}%`);
    const caption = /** @type {HTMLElement} */ (over.nextElementSibling);
    caption.textContent = "observed to the left, fitted to the right";
    caption.before(slider);
  }

  /** @param {{ size: [number, number], features: any }} content */
  showMeasured({ size, features }) {
    const rows = [["Picture", `${size[0]} × ${size[1]} pixels`]];
    const with_error = (/** @type {any} */ m) => `${m.value.toFixed(2)} ± ${m.error.toFixed(2)} px`;
    for (const [name, label] of [["shadow", "Shadow"], ["ring", "Ring"]]) {
      const { found, not_found: reason } = features[name] ?? {};
      if (found?.diameter) rows.push([`${label}, diameter`, with_error(found.diameter)]);
      else rows.push([label, `not found: ${reason ?? ""}`]);
    }
    this.size = size;
    this.measured.replaceChildren(...rows.flatMap(([name, value]) => [make("dt", { textContent: name }), make("dd", { textContent: value })]));
  }

  /** @param {string} textContent @param {any[]} parameters */
  table(textContent, parameters) {
    const table = make("table");
    table.append(make("caption", { textContent }));
    for (const { name, unit, mean, sd, free } of parameters) {
      if (!free) continue;
      const line = make("tr");
      line.append(make("th", { scope: "row", textContent: name.replaceAll("_", " ") }));
      line.append(make("td", { textContent: `${shown(Number(mean.toPrecision(5)))} ± ${shown(Number(sd.toPrecision(2)))}` }), make("td", { textContent: unit }));
      table.append(line);
    }
    return table;
  }

  /** @param {any} report */
  showFit(report) {
    this.report = report;
    const table = this.table(`${report.model}, χ² ${report.chi2.toFixed(0)} for ${report.degrees} degrees of freedom`, report.parameters);
    this.fitted.replaceChildren(table, ...report.warnings.map((/** @type {string} */ text) => make("p", { className: "mend", textContent: text })));
    this.words.textContent = `${report.converged ? "Converged" : "Not converged"} after ${report.wall_s.toFixed(1)} s, ${report.evaluations} pictures${report.good ? "" : "; the model does not describe the picture"}`;
    this.take.hidden = !["page-thorne", "power-law", "thin-power-law", "silhouette"].includes(report.model);
  }

  /** Shows the hole that was found. */
  adopt() {
    /** @type {Record<string, number>} */
    const found = Object.fromEntries(this.report.parameters.map((/** @type {any} */ one) => [one.name, one.mode]));
    const set = /** @type {Record<string, any>} */ ({ "disk.model": this.report.model === "page-thorne" ? "page-thorne" : this.report.model === "silhouette" ? "ring" : "power-law" });
    const put = (/** @type {string} */ key, /** @type {number | undefined} */ value, low = -Infinity, high = Infinity) => {
      if (value !== undefined && Number.isFinite(value)) set[key] = Number(Math.min(high, Math.max(low, value)).toPrecision(6));
    };
    put("spacetime.spin", found.spin, -1, 1);
    put("observer.inclination", found.inclination, 0, 180);
    put("observer.distance", found.distance, 3, 1e6);
    // East of North is from up over left; the camera's roll turns the picture clockwise.
    put("screen.roll", found.position_angle === undefined ? undefined : -(((found.position_angle + 180) % 360) - 180));
    if (found.scale > 0 && Number.isFinite(found.distance)) {
      // The same part of the plane through the hole.
      const [width, height] = this.size.map((pixels) => pixels * found.scale);
      put("screen.field_of_view", (360 / Math.PI) * Math.atan(height / 2 / found.distance), 0.01, 170);
      put("disk.outer", found.outer ?? Math.hypot(width, height), 2, 1000);
    }
    set["sky.kind"] = "black";
    if (set["disk.model"] === "power-law") put("disk.index", found.index);
    this.dialog.close();
    this.use(set);
  }
}
