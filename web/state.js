// What is seen: the base scene and the keys set in it. It stands in the page's address, and can be undone.

/** @typedef {{ base: string, set: Record<string, any> }} Look */

/** A look in the manner of an address. @param {Look} look */
export function written(look) {
  const parts = look.base === "" ? [] : [`scene=${encodeURIComponent(look.base)}`];
  for (const key of Object.keys(look.set).sort()) {
    const value = look.set[key];
    // A word that could be taken for something else keeps its quotation marks.
    const text = typeof value === "string" && !isJson(value) ? value : JSON.stringify(value);
    parts.push(`${encodeURIComponent(key)}=${encodeURIComponent(text).replaceAll("%2C", ",").replaceAll("%5B", "[").replaceAll("%5D", "]")}`);
  }
  return parts.join("&");
}

/** A look from an address. What cannot be read is left out. @param {string} text @returns {Look} */
export function read(text) {
  /** @type {Look} */
  const look = { base: "", set: {} };
  for (const part of text.replace(/^#/, "").split("&")) {
    const place = part.indexOf("=");
    if (place <= 0) continue;
    const [key, value] = [part.slice(0, place), part.slice(place + 1)].map(decoded);
    if (key === "scene") look.base = value;
    else if (/^[a-z0-9_.]+$/i.test(key)) look.set[key] = isJson(value) ? JSON.parse(value) : value;
  }
  return look;
}

/** @param {string} text */
function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** @param {string} text */
function isJson(text) {
  try {
    JSON.parse(text);
    return true;
  } catch {
    return false;
  }
}

/** Looks that were, and those that were undone. */
export class Course {
  /** @param {Look} look */
  constructor(look) {
    this.look = look;
    /** @type {string[]} */
    this.before = [];
    /** @type {string[]} */
    this.after = [];
    this.kept = written(look);
  }

  /** Keeps the look as it is now as one that can be come back to. */
  keep() {
    const now = written(this.look);
    if (now === this.kept) return;
    this.before.push(this.kept);
    if (this.before.length > 200) this.before.shift();
    this.after = [];
    this.kept = now;
  }

  /** @returns {boolean} whether there was anything to undo */
  undo() {
    return this.go(this.before, this.after);
  }

  /** @returns {boolean} */
  redo() {
    return this.go(this.after, this.before);
  }

  /** @param {string[]} from @param {string[]} to */
  go(from, to) {
    const other = from.pop();
    if (other === undefined) return false;
    to.push(this.kept);
    this.kept = other;
    this.look = read(other);
    return true;
  }
}
