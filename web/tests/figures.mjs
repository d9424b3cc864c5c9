// How fast the page is: figures.mjs ADDRESS. Prints a report; `cargo xtask campaign page` keeps it. Ends with 1 if it is too slow.

import fs from "node:fs";
import path from "node:path";
import { chromium } from "playwright-core";

const [address] = process.argv.slice(2);
const folders = (process.env.PATH ?? "").split(path.delimiter);
const executablePath = ["chromium", "chromium-browser", "google-chrome"]
  .flatMap((name) => folders.map((folder) => path.join(folder, name)))
  .find((file) => fs.existsSync(file));
const args = ["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-dev-shm-usage"];
const browser = await chromium.launch({ executablePath, args });

/** How often everything is measured; medians count. */
const TIMES = 7;

const median = (numbers) => [...numbers].sort((a, b) => a - b)[Math.floor(numbers.length / 2)];
const all = (numbers, digits) => numbers.map((number) => number.toFixed(digits)).join(", ");
let passed = true;
const check = (good) => {
  passed &&= good;
  return good ? "yes" : "NO";
};

/** A page whose picture has a size. */
async function opened(width, height) {
  const context = await browser.newContext({ viewport: { width: width + 340, height: height + 49 }, colorScheme: "dark" });
  const page = await context.newPage();
  await page.goto(address);
  await still(page);
  const box = await page.locator("#picture").boundingBox();
  if (Math.round(box.width) !== width || Math.round(box.height) !== height) {
    throw new Error(`the picture has ${box.width} × ${box.height} pixels instead of ${width} × ${height}`);
  }
  return { page, box };
}

async function still(page) {
  await page.waitForTimeout(400);
  await page.waitForFunction(() => document.querySelector("#picture").dataset.last === "true" && window.kerrscope.lastTime >= window.kerrscope.asked, null, { timeout: 60000 });
}

/** Drags across the picture for some 1.5 s, and gives frames a second and the time to full quality afterwards. */
async function dragged({ page, box }) {
  const before = await page.evaluate(() => window.kerrscope.moving);
  const at = (x, y) => [box.x + x * box.width, box.y + y * box.height];
  await page.mouse.move(...at(0.4, 0.5));
  await page.mouse.down();
  const begin = performance.now();
  for (let step = 1; step <= 120; step += 1) {
    await page.mouse.move(...at(0.4 + 0.001 * step, 0.5 - 0.0007 * step));
    await page.waitForTimeout(10);
  }
  const seconds = (performance.now() - begin) / 1000;
  const frames = (await page.evaluate(() => window.kerrscope.moving)) - before;
  await page.mouse.up();
  await still(page);
  return [frames / seconds, await page.evaluate(() => window.kerrscope.lastTime - window.kerrscope.asked)];
}

const first = [];
let small;
for (let k = 0; k < TIMES; k += 1) {
  await small?.page.context().close();
  small = await opened(640, 360);
  first.push(await small.page.evaluate(() => window.kerrscope.firstFrame - window.kerrscope.opened));
}
const rates = [];
for (let k = 0; k < TIMES; k += 1) rates.push((await dragged(small))[0]);
await small.page.context().close();
const large = await opened(1280, 720);
const status = await large.page.textContent("#status");
const stops = [];
for (let k = 0; k < TIMES; k += 1) stops.push((await dragged(large))[1]);
await browser.close();

console.log(`The built-in scene (closed form, disk and sky) in ${await browser.version()}, which shares the processor with the server; medians of ${TIMES}, and all.\n`);
console.log(`- first frame ${median(first).toFixed(0)} ms after the socket opened (${all(first, 0)}); at most 150: ${check(median(first) <= 150)}`);
console.log(`- ${median(rates).toFixed(1)} frames a second while dragging at 640 × 360 (${all(rates, 1)}); at least 20: ${check(median(rates) >= 20)}`);
console.log(`- full quality at 1280 × 720, ${/(\d+) rays? a pixel/.exec(status)?.[0]}, ${median(stops).toFixed(0)} ms after stopping (${all(stops, 0)}); at most 1000: ${check(median(stops) <= 1000)}`);
process.exit(passed ? 0 : 1);
