// The dialogue that saves a picture.

import { make } from "./panel.js";

/** Sizes that are offered. @type {[string, number, number][]} */
const SIZES = [
  ["as on the screen", 0, 0],
  ["1280 × 720", 1280, 720],
  ["1920 × 1080", 1920, 1080],
  ["3840 × 2160", 3840, 2160],
  ["1080 × 1080", 1080, 1080],
];

export class Saver {
  /**
   * @param {HTMLDialogElement} dialog
   * @param {(wish: { format: string, size: [number, number], samples: number }) => void} ask
   * @param {() => void} stop
   * @param {() => [number, number]} size  Of the picture on the screen.
   */
  constructor(dialog, ask, stop, size) {
    this.dialog = dialog;
    this.size = size;
    const find = (/** @type {string} */ name) => /** @type {any} */ (dialog.querySelector(`[name="${name}"]`));
    /** @type {{ format: HTMLSelectElement, preset: HTMLSelectElement, width: HTMLInputElement, height: HTMLInputElement,
     *   samples: HTMLInputElement, go: HTMLButtonElement, stop: HTMLButtonElement, close: HTMLButtonElement }} */
    this.parts = {
      format: find("format"), preset: find("size"), width: find("width"), height: find("height"), samples: find("samples"),
      go: find("go"), stop: find("stop"), close: find("close"),
    };
    this.bar = /** @type {HTMLProgressElement} */ (dialog.querySelector("progress"));
    this.words = /** @type {HTMLElement} */ (dialog.querySelector("output"));
    this.format = "png";
    const { parts } = this;
    SIZES.forEach(([name], place) => parts.preset.append(make("option", { value: String(place), textContent: name })));
    parts.preset.append(make("option", { value: "own", textContent: "other", hidden: true }));
    parts.preset.onchange = () => this.fill();
    parts.width.oninput = parts.height.oninput = () => (parts.preset.value = "own");
    parts.format.onchange = () => this.enable(false);
    parts.go.onclick = () => {
      const number = (/** @type {HTMLInputElement} */ field) => Math.round(Number(field.value));
      this.format = parts.format.value;
      this.enable(true);
      this.words.textContent = "Drawing …";
      ask({ format: this.format, size: [number(parts.width), number(parts.height)], samples: number(parts.samples) });
    };
    parts.stop.onclick = stop;
    parts.close.onclick = () => dialog.close();
  }

  open() {
    this.parts.preset.value = "0";
    this.fill();
    this.words.textContent = "";
    this.enable(false);
    this.dialog.showModal();
  }

  fill() {
    const [, width, height] = SIZES[Number(this.parts.preset.value)] ?? SIZES[0];
    const [w, h] = width > 0 ? [width, height] : this.size();
    this.parts.width.value = String(w);
    this.parts.height.value = String(h);
  }

  /** @param {boolean} busy */
  enable(busy) {
    const { go, stop, width, height, samples, preset, format } = this.parts;
    const plain = format.value === "toml";
    for (const part of [go, format, width, height, samples, preset]) part.disabled = busy;
    if (plain && !busy) for (const part of [width, height, samples, preset]) part.disabled = false;
    stop.hidden = !busy;
    this.bar.hidden = !busy;
    this.bar.value = 0;
  }

  /** @param {{ done: number, total: number }} progress */
  progress({ done, total }) {
    this.bar.value = total > 0 ? done / total : 0;
    this.words.textContent = `Drawing: ${Math.floor((100 * done) / Math.max(total, 1))} %`;
  }

  /** @param {{ message: string, help: string }[]} faults */
  failed(faults) {
    this.enable(false);
    this.words.textContent = faults.map(({ message, help }) => (help ? `${message}: ${help}` : message)).join("; ");
  }

  /** Hands the file to the browser. @param {ArrayBuffer} bytes */
  done(bytes) {
    this.enable(false);
    const kinds = { png: "image/png", exr: "image/x-exr", toml: "text/plain" };
    const kind = kinds[/** @type {keyof typeof kinds} */ (this.format)] ?? "application/octet-stream";
    const address = URL.createObjectURL(new Blob([bytes], { type: kind }));
    make("a", { href: address, download: `kerrscope.${this.format}` }).click();
    setTimeout(() => URL.revokeObjectURL(address), 60000);
    this.words.textContent = `Saved kerrscope.${this.format}, ${(bytes.byteLength / 1e6).toFixed(2)} MB`;
  }
}
