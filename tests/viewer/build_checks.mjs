// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { open, ROOT, VIEWER } from "./support.mjs";

test("the page is one file with one place for the data", () => {
  assert.equal(VIEWER.split("<!--DATA-->").length, 2);
  assert.ok(VIEWER.indexOf("<!--DATA-->") < VIEWER.indexOf("<script>"), "the data come before the script");
  assert.equal(VIEWER.match(/<\/script/gi).length, 1, "nothing in the script ends it");
  const outside = VIEWER.slice(0, VIEWER.indexOf("<script>")).match(/ src=|href="(?!data:)|@import|url\((?!data:)/gi);
  assert.equal(outside, null);
  assert.ok(/Copyright © 2010-\d+ three\.js authors/.test(VIEWER), "the licences are in it");
});

test("building again gives the same bytes", () => {
  const folder = mkdtempSync(join(tmpdir(), "viewer-build-"));
  try {
    const out = join(folder, "viewer.html");
    execFileSync(join(ROOT, "viewer/build.py"), [out]);
    assert.ok(readFileSync(out, "utf8") === VIEWER, "the page given is not what the sources make now");
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test("a page without data says what it is", async () => {
  const { page, complaints } = await open(`file://${process.env.VIEWER_HTML}`);
  assert.match(await page.getByRole("alert").textContent(), /no data in this page/);
  assert.deepEqual(complaints, []);
  await page.close();
});
