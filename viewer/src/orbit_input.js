// SPDX-License-Identifier: MIT
// Mouse, pen and fingers on a canvas turn the orbit.
import { onGestures } from "./gestures.js";

export function steer(canvas, orbit, { click, doubleClick }) {
  const height = () => canvas.clientHeight;

  onGestures(canvas, {
    drag: (dx, dy, event) => {
      if (event.buttons & 1 && !event.shiftKey && !event.ctrlKey) {
        orbit.rotate((-dx * Math.PI) / height(), (dy * Math.PI) / height());
      } else {
        orbit.pan(dx / height(), -dy / height());
      }
    },
    pinch: ({ dx, dy, scale }) => {
      orbit.pan(dx / height(), -dy / height());
      if (scale !== 1) orbit.zoom(scale);
    },
    click: (x, y, event, pressed) => {
      if (event.button === 0 && pressed === 0) click(x, y);
    },
    doubleClick,
    wheel: (scale, x, y) => {
      const half = height() / 2;
      orbit.zoom(scale, (x - canvas.clientWidth / 2) / half, -(y - half) / half);
    },
  });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
}
