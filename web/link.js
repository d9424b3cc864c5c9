// The connection to the program: wishes there, frames and facts back.

/**
 * @typedef {object} Frame
 * @property {number} generation
 * @property {number} width
 * @property {number} height
 * @property {[number, number]} wanted
 * @property {number} samples
 * @property {boolean} last
 * @property {number} milliseconds
 * @property {number} rate
 * @property {number} error
 * @property {number} givenUp
 * @property {ImageData} image
 *
 * @typedef {object} Wish
 * @property {string} base
 * @property {Record<string, any>} set
 * @property {[number, number]} size
 * @property {number} samples
 * @property {boolean} moving
 * @property {string[]} overlays
 *
 * @typedef {object} Listener
 * @property {(frame: Frame) => void} frame
 * @property {(kind: string, content: any) => void} notice
 * @property {(open: boolean) => void} open
 * @property {(generation: number, bytes: ArrayBuffer) => void} file
 */

/** @param {ArrayBuffer} bytes @returns {Frame | null} */
export function decode(bytes) {
  if (bytes.byteLength < 44) return null;
  const head = new DataView(bytes);
  // "KSF1"
  if (head.getUint32(0) !== 0x4b534631) return null;
  const [width, height] = [head.getUint16(8, true), head.getUint16(10, true)];
  if (bytes.byteLength !== 40 + 4 * width * height) return null;
  return {
    generation: head.getUint32(4, true),
    width,
    height,
    wanted: [head.getUint16(12, true), head.getUint16(14, true)],
    samples: head.getUint32(16, true),
    last: head.getUint32(20, true) === 1,
    milliseconds: head.getFloat32(24, true),
    rate: head.getFloat32(28, true),
    error: head.getFloat32(32, true),
    givenUp: head.getUint32(36, true),
    image: new ImageData(new Uint8ClampedArray(bytes, 40), width, height),
  };
}

/** A socket that is opened again when it breaks, and asked again for what was asked last. */
export class Link {
  /** @param {Listener} listener */
  constructor(listener) {
    this.listener = listener;
    /** @type {WebSocket | null} */
    this.socket = null;
    this.generation = 0;
    /** @type {Wish | null} */
    this.wish = null;
    /** Whether the wish has not been sent. */
    this.waiting = false;
    /** When the wish before was sent, and the last that was answered. */
    this.sent = 0;
    this.answered = 0;
    this.pause = 250;
    this.closed = false;
    this.connect();
  }

  connect() {
    const socket = new WebSocket(`ws://${location.host}/socket`);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.onopen = () => {
      this.pause = 250;
      this.answered = this.generation;
      this.listener.open(true);
      if (this.wish) this.waiting = true;
      this.flush();
    };
    socket.onmessage = (event) => this.receive(event.data);
    socket.onclose = () => {
      this.socket = null;
      if (this.closed) return;
      this.listener.open(false);
      setTimeout(() => this.connect(), this.pause);
      this.pause = Math.min(2 * this.pause, 5000);
    };
  }

  close() {
    this.closed = true;
    this.socket?.close();
  }

  /** @param {Wish} wish */
  ask(wish) {
    this.wish = wish;
    this.waiting = true;
    this.flush();
  }

  /** Sends the last wish. While things move, one is drawn and one waits for its turn: what comes between is out of date. */
  flush() {
    if (!this.waiting || !this.wish || this.socket?.readyState !== WebSocket.OPEN) return;
    if (this.wish.moving && this.generation - this.answered > 1 && performance.now() - this.sent < 400) return;
    this.generation = this.generation + 1;
    this.socket.send(JSON.stringify({ kind: "show", generation: this.generation, ...this.wish }));
    this.sent = performance.now();
    this.waiting = false;
  }

  /** Sends another message at once. @param {Record<string, any>} message @returns {boolean} whether there is a connection */
  send(message) {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  /** @param {string | ArrayBuffer} data */
  receive(data) {
    if (typeof data !== "string") {
      // "KSV1": a file.
      if (data.byteLength >= 8 && new DataView(data).getUint32(0) === 0x4b535631) {
        this.listener.file(new DataView(data).getUint32(4, true), data.slice(8));
        return;
      }
      const frame = decode(data);
      if (!frame) return;
      this.answered = Math.max(this.answered, frame.generation);
      this.flush();
      this.listener.frame(frame);
      return;
    }
    const { kind, content } = JSON.parse(data);
    if (kind === "faults" || kind === "fault") {
      this.answered = this.generation;
      this.flush();
    }
    this.listener.notice(kind, content);
  }
}
