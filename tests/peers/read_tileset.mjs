// SPDX-License-Identifier: MIT
// Prints what others find in a folder of 3D Tiles, as write_tileset prints what it wrote. Khronos'
// validator must find no fault in any .glb; three reads them. The rules of tileset.json that concern
// such a tileset are checked here: the validator of Cesium is not to be had from npm.
import fs from "node:fs";
import path from "node:path";
import validator from "gltf-validator";
import { Matrix4, Vector3 } from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import fnv1a from "./fnv1a.cjs";

const folder = process.argv[2];
const tileset = JSON.parse(fs.readFileSync(path.join(folder, "tileset.json")));
const demand = (holds, what) => {
  if (!holds) throw new Error(what);
};

async function pointsOf(uri) {
  const bytes = fs.readFileSync(path.join(folder, uri));
  const { issues } = await validator.validateBytes(new Uint8Array(bytes), { maxIssues: 20 });
  demand(issues.numErrors === 0 && issues.numWarnings === 0, `${uri}: ${JSON.stringify(issues.messages)}`);
  const { scene } = await new GLTFLoader().parseAsync(Uint8Array.from(bytes).buffer, "");
  scene.updateMatrixWorld(true);
  let points;
  scene.traverse((object) => object.isPoints && (points = object));
  return points;
}

/// From glTF's y up to z up, as the specification of 3D Tiles has it.
const zUp = new Matrix4().set(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1);

function positionsOf(points) {
  const matrix = new Matrix4().multiplyMatrices(zUp, points.matrixWorld);
  const position = points.geometry.getAttribute("position");
  return Array.from({ length: position.count }, (_, i) => new Vector3().fromBufferAttribute(position, i).applyMatrix4(matrix));
}

const boundsOf = ({ boundingVolume: { box } }) => [0, 1, 2].map((c) => [box[c] - box[3 + 4 * c], box[c] + box[3 + 4 * c]]);
const holds = (outer, inner, slack) => outer.every(([low, high], c) => inner[c][0] >= low - slack && inner[c][1] <= high + slack);

const lines = [];
async function visit(tile, parent) {
  demand(tile.boundingVolume.box.length === 12, "a box has 12 numbers");
  if (parent) {
    demand(tile.geometricError < parent.geometricError, "errors fall from parent to child");
    demand(holds(boundsOf(parent), boundsOf(tile), 1e-6), "a child lies within its parent");
    demand(!tile.transform, "only the root has a transform");
  }
  const { uri } = tile.content;
  const points = await pointsOf(uri);
  const places = positionsOf(points);
  const bounds = boundsOf(tile);
  for (const place of places) demand(holds(bounds, place.toArray().map((p) => [p, p]), 1e-4), `${uri}: a point lies outside of the box`);
  for (const child of tile.children ?? []) await visit(child, tile);
  if (tile.children) return;
  const name = path.basename(uri, ".glb");
  const print = (field, values) => lines.push([name, field, values.length, fnv1a(values)].join(" "));
  ["x", "y", "z"].forEach((axis) => print(axis, places.map((place) => Math.round(1000 * place[axis]))));
  for (const field of ["probability", "scans", "sessions_0", "sessions_1"]) print(field, Array.from(points.geometry.getAttribute(`_${field}`).array));
}

demand(tileset.asset.version === "1.1" && tileset.geometricError >= tileset.root.geometricError, "asset and error of the tileset");
demand(tileset.root.refine === "REPLACE" && tileset.root.transform.length === 16, "refinement and transform of the root");
await visit(tileset.root, null);
const order = (line) => line.slice(0, line.indexOf(" "));
console.log(lines.sort((a, b) => (order(a) < order(b) ? -1 : order(a) > order(b) ? 1 : 0)).join("\n"));
