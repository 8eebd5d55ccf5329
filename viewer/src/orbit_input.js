// SPDX-License-Identifier: MIT
// Mouse, pen and fingers on a canvas turn the orbit; a press without a drag is a click.

const CLICK_REACH = 4;  // px

export function steer(canvas, orbit, { click, doubleClick }) {
  const pointers = new Map();
  let travelled = 0;

  const height = () => canvas.clientHeight;
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, width: Math.hypot(a.x - b.x, a.y - b.y) };
  };

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
    if (pointers.size === 1) travelled = 0;
  });

  canvas.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const dx = event.offsetX - before.x, dy = event.offsetY - before.y;
    travelled += Math.hypot(dx, dy);
    if (travelled < CLICK_REACH) return;
    if (pointers.size >= 2) {
      const was = spread();
      pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
      const is = spread();
      orbit.pan((is.x - was.x) / height(), -(is.y - was.y) / height());
      if (was.width > 0) orbit.zoom(is.width / was.width);
      return;
    }
    pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
    if (event.buttons & 1 && !event.shiftKey && !event.ctrlKey) {
      orbit.rotate((-dx * Math.PI) / height(), (dy * Math.PI) / height());
    } else {
      orbit.pan(dx / height(), -dy / height());
    }
  });

  const release = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    const still = travelled < CLICK_REACH && event.type === "pointerup";
    if (still && event.button === 0 && pointers.size === 0) click(event.offsetX, event.offsetY);
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("dblclick", (event) => doubleClick(event.offsetX, event.offsetY));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());

  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 30 : 1;
    const half = height() / 2;
    orbit.zoom(Math.exp(-0.0015 * lines * event.deltaY),
      (event.offsetX - canvas.clientWidth / 2) / half, -(event.offsetY - half) / half);
  }, { passive: false });
}
