// SPDX-License-Identifier: MIT
// Measures and prints; only a breakdown fails.
import assert from "node:assert/strict";
import { test } from "node:test";
import { makeRun } from "./fixture.mjs";
import { fileOf, open, picture, isGrey, settled, shot, stats } from "./support.mjs";

test("a million points", async (t) => {
  const address = fileOf([makeRun({ points: 1_000_000, framePoints: 5000 })]);
  const { page, complaints } = await open(address);
  await page.evaluate(() => window.viewer.ready);
  await settled(page);
  const { times, views: [start] } = await stats(page);
  const moved = await page.evaluate(async () => {
    const before = window.viewer.stats().views[0].frames;
    const began = performance.now();
    let turns = 0;
    while (performance.now() - began < 3000) {
      const { camera } = window.viewer.state();
      window.viewer.setCamera({ yaw: camera.yaw + 0.03 });
      await new Promise((done) => requestAnimationFrame(done));
      ++turns;
    }
    const view = window.viewer.stats().views[0];
    return { rate: (view.frames - before) / 3, budget: view.budget, turns };
  });
  const rest = await page.evaluate(async () => {
    const began = performance.now();
    await window.viewer.settled();
    return performance.now() - began;
  });
  const pick = await page.evaluate(() => {
    const began = performance.now();
    for (let i = 0; i < 5; ++i) window.viewer.pick(300 + 20 * i, 300);
    return (performance.now() - began) / 5;
  });
  t.diagnostic(`first points after ${times.firstPoints.toFixed(0)} ms, everything decoded after ${times.ready.toFixed(0)} ms`);
  t.diagnostic(`${moved.rate.toFixed(1)} frames/s of ${moved.budget} points while turning; all ${start.pointsTotal} at rest after ${rest.toFixed(0)} ms; a click takes ${pick.toFixed(1)} ms`);
  await shot(page, "million");
  assert.equal(start.pointsDrawn, 1_000_000);
  assert.ok((await picture(page)).count(isGrey) > 20_000);
  assert.ok(moved.rate > 1, "a picture a second at the least");
  assert.deepEqual(complaints, []);
  await page.close();
});
