// SPDX-License-Identifier: MIT
// Which point is under the pointer: all are projected here, and only upon a click.

const SAME_SURFACE = 1.03;  // depths within this ratio (and 10 cm) compete by their place on the screen

/** Clip coordinates x, y, w of a stored point are affine in it: scale and origin go into the matrix. */
function storedToClip(m, { low, step }) {
  const row = (r) => {
    const [a, b, c, d] = [m[r], m[4 + r], m[8 + r], m[12 + r]];
    return [a * step, b * step, c * step, a * low[0] + b * low[1] + c * low[2] + d];
  };
  return [row(0), row(1), row(3)];
}

/**
 * The point of a cloud nearest to (x, y), in px of a canvas of `size`: {index, depth}, or null where none is within
 * `tolerance`. What is in front wins.
 */
export function pick(cloud, clipMatrix, size, [x, y], tolerance) {
  const [[xa, xb, xc, xd], [ya, yb, yc, yd], [wa, wb, wc, wd]] = storedToClip(clipMatrix, cloud);
  const { positions, begin, end, low, step } = cloud;
  const halfWidth = size.width / 2, halfHeight = size.height / 2;
  const aimX = x - halfWidth, aimY = halfHeight - y;
  const near = [];
  let nearest = Infinity;
  for (let i = begin; i < end; ++i) {
    const px = positions[3 * i], py = positions[3 * i + 1], pz = positions[3 * i + 2];
    const w = wa * px + wb * py + wc * pz + wd;
    if (w <= 0.1) continue;
    const dx = (halfWidth * (xa * px + xb * py + xc * pz + xd)) / w - aimX;
    if (dx > tolerance || dx < -tolerance) continue;
    const dy = (halfHeight * (ya * px + yb * py + yc * pz + yd)) / w - aimY;
    if (dy > tolerance || dy < -tolerance) continue;
    if (!cloud.shows(i, low[0] + step * px, low[1] + step * py, low[2] + step * pz)) continue;
    near.push({ index: i, depth: w, off: dx * dx + dy * dy });
    if (w < nearest) nearest = w;
  }
  const front = near.filter(({ depth }) => depth <= nearest * SAME_SURFACE + 0.1);
  if (front.length === 0) return null;
  return front.reduce((best, point) => (point.off < best.off ? point : best));
}

/** Where a place is on a canvas, px; null behind the camera. */
export function project(clipMatrix, size, [x, y, z]) {
  const m = clipMatrix;
  const w = m[3] * x + m[7] * y + m[11] * z + m[15];
  if (w <= 0) return null;
  return [
    (size.width / 2) * (1 + (m[0] * x + m[4] * y + m[8] * z + m[12]) / w),
    (size.height / 2) * (1 - (m[1] * x + m[5] * y + m[9] * z + m[13]) / w),
  ];
}
