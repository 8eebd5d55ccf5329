// SPDX-License-Identifier: MIT
// Points by the cells of the world's grid, and the cells that a correction takes in.
import { finalOf, STATIC } from "./data.js";

export const NAMES = ["unknown", "static", "dynamic"];  // by verdict
const MOST_CELLS = 20_000;  // of an instance
const REACH = 20;  // m from the point clicked
const GROUND_AROUND = 1;  // m within which the lowest static cell is looked for

const NEIGHBOURS = [-1, 0, 1].flatMap((z) => [-1, 0, 1].flatMap((y) => [-1, 0, 1].map((x) => [x, y, z]))).filter((d) => d.some(Boolean));

/** The points of a cloud by cell. `base` are the filter's verdicts: those of the page, before any correction. */
export class CellIndex {
  #heads = new Map();  // cell to its last point
  #next;  // the point before it in the same cell
  #columns = null;  // lowest static cell, by column

  constructor(cloud, origin, edge) {
    this.cloud = cloud;
    this.edge = edge;
    this.base = cloud.verdicts.slice();
    const { low, step, positions } = cloud;
    this.tables = low.map((l, c) => Int32Array.from({ length: 65536 }, (_, q) => Math.floor((origin[c] + l + step * q) / edge)));
    this.first = this.tables.map((table) => table[0] - 1);
    this.size = this.tables.map((table, c) => table[65535] - this.first[c] + 2);
    this.#next = new Int32Array(positions.length / 3);
    for (let i = 0; i < this.#next.length; ++i) {
      const key = this.keyOf(this.cellOf(i));
      this.#next[i] = this.#heads.get(key) ?? -1;
      this.#heads.set(key, i);
    }
  }

  cellOf(i) {
    const { positions } = this.cloud;
    return [0, 1, 2].map((c) => this.tables[c][positions[3 * i + c]]);
  }

  keyOf(cell) {
    const [x, y, z] = cell.map((at, c) => at - this.first[c]);
    if (x < 0 || y < 0 || z < 0 || x >= this.size[0] || y >= this.size[1] || z >= this.size[2]) return -1;
    return x + this.size[0] * (y + this.size[1] * z);
  }

  cellOfKey(key) {
    const [nx, ny] = this.size;
    return [key % nx, Math.floor(key / nx) % ny, Math.floor(key / nx / ny)].map((at, c) => at + this.first[c]);
  }

  *pointsIn(key) {
    for (let i = this.#heads.get(key) ?? -1; i >= 0; i = this.#next[i]) yield i;
  }

  #has(key, verdict) {
    for (const i of this.pointsIn(key)) if (finalOf(this.cloud.verdicts[i]) === verdict) return true;
    return false;
  }

  #holdsBase(key, verdict) {
    for (const i of this.pointsIn(key)) if (finalOf(this.base[i]) === verdict) return true;
    return false;
  }

  #lowest(x, y) {
    if (!this.#columns) {
      this.#columns = new Map();
      for (const [key, i] of this.#heads) {
        if (finalOf(this.base[i]) !== STATIC && !this.#holdsBase(key, STATIC)) continue;
        const [cx, cy, cz] = this.cellOfKey(key);
        const column = this.keyOf([cx, cy, this.first[2]]);
        this.#columns.set(column, Math.min(cz, this.#columns.get(column) ?? Infinity));
      }
    }
    return this.#columns.get(this.keyOf([x, y, this.first[2]])) ?? Infinity;
  }

  /** Not more than a cell above the lowest static cell nearby. */
  isGround([x, y, z]) {
    const reach = Math.round(GROUND_AROUND / this.edge);
    let lowest = Infinity;
    for (let dx = -reach; dx <= reach; ++dx) {
      for (let dy = -reach; dy <= reach; ++dy) lowest = Math.min(lowest, this.#lowest(x + dx, y + dy));
    }
    return z <= lowest + 1;
  }

  /** Cells of the verdict that hang together with the cell, through faces, edges and corners: {keys, cut}. */
  instanceAt(cell, verdict) {
    const start = this.keyOf(cell);
    const seen = new Set([start]), queue = [start];
    const reach = REACH / this.edge;
    const far = (other) => Math.hypot(...other.map((o, c) => o - cell[c])) > reach;
    let cut = false;
    for (let at = 0; at < queue.length; ++at) {
      const from = this.cellOfKey(queue[at]);
      for (const d of NEIGHBOURS) {
        const other = from.map((f, c) => f + d[c]);
        const key = this.keyOf(other);
        if (key < 0 || seen.has(key) || !this.#has(key, verdict)) continue;
        seen.add(key);
        if (verdict === STATIC && this.isGround(other)) continue;
        if (far(other) || queue.length >= MOST_CELLS) {
          cut = true;
          continue;
        }
        queue.push(key);
      }
    }
    return { keys: queue, cut };
  }

  /** Points in the cells whose verdict is now one of `verdicts`. */
  pointsOf(keys, verdicts) {
    return keys.flatMap((key) => [...this.pointsIn(key)].filter((i) => verdicts.includes(finalOf(this.cloud.verdicts[i]))));
  }

  /**
   * The cells of points as an edit names them: by the filter's verdict, runs of x, y, z, count. Cells beside them in
   * which the page shows no point of that verdict go with them: points that the page leaves out, or rounds, may lie there.
   */
  cellsOf(points) {
    const sets = [new Set(), new Set(), new Set()];
    for (const i of points) sets[finalOf(this.base[i])].add(this.keyOf(this.cellOf(i)));
    const cells = {};
    sets.forEach((set, verdict) => {
      if (set.size === 0) return;
      const all = new Set(set);
      for (const key of set) {
        const cell = this.cellOfKey(key);
        for (const d of NEIGHBOURS) {
          const other = this.keyOf(cell.map((c, axis) => c + d[axis]));
          if (other >= 0 && !this.#holdsBase(other, verdict)) all.add(other);
        }
      }
      cells[NAMES[verdict]] = runsOf([...all].sort((a, b) => a - b), this);
    });
    return cells;
  }

  /** Gives the cloud's points the verdict of an edit. `rowOf(i)`: the scan of a point. */
  apply(edit, rowOf) {
    const { verdicts } = this.cloud;
    const label = NAMES.indexOf(edit.label);
    for (const [name, numbers] of Object.entries(edit.cells)) {
      const from = NAMES.indexOf(name);
      for (let at = 0; at < numbers.length; at += 4) {
        for (let k = 0; k < numbers[at + 3]; ++k) {
          const key = this.keyOf([numbers[at] + k, numbers[at + 1], numbers[at + 2]]);
          if (key < 0) continue;
          for (const i of this.pointsIn(key)) {
            if (finalOf(this.base[i]) !== from) continue;
            const row = edit.scans && rowOf(i);
            if (edit.scans && !(row >= edit.scans[0] && row <= edit.scans[1])) continue;
            verdicts[i] = (verdicts[i] & ~3) | label;
          }
        }
      }
    }
  }
}

/** Keys in order have the cells of a row along x side by side. */
function runsOf(keys, index) {
  const runs = [];
  let last = -2;
  for (const key of keys) {
    const cell = index.cellOfKey(key);
    const goesOn = key === last + 1 && cell[1] === runs.at(-3) && cell[2] === runs.at(-2);
    if (goesOn) ++runs[runs.length - 1];
    else runs.push(...cell, 1);
    last = key;
  }
  return runs;
}
