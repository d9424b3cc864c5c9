// Mouse, touch and keys on the picture: around, nearer, rolled.

/**
 * What hands want: degrees around and over, a factor on the distance, degrees of roll.
 * @typedef {{ around?: number, over?: number, nearer?: number, roll?: number }} Gesture
 *
 * @typedef {object} Hold
 * @property {(gesture: Gesture) => void} move   While it goes on.
 * @property {() => void} rest                   When it is over.
 * @property {(x: number, y: number) => void} point  A place was pointed at, as shares of width and height.
 */

/** Degrees for a pixel. */
const DEGREES = 0.3;

/** Milliseconds after which a wheel or a key that is held counts as over. */
const REST = 180;

/** @param {HTMLCanvasElement} canvas @param {Hold} hold */
export function hands(canvas, hold) {
  /** @type {Map<number, { x: number, y: number }>} */
  const held = new Map();
  let far = 0;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;
  const soon = () => {
    clearTimeout(timer);
    timer = setTimeout(hold.rest, REST);
  };

  canvas.addEventListener("pointerdown", (event) => {
    if (event.pointerType === "mouse" && event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
    far = held.size > 1 ? Infinity : 0;
    canvas.classList.add("held");
    canvas.focus({ preventScroll: true });
    event.preventDefault();
  });

  canvas.addEventListener("pointermove", (event) => {
    const last = held.get(event.pointerId);
    if (!last) return;
    const now = { x: event.clientX, y: event.clientY };
    const [dx, dy] = [now.x - last.x, now.y - last.y];
    const other = [...held.entries()].find(([id]) => id !== event.pointerId)?.[1];
    held.set(event.pointerId, now);
    far += Math.hypot(dx, dy);
    if (other) {
      const [before, after] = [last, now].map(({ x, y }) => ({ x: x - other.x, y: y - other.y }));
      const turned = Math.atan2(after.y, after.x) - Math.atan2(before.y, before.x);
      hold.move({
        nearer: Math.hypot(after.x, after.y) / Math.max(Math.hypot(before.x, before.y), 1),
        roll: (-180 / Math.PI) * Math.atan2(Math.sin(turned), Math.cos(turned)),
      });
    } else if (far > 3) {
      if (event.shiftKey) hold.move({ roll: DEGREES * dx });
      else hold.move({ around: -DEGREES * dx, over: -DEGREES * dy });
    }
  });

  const release = (/** @type {PointerEvent} */ event) => {
    if (!held.delete(event.pointerId)) return;
    if (held.size > 0) return;
    canvas.classList.remove("held");
    if (far > 3) {
      hold.rest();
    } else if (event.type === "pointerup") {
      const box = canvas.getBoundingClientRect();
      hold.point((event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height);
    }
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);

  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const pixels = event.deltaMode === 1 ? 16 * event.deltaY : event.deltaY;
    hold.move({ nearer: Math.exp(-0.0015 * Math.max(-300, Math.min(300, pixels))) });
    soon();
  }, { passive: false });

  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "Enter") {
      event.preventDefault();
      hold.point(0.5, 0.5);
      return;
    }
    const step = event.shiftKey ? 10 : 2;
    /** @type {Record<string, Gesture>} */
    const gestures = {
      ArrowLeft: { around: -step }, ArrowRight: { around: step }, ArrowUp: { over: -step }, ArrowDown: { over: step },
      "+": { nearer: 1.05 }, "=": { nearer: 1.05 }, "-": { nearer: 1 / 1.05 }, q: { roll: step }, e: { roll: -step },
    };
    const gesture = gestures[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!gesture) return;
    event.preventDefault();
    hold.move(gesture);
    soon();
  });
}
