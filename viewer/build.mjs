// SPDX-License-Identifier: MIT
// node build.mjs OUT: the whole viewer as one HTML file that refers to nothing outside itself.
import { build } from "esbuild";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const MARKER = "<!--DATA-->";

const read = (file) => readFileSync(resolve(here, file), "utf8");

async function bundle() {
  const result = await build({
    absWorkingDir: here,
    entryPoints: ["src/main.js"],
    outdir: "out",
    bundle: true,
    minify: true,
    format: "iife",
    target: ["chrome100", "firefox113", "safari16.4"],  // all have DecompressionStream or nearly so
    charset: "utf8",
    legalComments: "none",  // the licences are given in full, see below
    write: false,
  });
  const text = (ending) => result.outputFiles.find((file) => file.path.endsWith(ending)).text;
  return { script: text(".js"), style: text(".css") };
}

function licences() {
  const of = (name) => `${name}\n\n${read(`node_modules/${name}/LICENSE`).trim()}`;
  return [of("three"), of("uplot")].join("\n\n");
}

/** What would end a script element, or begin a comment in it, is written so that it does not. */
const inScript = (code) => code.replaceAll(/<(?=\/script|!--)/gi, "\\x3C");

const out = process.argv[2];
if (!out) {
  console.error("usage: node build.mjs OUT");
  process.exit(2);
}
const { script, style } = await bundle();
const page = {
  STYLE: style.trim(),
  LICENCES: licences().replaceAll("<", "&lt;"),
  SCRIPT: inScript(script).trim(),
};
const html = read("src/index.html").replaceAll(/<!--([A-Z]+)-->/g, (all, name) => page[name] ?? all);
if (html.split(MARKER).length !== 2) throw new Error(`${MARKER} must be in the page exactly once`);
mkdirSync(dirname(resolve(out)), { recursive: true });
writeFileSync(out, html);
