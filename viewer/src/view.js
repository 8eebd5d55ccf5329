// SPDX-License-Identifier: MIT
// One canvas: clouds, what is drawn over them, and when. Nothing is drawn while nothing changes.
import * as THREE from "three";
import { kindColour } from "./colours.js";
import { FIELD_OF_VIEW } from "./orbit.js";
import { screenFragment, screenVertex } from "./shaders.js";

const NEAR = 0.1, FAR = 4000;
const REST = 160;  // ms without a movement after which everything is drawn
const PAUSE = 1500;  // ms from frame to frame: not the same movement
const SLOW = 80, QUICK = 34;  // ms from frame to frame: fewer, or more, points in the next

function screenPass() {
  const material = new THREE.ShaderMaterial({
    glslVersion: THREE.GLSL3, vertexShader: screenVertex, fragmentShader: screenFragment, depthTest: false, depthWrite: false,
    uniforms: {
      colours: { value: null }, depths: { value: null }, texel: { value: new THREE.Vector2() },
      nearPlane: { value: NEAR }, farPlane: { value: FAR }, strength: { value: 0 },
    },
  });
  const geometry = new THREE.BufferGeometry();  // one triangle that covers the screen
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
  const triangle = new THREE.Mesh(geometry, material);
  triangle.frustumCulled = false;
  const scene = new THREE.Scene();
  scene.add(triangle);
  return { scene, uniforms: material.uniforms };
}

export class View {
  #last = 0;  // time of the last frame of a movement
  #wanted = false;
  #restTimer = 0;
  #fresh = true;  // the picture has to begin anew

  /** `offset`: from the page's origin to that of the view's run, m. */
  constructor(element, orbit, offset = [0, 0, 0]) {
    this.element = element;
    this.orbit = orbit;
    this.offset = offset;
    this.clouds = [];  // drawn in this order
    this.budget = 150_000;  // points a frame while something moves
    this.drawn = 0;  // points of the current picture so far
    this.frames = 0;
    this.moving = false;
    this.background = new THREE.Color();
    this.renderer = new THREE.WebGLRenderer({ antialias: false, powerPreference: "high-performance" });
    this.renderer.autoClear = false;
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    element.prepend(this.canvas);
    this.camera = new THREE.PerspectiveCamera((FIELD_OF_VIEW * 180) / Math.PI, 1, NEAR, FAR);
    this.camera.up.set(0, 0, 1);
    this.points = new THREE.Scene();
    this.overlay = new THREE.Scene();
    this.target = new THREE.WebGLRenderTarget(1, 1, { depthTexture: new THREE.DepthTexture(1, 1, THREE.UnsignedIntType) });
    this.screen = screenPass();
    new ResizeObserver(() => this.resize()).observe(element);
    this.canvas.addEventListener("webglcontextrestored", () => this.redraw());
    orbit.watch(() => this.move());
    this.resize();
  }

  add(cloud) {
    this.clouds.push(cloud);
    cloud.setTheme(this.theme ?? "dark");
    this.points.add(cloud.object);
    this.redraw();
  }

  remove(cloud) {
    this.clouds = this.clouds.filter((other) => other !== cloud);
    this.points.remove(cloud.object);
    cloud.dispose();
    this.redraw();
  }

  setTheme(theme) {
    this.theme = theme;
    this.background = new THREE.Color(kindColour(theme, "background"));
    for (const cloud of this.clouds) cloud.setTheme(theme);
    this.redraw();
  }

  get aspect() {
    return this.camera.aspect;
  }

  get total() {
    return this.clouds.reduce((sum, cloud) => sum + cloud.count, 0);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    const size = this.renderer.getDrawingBufferSize(new THREE.Vector2());
    this.target.setSize(size.x, size.y);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.onresize?.(size);
    this.redraw();
  }

  /** The camera or the scan changes quickly: a beginning of the points will do until it rests. */
  move() {
    this.moving = true;
    clearTimeout(this.#restTimer);
    this.#restTimer = setTimeout(() => this.#settle(), REST);
    this.redraw();
  }

  #settle() {
    if (this.#wanted) {  // frames take longer than the rest: the last of the movement is not drawn yet
      this.#restTimer = setTimeout(() => this.#settle(), REST);
      return;
    }
    this.moving = false;
    this.redraw();
  }

  /** Something that is seen has changed. */
  redraw() {
    this.#fresh = true;
    this.#request();
  }

  #request() {
    if (this.#wanted) return;
    this.#wanted = true;
    requestAnimationFrame((now) => {
      this.#wanted = false;
      this.#frame(now);
    });
  }

  /** From frame to frame of a movement; its first one says nothing. */
  #adapt(now) {
    const took = now - this.#last;
    this.#last = now;
    if (took > PAUSE) return;
    if (took > SLOW) this.budget = Math.max(60_000, this.budget * 0.75);
    else if (took < QUICK) this.budget = Math.min(20_000_000, this.budget * 1.2);
  }

  #frame(now) {
    if (this.target.width <= 1) return;
    this.placeCamera();
    if (this.moving) this.#adapt(now);
    const { renderer } = this;
    renderer.setRenderTarget(null);
    renderer.setClearColor(this.background, 1);  // before the target is set: its colours would be taken as linear
    renderer.setRenderTarget(this.target);
    if (this.#fresh) {
      renderer.clear();
      this.drawn = 0;
      this.#fresh = false;
    }
    this.#drawPoints(Math.round(this.moving ? this.budget : 1.5 * this.budget));
    const complete = this.drawn >= this.total;
    this.#show(complete);
    ++this.frames;
    if (!complete && !this.moving) this.#request();  // at rest the picture fills up from frame to frame
    else if (complete) this.onrest?.();
  }

  /** The next `budget` points; the clouds behind the first (scans) are small and first in line. */
  #drawPoints(budget) {
    let before = 0;
    for (const cloud of [...this.clouds].reverse()) {
      const first = Math.min(Math.max(0, this.drawn - before), cloud.count);
      const n = Math.min(cloud.count - first, budget);
      cloud.setDrawn(first, n);
      budget -= n;
      before += cloud.count;
    }
    this.drawn = Math.min(this.total, this.drawn + Math.round(this.moving ? this.budget : 1.5 * this.budget));
    const pixels = this.target.height / (2 * Math.tan(FIELD_OF_VIEW / 2));
    for (const cloud of this.clouds) cloud.setUniforms({ pixelsPerMetre: pixels });
    this.renderer.render(this.points, this.camera);
  }

  #show(complete) {
    const { renderer, screen } = this;
    const lit = complete || this.drawn > 600_000;  // costs too much in a movement where not even that many are drawn
    screen.uniforms.colours.value = this.target.texture;
    screen.uniforms.depths.value = this.target.depthTexture;
    screen.uniforms.texel.value.set(1 / this.target.width, 1 / this.target.height).multiplyScalar(renderer.getPixelRatio());
    screen.uniforms.strength.value = lit ? (this.theme === "light" ? 1.4 : 3) : 0;
    renderer.setRenderTarget(null);
    renderer.render(screen.scene, this.camera);
    renderer.render(this.overlay, this.camera);
  }

  placeCamera() {
    const { eye, target } = this.orbit;
    this.camera.position.set(...eye.map((e, c) => e - this.offset[c]));
    this.camera.lookAt(...target.map((t, c) => t - this.offset[c]));
    this.camera.updateMatrixWorld();
  }

  /** World to clip coordinates, column by column. */
  get clipMatrix() {
    this.placeCamera();
    return new THREE.Matrix4().multiplyMatrices(this.camera.projectionMatrix, this.camera.matrixWorldInverse).elements;
  }
}
