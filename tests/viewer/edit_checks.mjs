// SPDX-License-Identifier: MIT
// `dynamicfilter serve --edit`: twenty wrong instances of a simulated street are corrected by the mouse.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, describe, test } from "node:test";
import { open, setCamera, settled, setValues, shot, state, until } from "./support.mjs";
import { scoresOf, wrongInstances } from "./wrong_instances.mjs";

const WANTED = 20;
const command = process.env.DF_COMMAND && resolve(process.env.DF_COMMAND);

describe("corrections by hand", { skip: command ? false : "DF_COMMAND is not set" }, () => {
  let folder, server, address, page, complaints;
  const at = (name) => join(folder, name);
  const run = (...words) => execFileSync(command, words, { cwd: folder, stdio: ["ignore", "pipe", "pipe"] });
  const editor = () => page.evaluate(() => window.viewer.editor());
  const status = () => page.locator(".edit-status").innerText();
  const saved = () => JSON.parse(readFileSync(at("out/edits.json"), "utf8"));
  const sizes = () => ["static_map.pcd", "dynamic_points.pcd"].map((name) => statSync(at(`out/${name}`)).size);
  const isApplied = async () => /^Applied|are those shown/.test(await status());

  async function openEditor() {
    ({ page, complaints } = await open(address));
    await page.evaluate(() => window.viewer.ready);
    await settled(page);
    await setValues(page, { static: false });
  }
  async function serve() {
    server = spawn(command, ["serve", "out", "--edit"], { cwd: folder });
    let said = "";
    server.stdout.on("data", (text) => (said += text));
    address = await until(() => said.match(/http:\/\/127\.0\.0\.1:\d+\/\?edit=[0-9a-f]{32}/)?.[0], "an address");
  }
  async function stop() {
    const ended = new Promise((done) => server.on("exit", done));
    server.kill("SIGINT");
    await ended;
  }
  before(async () => {
    folder = mkdtempSync(join(tmpdir(), "edit-"));
    run("simulate", "street", "--frames", "60", "-o", "data");
    run("run", "data", "-o", "out");
    await serve();
    await openEditor();
  });
  after(async () => {
    await page?.close();
    await stop();
    rmSync(folder, { recursive: true });
  });

  /** Clicks where a place is seen, from one side or another; true if points of it are chosen. */
  async function clickInstance(world) {
    const { origin } = await page.evaluate(() => JSON.parse(document.getElementById("run-0").textContent));
    const place = world.map((w, c) => w - origin[c]);
    for (const yaw of [-0.7, 0.9, 2.4, 4]) {
      await setCamera(page, { target: place, distance: 7, yaw, pitch: 0.7 });
      const [x, y] = await page.evaluate((p) => window.viewer.project(p), place);
      const box = await page.locator(".cell canvas").first().boundingBox();
      await page.mouse.click(box.x + x, box.y + y);
      const { selection } = await state(page);
      if (selection && Math.hypot(...selection.position.map((p, c) => p - place[c])) < 0.5) return true;
    }
    return false;
  }

  const http = (path, method, headers = {}) => fetch(new URL(path, address), { method, headers, body: method === "POST" ? "{}" : undefined });

  test("only the page that was opened with the printed address may edit", async () => {
    const token = new URL(address).searchParams.get("edit");
    for (const [path, method] of [["/edits", "GET"], ["/edits", "POST"], ["/apply", "POST"]]) {
      assert.equal((await http(path, method)).status, 403, `${method} ${path} without a token`);
      assert.equal((await http(path, method, { "X-Edit-Token": "0".repeat(32) })).status, 403);
      const curl = (...more) => execFileSync("curl", ["-s", "-o", "/dev/null", "-w", "%{http_code}", "-X", method, "-d", "{}",
        "-H", `X-Edit-Token: ${token}`, ...more, new URL(path, address).href], { encoding: "utf8" });
      if (method === "GET") continue;
      assert.equal(curl("-H", "Origin: http://example.org"), "403", "another origin");
      assert.equal(curl("-H", "Host: example.org"), "403", "another host");
    }
    assert.equal((await http("/edits", "POST", { "X-Edit-Token": token })).status, 400, "no edits");
    assert.equal(existsSync(at("out/edits.json")), false);
  });

  test("twenty wrong instances are corrected by clicks, on disk too", async (t) => {
    const wrong = wrongInstances(at("data"), at("out")).slice(0, WANTED + 15);
    const before = scoresOf(at("data"), at("out")), [still, moving] = sizes();
    const filters = wrongInstances(at("data"), at("out"));
    const began = performance.now();
    let corrected = 0;
    for (const { place, wrong: points } of wrong) {
      if ((await editor()).edits === WANTED) break;
      if (!(await clickInstance(place))) continue;
      if ((await editor()).edits === 2) await shot(page, "edit-chosen");
      await page.keyboard.press("j");
      corrected += points;
    }
    const seconds = (performance.now() - began) / 1000;
    assert.equal((await editor()).edits, WANTED);
    await until(() => existsSync(at("out/edits.json")) && saved().edits.length === WANTED, "all are saved");
    await page.getByRole("button", { name: "Apply" }).click();
    await until(isApplied, "applied", 30_000);
    await setValues(page, { static: true });
    await page.evaluate(() => window.viewer.setCamera({ distance: 25, pitch: 0.6 }));
    await settled(page);
    await shot(page, "edit-applied");
    await setValues(page, { static: false });
    const now = scoresOf(at("data"), at("out"));
    t.diagnostic(`${WANTED} instances in ${seconds.toFixed(1)} s; wrong points ${before.wrong} -> ${now.wrong} of ${before.all}`);
    assert.ok(before.wrong - now.wrong > 0.9 * corrected, `${before.wrong} -> ${now.wrong}, corrected ${corrected}`);
    assert.ok(filters.length > wrongInstances(at("data"), at("out")).length + 0.8 * WANTED);
    const [stillNow, movingNow] = sizes();
    assert.ok(stillNow > still && movingNow < moving);
    assert.equal(stillNow + movingNow <= still + moving + 4 && stillNow + movingNow >= still + moving - 4, true, "no point is lost");
    assert.deepEqual(complaints.filter((text) => !/403|400/.test(text)), []);
  });

  test("undo, redo and removal", async () => {
    const labels = () => readFileSync(at("out/labels/000030.label"));
    const edited = labels(), unedited = readFileSync(at("out/unedited/000030.label"));
    for (let i = 0; i < WANTED; ++i) await page.keyboard.press("Control+z");
    assert.equal((await editor()).edits, 0);
    await until(() => saved().edits.length === 0, "saved");
    await page.getByRole("button", { name: "Apply" }).click();
    await until(isApplied, "applied", 30_000);
    assert.ok(labels().equals(unedited), "the filter's verdict is back");
    for (let i = 0; i < WANTED; ++i) await page.keyboard.press("Control+Shift+z");
    await until(() => saved().edits.length === WANTED, "saved again");
    await page.getByRole("button", { name: "Remove edit 20" }).click();
    assert.equal((await editor()).edits, WANTED - 1);
    await page.getByRole("button", { name: "Undo" }).click();
    await until(() => saved().edits.length === WANTED, "the edit is back");
    await page.getByRole("button", { name: "Apply" }).click();
    await until(isApplied, "applied", 30_000);
    assert.ok(labels().equals(edited));
  });

  test("a rectangle and a lasso choose what is seen in them", async () => {
    const box = await page.locator(".cell canvas").first().boundingBox();
    const middle = [box.x + box.width / 2, box.y + box.height / 2];
    const { camera } = await state(page);
    for (const [tool, path] of [["Rectangle", [[-150, -120], [150, 120]]], ["Lasso", [[-150, 0], [0, -120], [150, 0], [0, 120]]]]) {
      await page.getByRole("button", { name: tool }).click();
      await page.mouse.move(middle[0] + path[0][0], middle[1] + path[0][1]);
      await page.mouse.down();
      for (const [x, y] of path.slice(1)) await page.mouse.move(middle[0] + x, middle[1] + y, { steps: 5 });
      if (tool === "Lasso") await shot(page, "edit-lasso");
      await page.mouse.up();
      assert.ok((await editor()).chosen > 0, tool);
    }
    assert.deepEqual((await state(page)).camera, camera, "the view stays");
    await page.keyboard.press("u");
    await until(() => saved().edits.length === WANTED + 1 && saved().edits.at(-1).how === "lasso", "saved");
    await page.keyboard.press("Control+z");
    await until(() => saved().edits.length === WANTED, "undone");
    await page.getByRole("button", { name: "Apply" }).click();
    await until(isApplied, "applied", 30_000);
  });

  test("an apply that was killed is finished by the next one", async () => {
    const files = () => ["static_map.pcd", "dynamic_points.pcd", "labels/000000.label", "labels/000059.label"].map((name) => readFileSync(at(`out/${name}`)));
    const whole = files();
    await page.close();
    for (const ms of [30, 90, 150, 250]) {
      const token = new URL(address).searchParams.get("edit");
      http("/apply", "POST", { "X-Edit-Token": token }).catch(() => {});
      await new Promise((done) => setTimeout(done, ms));
      const ended = new Promise((done) => server.on("exit", done));
      server.kill("SIGKILL");
      await ended;
      run("info", "out/static_map.pcd");
      await serve();
    }
    const { searchParams } = new URL(address);
    assert.equal((await http("/apply", "POST", { "X-Edit-Token": searchParams.get("edit") })).status, 200);
    files().forEach((bytes, i) => assert.ok(bytes.equals(whole[i])));
    await openEditor();
  });

  test("edits survive a new run, and the page shows them", async () => {
    const files = ["static_map.pcd", "dynamic_points.pcd", "labels/000030.label", "edits.json"].map((name) => readFileSync(at(`out/${name}`)));
    await page.close();
    await stop();
    run("run", "data", "-o", "out", "--overwrite");
    ["static_map.pcd", "dynamic_points.pcd", "labels/000030.label", "edits.json"].forEach((name, i) =>
      assert.ok(readFileSync(at(`out/${name}`)).equals(files[i]), name));
    run("run", "data", "-o", "other", "--edits", "out/edits.json", "--no-report");
    assert.ok(readFileSync(at("other/static_map.pcd")).equals(files[0]));
    await serve();
    await openEditor();
    assert.equal((await editor()).edits, WANTED);
    assert.ok(await isApplied());
  });

  test("what is damaged is named, with what to do", () => {
    writeFileSync(at("other/edits.json"), '{"format": "dynamicfilter edits", "version": 2}');
    for (const [name, words] of [["other", /version 2[^]*use the dynamicfilter that wrote it/], ["data", /not the output folder of a run[^]*dynamicfilter run/]]) {
      assert.throws(() => run("serve", name, "--edit"), (error) => error.status === 3 && words.test(String(error.stderr)));
    }
  });
});
