// SPDX-License-Identifier: MIT
// Mouse, pen and fingers on a canvas: drags, two fingers, clicks and the wheel. A press without a drag is a click.

const CLICK_REACH = 4;  // px

// Places and ways are in pixels. drag(dx, dy, event); pinch({ dx, dy, scale, x, y }); click(x, y, event, pressed), with the
// number of pointers that are still pressed; doubleClick(x, y); wheel(scale, x, y).
export function onGestures(canvas, { drag, pinch, click, doubleClick, wheel }) {
  const pointers = new Map();
  let travelled = 0;

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
    const was = pointers.size >= 2 ? spread() : null;
    pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
    if (!was) {
      drag(dx, dy, event);
      return;
    }
    const is = spread();
    const scale = was.width > 0 ? is.width / was.width : 1;
    pinch({ dx: is.x - was.x, dy: is.y - was.y, scale, x: is.x, y: is.y });
  });

  const release = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    const still = travelled < CLICK_REACH && event.type === "pointerup";
    if (still) click(event.offsetX, event.offsetY, event, pointers.size);
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("dblclick", (event) => doubleClick(event.offsetX, event.offsetY));
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 30 : 1;
    wheel(Math.exp(-0.0015 * lines * event.deltaY), event.offsetX, event.offsetY);
  }, { passive: false });
}
