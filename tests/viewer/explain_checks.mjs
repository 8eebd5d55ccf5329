// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { after, before, describe, test } from "node:test";
import { makeRun } from "./fixture.mjs";
import { isBlue, open, openRuns, picture, setCamera, settled, setValues, shot, state, stats, until } from "./support.mjs";

/** Clicks where a place is seen from nearby. */
async function clickPlace(page, place, distance = 6) {
  await setCamera(page, { target: place, distance, yaw: -0.7, pitch: 0.9 });
  const [x, y] = await page.evaluate((p) => window.viewer.project(p), place);
  const box = await page.locator(".cell canvas").first().boundingBox();
  await page.mouse.click(box.x + x, box.y + y);
  await settled(page);
}

describe("a click on a point", () => {
  const run = makeRun();
  let page, complaints;
  before(async () => {
    ({ page, complaints } = await openRuns([run]));
    await setValues(page, { static: false, unknown: false });
  });
  after(() => page.close());

  /** A known point that is in front where it is looked at. */
  async function clickKnown() {
    for (const point of run.known) {
      await clickPlace(page, point.place);
      if ((await state(page)).selection?.voxel === point.voxel) return point;
    }
    throw new Error("no known point is in front");
  }

  test("says why it was removed and which scans saw through", async () => {
    const point = await clickKnown();
    const panel = page.locator("#panel-point");
    assert.match(await panel.innerText(), /Removed: taken for something that moves/);
    assert.match(await panel.innerText(), new RegExp(`${point.passes.length + 5} scans saw through this place`));
    assert.match(await panel.innerText(), /5 more passes counted: of 45 key frames the newest 40/);
    assert.match(await panel.innerText(), /neighbour|voxels within two cells vote too/);
    assert.deepEqual(await panel.locator(".chip").allTextContents(), point.passes.map((row) => String(row + 10)));
    assert.ok((await stats(page)).views[0].box, "its voxel is boxed");
    await shot(page, "point-removed");
  });

  test("a scan that saw through leads there, with its line of sight", async () => {
    const chip = page.locator(".chip").nth(2);
    const row = Number(await chip.getAttribute("data-row"));
    const before = (await picture(page)).count(isBlue);
    await chip.click();
    await settled(page);
    assert.equal((await state(page)).row, row);
    assert.ok((await stats(page)).views[0].sight);
    assert.ok((await picture(page)).count(isBlue) > before + 100, "a line is drawn");
    assert.match(await page.locator(".when").textContent(), new RegExp(`^scan ${row + 10} `));
    assert.equal(await chip.getAttribute("aria-pressed"), "true");
    await shot(page, "line-of-sight");
    await page.keyboard.press("ArrowRight");
    assert.equal((await stats(page)).views[0].sight, false);
  });

  test("a link leads back to it", async () => {
    const address = await until(() => page.url().includes("point=0.map.") && page.url(), "the point in the address");
    const other = await open(address);
    await other.page.evaluate(() => window.viewer.ready);
    assert.equal((await state(other.page)).selection.index, (await state(page)).selection.index);
    await other.page.close();
  });

  test("the wrong points can be gone through", async () => {
    const truth = (verdict) => (verdict >> 2) & 3;
    const seen = new Set();
    for (let i = 0; i < 3; ++i) {
      await page.getByRole("button", { name: /False removals/ }).click();
      const { selection } = await state(page);
      assert.deepEqual([truth(selection.verdict), selection.verdict & 3], [1, 2]);
      seen.add(selection.index);
    }
    assert.equal(seen.size, 3);
    assert.match(await page.locator("#panel-point").innerText(), /False removal: the ground truth says it is static/);
    await page.locator(".cell canvas").focus();
    await page.keyboard.press("b");
    assert.match(await page.locator("#panel-point").innerText(), /Missed: the ground truth says it moves/);
    await settled(page);
    await shot(page, "point-missed");
  });

  test("Escape forgets it, an empty place too", async () => {
    await page.locator(".cell canvas").focus();
    await page.keyboard.press("Escape");
    assert.equal((await state(page)).selection, null);
    assert.match(await page.locator("#panel-point").innerText(), /Click a point/);
    assert.equal((await stats(page)).views[0].box, false);
    assert.deepEqual(complaints, []);
  });

  test("the middle of the view can be chosen by Enter", async () => {
    await setValues(page, { static: true, scan: false });
    await setCamera(page, { target: [40, 0, -1.7], distance: 5, yaw: 0, pitch: 1.2 });
    await page.locator(".cell canvas").focus();
    await page.keyboard.press("Enter");
    const { selection } = await state(page);
    assert.ok(Math.hypot(selection.position[0] - 40, selection.position[1]) < 0.5);
  });

  test("without a voxel, that is said", async () => {
    const place = [0, 1, 2].map((c) => run.meta.low[c] + run.meta.step * run.arrays["map-position"].data[15 + c]);
    await setValues(page, { unknown: true });
    await clickPlace(page, place, 0.4);
    assert.equal((await state(page)).selection.index, 5);
    assert.match(await page.locator("#panel-point").innerText(), /It has no voxel/);
  });
});

test("where no counters are kept, the page says so", async () => {
  const run = makeRun({ evidence: false, points: 20_000 });
  run.meta.occupancy_threshold = 0.6;
  const { page, complaints } = await openRuns([run]);
  await setValues(page, { static: false });
  await clickPlace(page, run.known[3].place);
  const text = await page.locator("#panel-point").innerText();
  assert.match(text, /preset paper keeps no counters/);
  assert.match(text, /probability[^]*from 0\.6 on it is kept/);
  assert.deepEqual(complaints, []);
  await page.close();
});
