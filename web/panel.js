// The settings as a form.

import { SETTINGS, at } from "./settings.js";

/** @typedef {import("./settings.js").Setting} Setting @typedef {import("./settings.js").Scene} Scene */

/**
 * @typedef {object} Row
 * @property {Setting} setting
 * @property {HTMLElement} element
 * @property {(value: any) => void} show
 */

/** Steps of a slider that goes by factors. */
const STEPS = 1000;

/** @template {keyof HTMLElementTagNameMap} K @param {K} name @param {Record<string, any>} [properties] @returns {HTMLElementTagNameMap[K]} */
export function make(name, properties = {}) {
  return Object.assign(document.createElement(name), properties);
}

/** A number as it is shown. @param {number} value */
export function shown(value) {
  if (value === Infinity) return "inf";
  if (!Number.isFinite(value)) return "";
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e6 || size < 1e-4)) return value.toExponential(3).replace(/\.?0+e/, "e").replace("e+", "e");
  return String(Number(value.toPrecision(6)));
}

export class Panel {
  /**
   * @param {HTMLElement} form
   * @param {(key: string, value: any, moving: boolean) => void} change
   */
  constructor(form, change) {
    this.change = change;
    /** @type {Row[]} */
    this.rows = [];
    /** @type {Map<string, HTMLFieldSetElement>} */
    this.groups = new Map();
    this.none = make("p", { className: "help", textContent: "No setting is called that.", hidden: true });
    this.none.setAttribute("role", "status");
    this.wanted = "";
    /** @type {Scene} */
    this.scene = {};
    for (const setting of SETTINGS) {
      let group = this.groups.get(setting.group);
      if (!group) {
        group = make("fieldset");
        group.append(make("legend", { textContent: setting.group }));
        this.groups.set(setting.group, group);
        form.append(group);
      }
      const row = this.row(setting, `s${this.rows.length}`);
      this.rows.push(row);
      group.append(row.element);
    }
    form.append(this.none);
    form.addEventListener("submit", (event) => event.preventDefault());
  }

  /** @param {Setting} setting @param {string} id @returns {Row} */
  row(setting, id) {
    const element = make("div", { className: "setting" });
    element.dataset.key = setting.key;
    const label = make("label", { htmlFor: id, textContent: setting.label, title: setting.key });
    if (setting.unit) label.append(make("span", { className: "unit", textContent: ` ${setting.unit}` }));
    element.append(label);
    const { key } = setting;
    if (setting.kind === "toggle") {
      const box = make("input", { id, type: "checkbox" });
      box.onchange = () => this.change(key, box.checked, false);
      element.append(box);
      return { setting, element, show: (value) => (box.checked = value === true) };
    }
    if (setting.kind === "choice") {
      const choices = setting.choices ?? [];
      const select = make("select", { id });
      choices.forEach(([, name], place) => select.append(make("option", { value: String(place), textContent: name })));
      const other = make("option", { value: "other", textContent: "as in the scene", hidden: true });
      select.append(other);
      select.onchange = () => this.change(key, choices[Number(select.value)]?.[0], false);
      element.append(select);
      const show = (/** @type {any} */ value) => {
        const text = JSON.stringify(value);
        const place = choices.findIndex(([choice]) => JSON.stringify(choice) === text);
        select.value = place < 0 ? "other" : String(place);
        other.hidden = place >= 0;
      };
      return { setting, element, show };
    }
    const field = make("input", { id, type: "text", inputMode: "decimal" });
    field.onchange = () => {
      const text = field.value.trim().replace(",", ".").replace("−", "-");
      if (text === "") this.change(key, undefined, false);
      else this.change(key, Number.isFinite(Number(text)) ? Number(text) : text, false);
    };
    element.append(field);
    if (setting.kind === "text") {
      return { setting, element, show: (value) => this.fill(field, typeof value === "number" ? shown(value) : value ?? "") };
    }
    const { min = 0, max = 1, step = 0.01, log = false } = setting;
    const slider = make("input", { type: "range" });
    slider.setAttribute("aria-label", setting.label);
    Object.assign(slider, log ? { min: "0", max: String(STEPS), step: "1" } : { min: String(min), max: String(max), step: String(step) });
    const value = () => {
      const raw = Number(slider.value);
      if (!log) return raw;
      return Number((min * (max / min) ** (raw / STEPS)).toPrecision(4));
    };
    slider.oninput = () => this.change(key, value(), true);
    slider.onchange = () => this.change(key, value(), false);
    element.append(slider);
    const show = (/** @type {any} */ now) => {
      const number = now === "inf" ? Infinity : Number(now);
      this.fill(field, shown(number));
      if (document.activeElement === slider && slider.matches(":active")) return;
      const along = log ? Math.round((STEPS * Math.log(number / min)) / Math.log(max / min)) : number;
      slider.value = String(Number.isFinite(along) ? along : STEPS);
      slider.setAttribute("aria-valuetext", `${shown(number)} ${setting.unit ?? ""}`.trim());
    };
    return { setting, element, show };
  }

  /** @param {HTMLInputElement} field @param {string} text */
  fill(field, text) {
    // What is being typed is not overwritten.
    if (document.activeElement !== field) field.value = text;
  }

  /** Shows the values of a scene. @param {Scene} scene @param {Record<string, any>} set */
  show(scene, set) {
    this.scene = scene;
    for (const row of this.rows) {
      const value = at(scene, row.setting.key);
      row.show(value ?? row.setting.usual);
      row.element.classList.toggle("changed", row.setting.key in set);
    }
    this.sift();
  }

  /** Shows what has to do with words alone. @param {string} words */
  search(words) {
    this.wanted = words.trim().toLowerCase();
    this.sift();
  }

  sift() {
    const words = this.wanted.split(/\s+/).filter(Boolean);
    for (const { setting, element } of this.rows) {
      const text = `${setting.label} ${setting.group} ${setting.key} ${setting.words ?? ""}`.toLowerCase();
      const found = words.every((word) => text.includes(word));
      element.hidden = !found || !(setting.when?.(this.scene) ?? true);
    }
    for (const group of this.groups.values()) {
      group.hidden = [...group.querySelectorAll(".setting")].every((row) => /** @type {HTMLElement} */ (row).hidden);
    }
    this.none.hidden = [...this.groups.values()].some((group) => !group.hidden);
  }
}
