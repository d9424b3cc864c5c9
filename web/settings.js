// What can be set, how it is shown, and where it has a meaning.

/**
 * A scene as the server knows it, with every default.
 * @typedef {Record<string, any>} Scene
 *
 * @typedef {object} Setting
 * @property {string} key      Key of the scene.
 * @property {string} label    What it is called.
 * @property {string} group    Under which heading it stands.
 * @property {"range" | "choice" | "toggle" | "text"} kind
 * @property {number} [min]
 * @property {number} [max]
 * @property {number} [step]
 * @property {boolean} [log]   Whether the slider goes by factors.
 * @property {string} [unit]
 * @property {[any, string][]} [choices]  Values and their names.
 * @property {any} [usual]     The value where the scene says none.
 * @property {string} [words]  Other words by which it is found.
 * @property {(scene: Scene) => boolean} [when]  Whether it has a meaning in a scene.
 */

/** @param {Scene} scene @param {string} key @returns {any} */
export function at(scene, key) {
  return key.split(".").reduce((table, name) => (table === undefined || table === null ? undefined : table[name]), scene);
}

/** @param {string} key @param {...any} values @returns {(scene: Scene) => boolean} */
const is = (key, ...values) => (scene) => values.includes(at(scene, key));
/** @param {...((scene: Scene) => boolean)} all @returns {(scene: Scene) => boolean} */
const both = (...all) => (scene) => all.every((one) => one(scene));
/** @param {(scene: Scene) => boolean} one @returns {(scene: Scene) => boolean} */
const not = (one) => (scene) => !one(scene);

const disk = not(is("disk.model", "none"));
const shines = is("disk.model", "page-thorne", "power-law", "profile");
const local = not(is("screen.kind", "impact"));
const named = (/** @type {string[]} */ ...names) => is("spacetime.name", ...names);

/** Spacetimes by the names of the program, and what they are called. @type {[string, string][]} */
const SPACETIMES = [
  ["kerr", "Kerr: turns"],
  ["schwarzschild", "Schwarzschild: does not turn"],
  ["minkowski", "Minkowski: flat"],
  ["reissner-nordstrom", "Reissner–Nordström: charged"],
  ["kerr-newman", "Kerr–Newman: turns, charged"],
  ["johannsen", "Johannsen: deformed Kerr"],
  ["ellis", "Ellis's wormhole"],
  ["morris-thorne", "Morris–Thorne wormhole"],
  ["majumdar-papapetrou", "Two charged holes at rest"],
  ["two-kerr", "Two Kerr holes, roughly"],
  ["schwarzschild-de-sitter", "Schwarzschild–de Sitter"],
];

/** Spacetimes in which no matter orbits as a disk's would. */
export const DISKLESS = ["ellis", "morris-thorne", "majumdar-papapetrou", "two-kerr", "schwarzschild-de-sitter"];

/**
 * A number of a metric known as text.
 * @param {string} name @param {string} label @param {number} min @param {number} max @param {Record<string, number>} usual
 * @returns {Setting[]}
 */
function parameter(name, label, min, max, usual) {
  return Object.entries(usual).map(([metric, value]) => ({
    key: `spacetime.parameters.${name}`, label, group: "Spacetime", kind: "range", min, max, step: 0.001, usual: value,
    when: named(metric),
  }));
}

/** @type {Setting[]} */
export const SETTINGS = [
  { key: "spacetime.name", label: "Spacetime", group: "Spacetime", kind: "choice", choices: SPACETIMES, words: "metric" },
  {
    key: "spacetime.spin", label: "Spin a", group: "Spacetime", kind: "range", min: -1, max: 1, step: 0.001,
    when: named("kerr"), words: "rotation angular momentum",
  },
  ...parameter("charge", "Charge", 0, 1, { "reissner-nordstrom": 0.8, "kerr-newman": 0.5 }),
  ...parameter("spin", "Spin", 0, 0.998, { "kerr-newman": 0.5, johannsen: 0.5 }),
  ...parameter("a13", "α₁₃", -2, 3, { johannsen: 0 }),
  ...parameter("a22", "α₂₂", -2, 3, { johannsen: 0 }),
  ...parameter("a52", "α₅₂", -2, 3, { johannsen: 0 }),
  ...parameter("e3", "ε₃", -2, 3, { johannsen: 0 }),
  ...parameter("size", "Size", 0.1, 5, { ellis: 1, "morris-thorne": 1 }),
  ...parameter("separation", "Separation", 1, 20, { "majumdar-papapetrou": 4, "two-kerr": 10 }),
  ...parameter("lambda", "Λ", 0, 0.02, { "schwarzschild-de-sitter": 0.001 }),

  {
    key: "observer.distance", label: "Distance", group: "Observer", kind: "range", min: 1.1, max: 1000, step: 0.01, log: true,
    unit: "M", words: "zoom radius",
  },
  {
    key: "observer.inclination", label: "Inclination", group: "Observer", kind: "range", min: 0, max: 180, step: 0.1, unit: "°",
    words: "angle tilt view",
  },
  { key: "observer.azimuth", label: "Azimuth", group: "Observer", kind: "range", min: -180, max: 180, step: 0.1, unit: "°" },
  {
    key: "observer.motion", label: "Motion", group: "Observer", kind: "choice", when: local, words: "velocity falling orbiting",
    choices: [
      ["static", "at rest"], ["zamo", "carried around (ZAMO)"], ["orbit", "orbiting"], ["fall", "falling in"],
    ],
  },
  {
    key: "screen.kind", label: "Screen", group: "Observer", kind: "choice", words: "camera projection",
    choices: [["pinhole", "camera"], ["angular", "equal angles"], ["impact", "impact parameters"]],
  },
  {
    key: "screen.field_of_view", label: "Field of view", group: "Observer", kind: "range", min: 1, max: 170, step: 0.1, unit: "°",
    when: local, words: "zoom angle",
  },
  {
    key: "screen.field_of_view", label: "Field of view", group: "Observer", kind: "range", min: 1, max: 200, step: 0.1, unit: "M",
    log: true, when: not(local), words: "zoom size",
  },
  { key: "screen.roll", label: "Roll", group: "Observer", kind: "range", min: -180, max: 180, step: 0.1, unit: "°" },

  {
    key: "disk.model", label: "Disk", group: "Disk", kind: "choice", words: "ring accretion emission",
    choices: [
      ["none", "none"], ["ring", "orange ring, drawn"], ["page-thorne", "Page–Thorne, physical"],
      ["power-law", "power law"],
    ],
  },
  { key: "disk.inner", label: "Inner edge", group: "Disk", kind: "text", unit: "M or isco", when: disk, words: "radius isco" },
  {
    key: "disk.outer", label: "Outer edge", group: "Disk", kind: "range", min: 2, max: 200, step: 0.1, log: true, unit: "M",
    when: disk, words: "size radius",
  },
  { key: "disk.doppler", label: "Doppler shift", group: "Disk", kind: "toggle", when: disk, words: "redshift motion" },
  {
    key: "disk.gravitational", label: "Gravitational shift", group: "Disk", kind: "toggle", when: disk, words: "redshift gravity",
  },
  { key: "disk.beaming", label: "Beaming, by these shifts", group: "Disk", kind: "toggle", when: disk, words: "brightness shift" },
  {
    key: "disk.orders", label: "Image orders", group: "Disk", kind: "choice", when: disk, words: "photon ring",
    choices: [[undefined, "all"], [[0], "0: direct"], [[1], "1: once around"], [[2], "2"], [[1, 2, 3, 4, 5, 6, 7], "1 and more"]],
  },
  {
    key: "disk.turns", label: "Turns", group: "Disk", kind: "choice", when: disk, words: "direction",
    choices: [["prograde", "prograde"], ["retrograde", "retrograde"]],
  },
  {
    key: "disk.light", label: "Light", group: "Disk", kind: "choice", when: shines, words: "colour spectrum",
    choices: [["bolometric", "bolometric"], ["blackbody", "black body"]],
  },
  {
    key: "disk.temperature", label: "Temperature", group: "Disk", kind: "range", min: 1000, max: 40000, step: 10, log: true,
    unit: "K", usual: 10000, when: both(shines, is("disk.light", "blackbody")),
  },
  {
    key: "disk.limb", label: "Limb", group: "Disk", kind: "choice", when: shines, words: "darkening",
    choices: [["isotropic", "isotropic"], ["electron-scattering", "electron scattering"]],
  },
  {
    key: "disk.index", label: "Index", group: "Disk", kind: "range", min: 0, max: 6, step: 0.05, usual: 3,
    when: is("disk.model", "power-law"),
  },
  { key: "disk.brightness", label: "Brightness", group: "Disk", kind: "range", min: 0.01, max: 100, step: 0.01, log: true, when: disk },
  { key: "disk.opacity", label: "Opacity", group: "Disk", kind: "range", min: 0, max: 1, step: 0.01, when: disk },
  { key: "disk.optically_thin", label: "Optically thin", group: "Disk", kind: "toggle", when: disk },
  { key: "disk.tilt", label: "Tilt", group: "Disk", kind: "range", min: 0, max: 90, step: 0.1, unit: "°", when: both(disk, not(shines)) },

  {
    key: "sky.kind", label: "Sky", group: "Sky", kind: "choice", words: "background stars grid milky way",
    choices: [
      ["stars", "stars, Milky Way"], ["grid", "grid"], ["black", "black"], ["uniform", "uniform"], ["gradient", "gradient"],
    ],
  },
  {
    key: "sky.brightness", label: "Sky brightness", group: "Sky", kind: "range", min: 0.01, max: 100, step: 0.01, log: true, usual: 1,
    when: not(is("sky.kind", "black")),
  },
  {
    key: "sky.spacing", label: "Lines every", group: "Sky", kind: "choice", usual: 15, when: is("sky.kind", "grid"),
    choices: [[5, "5°"], [10, "10°"], [15, "15°"], [30, "30°"]],
  },
  { key: "sky.longitude", label: "Turned by", group: "Sky", kind: "range", min: -180, max: 180, step: 1, unit: "°", when: is("sky.kind", "stars") },

  {
    key: "camera.display.layer", label: "Shown", group: "Picture", kind: "choice", words: "layer data false colours redshift",
    choices: [
      [undefined, "light"], ["g", "shift g"], ["r", "radius on the disk"], ["phi", "azimuth on the disk"], ["t", "elapsed time"],
      ["crossings", "crossings"], ["windings", "windings"], ["fate", "fate"], ["sky_theta", "θ on the sky"],
      ["sky_phi", "φ on the sky"], ["steps", "steps"], ["error", "error estimate"],
    ],
  },
  {
    key: "camera.display.order", label: "Of image order", group: "Picture", kind: "choice", usual: 0,
    when: is("camera.display.layer", "g", "r", "phi", "t"), choices: [[0, "0"], [1, "1"], [2, "2"]],
  },
  {
    key: "camera.display.colormap", label: "Colours", group: "Picture", kind: "choice", words: "colormap palette",
    when: (scene) => at(scene, "camera.display.layer") !== undefined && at(scene, "camera.display.layer") !== "fate",
    choices: [
      [undefined, "what suits"], ["viridis", "viridis"], ["magma", "magma"], ["inferno", "inferno"], ["plasma", "plasma"],
      ["cividis", "cividis"], ["grey", "grey"], ["hue", "hue"],
    ],
  },
  { key: "camera.display.exposure", label: "Exposure", group: "Picture", kind: "range", min: -8, max: 12, step: 0.05, unit: "stops" },
  {
    key: "camera.display.tone", label: "Tone curve", group: "Picture", kind: "choice",
    choices: [["neutral", "neutral"], ["filmic", "filmic"], ["none", "none"]],
  },

  {
    key: "page.samples", label: "Rays a pixel", group: "Picture", kind: "choice", usual: 4, words: "samples quality antialiasing",
    choices: [[1, "1"], [4, "4"], [9, "9"], [16, "16"], [64, "64"]],
  },

  { key: "page.critical", label: "Edge of the shadow", group: "Lines", kind: "toggle", words: "critical curve overlay" },
  { key: "page.orders", label: "Between image orders", group: "Lines", kind: "toggle", words: "overlay boundaries" },
  { key: "page.equator", label: "Grid on the equator", group: "Lines", kind: "toggle", words: "overlay plane radius" },
  { key: "page.shift", label: "Equal shifts g", group: "Lines", kind: "toggle", words: "overlay redshift contours" },
  {
    key: "page.compare", label: "Beside it", group: "Compare", kind: "choice", words: "slider two scenes",
    choices: [
      [undefined, "nothing"], ["no-spin", "no spin"], ["fast", "spin 0.99"], ["counter", "the opposite spin"], ["flat", "flat space"],
      ["no-shift", "no shift of light"], ["shift", "all shifts of light"],
    ],
  },

  { key: "units.mass", label: "Mass", group: "On the sky", kind: "text", unit: "suns", words: "µas shadow size" },
  { key: "units.distance", label: "Its distance", group: "On the sky", kind: "text", unit: "pc", words: "µas parsec" },
];

/** What is shown beside a picture: keys that differ. @type {Record<string, Record<string, any>>} */
export const BESIDE = {
  "no-spin": { "spacetime.name": "kerr", "spacetime.spin": 0 },
  fast: { "spacetime.name": "kerr", "spacetime.spin": 0.99 },
  counter: {},
  flat: { "spacetime.name": "minkowski" },
  "no-shift": { "disk.doppler": false, "disk.gravitational": false, "disk.beaming": false },
  shift: { "disk.doppler": true, "disk.gravitational": true, "disk.beaming": true },
};

/** Lines over a picture, by the ends of their keys. */
export const LINES = ["critical", "orders", "equator", "shift"];

/**
 * A picture to begin with.
 * @typedef {object} Preset
 * @property {string} name
 * @property {string} base
 * @property {Record<string, any>} set
 */

/** @type {Preset[]} */
export const PRESETS = [
  { name: "The scene given", base: "", set: {} },
  {
    name: "As in a film", base: "built-in",
    set: { "spacetime.spin": 0.6, "observer.distance": 34, "observer.inclination": 84, "screen.field_of_view": 46, "disk.outer": 14, "camera.display.exposure": 0.5 },
  },
  {
    name: "M87* at 17°", base: "built-in",
    set: {
      "spacetime.spin": 0.9, "observer.distance": "inf", "observer.inclination": 163, "screen.kind": "impact",
      "screen.field_of_view": 28, "screen.roll": -108, "disk.model": "power-law", "disk.inner": "isco", "disk.outer": 30, "disk.index": 4,
      "disk.optically_thin": true,
      "sky.kind": "black", "camera.display.exposure": 3, "units.mass": 6.5e9, "units.distance": 16.8e6,
    },
  },
  { name: "Schwarzschild", base: "built-in", set: { "spacetime.spin": 0, "observer.inclination": 75 } },
  { name: "Edge-on", base: "built-in", set: { "observer.inclination": 89.5, "spacetime.spin": 0.9 } },
  {
    name: "Extreme spin", base: "built-in",
    set: {
      "spacetime.spin": 0.999, "disk.model": "power-law", "disk.index": 1.5, "disk.light": "blackbody", "disk.temperature": 6500,
      "disk.outer": 18, "observer.inclination": 72, "camera.display.tone": "filmic", "camera.display.exposure": 2,
    },
  },
  {
    name: "Inside the photon shell", base: "built-in",
    set: { "observer.distance": 2.4, "observer.inclination": 90, "observer.motion": "zamo", "screen.kind": "angular", "screen.field_of_view": 150, "disk.model": "none", "sky.brightness": 2 },
  },
  { name: "A wormhole", base: "wormhole", set: {} },
  { name: "Two holes", base: "two-holes", set: {} },
  { name: "Johannsen, deformed", base: "built-in", set: { "spacetime.name": "johannsen", "spacetime.parameters.a13": 1.5, "disk.model": "ring", "disk.inner": 6 } },
  { name: "A disk by physics", base: "gallery/disk", set: {} },
  { name: "Thesis, figure 3.2", base: "thesis-3.2", set: {} },
  { name: "Thesis, figure 4.2", base: "thesis-4.2", set: {} },
  { name: "Thesis, figure 4.3", base: "thesis-4.3", set: {} },
  { name: "Thesis, figure 4.5", base: "thesis-4.5", set: {} },
  { name: "Thesis, figure 4.6", base: "thesis-4.6", set: {} },
  { name: "Thesis, figure 4.8", base: "thesis-4.8", set: {} },
  { name: "Thesis, figure 4.8, with physics", base: "thesis-4.8-physics", set: {} },
  { name: "Thesis, figure 5.1 a", base: "thesis-5.1a", set: {} },
  { name: "Thesis, figure 5.1 b", base: "thesis-5.1b", set: {} },
  { name: "The Earth behind a hole", base: "earth", set: {} },
  { name: "Balls", base: "balls", set: {} },
  { name: "A room", base: "room", set: {} },
  { name: "A well of light", base: "well", set: {} },
];
