// SPDX-License-Identifier: MIT
// The data in the page, as viewer/README.md lays them down.

const TYPES = {
  uint8: Uint8Array,
  uint16: Uint16Array,
  uint32: Uint32Array,
  int32: Int32Array,
  float32: Float32Array,
  float64: Float64Array,
};

export const NO_VOXEL = 0xffffffff;
export const UNKNOWN = 0, STATIC = 1, DYNAMIC = 2, NOT_RECORDED = 3;
export const NO_COUNT = 0xffffffff;

export const finalOf = (verdict) => verdict & 3;
export const truthOf = (verdict) => (verdict >> 2) & 3;
export const instantOf = (verdict) => (verdict >> 4) & 3;

export const hasTruth = (verdict) => truthOf(verdict) === STATIC || truthOf(verdict) === DYNAMIC;
export const isCorrected = (verdict) => instantOf(verdict) !== NOT_RECORDED && instantOf(verdict) !== finalOf(verdict);

const bytesOf = Uint8Array.fromBase64?.bind(Uint8Array) ?? ((text) => {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
});

/** Base64 in pieces, so that a large array is never in memory as one more string. */
async function* decoded(text) {
  const PIECE = 1 << 20;  // a multiple of 4: no piece ends within a group
  for (let at = 0; at < text.length; at += PIECE) yield bytesOf(text.slice(at, at + PIECE));
}

async function feed(writer, pieces) {
  for await (const piece of pieces) await writer.write(piece);
  await writer.close();
}

/** The bytes of base64 of gzip; throws unless there are `size` of them. */
async function inflate(text, size) {
  const stream = new DecompressionStream("gzip");
  const fed = feed(stream.writable.getWriter(), decoded(text));
  const bytes = new Uint8Array(size);
  const reader = stream.readable.getReader();
  let filled = 0;
  for (let next = await reader.read(); !next.done; next = await reader.read()) {
    if (filled + next.value.length > size) throw new Error(`more than the ${size} bytes announced`);
    bytes.set(next.value, filled);
    filled += next.value.length;
  }
  await fed;
  if (filled !== size) throw new Error(`${filled} bytes where ${size} were announced`);
  return bytes;
}

/** One run of the page: `meta` at once, the arrays as they are decoded. */
export class Run {
  constructor(number, meta) {
    this.number = number;
    this.meta = meta;
    this.arrays = {};  // by name, those decoded so far
  }

  has(name) {
    return name in (this.meta.arrays ?? {});
  }

  /** Decodes an array; undefined where the run has none. Its text leaves the page, to free the memory. */
  async load(name) {
    if (this.arrays[name] || !this.has(name)) return this.arrays[name];
    const { type, columns, rows } = this.meta.arrays[name];
    const Type = TYPES[type];
    const id = `run-${this.number}-${name}`;
    const element = document.getElementById(id);
    if (!Type || !element) throw new Error(`${id} is ${Type ? "missing" : `of the unknown type ${type}`}`);
    try {
      const bytes = await inflate(element.textContent.trim(), columns * rows * Type.BYTES_PER_ELEMENT);
      element.remove();
      return (this.arrays[name] = new Type(bytes.buffer));
    } catch (error) {
      throw new Error(`${id} is damaged: ${error.message}`, { cause: error });
    }
  }

  async loadAll(names) {
    for (const name of names) await this.load(name);
  }
}

/** The runs in the page, in order. */
export function runsInPage() {
  const runs = [];
  for (let k = 0; ; ++k) {
    const element = document.getElementById(`run-${k}`);
    if (!element) return runs;
    runs.push(new Run(k, JSON.parse(element.textContent)));
  }
}
