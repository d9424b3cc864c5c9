// The page in a browser: page.mjs ADDRESS FOLDER BROWSER PROGRAM. Ends with 1 at the first thing that is not as it should be.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import { chromium } from "playwright-core";

const [address, folder, executablePath, program] = process.argv.slice(2);
const args = ["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-dev-shm-usage"];
const browser = await chromium.launch({ executablePath, args });
const context = await browser.newContext({ viewport: { width: 980, height: 409 }, acceptDownloads: true, colorScheme: "dark" });
const page = await context.newPage();
const wrong = [];
const foreign = [];
page.on("pageerror", (error) => wrong.push(error.message));
page.on("console", (message) => message.type() === "error" && wrong.push(message.text()));
page.on("request", (request) => request.url().startsWith(new URL(address).origin) || foreign.push(request.url()));

/** Waits until the picture asked for last is whole, and no fault is shown. */
async function still() {
  await page.waitForTimeout(250);
  await page.waitForFunction(() => document.querySelector("#picture").dataset.last === "true" && window.kerrscope.lastTime >= window.kerrscope.asked, null, { timeout: 60000 });
  assert.equal(await page.isVisible("#faults"), false, await page.textContent("#faults"));
}

/** A blurred ring of 12 pixels across, brighter on one side, with noise of 3 % of the brightest: 28 × 28 pixels, the lowest row first. */
function ring() {
  const steps = Array.from({ length: 180 }, (_, k) => (2 * Math.PI * k) / 180);
  const clean = Array.from({ length: 28 * 28 }, (_, k) => {
    const [x, y] = [(k % 28) - 13.5, Math.floor(k / 28) - 13.5];
    return steps.reduce((sum, angle) => {
      const [dx, dy] = [x - 6 * Math.cos(angle), y - 6 * Math.sin(angle)];
      return sum + (1 + 0.4 * Math.cos(angle - 2)) * Math.exp(-(dx * dx + dy * dy) / 8);
    }, 0);
  });
  const brightest = Math.max(...clean);
  let state = 1;
  const chance = () => ((state = (Math.imul(state, 1664525) + 1013904223) >>> 0) + 0.5) / 2 ** 32;
  const normal = () => Math.sqrt(-2 * Math.log(chance())) * Math.cos(2 * Math.PI * chance());
  return clean.map((value) => value + 0.03 * brightest * normal());
}

/** A FITS file of a square picture. @param {number} size @param {number[]} values */
function fits(size, values) {
  const keys = { SIMPLE: "T", BITPIX: "-64", NAXIS: "2", NAXIS1: `${size}`, NAXIS2: `${size}` };
  const cards = [...Object.entries(keys).map(([key, value]) => `${key.padEnd(8)}= ${value.padStart(20)}`), "END"];
  const data = Buffer.alloc(Math.ceil((8 * values.length) / 2880) * 2880);
  values.forEach((value, k) => data.writeDoubleBE(value, 8 * k));
  return Buffer.concat([Buffer.from(cards.map((card) => card.padEnd(80)).join("").padEnd(2880)), data]);
}

/** The picture's bytes. */
const pixels = () => page.evaluate(() => document.querySelector("#picture").toDataURL());
const hash = () => page.evaluate(() => decodeURIComponent(location.hash));

// Opened: the canvas stands in the served page, and a first frame comes soon.
const served = await (await page.request.get(address)).text();
assert.match(served, /<canvas[^>]*>/);
await page.goto(address);
await still();
const opening = await page.evaluate(() => window.kerrscope.firstFrame - window.kerrscope.opened);
console.log(`first frame ${opening.toFixed(0)} ms after the socket opened`);
assert.ok((await page.textContent("#readouts")).includes("1.454 M"), "the innermost stable orbit of a = 0.99");
const first = await pixels();
await page.screenshot({ path: path.join(folder, "desktop.png") });

// Dragged: the picture follows, and the address says where to.
const box = await page.locator("#picture").boundingBox();
const at = (x, y) => [box.x + x * box.width, box.y + y * box.height];
const before = await page.evaluate(() => window.kerrscope.moving);
await page.mouse.move(...at(0.4, 0.5));
await page.mouse.down();
const begin = Date.now();
for (let step = 1; step <= 150; step += 1) {
  await page.mouse.move(...at(0.4 + 0.001 * step, 0.5 - 0.0007 * step));
  await page.waitForTimeout(10);
}
const seconds = (Date.now() - begin) / 1000;
const frames = (await page.evaluate(() => window.kerrscope.moving)) - before;
console.log(`${(frames / seconds).toFixed(1)} frames a second while dragging at ${Math.round(box.width)} × ${Math.round(box.height)}`);
assert.ok(frames >= 3, "it moves");
await page.mouse.up();
await still();
console.log(`full quality ${(await page.evaluate(() => window.kerrscope.lastTime - window.kerrscope.asked)).toFixed(0)} ms after stopping`);
assert.match(await hash(), /observer\.azimuth=-?\d/);
const dragged = await pixels();
assert.notEqual(dragged, first);

// Undone, and done again.
await page.click("#undo");
await still();
assert.equal(await pixels(), first, "undone it is the picture that was");
await page.click("#redo");
await still();
assert.equal(await pixels(), dragged);

// A link is a picture.
const link = await page.evaluate(() => location.href);
const second = await context.newPage();
await second.setViewportSize({ width: 980, height: 409 });
await second.goto(link);
await second.waitForFunction(() => document.querySelector("#picture").dataset.last === "true" && window.kerrscope.lastTime >= window.kerrscope.asked, null, { timeout: 60000 });
await second.waitForTimeout(400);
assert.equal(await second.evaluate(() => document.querySelector("#picture").toDataURL()), dragged, "the address round trip");
await second.close();

// Spin, by its field and by keys.
await page.fill("[data-key='spacetime.spin'] input[type=text]", "0.5");
await page.keyboard.press("Enter");
await page.locator("#picture").focus();
await still();
assert.match(await hash(), /spacetime\.spin=0\.5/);
assert.ok((await page.textContent("#readouts")).includes("4.233 M"), "the innermost stable orbit of a = 0.5");
await page.keyboard.press("ArrowLeft");
await still();
const inclined = await hash();
await page.keyboard.press("+");
await still();
assert.notEqual(await hash(), inclined);

// What is wrong is said, with its place and how to mend it, and what was seen stays.
await page.fill("[data-key='spacetime.spin'] input[type=text]", "1.5");
await page.keyboard.press("Enter");
await page.waitForSelector("#faults:not([hidden])");
const fault = await page.textContent("#faults");
assert.match(fault, /spacetime\.spin/);
assert.match(fault, /from -1 to 1/);
await page.click("#undo");
await page.locator("#picture").focus();
await still();

// Search.
await page.fill("#search", "doppler");
assert.equal(await page.locator(".setting:visible").count(), 1);
await page.fill("#search", "zebra");
assert.ok(await page.getByText("No setting is called that.").isVisible());
await page.fill("#search", "");

// A data layer has a scale; light has none.
await page.locator("[data-key='camera.display.layer'] select").selectOption({ index: 1 });
await page.waitForSelector("#key:not([hidden])");
await still();
assert.ok((await page.locator("#key .marks span").count()) >= 2, "marks along the colours");
await page.screenshot({ path: path.join(folder, "layer.png") });
await page.click("#undo");
await still();
assert.equal(await page.isVisible("#key"), false);

// Lines, and the picture beside it.
await page.getByLabel("Edge of the shadow", { exact: true }).check();
await still();
await page.waitForFunction(() => Number(document.querySelector("#lines").dataset.pieces) > 20);
await page.getByLabel("Edge of the shadow", { exact: true }).uncheck();
await page.selectOption("[data-key='page.compare'] select", { label: "flat space" });
await page.waitForFunction(() => document.querySelector("#other").dataset.last === "true", null, { timeout: 60000 });
await still();
assert.equal(await page.isVisible("#other-faults"), false);
await page.selectOption("[data-key='page.compare'] select", { label: "nothing" });

// Presets: each shows something without a fault.
const presets = await page.locator("#preset option:not([hidden])").allTextContents();
for (const name of presets.filter((name) => !/two holes|well|room|balls|earth|figure|wormhole/i.test(name))) {
  const frame = await page.evaluate(() => window.kerrscope.frames);
  await page.selectOption("#preset", { label: name });
  await page.waitForFunction((seen) => window.kerrscope.frames > seen, frame, { timeout: 60000 });
  assert.equal(await page.isVisible("#faults"), false, `${name}: ${await page.textContent("#faults")}`);
}
for (const name of presets.filter((name) => /two holes|well|room|balls|earth|figure|wormhole/i.test(name))) {
  // Slow ones: the first frame of each.
  const asked = await page.evaluate(() => window.kerrscope.frames);
  await page.selectOption("#preset", { label: name });
  await page.waitForFunction((seen) => window.kerrscope.frames > seen, asked, { timeout: 120000 });
  assert.equal(await page.isVisible("#faults"), false, `${name}: ${await page.textContent("#faults")}`);
}

// From one thing to another: keys of the base that lose their meaning are taken out with it.
const choose = (key, label) => page.locator(`[data-key='${key}']:not([hidden]) select`).selectOption({ label });
await page.selectOption("#preset", { label: "A disk by physics" });
await still();
for (const [key, label] of [
  ["disk.model", "orange ring, drawn"], ["disk.model", "none"], ["disk.model", "Page–Thorne, physical"],
  ["spacetime.name", "Kerr–Newman: turns, charged"], ["spacetime.name", "Ellis's wormhole"], ["spacetime.name", "Kerr: turns"],
]) {
  const seen = await page.evaluate(() => window.kerrscope.frames);
  await choose(key, label);
  await page.waitForFunction((before) => window.kerrscope.frames > before || !document.querySelector("#faults").hidden, seen, { timeout: 60000 });
  await page.waitForTimeout(100);
  assert.equal(await page.isVisible("#faults"), false, `${label}: ${await page.textContent("#faults")}`);
}

// A pixel's ray.
await page.selectOption("#preset", { label: "As in a film" });
await still();
await page.mouse.click(...at(0.5, 0.3));
await page.waitForSelector("#ray:not([hidden]) svg");
assert.match(await page.textContent("#ray"), /Crossings of the equatorial plane/);
await page.click("#ray button");

// Saved: bit for bit what `render` makes of the saved scene.
for (const format of ["toml", "png", "exr"]) {
  await page.click("#save");
  await page.selectOption("#save-format", format);
  await page.fill("#save-width", "160");
  await page.fill("#save-height", "90");
  await page.fill("#save-samples", "4");
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#saver [name=go]")]);
  await download.saveAs(path.join(folder, `saved.${format}`));
  await page.click("#saver [name=close]");
}
execFileSync(program, ["render", "saved.toml", "-o", "drawn.png", "-o", "drawn.exr"], { cwd: folder });
for (const format of ["png", "exr"]) {
  const [saved, drawn] = ["saved", "drawn"].map((name) => fs.readFileSync(path.join(folder, `${name}.${format}`)));
  assert.ok(saved.equals(drawn), `the saved ${format} is another than that of render`);
}

// An observation: measured and fitted, shown under its fit, and taken as a scene.
fs.writeFileSync(path.join(folder, "seen.fits"), fits(28, ring()));
await page.click("#observe");
await page.selectOption("#observed-model", "ring");
await page.setInputFiles("#observed-file", path.join(folder, "seen.fits"));
await page.waitForFunction(() => /^Converged/.test(document.querySelector("#observer output").textContent), null, { timeout: 180000 });
assert.equal(await page.locator(".pictures figure").count(), 2);
const [under, fit] = [".over canvas:not(.fit)", ".over .fit"].map((part) => page.locator(`[data-name=observed] ${part}`));
assert.deepEqual(await fit.boundingBox(), await under.boundingBox(), "the fit lies over the picture");
const covered = () => fit.evaluate((canvas) => getComputedStyle(canvas).clipPath);
assert.match(await covered(), /50%/);
await page.fill(".pictures input", "20");
assert.match(await covered(), /20%/);
assert.match(await page.textContent(".measured"), /28 × 28 pixels/);
assert.match(await page.textContent(".fitted"), /diameter/);
fs.writeFileSync(path.join(folder, "nothing.png"), "this is no picture");
await page.setInputFiles("#observed-file", path.join(folder, "nothing.png"));
await page.waitForFunction(() => !document.querySelector("#observer output").textContent.startsWith("Reading"), null, { timeout: 20000 });
assert.doesNotMatch(await page.textContent("#observer output"), /converged/i);
await page.click("#observer [name=close]");

// By keyboard alone every control is reached, and each has a name.
const unnamed = await page.evaluate(() => [...document.querySelectorAll("button, input, select, canvas")].filter((part) => {
  if (part.closest("[aria-hidden=true]") || part.getAttribute("aria-hidden") === "true") return false;
  return !(part.getAttribute("aria-label") || part.labels?.length || part.textContent.trim() || part.title);
}).map((part) => part.outerHTML));
assert.deepEqual(unnamed, []);

// A phone: nothing sticks out sideways.
await page.setViewportSize({ width: 390, height: 844 });
await still();
assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), "wider than the phone");
await page.screenshot({ path: path.join(folder, "phone.png") });

// Dark and light.
const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
const dark = await ground();
await page.click("#theme");
assert.notEqual(await ground(), dark);

assert.deepEqual(foreign, [], "something was fetched from elsewhere");
assert.deepEqual(wrong, []);
await browser.close();
console.log("the page does what it shall");
