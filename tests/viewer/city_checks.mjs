// SPDX-License-Identifier: MIT
// The overview of a city and the page of a tile, as files on the disk.
import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { pathToFileURL } from "node:url";
import { makeCity, makeTile, pageOf } from "./fixture.mjs";
import { open, picture, settled, setValues, shot, state, until, VIEWER } from "./support.mjs";

/** As the command writes it: the script in a file beside the page. */
function sharedPageOf(run) {
  const [, style] = VIEWER.match(/<style>([^]*?)<\/style>/);
  const begin = VIEWER.indexOf("<script>") + "<script>".length, end = VIEWER.indexOf("</script>", begin);
  const script = VIEWER.slice(begin, end);
  const page = VIEWER.slice(0, begin - 1) + ' src="viewer.js">' + VIEWER.slice(end);
  return { page: pageOf(page.replace(`<style>${style}</style>`, () => '<link rel="stylesheet" href="viewer.css">'), [run]), script, style };
}

const isGreenOrYellow = (r, g, b) => g > 120 && g > 1.3 * b;

describe("a city", () => {
  let folder, page, complaints;
  const at = (name) => pathToFileURL(join(folder, name)).href;

  before(async () => {
    folder = mkdtempSync(join(tmpdir(), "city-"));
    mkdirSync(join(folder, "report"));
    writeFileSync(join(folder, "report.html"), pageOf(VIEWER, [makeCity()]));
    for (const name of ["2_0_0", "2_1_0"]) {
      const { page: tile, script, style } = sharedPageOf(makeTile({ name }));
      writeFileSync(join(folder, `report/${name}.html`), tile);
      writeFileSync(join(folder, "report/viewer.js"), script);
      writeFileSync(join(folder, "report/viewer.css"), style);
    }
    ({ page, complaints } = await open(at("report.html")));
    await page.evaluate(() => window.viewer.ready);
    await settled(page);
  });
  after(async () => {
    await page.close();
    rmSync(folder, { recursive: true });
  });

  const canvasAt = async (place) => {
    const box = await page.locator(".cell canvas").boundingBox();
    const [x, y] = await page.evaluate((p) => window.viewer.project(p), place);
    return [box.x + x, box.y + y];
  };

  test("all tiles are drawn with their pictures", async () => {
    await shot(page, "city");
    assert.deepEqual(await page.evaluate(() => window.viewer.stats().tiles), 6);
    assert.ok((await picture(page)).count(isGreenOrYellow) > 2000);
    assert.match(await page.locator("header").innerText(), /6 tiles · 2 drives/);
  });

  test("north is up, and the small tiles are where they belong", async () => {
    const names = await page.evaluate(() => [[10, 10], [150, 10], [10, 150], [110, 110], [110, 160], [300, 0]]
      .map((place) => window.viewer.project(place)).map(([x, y]) => window.viewer.tileAt(x, y)));
    assert.deepEqual(names, ["2_0_0", "2_1_0", "2_0_1", "1_2_2", "1_2_3", null]);
    const [, low] = await canvasAt([10, 10]), [, high] = await canvasAt([10, 150]);
    assert.ok(high < low);
  });

  test("a click says what a tile holds and who saw it", async () => {
    await page.mouse.click(...await canvasAt([150, 30]));
    assert.equal((await state(page)).selected, 1);
    const told = await page.locator("#panel-tile").innerText();
    assert.match(told, /Tile 2_1_0/);
    assert.match(told, /voxels\s+2,000/);
    assert.match(told, /Seen by 1 of 2 drives\s+south/i);
    await shot(page, "city-tile");
  });

  test("a drive dims the tiles that it did not see", async () => {
    const before = (await picture(page)).count(isGreenOrYellow);
    await page.getByLabel("Drive", { exact: true }).selectOption({ label: "north" });
    await settled(page);
    assert.ok((await picture(page)).count(isGreenOrYellow) < 0.8 * before);
    assert.equal(await page.locator("#panel-tiles li").count(), 4);
    await setValues(page, { drive: -1 });
  });

  test("counts colour the tiles", async () => {
    const plain = await picture(page);
    await setValues(page, { colour: "scans" });
    await shot(page, "city-scans");
    assert.match(await page.locator(".legend").innerText(), /Scans\s+0\s+600/);
    assert.ok((await picture(page)).count(isGreenOrYellow) !== plain.count(isGreenOrYellow));
    await setValues(page, { colour: "height" });
  });

  test("wheel and keys move it", async () => {
    const before = await state(page);
    await page.mouse.move(...await canvasAt([100, 100]));
    await page.mouse.wheel(0, -400);
    await until(async () => (await state(page)).scale > 1.2 * before.scale, "nearer");
    await page.keyboard.press("0");
    await until(async () => Math.abs((await state(page)).scale - before.scale) < 1e-9, "all in view");
  });

  const arrived = async (address) => {
    await page.waitForURL(address);
    await page.waitForFunction(() => window.viewer);
    await page.evaluate(() => window.viewer.ready);
  };

  test("the list leads to a tile, its neighbours, and back", async () => {
    await page.getByRole("tab", { name: "Tiles" }).click();
    await page.getByRole("link", { name: "2_0_0" }).click();
    await arrived(/2_0_0\.html/);
    await settled(page);
    await shot(page, "city-page");
    assert.match(await page.locator("header").innerText(), /Tile 2_0_0[^]*All tiles[^]*seen by 1 of 2 drives/);
    assert.equal((await state(page)).colour, "height");
    assert.match(await page.locator("#panel-run").innerText(), /east\s+2_1_0/);
    await page.getByRole("link", { name: "2_1_0" }).click();
    await arrived(/2_1_0\.html/);
    await page.getByRole("link", { name: "All tiles" }).click();
    await arrived(/report\.html/);
    assert.match(await page.title(), /Map of several drives/);
    assert.deepEqual(complaints, []);
  });

  test("a tile is coloured by scans and drives", async () => {
    const opened = await open(at("report/2_0_0.html"));
    await opened.page.evaluate(() => window.viewer.ready);
    await settled(opened.page);
    assert.deepEqual(await opened.page.locator("#colour option").allTextContents(),
      ["Verdict", "Height", "Probability of being static", "Scans that saw it", "Drives that saw it"]);
    const seen = {};
    for (const colour of ["scans", "drives"]) {
      await setValues(opened.page, { colour });
      seen[colour] = await picture(opened.page);
    }
    const isPink = (r, g, b) => r > 150 && r > 1.5 * g && b > 60;
    assert.ok(seen.drives.count(isPink) > 500, "half of the drives saw each point");
    assert.equal(seen.scans.count(isPink), 0);
    assert.deepEqual(opened.complaints, []);
    await opened.page.close();
  });

  test("a tile is shown as each drive saw it", async () => {
    const { page: tile, complaints: said } = await open(at("report/2_0_0.html"));
    await tile.evaluate(() => window.viewer.ready);
    await settled(tile);
    const isPoint = (r, g, b) => Math.max(r, g, b) > 60 && Math.max(r, g, b) - Math.min(r, g, b) > 30;
    const drawn = async () => (await picture(tile)).count(isPoint);
    const all = await drawn();
    const slider = tile.getByLabel("Date", { exact: true });
    const share = {};
    for (const [value, name] of [["1", "south"], ["2", "north"], ["0", "all"]]) {
      await slider.fill(value);
      await settled(tile);
      assert.match(await tile.locator(".field", { has: slider }).innerText(), new RegExp(`Seen at\\s+${name}`));
      share[name] = (await drawn()) / all;
      await shot(tile, `city-date-${name}`);
    }
    assert.equal(share.all, 1);
    for (const name of ["south", "north"]) assert.ok(share[name] > 0.5 && share[name] < 0.99, `${name} has ${share[name]}`);
    assert.equal((await state(tile)).groups, -1);
    for (const name of ["south", "north"]) await tile.getByLabel(name, { exact: true }).uncheck();
    await settled(tile);
    assert.equal(await drawn(), 0);
    await tile.getByLabel("north", { exact: true }).check();
    assert.equal(await slider.inputValue(), "2");
    assert.deepEqual(said, []);
    await tile.close();
  });
});
