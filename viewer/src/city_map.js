// SPDX-License-Identifier: MIT
// The tiles of a city from above on a canvas: pictures, outlines, trajectories. North is up.
import { kindColour, scaleColours } from "./colours.js";
import { currentTheme } from "./theme.js";

const TRACK_COLOURS = ["#ff8a3c", "#56b4e9", "#f0e442", "#e377c2", "#3fd0b0", "#ff5c5c", "#b39ddb", "#c5e1a5"];
export const trackColour = (k) => TRACK_COLOURS[k % TRACK_COLOURS.length];

/** 1 at least. */
export const greatest = (tiles, value) => tiles.reduce((most, tile) => Math.max(most, value(tile)), 1);

const ATLAS_WIDTH = 4096;  // px
const GREY = Uint8Array.from({ length: 3 * 256 }, (_, i) => 70 + 0.55 * Math.floor(i / 3));

/** What a tile's fill says: {value(tile, city), words}. */
export const MEASURES = {
  height: { label: "Height" },
  voxels: { label: "Voxels", value: ({ voxels }) => voxels },
  scans: { label: "Scans", value: ({ scans }) => scans },
  drives: { label: "Drives that saw it", value: ({ drives }) => drives.length },
};

/** Relief: lighter where the ground rises towards the north-west. */
function shade(values, edge, at, hasNorth, hasWest) {
  const here = values[at];
  const west = (hasWest && values[at - 1]) || here;
  const north = (hasNorth && values[at - edge]) || here;
  return Math.min(1.35, Math.max(0.6, 1 + 0.02 * (2 * here - west - north)));
}

/** All tiles' pictures on one canvas, each in a slot of its own. */
class Atlas {
  constructor(tiles, pictures) {
    this.slot = greatest(tiles, ({ edge }) => edge) + 2;  // a gap, so that no neighbour bleeds in
    this.columns = Math.max(1, Math.floor(ATLAS_WIDTH / this.slot));
    this.canvas = document.createElement("canvas");
    this.canvas.width = this.columns * this.slot;
    this.canvas.height = Math.max(1, Math.ceil(tiles.length / this.columns)) * this.slot;
    this.tiles = tiles;
    this.pictures = pictures;
  }

  place(i) {
    return [(i % this.columns) * this.slot, Math.floor(i / this.columns) * this.slot];
  }

  paint(colours) {
    const context = this.canvas.getContext("2d");
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    let begin = 0;
    this.tiles.forEach(({ edge }, i) => {
      const values = this.pictures.subarray(begin, begin + edge * edge);
      begin += edge * edge;
      const image = context.createImageData(edge, edge);
      for (let at = 0; at < values.length; ++at) {
        const value = values[at];
        if (value === 0) continue;
        const light = shade(values, edge, at, at >= edge, at % edge > 0);
        for (let c = 0; c < 3; ++c) image.data[4 * at + c] = light * colours[3 * value + c];
        image.data[4 * at + 3] = 255;
      }
      context.putImageData(image, ...this.place(i));
    });
  }
}

export class CityMap {
  frames = 0;
  #wanted = false;

  /** `settings`: {colour, drive, tracks, outlines, names, selected}. */
  constructor(element, { tiles, origin, tracks }, settings) {
    this.element = element;
    this.settings = settings;
    const placed = (west, south, side) => ({ west: west - origin[0], south: south - origin[1], side });
    this.tiles = tiles.map((tile) => ({ ...tile, ...placed(tile.west, tile.south, tile.side), filled: placed(...tile.picture) }));
    this.tracks = tracks;
    this.canvas = document.createElement("canvas");
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "application");
    this.canvas.setAttribute("aria-label", "Tiles from above. Arrows move, plus and minus zoom; the panel Tiles lists them.");
    element.prepend(this.canvas);
    this.context = this.canvas.getContext("2d");
    this.centre = [0, 0];  // m
    this.scale = 1;  // px per m
    new ResizeObserver(() => this.resize()).observe(element);
    this.resize();
    this.fit();
  }

  /** To be followed by repaint(). */
  setPictures(pictures) {
    this.atlas = new Atlas(this.tiles, pictures);
  }

  /** Colours have changed. */
  repaint() {
    const byHeight = this.settings.colour === "height";
    this.atlas?.paint(byHeight ? scaleColours("viridis") : GREY);
    this.redraw();
  }

  resize() {
    const ratio = Math.min(window.devicePixelRatio, 2);
    this.width = this.element.clientWidth;
    this.height = this.element.clientHeight;
    this.canvas.width = Math.round(this.width * ratio);
    this.canvas.height = Math.round(this.height * ratio);
    this.ratio = ratio;
    this.redraw();
  }

  /** The box of what all tiles hold [west, south, east, north], m. */
  get extent() {
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    for (const { filled: { west, south, side } } of this.tiles) {
      box[0] = Math.min(box[0], west);
      box[1] = Math.min(box[1], south);
      box[2] = Math.max(box[2], west + side);
      box[3] = Math.max(box[3], south + side);
    }
    return this.tiles.length ? box : [0, 0, 100, 100];
  }

  fit() {
    const [west, south, east, north] = this.extent;
    this.show([(west + east) / 2, (south + north) / 2], 0.92 * Math.min(this.width / (east - west), this.height / (north - south)));
  }

  show(centre, scale) {
    this.centre = centre;
    this.scale = Math.min(200, Math.max(1e-4, scale));
    this.redraw();
  }

  /** Keeps the place under (x, y). */
  zoom(factor, x = this.width / 2, y = this.height / 2) {
    const place = this.placeAt(x, y);
    const scale = Math.min(200, Math.max(1e-4, this.scale * factor));
    this.show([place[0] - (x - this.width / 2) / scale, place[1] + (y - this.height / 2) / scale], scale);
  }

  pan(dx, dy) {
    this.show([this.centre[0] - dx / this.scale, this.centre[1] + dy / this.scale], this.scale);
  }

  placeAt(x, y) {
    return [this.centre[0] + (x - this.width / 2) / this.scale, this.centre[1] - (y - this.height / 2) / this.scale];
  }

  project([east, north]) {
    return [this.width / 2 + (east - this.centre[0]) * this.scale, this.height / 2 - (north - this.centre[1]) * this.scale];
  }

  /** Index of the tile at a pixel, or -1. */
  tileAt(x, y) {
    const [east, north] = this.placeAt(x, y);
    return this.tiles.findIndex(({ west, south, side }) => east >= west && east < west + side && north >= south && north < south + side);
  }

  redraw() {
    if (this.#wanted) return;
    this.#wanted = true;
    requestAnimationFrame(() => {
      this.#wanted = false;
      this.#draw();
      ++this.frames;
    });
  }

  get idle() {
    return !this.#wanted;
  }

  #draw() {
    const { context } = this;
    const theme = currentTheme();
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.fillStyle = kindColour(theme, "background");
    context.fillRect(0, 0, this.width, this.height);
    const seen = this.tiles.map((tile, i) => ({ tile, i, box: this.#boxOf(tile) })).filter(({ box }) => this.#inView(box));
    for (const { tile, i, box } of seen) this.#drawTile(tile, i, box, theme);
    if (this.settings.tracks) this.#drawTracks();
    for (const { tile, box } of seen) this.#drawName(tile, box);
    this.#drawSelected();
  }

  #boxOf({ west, south, side }) {
    const [left, top] = this.project([west, south + side]);
    return [left, top, side * this.scale];
  }

  #inView([left, top, size]) {
    return left < this.width && top < this.height && left + size > 0 && top + size > 0;
  }

  #drawTile(tile, i, [left, top, size], theme) {
    const { context, settings } = this;
    const { value } = MEASURES[settings.colour];
    if (this.atlas && tile.edge) {
      const [x, y, pixels] = this.#boxOf(tile.filled);
      context.imageSmoothingEnabled = pixels < 2 * tile.edge;
      context.drawImage(this.atlas.canvas, ...this.atlas.place(i), tile.edge, tile.edge, x, y, pixels, pixels);
    }
    if (value) {
      this.most ??= {};
      const most = (this.most[settings.colour] ??= greatest(this.tiles, value));
      const colours = scaleColours("cividis"), at = 3 * Math.round((255 * value(tile)) / most);
      context.fillStyle = `rgb(${colours.slice(at, at + 3).join(" ")} / 62%)`;
      context.fillRect(left, top, size, size);
    }
    if (settings.drive >= 0 && !tile.drives.includes(settings.drive)) {
      context.globalAlpha = 0.75;
      context.fillStyle = kindColour(theme, "background");
      context.fillRect(left, top, size, size);
      context.globalAlpha = 1;
    }
    if (!settings.outlines || size < 12) return;  // they would be all that is seen
    context.strokeStyle = kindColour(theme, "mark");
    context.globalAlpha = 0.35;
    context.lineWidth = 1;
    context.strokeRect(Math.round(left) + 0.5, Math.round(top) + 0.5, Math.round(size), Math.round(size));
    context.globalAlpha = 1;
  }

  #drawTracks() {
    const { context, settings } = this;
    const { begin, positions } = this.tracks;
    context.lineJoin = "round";
    for (let k = 0; k + 1 < begin.length; ++k) {
      const chosen = settings.drive === k;
      context.globalAlpha = settings.drive < 0 || chosen ? 0.95 : 0.2;
      context.lineWidth = chosen ? 3.5 : 2;
      context.strokeStyle = trackColour(k);
      context.beginPath();
      for (let i = begin[k]; i < begin[k + 1]; ++i) {
        const at = this.project([positions[2 * i], positions[2 * i + 1]]);
        if (i === begin[k]) context.moveTo(...at);
        else context.lineTo(...at);
      }
      context.stroke();
    }
    context.globalAlpha = 1;
  }

  #drawName(tile, [left, top, size]) {
    if (!this.settings.outlines || size < 74) return;
    const { context } = this;
    const x = Math.max(left, 0), y = Math.max(top, 0);  // of a large tile the corner may be far away
    const { value } = MEASURES[this.settings.colour];
    const lines = [tile.name, ...(value ? [value(tile).toLocaleString("en-GB")] : [])];
    context.font = "12px system-ui, sans-serif";
    const width = Math.max(...lines.map((line) => context.measureText(line).width));
    context.fillStyle = currentTheme() === "dark" ? "rgb(14 17 22 / 72%)" : "rgb(255 255 255 / 78%)";
    context.fillRect(x + 4, y + 4, width + 10, 16 * lines.length + 4);
    context.fillStyle = kindColour(currentTheme(), "mark");
    lines.forEach((line, i) => context.fillText(line, x + 9, y + 18 + 16 * i));
  }

  #drawSelected() {
    const tile = this.tiles[this.settings.selected];
    if (!tile) return;
    const [left, top, size] = this.#boxOf(tile);
    this.context.strokeStyle = kindColour(currentTheme(), "corrected");
    this.context.lineWidth = 3;
    this.context.strokeRect(left, top, size, size);
  }
}
