// A picture that follows what is asked of it: a canvas, lines over it, and the link to the program.

import { draw } from "./lines.js";
import { Link } from "./link.js";

/** @typedef {import("./link.js").Frame} Frame @typedef {import("./link.js").Wish} Wish */

export class Picture {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {HTMLCanvasElement} over
   * @param {{ frame: (frame: Frame) => void, notice: (kind: string, content: any) => void, open: (open: boolean) => void,
   *   file: (generation: number, bytes: ArrayBuffer) => void }} listener
   */
  constructor(canvas, over, listener) {
    this.canvas = canvas;
    this.over = over;
    this.context = canvas.getContext("2d", { alpha: false });
    this.buffer = document.createElement("canvas");
    this.bufferContext = this.buffer.getContext("2d", { alpha: false });
    this.link = new Link({
      ...listener,
      frame: (frame) => {
        this.paint(frame);
        listener.frame(frame);
      },
      notice: (kind, content) => {
        if (kind === "overlay") draw(this.over, content.lines);
        else listener.notice(kind, content);
      },
    });
  }

  /** @param {Wish} wish */
  ask(wish) {
    if (wish.overlays.length === 0) draw(this.over, []);
    this.link.ask(wish);
  }

  /** @param {Frame} frame */
  paint(frame) {
    const { canvas, context, buffer, bufferContext } = this;
    if (!context || !bufferContext) return;
    const [width, height] = frame.wanted;
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    if (frame.width === width && frame.height === height) {
      context.putImageData(frame.image, 0, 0);
    } else {
      buffer.width = frame.width;
      buffer.height = frame.height;
      bufferContext.putImageData(frame.image, 0, 0);
      context.imageSmoothingEnabled = true;
      context.imageSmoothingQuality = "high";
      context.drawImage(buffer, 0, 0, width, height);
    }
    canvas.dataset.generation = String(frame.generation);
    canvas.dataset.last = String(frame.last);
  }

  close() {
    this.link.close();
    draw(this.over, []);
  }
}
