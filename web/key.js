// What the colours of a data layer mean.

import { make } from "./panel.js";

/**
 * Shows colours and their meaning, or nothing.
 * @param {HTMLElement} box
 * @param {{ heading: string, bar: string[], marks: [number, string][], boxes: [string, string][] } | null} key
 */
export function showKey(box, key) {
  box.hidden = !key;
  if (!key) return;
  const parts = [make("figcaption", { textContent: key.heading })];
  if (key.bar.length > 0) {
    const bar = make("div", { className: "bar" });
    bar.style.background = `linear-gradient(to right, ${key.bar.join(", ")})`;
    const marks = make("div", { className: "marks" });
    marks.append(...key.marks.map(([place, label]) => {
      const mark = make("span", { textContent: label });
      mark.style.left = `${100 * place}%`;
      return mark;
    }));
    parts.push(bar, marks);
  }
  if (key.boxes.length > 0) {
    const boxes = make("ul");
    boxes.append(...key.boxes.map(([colour, name]) => {
      const item = make("li", { textContent: name });
      const box = make("span", { className: "box" });
      box.style.background = colour;
      item.prepend(box);
      return item;
    }));
    parts.push(boxes);
  }
  box.replaceChildren(...parts);
}
