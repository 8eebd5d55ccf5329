// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { test } from "node:test";
import { makeRun } from "./fixture.mjs";
import { openRuns, picture, settled, shot, state } from "./support.mjs";

const isDark = (r, g, b) => r + g + b < 90;
const isLight = (r, g, b) => r + g + b > 700;

test("follows the system's light or dark, and the key for it", async () => {
  const { page } = await openRuns([makeRun({ points: 60_000 })], { colorScheme: "light" });
  const most = async (test) => {
    const seen = await picture(page);
    return seen.count(test) > 0.3 * seen.width * seen.height;
  };
  assert.ok(await most(isLight));
  await shot(page, "light");
  await page.emulateMedia({ colorScheme: "dark" });
  await settled(page);
  assert.ok(await most(isDark));
  await page.getByRole("button", { name: "Light" }).click();
  await settled(page);
  assert.ok(await most(isLight));
  await page.getByRole("tab", { name: "Plots" }).click();
  await shot(page, "light-plots");
  await page.close();
});

test("on a phone the panels are a drawer", async () => {
  const { page, complaints } = await openRuns([makeRun({ points: 60_000 })], { width: 390, height: 780 });
  await shot(page, "phone");
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  assert.equal(await page.locator("#panel-view").isVisible(), false);
  await page.getByRole("tab", { name: "View" }).click();
  assert.ok(await page.locator("#panel-view").isVisible());
  await page.getByLabel("Colour by").selectOption("height");
  assert.equal((await state(page)).colour, "height");
  await shot(page, "phone-view");
  await page.getByRole("tab", { name: "Plots" }).click();
  assert.equal(await page.locator("#panel-view").isVisible(), false);
  await page.locator(".u-over").first().waitFor();
  await shot(page, "phone-plots");
  await page.getByRole("tab", { name: "Plots" }).click();
  assert.equal(await page.locator("#panel-plots").isVisible(), false);
  assert.deepEqual(complaints, []);
  await page.close();
});

test("all that can be operated has a name and can be reached by Tab", async () => {
  const { page } = await openRuns([makeRun({ points: 5000 })]);
  const nameless = await page.evaluate(() => [...document.querySelectorAll("button, input, select, canvas[tabindex]")]
    .filter((e) => !(e.getAttribute("aria-label") || e.textContent.trim() || e.closest("label")?.textContent.trim())).map((e) => e.outerHTML));
  assert.deepEqual(nameless, []);
  const reached = new Set();
  for (let i = 0; i < 45; ++i) {
    await page.keyboard.press("Tab");
    reached.add(await page.evaluate(() => document.activeElement.tagName + (document.activeElement.getAttribute("aria-label") ?? document.activeElement.id ?? "")));
  }
  for (const wanted of ["SELECTColour by", "INPUTHeight, from", "INPUTScan", "BUTTONPlay", "BUTTONtab-point"]) assert.ok(reached.has(wanted), wanted);
  assert.ok([...reached].some((name) => name.startsWith("CANVAS")));
  await page.close();
});
