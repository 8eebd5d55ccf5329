// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { after, before, describe, test } from "node:test";
import { makeCloud, makeRun } from "./fixture.mjs";
import { differs, isAlarm, isGrey, isOrange, open, openRuns, picture, fileOf, settled, setValues, shot, state, stats, until } from "./support.mjs";

describe("the report of a run", () => {
  let page, complaints;
  before(async () => {
    ({ page, complaints } = await openRuns([makeRun({ points: 80_000 })]));
  });
  after(() => page.close());

  test("draws all points, and nothing more while nothing changes", async () => {
    await shot(page, "report");
    const view = (await stats(page)).views[0];
    assert.equal(view.pointsDrawn, 80_000);
    const seen = await picture(page);
    assert.ok(seen.count(isGrey) > 5000, "static points are grey");
    assert.ok(seen.count(isOrange) > 500, "removed points are orange");
    await new Promise((done) => setTimeout(done, 400));
    assert.equal((await stats(page)).views[0].frames, view.frames);
    assert.deepEqual(complaints, []);
  });

  test("layers go and come", async () => {
    const before = await picture(page);
    await page.getByLabel("Removed", { exact: false }).first().uncheck();
    await settled(page);
    assert.equal((await picture(page)).count(isOrange), 0);
    await page.getByLabel("Static", { exact: false }).first().uncheck();
    await page.getByLabel("Trajectory").uncheck();
    await settled(page);
    assert.ok((await picture(page)).count(isGrey) < 0.1 * before.count(isGrey));
    await setValues(page, { static: true, dynamic: true, path: true });
    assert.ok(differs(before, await picture(page)) < 0.001);
  });

  test("the objects that moved are listed, and the way of the chosen one is drawn", async () => {
    await page.getByRole("tab", { name: "Objects" }).click();
    const panel = page.locator("#panel-objects");
    assert.match(await panel.innerText(), /14 objects moved/);
    const numbers = () => panel.locator("[data-object]").allTextContents();
    assert.deepEqual(await numbers(), Array.from({ length: 14 }, (_, k) => String(14 - k)), "those with most points first");
    await panel.getByLabel("Order of the objects").selectOption("first");
    assert.equal((await numbers())[0], "1");
    assert.equal((await stats(page)).views[0].way, false);
    await panel.getByRole("button", { name: "3", exact: true }).click();
    await settled(page);
    assert.equal((await state(page)).row, 6);
    assert.equal((await stats(page)).views[0].way, true);
    await shot(page, "objects");
    await setValues(page, { row: 0, scan: false });
    await page.getByRole("tab", { name: "Point" }).click();
  });

  test("every colouring has a look and a legend of its own", async () => {
    const legends = new Set(), pictures = [];
    for (const colour of ["verdict", "instant", "error", "height", "intensity", "probability", "time"]) {
      await page.getByLabel("Colour by").selectOption(colour);
      await settled(page);
      legends.add(await page.getByRole("region", { name: "Legend" }).textContent());
      const seen = await picture(page);
      for (const other of pictures) assert.ok(differs(seen, other) > 0.002, `${colour} looks like one before`);
      pictures.push(seen);
      await shot(page, `colour-${colour}`);
    }
    assert.equal(legends.size, 7);
    await setValues(page, { colour: "verdict" });
  });

  test("errors and corrections stand out", async () => {
    const plain = await picture(page);
    await page.getByLabel("Mark corrections").check();
    await settled(page);
    assert.ok(differs(plain, await picture(page)) > 0.002);
    assert.match(await page.getByRole("region", { name: "Legend" }).textContent(), /corrected later/);
    await setValues(page, { corrections: false });
  });

  test("cuts by height and by range hide points", async () => {
    const all = (await picture(page)).count(isGrey);
    await page.getByLabel("Height, to").fill("60");
    await settled(page);
    assert.ok((await picture(page)).count(isGrey) < 0.95 * all);
    assert.ok((await state(page)).height[1] < 5);
    await setValues(page, { height: null });
    for (const from of ["sensor", "path"]) {
      await page.getByLabel("Range is measured from").selectOption(from);
      await page.getByLabel("Range, to").fill("14");
      await settled(page);
      const cut = (await picture(page)).count(isGrey);
      assert.ok(cut > 50 && cut < 0.85 * all, `${cut} of ${all} are left, from the ${from}`);
      await setValues(page, { range: null });
    }
    await setValues(page, { rangeFrom: "sensor" });
  });

  test("points grow", async () => {
    const before = await picture(page);
    await page.getByLabel("Point size").fill("3");
    await settled(page);
    assert.ok((await picture(page)).count(isGrey) > 1.2 * before.count(isGrey));
    await setValues(page, { size: 1 });
  });

  test("says where the data come from, and what is left out", async () => {
    await page.getByRole("tab", { name: "Run" }).click();
    const text = await page.locator("#panel-run").innerText();
    assert.match(text, /One point a cube of 12 cm: 80,000 of 752,000 shown/);
    assert.match(text, /recordings\/street/);
    assert.match(text, /000017: 412 of 4096 points are not finite <b>/);
    assert.match(text, /no stamps in the recording/);
    await page.getByText("Settings").click();
    assert.match(await page.locator("#panel-run pre").first().textContent(), /max_scans = 400/);
    assert.match(text, /99\.81/);
    await shot(page, "run-panel");
  });

  test("the address holds the view", async () => {
    await setValues(page, { colour: "height", static: false, row: 42, scan: true });
    await page.evaluate(() => window.viewer.setCamera({ distance: 33, yaw: 1, pitch: 0.4, target: [20, 1, 0] }));
    const address = await until(async () => page.url().includes("distance") || page.url().includes("colour=height") && page.url().includes(",33") && page.url(), "the view in the address");
    const other = await open(address);
    await other.page.evaluate(() => window.viewer.ready);
    const { colour, static: shown, row, camera } = await state(other.page);
    assert.deepEqual({ colour, shown, row }, { colour: "height", shown: false, row: 42 });
    assert.deepEqual(camera, { target: [20, 1, 0], yaw: 1, pitch: 0.4, distance: 33 });
    await other.page.close();
  });
});

test("nonsense in the address does no harm", async () => {
  const { page, complaints } = await open(`${fileOf([makeRun({ points: 5000 })])}#colour=red&row=-7&size=1e9&camera=1,2&height=x`);
  await page.evaluate(() => window.viewer.ready);
  assert.equal((await state(page)).colour, "verdict");
  assert.deepEqual(complaints, []);
  await page.close();
});

test("alarms of the watch are listed, and marked on the trajectory", async () => {
  const alarms = [{ text: "scans 000012 to 000030: the ground is lost", first: 2, last: 20 }];
  const { page, complaints } = await openRuns([makeRun({ points: 20_000, alarms })]);
  const marked = (await picture(page)).count(isAlarm);
  await page.getByLabel("Trajectory").uncheck();
  await settled(page);
  assert.ok(marked > (await picture(page)).count(isAlarm) + 30, `${marked} points of the picture`);
  await page.getByRole("tab", { name: "Run" }).click();
  assert.match(await page.locator("#panel-run").innerText(), /the ground is lost/);
  await shot(page, "alarms");
  assert.deepEqual(complaints, []);
  await page.close();
});

test("a cloud without a run is shown", async () => {
  const { page, complaints } = await openRuns([makeCloud()]);
  assert.ok((await picture(page)).count(isGrey) > 3000);
  await page.getByRole("tab", { name: "Plots" }).click();
  assert.match(await page.locator("#panel-plots").innerText(), /nothing to plot/);
  assert.equal(await page.locator(".timeline").isVisible(), false);
  await shot(page, "cloud");
  assert.deepEqual(complaints, []);
  await page.close();
});

test("an empty map is said to be one", async () => {
  const { page, complaints } = await openRuns([makeCloud({ points: 0 })]);
  assert.equal((await stats(page)).views[0].pointsDrawn, 0);
  assert.deepEqual(complaints, []);
  await page.close();
});

test("damaged data are named", async () => {
  const run = makeRun({ points: 2000 });
  run.arrays["voxel-probability"].rows += 1;
  const { page } = await open(fileOf([run]));
  await until(async () => /run-0-voxel-probability is damaged: \d+ bytes where \d+ were announced/.test(await page.locator(".status").textContent()), "the page says what is damaged");
  await page.close();
});

describe("the report of several sensors", () => {
  let page, complaints;
  before(async () => {
    ({ page, complaints } = await openRuns([makeRun({ points: 60_000, sensors: ["front", "rear"] })]));
  });
  after(() => page.close());

  test("the points of each can be hidden, and the playback leaves out its scans", async () => {
    const count = async () => (await picture(page)).count((r, g, b) => isGrey(r, g, b) || isOrange(r, g, b));
    const all = await count();
    await page.getByLabel("rear", { exact: true }).uncheck();
    await settled(page);
    const front = await count();
    await shot(page, "sensor-front");
    await page.getByLabel("rear", { exact: true }).check();
    await page.getByLabel("front", { exact: true }).uncheck();
    await settled(page);
    const rear = await count();
    for (const one of [front, rear]) assert.ok(one > 0.3 * all && one < 0.98 * all, `${one} of ${all}`);
    // Scans 0 and 4 are of the front sensor, 2 and 6 of the rear one.
    await setValues(page, { row: 0, scan: true });
    assert.equal((await stats(page)).views[0].scanIsShown, false);
    for (const row of [2, 6]) {
      await page.getByLabel("Next scan").click();
      assert.equal((await state(page)).row, row);
      assert.equal((await stats(page)).views[0].scanIsShown, true);
    }
    await page.getByLabel("front", { exact: true }).check();
    assert.equal((await state(page)).groups, -1);
    await setValues(page, { row: 0, scan: false });
    assert.equal(await count(), all);
    assert.deepEqual(complaints, []);
  });

  test("a link keeps what is hidden", async () => {
    await page.getByLabel("rear", { exact: true }).uncheck();
    await until(async () => /groups=1&/.test(await page.evaluate(() => location.hash)), "the link");
    await page.reload();
    await page.evaluate(() => window.viewer.ready);
    assert.equal(await page.getByLabel("rear", { exact: true }).isChecked(), false);
    assert.equal(await page.getByLabel("front", { exact: true }).isChecked(), true);
  });
});
