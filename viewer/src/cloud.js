// SPDX-License-Identifier: MIT
// Points on the GPU as they are in the page: quantised, one attribute per array, no copies.
import * as THREE from "three";
import { colouringIndex, kindPalette, kindColour, rgb, scaleImage, scaleRow } from "./colours.js";
import { finalOf, instantOf } from "./data.js";
import { ALL_GROUPS } from "./groups.js";
import { pointFragment, pointVertex } from "./shaders.js";

const ALL = [-1e9, 1e9];

const scales = (() => {
  const { image, rows } = scaleImage(256);
  const texture = new THREE.DataTexture(image, 256, rows);
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return { texture, rows };
})();

const nowhere = (() => {
  const texture = new THREE.DataTexture(new Uint8Array(1), 1, 1, THREE.RedFormat);
  texture.needsUpdate = true;
  return texture;
})();

function uniforms({ low, step }) {
  const value = (v) => ({ value: v });
  return {
    low: value(new THREE.Vector3(...low)), stepSize: value(step),
    palette: value([]), background: value(new THREE.Color()), scales: value(scales.texture), scaleCoordinate: value(0),
    mode: value(0), layers: value(7), shownGroups: value(ALL_GROUPS), markCorrected: value(false), fade: value(0),
    heightScale: value(new THREE.Vector2(0, 1)),
    heightCut: value(new THREE.Vector2(...ALL)), rangeCut: value(new THREE.Vector2(...ALL)), fromPath: value(false),
    sensor: value(new THREE.Vector3()), pathDistance: value(nowhere), pathBox: value(new THREE.Vector4(0, 0, 1, 1)),
    pathReach: value(1), pointWorld: value(0.1), pointLeast: value(1), pixelsPerMetre: value(500),
  };
}

export class Cloud {
  /** Position = low + step * p, drawn in this order. `shares`: another cloud whose GPU arrays are used; this one draws a range of them. */
  constructor({ positions, verdicts, low, step, shares = null }) {
    this.positions = positions;
    this.verdicts = verdicts;
    this.low = low;
    this.step = step;
    this.begin = 0;
    this.end = positions.length / 3;
    this.groups = null;  // by point, bits
    this.settings = { layers: 7, groups: ALL_GROUPS, instant: false, height: ALL, range: ALL, fromPath: false, sensor: [0, 0, 0] };
    this.field = null;  // distance from the path
    this.geometry = new THREE.BufferGeometry();
    if (shares) {
      for (const name of ["position", "verdict"]) this.geometry.setAttribute(name, shares.geometry.getAttribute(name));
    } else {
      this.setAttribute("position", positions, 3);
      this.setAttribute("verdict", verdicts);
    }
    this.material = new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3, vertexShader: pointVertex, fragmentShader: pointFragment, uniforms: uniforms(this),
    });
    this.object = new THREE.Points(this.geometry, this.material);
    this.object.frustumCulled = false;
    this.object.matrixAutoUpdate = false;
  }

  get count() {
    return this.object.visible ? this.end - this.begin : 0;
  }

  setAttribute(name, array, columns = 1, normalised = false) {
    this.geometry.setAttribute(name, new THREE.BufferAttribute(array, columns, normalised));
  }

  setUniforms(values) {
    for (const [name, value] of Object.entries(values)) {
      const uniform = this.material.uniforms[name];
      if (Array.isArray(value) && uniform.value?.fromArray) uniform.value.fromArray(value);
      else uniform.value = value;
    }
  }

  /** Only points [begin, end) belong to the cloud for now. */
  setRange(begin, end) {
    this.begin = begin;
    this.end = end;
  }

  /** Of the cloud's points, those from the `first`, `n` at most, are drawn by the next render. */
  setDrawn(first, n) {
    const begin = Math.min(this.begin + first, this.end);
    this.geometry.setDrawRange(begin, Math.max(0, Math.min(n, this.end - begin)));
  }

  setTheme(theme) {
    const palette = kindPalette(theme);
    this.setUniforms({
      palette: Array.from({ length: palette.length / 3 }, (_, i) => new THREE.Vector3().fromArray(palette, 3 * i)),
      background: rgb(kindColour(theme, "background")),
    });
  }

  setColouring(id) {
    this.settings.instant = id === "instant";
    this.setUniforms({ mode: Math.max(0, colouringIndex(id)), scaleCoordinate: (scaleRow(id) + 0.5) / scales.rows });
  }

  setLayers(verdicts) {
    this.settings.layers = verdicts.reduce((bits, verdict) => bits | (1 << verdict), 0);
    this.setUniforms({ layers: this.settings.layers });
  }

  /** By point, a bit for each that saw it. */
  setGroups(groups) {
    this.groups = groups;
    this.setAttribute("groups", new Uint16Array(groups.buffer, groups.byteOffset, 2 * groups.length), 2);  // floats hold 16 bits
  }

  showGroups(bits) {
    this.settings.groups = this.groups ? bits : ALL_GROUPS;
    this.setUniforms({ shownGroups: this.settings.groups });
  }

  setCuts({ height, range, fromPath, sensor }) {
    Object.assign(this.settings, { height: height ?? ALL, range: range ?? ALL, fromPath: fromPath && !!this.field, sensor });
    this.setUniforms({
      heightCut: this.settings.height, rangeCut: this.settings.range, fromPath: this.settings.fromPath, sensor,
    });
  }

  setPathField(field) {
    this.field = field;
    this.setUniforms({ pathDistance: field.texture, pathBox: field.box, pathReach: field.reach });
  }

  position(i) {
    return [0, 1, 2].map((c) => this.low[c] + this.step * this.positions[3 * i + c]);
  }

  /** Whether the shader would draw a point there: the same tests as in the vertex shader. */
  shows(i, x, y, z) {
    const { layers, groups, instant, height, range, fromPath, sensor } = this.settings;
    if (groups !== ALL_GROUPS && (this.groups[i] & groups) === 0) return false;
    const verdict = this.verdicts[i];
    if (((layers >> ((instant ? instantOf(verdict) : finalOf(verdict)) % 3)) & 1) === 0) return false;
    if (z < height[0] || z > height[1]) return false;
    if (range === ALL) return true;
    const away = fromPath ? this.field.at(x, y) : Math.hypot(x - sensor[0], y - sensor[1], z - sensor[2]);
    return away >= range[0] && away <= range[1];
  }

  dispose() {
    this.geometry.dispose();
    this.material.dispose();
  }
}
