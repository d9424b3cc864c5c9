// The page: a picture, what is set, and what is seen.

import { hands } from "./hands.js";
import { showKey } from "./key.js";
import { Panel, make } from "./panel.js";
import { Observation } from "./observation.js";
import { Picture } from "./picture.js";
import { showRay } from "./ray.js";
import { readouts, status } from "./readouts.js";
import { Saver } from "./save.js";
import { BESIDE, DISKLESS, LINES, PRESETS, SETTINGS, at } from "./settings.js";
import { Course, read, written } from "./state.js";

/** @template {HTMLElement} T @param {string} id @param {new () => T} kind @returns {T} */
function element(id, kind) {
  const found = document.getElementById(id);
  if (!(found instanceof kind)) throw new Error(`the page has no ${id}`);
  return found;
}

const canvas = element("picture", HTMLCanvasElement);
const stage = element("stage", HTMLElement);
const line = element("status", HTMLElement);
const faults = element("faults", HTMLElement);
const list = element("readouts", HTMLElement);
const preset = element("preset", HTMLSelectElement);
const search = element("search", HTMLInputElement);
const undo = element("undo", HTMLButtonElement);
const redo = element("redo", HTMLButtonElement);
const ray = element("ray", HTMLElement);

/** Pixels of the whole picture at most. */
const MOST_PIXELS = 1920 * 1200;

const course = new Course(read(location.hash));
/** The scene as the server knows it. @type {any} */
let scene = null;
/** Where the observer is. @type {{ distance: number, inclination: number, azimuth: number } | null} */
let place = null;
/** Radius of the innermost stable orbit, if there is one. @type {number | null} */
let isco = null;
/** Times of the last frames, for their rate. @type {number[]} */
let times = [];

/** What tests ask for. */
const seen = { frames: 0, last: 0, firstFrame: 0, opened: 0, lastTime: 0, asked: 0, width: 0, moving: 0 };
Object.assign(window, { kerrscope: seen });

const picture = new Picture(canvas, element("lines", HTMLCanvasElement), {
  frame: (frame) => {
    const now = performance.now();
    if (seen.frames === 0) seen.firstFrame = now;
    seen.frames += 1;
    seen.width = frame.width;
    if (frame.last) {
      seen.last = frame.generation;
      seen.lastTime = now;
    } else {
      seen.moving += 1;
    }
    times = [...times.filter((time) => now - time < 1000), now];
    line.textContent = status(frame, frame.last ? 0 : times.length);
  },
  notice: (kind, content) => {
    if (kind === "facts") {
      const first = !scene || isco !== (content.hole?.isco ?? null);
      scene = content.scene;
      place = { ...content.place, distance: content.place.distance ?? Infinity };
      faults.hidden = true;
      isco = content.hole?.isco ?? null;
      readouts(list, content);
      display();
      // What stands beside it depends on the scene.
      if (first) compare(wish(false));
    } else if (kind === "key") {
      showKey(element("key", HTMLElement), content.key);
    } else if (kind === "ray") {
      showRay(ray, content, size(), leave);
    } else if (kind === "drawing") {
      line.textContent = `${line.textContent?.split(" · finer")[0]} · finer: ${Math.floor((100 * content.done) / content.total)} %`;
    } else if (kind === "progress") {
      saver.progress(content);
    } else if (kind === "unsaved") {
      saver.failed(content.faults);
    } else {
      complain(kind === "faults" ? content.faults : [{ place: "", message: String(content), help: "" }]);
    }
  },
  open: (open) => {
    if (open) seen.opened = performance.now();
    line.textContent = open ? "Connected" : "The program is gone; waiting for it …";
  },
  file: (_, bytes) => saver.done(bytes),
});

const saver = new Saver(
  element("saver", HTMLDialogElement),
  ({ format, size: [width, height], samples }) => {
    const view = { ...wish(false), generation: 0, size: [width, height], samples, overlays: [] };
    if (!picture.link.send({ kind: "save", view, format })) saver.failed([{ message: "the program is gone", help: "start it again" }]);
  },
  () => picture.link.send({ kind: "stop" }),
  () => size(),
);

/** Shows the values of settings; where the observer is, by distance and angles, however it was said. */
function display() {
  const page = Object.fromEntries(Object.entries(own(course.look.set, true)).map(([key, value]) => [key.slice(5), value]));
  const observer = scene?.observer?.position && place ? { ...scene.observer, ...place } : scene?.observer;
  panel.show({ ...scene, observer, page }, course.look.set);
}

/** @param {{ place: string, message: string, help: string }[]} found @param {HTMLElement} [box] */
function complain(found, box = faults) {
  box.replaceChildren(...found.map(({ place: where, message, help }) => {
    const words = make("p");
    if (where) words.append(make("code", { textContent: where }), ": ");
    words.append(message);
    if (help) words.append(make("br"), make("span", { className: "mend", textContent: help }));
    return words;
  }));
  box.hidden = found.length === 0;
}

/** The size of the picture: as many pixels as the screen has for it, but not too many. @returns {[number, number]} */
function size() {
  const box = stage.getBoundingClientRect();
  const [width, height] = [Math.max(box.width, 16), Math.max(box.height, 16)];
  const scale = Math.min(window.devicePixelRatio || 1, Math.sqrt(MOST_PIXELS / (width * height)));
  return [Math.round(width * scale), Math.round(height * scale)];
}

/** The keys to be set. @param {Record<string, any>} set @returns {Record<string, any>} */
function keys(set) {
  const asked = Object.fromEntries(Object.entries(set).filter(([key]) => !key.startsWith("page.")));
  const placed = ["observer.distance", "observer.inclination", "observer.azimuth"].some((key) => key in set);
  if (placed) asked["observer.position"] = null;
  return asked;
}

/** Takes keys out that have no meaning beside the others, and those of the base too. @param {Record<string, any>} set */
function prune(set) {
  if (!scene) return set;
  /** @type {any} */
  const would = structuredClone(scene);
  for (const [key, value] of Object.entries(set)) {
    const names = key.split(".");
    const last = names.pop() ?? "";
    const table = names.reduce((within, name) => (within[name] ??= {}), would);
    table[last] = value ?? undefined;
  }
  /** @type {Record<string, any>} */
  const left = { ...set };
  // Several settings may share a key, each with a meaning in other scenes.
  for (const key of new Set(SETTINGS.map((setting) => setting.key))) {
    const some = SETTINGS.filter((setting) => setting.key === key);
    if (key.startsWith("page.") || some.some(({ when }) => when?.(would) ?? true)) continue;
    // What the base says was taken out before: it stays out.
    if (left[key] === null) continue;
    delete left[key];
    if (course.look.base !== "built-in" && at(scene, key) !== undefined) left[key] = null;
  }
  return left;
}

/** What is wished for. @param {boolean} moving @returns {import("./link.js").Wish} */
function wish(moving) {
  const { base, set } = course.look;
  const overlays = LINES.filter((name) => set[`page.${name}`] === true);
  return { base, set: keys(set), size: size(), samples: Number(set["page.samples"] ?? 4), moving, overlays };
}

/** Asks for the picture. @param {boolean} moving */
function ask(moving) {
  seen.asked = performance.now();
  const wished = wish(moving);
  picture.ask(wished);
  compare(wished);
}

/** The picture beside it, while there is one. @type {Picture | null} */
let other = null;

/** What differs in the picture beside it; none if there can be none. @param {string} how @returns {Record<string, any> | null} */
function differing(how) {
  const { set } = course.look;
  const now = (/** @type {string} */ key) => set[key] ?? at(scene, key);
  if (how === "counter") {
    const key = ["spacetime.spin", "spacetime.parameters.spin"].find((key) => spun(key));
    return key ? { [key]: -Number(now(key) ?? SETTINGS.find((setting) => setting.key === key && setting.when?.(scene))?.usual) } : null;
  }
  // Where space is flat no orbit is the last stable one: the edge stays where it was.
  const edge = how === "flat" && now("disk.inner") === "isco" && isco ? { "disk.inner": round(isco, 5) } : {};
  return { ...BESIDE[how], ...edge };
}

/** Whether a key is the spin of this spacetime. @param {string} key */
const spun = (key) => SETTINGS.some((setting) => setting.key === key && setting.when?.(scene));

/** @param {import("./link.js").Wish} wished */
function compare(wished) {
  const { set } = course.look;
  const how = BESIDE[set["page.compare"]];
  const [beside, split, wrong] = ["beside", "split", "other-faults"].map((id) => element(id, HTMLElement));
  beside.hidden = split.hidden = !how;
  const choices = SETTINGS.find(({ key }) => key === "page.compare")?.choices ?? [];
  element("beside-name", HTMLElement).textContent = choices.find(([choice]) => choice === set["page.compare"])?.[1] ?? "";
  if (!how) {
    other?.close();
    other = null;
    wrong.hidden = true;
    return;
  }
  const ignored = () => {};
  other ??= new Picture(element("other", HTMLCanvasElement), element("other-lines", HTMLCanvasElement), {
    frame: ignored, open: ignored, file: ignored,
    notice: (kind, content) => {
      // What was seen before is not of this scene.
      if (other) other.canvas.hidden = kind === "faults";
      if (kind === "faults") complain(content.faults, wrong);
      else if (kind === "facts") wrong.hidden = true;
    },
  });
  // Facts that are not there yet come, and with them this is asked again.
  if (!scene) return;
  const changes = differing(set["page.compare"]);
  other.canvas.hidden = !changes;
  if (!changes) {
    complain([{ place: "", message: "nothing turns in this spacetime", help: "" }], wrong);
    return;
  }
  other.ask({ ...wished, set: keys(prune({ ...set, ...changes })) });
}

/** Closes what a ray is shown in. */
function leave() {
  if (ray.hidden) return;
  ray.hidden = true;
  canvas.focus({ preventScroll: true });
}

const slider = element("slider", HTMLInputElement);
const slide = () => (element("beside", HTMLElement).style.clipPath = `inset(0 0 0 ${slider.value}%)`);
slider.oninput = slide;
slide();

/** Those settings that are the page's, or those that are not. @param {Record<string, any>} set @param {boolean} page */
const own = (set, page) => Object.fromEntries(Object.entries(set).filter(([key]) => key.startsWith("page.") === page));

/** After a change is complete: kept, and in the address. */
function settle() {
  course.keep();
  const text = written(course.look);
  if (location.hash.replace(/^#/, "") !== text) history.replaceState(null, "", text ? `#${text}` : location.pathname);
  undo.disabled = course.before.length === 0;
  redo.disabled = course.after.length === 0;
  const { base, set } = course.look;
  const known = PRESETS.findIndex((one) => written(one) === written({ base, set: own(set, false) }));
  preset.value = known < 0 ? "own" : String(known);
  ask(false);
}

/** Sets a key, or leaves it to the base. @param {string} key @param {any} value */
function put(key, value) {
  const { set } = course.look;
  if (value === undefined) {
    // The base may say something: then nothing has to be said aloud.
    if (course.look.base !== "built-in" && scene && at(scene, key) !== undefined && !(key in set)) set[key] = null;
    else delete set[key];
  } else {
    set[key] = value;
  }
  if (key.startsWith("page.") && value === false) delete set[key];
  if (key === "spacetime.name") {
    for (const other of Object.keys(set)) if (other.startsWith("spacetime.parameters.")) delete set[other];
    if (DISKLESS.includes(value)) set["disk.model"] = "none";
    else if (set["disk.model"] === "none") delete set["disk.model"];
  }
  if (key === "screen.kind") {
    delete set["screen.field_of_view"];
    if (value !== "impact" && set["observer.distance"] === "inf") delete set["observer.distance"];
  }
  course.look.set = prune(set);
}

const panel = new Panel(element("settings", HTMLFormElement), (key, value, moving) => {
  if (key.startsWith("observer.") && place && scene && at(scene, "observer.position")) stand();
  put(key, value);
  if (key.startsWith("page.")) display();
  if (moving) ask(true);
  else settle();
});

/** Says where the observer is by distance and angles, if it was said by a position. */
function stand() {
  if (!place) return;
  const { set } = course.look;
  if (scene && at(scene, "observer.position")) {
    set["observer.distance"] ??= Number.isFinite(place.distance) ? round(place.distance, 6) : "inf";
    set["observer.inclination"] ??= round(place.inclination, 6);
    set["observer.azimuth"] ??= round(place.azimuth, 6);
  }
}

/** @param {number} value @param {number} digits */
const round = (value, digits) => Number(value.toPrecision(digits));

hands(canvas, {
  move: ({ around = 0, over = 0, nearer = 1, roll = 0 }) => {
    if (!scene) return;
    stand();
    const { set } = course.look;
    const now = (/** @type {string} */ key, /** @type {number} */ usual) => Number(set[key] ?? at(scene, key) ?? usual);
    if (around !== 0 || over !== 0) {
      // Dragged in the picture's own directions, however it is rolled.
      const angle = (now("screen.roll", 0) * Math.PI) / 180;
      const [x, y] = [around * Math.cos(angle) + over * Math.sin(angle), over * Math.cos(angle) - around * Math.sin(angle)];
      const azimuth = now("observer.azimuth", 0) + x;
      set["observer.azimuth"] = round(azimuth - 360 * Math.round(azimuth / 360), 6);
      set["observer.inclination"] = round(Math.min(180, Math.max(0, now("observer.inclination", 90) + y)), 6);
    }
    if (nearer !== 1) {
      const far = set["observer.distance"] ?? at(scene, "observer.distance");
      if (far === "inf" || at(scene, "screen.kind") === "impact") {
        set["screen.field_of_view"] = round(Math.min(1000, Math.max(0.01, now("screen.field_of_view", 20) / nearer)), 5);
      } else {
        set["observer.distance"] = round(Math.min(1e5, Math.max(0.3, now("observer.distance", 30) / nearer)), 5);
      }
    }
    if (roll !== 0) {
      const rolled = now("screen.roll", 0) + roll;
      set["screen.roll"] = round(rolled - 360 * Math.round(rolled / 360), 6);
    }
    ask(true);
  },
  rest: settle,
  point: (x, y) => picture.link.send({ kind: "inspect", view: { ...wish(false), generation: 0, overlays: [] }, at: [x, y] }),
});

PRESETS.forEach(({ name }, number) => preset.append(make("option", { value: String(number), textContent: name })));
preset.append(make("option", { value: "own", textContent: "Your own", hidden: true }));
preset.onchange = () => {
  const chosen = PRESETS[Number(preset.value)];
  if (!chosen) return;
  course.look = { base: chosen.base, set: { ...chosen.set, ...own(course.look.set, true) } };
  // What the scene before said counts no more.
  scene = null;
  settle();
};

/** @param {boolean} back */
function step(back) {
  if (back ? course.undo() : course.redo()) {
    const focused = document.activeElement;
    scene = null;
    settle();
    // A button that can be pressed no more keeps no focus.
    if (focused instanceof HTMLButtonElement && focused.disabled) canvas.focus({ preventScroll: true });
  }
}
undo.onclick = () => step(true);
redo.onclick = () => step(false);

element("save", HTMLButtonElement).onclick = () => saver.open();

const observation = new Observation(element("observer", HTMLDialogElement), (set) => {
  course.look = { base: "built-in", set: { ...set, ...own(course.look.set, true) } };
  scene = null;
  settle();
});
element("observe", HTMLButtonElement).onclick = () => observation.open();
document.addEventListener("dragover", (event) => {
  event.preventDefault();
  document.body.classList.add("dropping");
});
document.addEventListener("dragleave", (event) => event.relatedTarget ?? document.body.classList.remove("dropping"));
document.addEventListener("drop", (event) => {
  event.preventDefault();
  document.body.classList.remove("dropping");
  const file = event.dataTransfer?.files[0];
  if (file) observation.open(file);
});

element("share", HTMLButtonElement).onclick = async () => {
  try {
    await navigator.clipboard.writeText(location.href);
    line.textContent = "The address is copied";
  } catch {
    line.textContent = "Copy the address from the browser: it is this picture's";
  }
};

const theme = (/** @type {string} */ name) => {
  document.documentElement.dataset.theme = name;
};
theme(localStorage.getItem("theme") ?? (matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark"));
element("theme", HTMLButtonElement).onclick = () => {
  const other = document.documentElement.dataset.theme === "light" ? "dark" : "light";
  localStorage.setItem("theme", other);
  theme(other);
};

search.oninput = () => panel.search(search.value);
document.addEventListener("keydown", (event) => {
  const { target } = event;
  const typing = target instanceof HTMLSelectElement || (target instanceof HTMLInputElement && target.type !== "range" && target.type !== "checkbox");
  if (typing || event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
  if (event.key === "/") {
    event.preventDefault();
    search.focus();
  } else if (event.key === "Escape") {
    leave();
  } else if (event.key.toLowerCase() === "s") {
    saver.open();
  } else if (event.key.toLowerCase() === "u") {
    step(!event.shiftKey);
  }
});

window.addEventListener("hashchange", () => {
  const look = read(location.hash);
  if (written(look) === written(course.look)) return;
  course.look = look;
  scene = null;
  settle();
});

/** @type {ReturnType<typeof setTimeout> | undefined} */
let resized;
new ResizeObserver(() => {
  clearTimeout(resized);
  resized = setTimeout(() => {
    if (picture.link.wish && String(picture.link.wish.size) !== String(size())) ask(false);
  }, 120);
}).observe(stage);

settle();
