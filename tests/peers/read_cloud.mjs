// SPDX-License-Identifier: MIT
// Prints what others' readers find in a cloud, as write_clouds prints what it wrote: for each field
// its name, and the number and FNV-1a of its values. PCD and PLY by three, LAS by copc.
import fs from "node:fs";
import { Las } from "copc";
import { PCDLoader } from "three/examples/jsm/loaders/PCDLoader.js";
import { PLYLoader } from "three/examples/jsm/loaders/PLYLoader.js";
import fnv1a from "./fnv1a.cjs";

const bufferOf = (bytes) => Uint8Array.from(bytes).buffer;

function columnsOf(geometry, dynamic) {
  const at = geometry.getAttribute("position").array;
  const axis = (first) => at.filter((_, i) => i % 3 === first);
  const own = (name) => geometry.getAttribute(name).array;
  return { x: axis(0), y: axis(1), z: axis(2), intensity: own("intensity"), dynamic: own(dynamic) };
}

/// three knows the field `label`, but not `dynamic`.
function readPcd(bytes) {
  const text = bytes.toString("latin1").replace(/^(FIELDS .*)dynamic/m, "$1label");
  return columnsOf(new PCDLoader().parse(bufferOf(Buffer.from(text, "latin1"))).geometry, "label");
}

function readPly(bytes) {
  const loader = new PLYLoader();
  loader.setCustomPropertyNameMapping({ intensity: ["intensity"], dynamic: ["dynamic"] });
  return columnsOf(loader.parse(bufferOf(bytes)), "dynamic");
}

async function readLas(bytes) {
  const header = Las.Header.parse(bytes);
  const get = async (begin, end) => bytes.subarray(begin, end);
  const vlrs = await Las.Vlr.walk(get, header);
  const extra = Las.ExtraBytes.parse(
    await Las.Vlr.fetch(get, Las.Vlr.find(vlrs, "LASF_Spec", 4)));
  const view = Las.View.create(bytes.subarray(header.pointDataOffset), header, extra);
  if (view.pointCount !== header.pointCount || header.pointCountByReturn[0] !== view.pointCount) {
    throw new Error(`${view.pointCount} points, but the header has ${header.pointCount}`);
  }
  const column = (name) => Array.from({ length: view.pointCount }, (_, i) => view.getter(name)(i));
  const axes = ["X", "Y", "Z"].map((name, i) => {
    const found = column(name);
    if (Math.min(...found) !== header.min[i] || Math.max(...found) !== header.max[i]) {
      throw new Error(`${name} is not within the header's bounds exactly`);
    }
    return found.map((value) => Math.round(1000 * value));
  });
  return { x: axes[0], y: axes[1], z: axes[2], intensity: column("intensity_exact"),
           dynamic: column("dynamic") };
}

const readers = { pcd: readPcd, ply: readPly, las: readLas };
const path = process.argv[2];
const columns = await readers[path.split(".").pop()](fs.readFileSync(path));
for (const [name, values] of Object.entries(columns)) {
  console.log(`${name} ${values.length} ${fnv1a(values)}`);
}
