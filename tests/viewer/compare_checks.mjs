// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { after, before, describe, test } from "node:test";
import { makeCloud, makeRun } from "./fixture.mjs";
import { isGrey, openRuns, picture, setCamera, settled, setValues, shot, state, stats } from "./support.mjs";

describe("runs side by side", () => {
  let page, complaints;
  before(async () => {
    const runs = [makeRun({ name: "default", points: 60_000 }), makeRun({ name: "paper", points: 60_000, evidence: false, wrong: 0.03 }), makeCloud({ points: 40_000 })];
    ({ page, complaints } = await openRuns(runs, { width: 1440, height: 860 }));
  });
  after(() => page.close());

  test("each has a picture with its name", async () => {
    await shot(page, "compare");
    for (let k = 0; k < 3; ++k) assert.ok((await picture(page, k)).count(isGrey) > 1000, `picture ${k}`);
    assert.deepEqual(await page.locator(".caption h2").allTextContents(), ["default", "paper", "octomap"]);
  });

  test("one place of the world is at one place of all pictures", async () => {
    await setCamera(page, { target: [30, 2, 0], distance: 25, yaw: 0.4, pitch: 0.5 });
    const seen = await page.evaluate(() => [window.viewer.project([28, 1, -1], 0), window.viewer.project([28, 1, -1], 1), window.viewer.project([25, 1, -1], 2)]);
    for (const [x, y] of seen) assert.ok(Math.hypot(x - seen[0][0], y - seen[0][1]) < 0.5, JSON.stringify(seen));
    const box = await page.locator(".cell canvas").nth(2).boundingBox();
    await page.mouse.move(box.x + 100, box.y + 150);
    await page.mouse.down();
    await page.mouse.move(box.x + 160, box.y + 150, { steps: 3 });
    await page.mouse.up();
    assert.ok((await state(page)).camera.yaw < 0.4);
  });

  test("the slider moves all that have scans", async () => {
    await setValues(page, { row: 50, scan: true });
    const { views } = await stats(page);
    assert.deepEqual(views.map(({ row, scanIsShown }) => [row, scanIsShown]), [[50, true], [50, true], [-1, false]]);
    await settled(page);
    await shot(page, "compare-scan");
  });

  test("the table marks the best of each row", async () => {
    await page.getByRole("tab", { name: "Scores" }).click();
    const row = async (name) => page.getByRole("row", { name }).first().locator("td").evaluateAll((cells) => cells.map((c) => [c.firstChild.textContent, c.className]));
    assert.deepEqual(await row(/preserved PR/), [["99.81", "best"], ["93.81", ""], ["–", ""]]);
    assert.deepEqual(await row(/rejected RR/), [["98.96", "best"], ["98.96", "best"], ["–", ""]]);
    assert.deepEqual(await row(/scans per second/), [["48.2", ""], ["51.2", "best"], ["–", ""]]);
    assert.deepEqual(complaints, []);
  });
});
