// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { after, before, describe, test } from "node:test";
import { makeRun, pageOf } from "./fixture.mjs";
import { correctionRecord, LiveServer, scanRecord } from "./live_server.mjs";
import { isBlue, isGrey, isOrange, open, picture, setValues, shot, state, until, VIEWER } from "./support.mjs";
import { scanPoints, sensorAt, stampOf } from "./street.mjs";

const STATIC = 1, DYNAMIC = 2, NOT_RECORDED = 0b111100;
const POINTS = 3000;

/** A scan relative to the first sensor position; every twentieth of what moves is missed at first. */
function scanOf(row) {
  const first = sensorAt(0);
  const points = scanPoints(row, POINTS);
  return {
    index: row, stamp: stampOf(row), sensor: sensorAt(row).map((s, c) => s - first[c]),
    places: points.map(({ place }) => place.map((p, c) => p - first[c])),
    verdicts: points.map(({ moving }, i) => (moving && i % 20 ? DYNAMIC : STATIC)), points,
  };
}

const settledOf = ({ points }) => points.map(({ moving }) => (moving ? DYNAMIC : STATIC) | NOT_RECORDED);

describe("the live view", () => {
  const server = new LiveServer();
  const scans = Array.from({ length: 30 }, (_, row) => scanOf(row));
  let page, complaints, number = 0;
  const push = (record) => server.push(record(++number));
  const live = () => page.evaluate(() => window.viewer.live());
  const received = (n) => until(async () => (await live()).scans === n, `${n} scans arrive`);

  before(async () => {
    ({ page, complaints } = await open(await server.start()));
    await page.evaluate(() => window.viewer.ready);
  });
  after(async () => {
    await page.close();
    await server.stop();
  });

  test("waits for the first scan", async () => {
    await until(async () => /street, live/.test(await page.locator("h1").textContent()), "the run's name");
    assert.match(await page.getByText("Waiting for the first scan").textContent(), /Waiting/);
    await shot(page, "live-waiting");
  });

  test("takes every scan and shows the newest", async () => {
    for (const scan of scans.slice(0, 20)) push((n) => scanRecord(n, scan));
    await received(20);
    assert.equal((await state(page)).row, 19);
    assert.match(await page.locator(".when").textContent(), /^scan 19 · 1.9 s\n20 of 20 received/);
    assert.match(await page.locator("#panel-live").innerText(), /20 of 60/);
    assert.match(await page.locator("#panel-live").innerText(), /60,000/);
    await page.evaluate(() => window.viewer.settled());
    const seen = await picture(page);
    assert.ok(seen.count(isGrey) > 300 && seen.count(isOrange) > 50);
    await shot(page, "live");
  });

  test("corrections recolour, are counted and can be marked", async () => {
    const wrong = scans.slice(0, 20).reduce((sum, scan) => sum + scan.points.filter(({ moving }, i) => moving && i % 20 === 0).length, 0);
    for (const scan of scans.slice(0, 20)) push((n) => correctionRecord(n, { index: scan.index, verdicts: settledOf(scan) }));
    await until(async () => (await live()).corrected === wrong, `${wrong} points are corrected`);
    const before = (await picture(page)).count(isBlue);
    await setValues(page, { corrections: true, size: 3 });
    assert.ok((await picture(page)).count(isBlue) > before + 20);
    await shot(page, "live-corrections");
    await setValues(page, { corrections: false, size: 1 });
  });

  test("pauses and steps, while scans still come in", async () => {
    await page.getByLabel("Pause").click();
    for (const scan of scans.slice(20, 25)) push((n) => scanRecord(n, scan));
    await received(25);
    assert.equal((await state(page)).row, 19);
    await page.getByLabel("Scan before").click();
    assert.equal((await state(page)).row, 18);
    await page.getByLabel("Play", { exact: true }).click();
    assert.equal((await state(page)).row, 24);
  });

  test("says when the server is gone, and goes on when it is back", async () => {
    const { port } = server;
    await server.stop();
    await until(async () => /Connection lost/.test(await page.locator(".banner").textContent()), "the loss is said");
    await shot(page, "live-lost");
    for (const scan of scans.slice(25, 28)) push((n) => scanRecord(n, scan));
    await server.start(port);
    await received(28);
    assert.equal(await page.locator(".banner").textContent(), "");
  });

  test("damaged and forgotten records do no harm", async () => {
    complaints.length = 0;  // the lost connection was one
    const short = scanRecord(++number, scans[0]);
    short.buffer.writeUInt32LE(POINTS + 1, 48);
    server.push(short);
    const cut = scanRecord(++number, scans[0]);
    server.push({ number: cut.number, buffer: cut.buffer.subarray(0, 400) });
    await until(async () => (await live()).damaged === 2, "both are counted");
    server.push({ number: ++number, buffer: Buffer.from([1, 2, 3]) });
    await until(async () => (await live()).damaged === 3, "a piece of a record is counted");
    push((n) => correctionRecord(n, { index: 4_000_000, verdicts: [1, 1] }));
    number += 7;  // forgotten by the server
    push((n) => scanRecord(n, scans[28]));
    await received(29);
    assert.ok((await live()).skipped >= 7);
    assert.deepEqual(complaints, []);
  });

  test("says at the end that the report is there", async () => {
    push((n) => scanRecord(n, { ...scans[29], places: scans[29].places.map((p, i) => (i < 3 ? [NaN, Infinity, 0] : p)) }));
    await received(30);
    server.report = pageOf(VIEWER, [makeRun({ points: 5000 })]);
    Object.assign(server.state, { done: true, report: true });
    const link = page.getByRole("alert").getByRole("link", { name: "Open the report" });
    await link.waitFor();
    await shot(page, "live-done");
    assert.deepEqual(complaints, []);
    await server.stop();  // as the command does, once the report is fetched
    const [report] = await Promise.all([page.waitForEvent("popup"), link.click()]);
    await report.waitForFunction(() => window.viewer);
    await report.evaluate(() => window.viewer.ready);
    assert.equal(await report.locator("h1").textContent(), "street");
    assert.match(await page.locator(".banner").textContent(), /finished/);
    await report.close();
  });
});
