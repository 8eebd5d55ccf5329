// SPDX-License-Identifier: MIT
// One browser for all tests, pages from files, screenshots as pixels.
import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";
import { pageOf } from "./fixture.mjs";
import { decodePng } from "./png.mjs";

export const ROOT = fileURLToPath(new URL("../../", import.meta.url));
const { chromium } = createRequire(join(ROOT, "viewer/package.json"))("playwright-core");

export const VIEWER = readFileSync(resolve(process.env.VIEWER_HTML), "utf8");
const SHOTS = resolve(process.env.VIEWER_SCREENSHOTS ?? join(ROOT, "build/viewer-screenshots"));
mkdirSync(SHOTS, { recursive: true });

const folder = mkdtempSync(join(tmpdir(), "viewer-"));
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", ...(process.getuid?.() === 0 ? ["--no-sandbox"] : [])],
});
after(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

let files = 0;

/** A page of runs as a file; its address. */
export function fileOf(runs) {
  const file = join(folder, `${++files}.html`);
  writeFileSync(file, pageOf(VIEWER, runs));
  return pathToFileURL(file).href;
}

/** Opens an address; whatever the page complains of is in `complaints`. */
export async function open(address, { width = 1200, height = 720, colorScheme = "dark" } = {}) {
  const page = await browser.newPage({ viewport: { width, height }, colorScheme });
  const complaints = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("request", (request) => !/^(file|data|blob):/.test(request.url()) && address.startsWith("file:") && complaints.push(`asked for ${request.url()}`));
  await page.goto(address);
  return { page, complaints };
}

export async function openRuns(runs, options) {
  const { page, complaints } = await open(fileOf(runs), options);
  await page.evaluate(() => window.viewer.ready);
  await settled(page);
  return { page, complaints };
}

/** Waits until all points are drawn. */
export async function settled(page) {
  await page.evaluate(() => window.viewer.settled());
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

export const state = (page) => page.evaluate(() => window.viewer.state());
export const stats = (page) => page.evaluate(() => window.viewer.stats());
export const setValues = async (page, values) => {
  await page.evaluate((v) => window.viewer.set(v), values);
  await settled(page);
};
export const setCamera = async (page, camera) => {
  await page.evaluate((c) => window.viewer.setCamera(c), camera);
  await settled(page);
};

/** Waits until `look` gives something true. */
export async function until(look, what, ms = 8000) {
  const end = Date.now() + ms;
  for (;;) {
    const found = await look();
    if (found) return found;
    assert.ok(Date.now() < end, `in vain: ${what}`);
    await new Promise((done) => setTimeout(done, 60));
  }
}

/** A screenshot that is kept under a name. */
export const shot = (page, name) => page.screenshot({ path: join(SHOTS, `${name}.png`) });

/** What the page's n-th canvas of points shows: {count(test)} of pixels by (r, g, b). */
export async function picture(page, n = 0) {
  const box = await page.locator(".cell canvas").nth(n).boundingBox();
  const inset = { x: box.x + 2, y: box.y + 60, width: box.width - 4, height: box.height - 190 };  // without caption and legend
  const { width, height, pixels } = decodePng(await page.screenshot({ clip: inset }));
  return {
    width, height, pixels,
    count(test) {
      let found = 0;
      for (let i = 0; i < pixels.length; i += 3) if (test(pixels[i], pixels[i + 1], pixels[i + 2])) ++found;
      return found;
    },
  };
}

export const isOrange = (r, g, b) => r > 90 && r > 1.8 * g && g > b;
export const isGrey = (r, g, b) => r > 60 && Math.abs(r - b) < 40 && Math.abs(r - g) < 25;
export const isAlarm = (r, g, b) => r > 120 && r > 2 * g && b > 1.2 * g;
export const isBlue = (r, g, b) => b > 140 && b > 1.8 * r;

export function differs(a, b) {
  let n = 0;
  for (let i = 0; i < a.pixels.length; ++i) if (Math.abs(a.pixels[i] - b.pixels[i]) > 8) ++n;
  return n / a.pixels.length;
}
