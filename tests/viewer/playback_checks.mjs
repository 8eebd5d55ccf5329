// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { after, before, describe, test } from "node:test";
import { makeRun, SCANS } from "./fixture.mjs";
import { differs, openRuns, picture, settled, setValues, shot, state, stats, until } from "./support.mjs";

describe("playback", () => {
  let page, complaints;
  before(async () => {
    ({ page, complaints } = await openRuns([makeRun({ points: 60_000 })]));
  });
  after(() => page.close());
  const label = () => page.locator(".when").textContent();

  test("the slider shows a scan over the dimmed map", async () => {
    const map = await picture(page);
    await page.getByLabel("Scan", { exact: true }).fill("40");
    await settled(page);
    const scan = await picture(page);
    assert.ok(differs(map, scan) > 0.02);
    assert.equal(await label(), "scan 50 · 4.0 s\n41 of 120");
    assert.ok((await stats(page)).views[0].scanIsShown);
    await shot(page, "scan");
    await page.getByLabel("Scan", { exact: true }).fill("41");
    assert.match(await label(), /no points here/);
    assert.equal((await stats(page)).views[0].scanIsShown, false);
  });

  test("steps go from frame to frame", async () => {
    await setValues(page, { row: 40 });
    await page.getByLabel("Next scan").click();
    assert.equal((await state(page)).row, 42);
    await page.getByLabel("Scan before").click();
    await page.getByLabel("Scan before").click();
    assert.equal((await state(page)).row, 38);
  });

  test("plays to the end by the stamps, and again from the start", async () => {
    await setValues(page, { row: 0 });
    await page.getByLabel("Speed").selectOption("5");
    const began = Date.now();
    await page.getByLabel("Play", { exact: true }).click();
    await until(async () => (await state(page)).row > 10, "it plays");
    await until(async () => !(await state(page)).playing, "it ends");
    assert.equal((await state(page)).row, SCANS - 2);
    assert.ok(Math.abs(Date.now() - began - 2400) < 1500, `12 s at 5 times take 2.4 s, not ${Date.now() - began} ms`);
    await page.getByLabel("Play", { exact: true }).click();
    assert.ok((await state(page)).row < 40);
    await page.getByLabel("Pause").click();
  });

  test("follows the sensor", async () => {
    await setValues(page, { row: 0, follow: true });
    const { camera: start } = await state(page);
    await setValues(page, { row: 60 });
    const { camera: end } = await state(page);
    assert.ok(Math.abs(end.target[0] - start.target[0] - 30) < 0.01);
    assert.equal(end.yaw, start.yaw);
    await setValues(page, { follow: false });
  });

  test("keys do all of it", async () => {
    await setValues(page, { row: 20, colour: "verdict" });
    await page.locator(".cell canvas").focus();
    const press = (key) => page.keyboard.press(key);
    await press("ArrowRight");
    assert.equal((await state(page)).row, 22);
    await press("ArrowLeft");
    assert.equal((await state(page)).row, 20);
    await press("End");
    assert.equal((await state(page)).row, SCANS - 2);
    await press("Home");
    assert.equal((await state(page)).row, 0);
    await press("Space");
    assert.equal((await state(page)).playing, true);
    await press("Space");
    assert.equal((await state(page)).playing, false);
    for (const [key, colour] of [["4", "height"], ["3", "error"], ["1", "verdict"]]) {
      await press(key);
      assert.equal((await state(page)).colour, colour);
    }
    for (const [key, name] of [["z", "static"], ["x", "dynamic"], ["c", "unknown"], ["p", "scan"], ["m", "corrections"], ["f", "follow"]]) {
      const before = (await state(page))[name];
      await press(key);
      assert.equal((await state(page))[name], !before, name);
      await press(key);
    }
    const { camera } = await state(page);
    for (const key of ["w", "a", "q", "r", "+"]) await press(key);
    assert.notDeepEqual((await state(page)).camera, camera);
    await press("t");
    assert.ok((await state(page)).camera.pitch > 1.5);
    await settled(page);
    await shot(page, "from-above");
    await press("0");
    await press("?");
    assert.ok(await page.getByRole("dialog").isVisible());
    await shot(page, "keys");
    await press("x");
    assert.equal((await state(page)).dynamic, true, "no key acts behind the help");
    await press("Escape");
    assert.equal(await page.getByRole("dialog").isVisible(), false);
    assert.deepEqual(complaints, []);
  });

  test("the mouse turns, moves and zooms", async () => {
    const box = await page.locator(".cell canvas").boundingBox();
    const x = box.x + box.width / 2, y = box.y + box.height / 2;
    const drag = async (button) => {
      await page.mouse.move(x, y);
      await page.mouse.down({ button });
      await page.mouse.move(x + 60, y + 40, { steps: 4 });
      await page.mouse.up({ button });
    };
    const { camera: first } = await state(page);
    await drag("left");
    const { camera: turned } = await state(page);
    assert.ok(turned.yaw < first.yaw && turned.pitch > first.pitch);
    await drag("right");
    const { camera: moved } = await state(page);
    assert.equal(moved.yaw, turned.yaw);
    assert.notDeepEqual(moved.target, turned.target);
    await page.mouse.wheel(0, -300);
    assert.ok((await state(page)).camera.distance < moved.distance);
    assert.equal((await state(page)).selection, null, "a drag is no click");
  });

  test("a click in a plot goes to its scan", async () => {
    await page.getByRole("tab", { name: "Plots" }).click();
    const plot = page.locator(".u-over").first();
    await plot.click();
    assert.ok(Math.abs((await state(page)).row - (SCANS - 1) / 2) < 2);
    assert.match(await page.locator("#panel-plots").innerText(), /Latency by stage[\s\S]*front end[\s\S]*6\.30/);
    await settled(page);
    await shot(page, "plots");
    await page.locator(".heatmap").scrollIntoViewIfNeeded();
    await shot(page, "plots-evidence");
    assert.deepEqual(complaints, []);
  });
});
