// SPDX-License-Identifier: MIT
// The page with what the command fills in: a report, a comparison, and a run watched live.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, describe, test } from "node:test";
import { pathToFileURL } from "node:url";
import { isGrey, isOrange, open, picture, settled, shot, stats, until } from "./support.mjs";

const FRAMES = 40;
const command = process.env.DF_COMMAND && resolve(process.env.DF_COMMAND);

describe("what the command shows", { skip: command ? false : "DF_COMMAND is not set" }, () => {
  let folder;
  const at = (name) => join(folder, name);
  const run = (...words) => execFileSync(command, words, { cwd: folder, stdio: ["ignore", "pipe", "pipe"] });

  before(() => {
    folder = mkdtempSync(join(tmpdir(), "command-"));
    run("simulate", "crowd", "--frames", String(FRAMES), "--pedestrians", "60", "-o", "data");
    run("run", "data", "-o", "out");
  });
  after(() => rmSync(folder, { recursive: true }));

  async function openedReport(file) {
    const { page, complaints } = await open(pathToFileURL(file).href);
    await page.evaluate(() => window.viewer.ready);
    await settled(page);
    return { page, complaints };
  }

  test("a report opens and shows the run", async () => {
    const { page, complaints } = await openedReport(at("out/report.html"));
    const seen = await picture(page);
    assert.ok(seen.count(isGrey) > 1000 && seen.count(isOrange) > 50);
    assert.ok((await stats(page)).views[0].pointsDrawn > 10_000);
    assert.match(await page.locator("body").innerText(), new RegExp(`${FRAMES} scans`));
    await shot(page, "command-report");
    assert.deepEqual(complaints, []);
    await page.close();
  });

  test("a run and somebody's map stand side by side", async () => {
    run("report", "out", "out/static_map.pcd", "--truth", "data", "-o", "both.html");
    const { page, complaints } = await openedReport(at("both.html"));
    assert.equal(await page.locator(".cell canvas").count() >= 2, true);
    for (const n of [0, 1]) assert.ok((await picture(page, n)).count(isGrey) > 300, `canvas ${n}`);
    assert.match(await page.locator("body").innerText(), /static_map\.pcd/);
    await shot(page, "command-compare");
    assert.deepEqual(complaints, []);
    await page.close();
  });

  test("the live view receives every scan, its corrections, and the report", async () => {
    const process = spawn(command, ["run", "data", "-o", "live", "--view", "--online", "--speed", "8"], { cwd: folder });
    const ended = new Promise((done) => process.on("exit", done));
    let said = "";
    process.stderr.on("data", (text) => (said += text));
    const address = await until(() => said.match(/http:\/\/127\.0\.0\.1:\d+\//)?.[0], "an address");
    const { page, complaints } = await open(address);
    const live = () => page.evaluate(() => window.viewer.live());
    // On a busy machine the run drops scans, as it should.
    const judged = await until(() => existsSync(at("live/metrics.json")) && JSON.parse(readFileSync(at("live/metrics.json"))).scans,
      "the run is done", 60_000);
    assert.ok(judged > FRAMES / 2, `${judged} scans`);
    await until(async () => (await live()).scans === judged, "every scan arrives", 30_000);
    await until(async () => (await live()).corrections >= judged, "every scan is corrected", 30_000);
    await shot(page, "command-live");
    assert.equal(await ended, judged === FRAMES ? 0 : 4, said);
    assert.deepEqual(complaints.filter((text) => !/Failed to load|ERR_CONNECTION/.test(text)), []);
    await page.close();
  });
});
