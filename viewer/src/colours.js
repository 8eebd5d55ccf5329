// SPDX-License-Identifier: MIT
// All colours of points. Kinds are told apart by hue and by brightness, scales are even to the eye.

const KINDS = {
  dark: {
    background: "#0e1116", unknown: "#cc79a7", static: "#a7b0ba", dynamic: "#e8590c", corrected: "#56b4e9",
    rightStatic: "#6b747e", rightDynamic: "#4a86b0", falseRemoved: "#ff6a13", missed: "#fff04d", none: "#59616b",
    path: "#3fd0b0", alarm: "#ff5470", sensor: "#ffffff", mark: "#ffffff",
  },
  light: {
    background: "#f3f5f8", unknown: "#a83d7c", static: "#7d8792", dynamic: "#d55e00", corrected: "#0072b2",
    rightStatic: "#aab2bb", rightDynamic: "#6fa8cf", falseRemoved: "#e05a00", missed: "#16213e", none: "#b4bcc5",
    path: "#00795c", alarm: "#c1121f", sensor: "#10151c", mark: "#10151c",
  },
};

/** Kinds in the order in which the shader knows them. */
export const KIND_ORDER = [
  "unknown", "static", "dynamic", "corrected", "rightStatic", "rightDynamic", "falseRemoved", "missed", "none",
];

const SCALES = {
  viridis: ["#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"],
  cividis: ["#00224e", "#123570", "#3b496c", "#575d6d", "#707173", "#8a8678", "#a59c74", "#c3b369", "#fee838"],
  plasma: ["#0d0887", "#4c02a1", "#7e03a8", "#aa2395", "#cc4778", "#e66c5c", "#f89540", "#fdc527", "#f0f921"],
  odds: ["#d55e00", "#e3833a", "#eec29b", "#d9dcdf", "#9cc3dd", "#4b97c6", "#0072b2"],
};
const SCALE_ORDER = Object.keys(SCALES);

/**
 * Colourings in the order in which the shader knows them. `needs`: the array that this colouring uses;
 * `flag`: a property that the run must have.
 */
export const COLOURINGS = [
  { id: "verdict", label: "Verdict" },
  { id: "instant", label: "Front-end verdict", flag: "has_instant" },
  { id: "error", label: "Error", flag: "has_truth" },
  { id: "height", label: "Height", scale: "viridis" },
  { id: "intensity", label: "Intensity", scale: "cividis", needs: "map-intensity" },
  { id: "probability", label: "Probability of being static", scale: "odds", needs: "map-voxel" },
  { id: "time", label: "Time", scale: "plasma", needs: "map-scan" },
  { id: "scans", label: "Scans that saw it", scale: "cividis", needs: "map-scans" },
  { id: "drives", label: "Drives that saw it", scale: "plasma", needs: "map-drives" },
];

export const colouringsOf = (run) =>
  COLOURINGS.filter(({ flag, needs }) => (!flag || run.meta[flag]) && (!needs || run.has(needs)));

export const kindColour = (theme, kind) => KINDS[theme][kind];
export const scaleGradient = (scale) => `linear-gradient(to right, ${SCALES[scale].join(", ")})`;

/** `known(id)`: which of them a view can show. */
export const colouringsWhere = (known) => COLOURINGS.filter(({ id }) => known(id));

const channels = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));

/** Flat rgb triples 0..1 of all kinds. */
export const kindPalette = (theme) =>
  KIND_ORDER.flatMap((kind) => channels(KINDS[theme][kind]).map((c) => c / 255));

export const rgb = (hex) => channels(hex).map((c) => c / 255);

/** All scales as the rows of one RGBA image, `width` wide. */
export function scaleImage(width) {
  const image = new Uint8Array(4 * width * SCALE_ORDER.length);
  SCALE_ORDER.forEach((name, row) => {
    const stops = SCALES[name].map(channels);
    for (let x = 0; x < width; ++x) {
      const at = (x / (width - 1)) * (stops.length - 1);
      const i = Math.min(Math.floor(at), stops.length - 2);
      for (let c = 0; c < 3; ++c) {
        image[4 * (row * width + x) + c] = stops[i][c] + (at - i) * (stops[i + 1][c] - stops[i][c]);
      }
      image[4 * (row * width + x) + 3] = 255;
    }
  });
  return { image, rows: SCALE_ORDER.length };
}

/** A scale as 256 rgb triples 0..255. */
export function scaleColours(name) {
  const { image } = scaleImage(256);
  const row = 4 * 256 * SCALE_ORDER.indexOf(name);
  return Uint8Array.from({ length: 3 * 256 }, (_, i) => image[row + 4 * Math.floor(i / 3) + (i % 3)]);
}

export const scaleRow = (id) => SCALE_ORDER.indexOf(COLOURINGS.find((c) => c.id === id)?.scale);
export const colouringIndex = (id) => COLOURINGS.findIndex((c) => c.id === id);
