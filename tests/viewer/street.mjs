// SPDX-License-Identifier: MIT
// A street of 80 m with walls, cars, poles and people who walk, seen by a sensor that drives along it.
import { random } from "./random.mjs";

const LENGTH = 80, HALF_WIDTH = 9, GROUND = -1.7;
export const SCANS = 120, RATE = 10;

export const stampOf = (row) => 1000 + row / RATE;
export const sensorAt = (row) => [8 + (row / SCANS) * 60, 0.6 * Math.sin(row / 14), 0];

export const PEOPLE = Array.from({ length: 14 }, (_, k) => ({
  x: 10 + ((k * 37) % 62), y: -6 + ((k * 29) % 12), speed: (k % 2 ? 1 : -1) * (0.9 + 0.1 * (k % 5)), drift: 0.3 * ((k % 3) - 1),
}));

/** Where a person is at a row. */
export const personAt = (k, row) => {
  const { x, y, speed, drift } = PEOPLE[k];
  const t = row / RATE;
  return [x + speed * t, y + drift * t];
};

const CARS = [[15, 6.2], [24, 6.2], [40, -6.4], [52, 6.1], [61, -6.3]];

function surface(r) {
  const kind = r();
  if (kind < 0.45) return [r() * LENGTH, (2 * r() - 1) * HALF_WIDTH, GROUND + 0.01 * r()];
  if (kind < 0.83) {
    const side = r() < 0.5 ? -1 : 1, x = r() * LENGTH, z = GROUND + r() * (6 + 3 * Math.sin(Math.floor(x / 11) * 2.3));
    const window = Math.floor(x / 1.6) % 2 === 0 && Math.floor((z - GROUND) / 1.5) % 2 === 1;
    return [x, side * (HALF_WIDTH + (window ? 0.35 : 0)), z];
  }
  if (kind < 0.93) {
    const [cx, cy] = CARS[Math.floor(r() * CARS.length)];
    const a = r(), b = r(), face = Math.floor(r() * 3);
    if (face === 0) return [cx + 4.2 * (a - 0.5), cy + 1.8 * (b - 0.5), GROUND + 1.45];
    if (face === 1) return [cx + 4.2 * (a - 0.5), cy + 0.9 * (b < 0.5 ? -1 : 1), GROUND + 1.45 * r()];
    return [cx + 2.1 * (a < 0.5 ? -1 : 1), cy + 1.8 * (b - 0.5), GROUND + 1.45 * r()];
  }
  const x = 6 + 12 * Math.floor(r() * 6), angle = 2 * Math.PI * r();
  if (kind < 0.955) return [x + 0.12 * Math.cos(angle), 7.4 + 0.12 * Math.sin(angle), GROUND + 5 * r()];
  const lift = 2 * r() - 1, ring = Math.sqrt(1 - lift * lift) * (0.7 + 0.3 * r());
  return [x + 1.7 * ring * Math.cos(angle), -7.2 + 1.7 * ring * Math.sin(angle), GROUND + 4 + 1.5 * lift];
}

function person(r, k, row) {
  const [x, y] = personAt(k, row);
  const angle = 2 * Math.PI * r(), height = 1.75 * r();
  const radius = height < 0.8 ? 0.14 : height < 1.45 ? 0.22 : 0.11;
  return [x + radius * Math.cos(angle), y + radius * Math.sin(angle), GROUND + 0.02 + height];
}

/** `n` points of what stands and of who walked, each {place, moving, row}; every beginning is a fair sample. */
export function* mapPoints(n, seed = 1, movingShare = 0.12) {
  const r = random(seed);
  for (let i = 0; i < n; ++i) {
    const row = Math.floor(r() * SCANS);
    if (r() < movingShare) {
      yield { place: person(r, Math.floor(r() * PEOPLE.length), row), moving: true, row };
    } else {
      const place = surface(r);
      const nearest = ((place[0] - 8) / 60) * SCANS;
      yield { place, moving: false, row: Math.max(0, Math.min(SCANS - 1, Math.round(nearest + 40 * (r() - 0.5)))) };
    }
  }
}

/** The points of one scan: what lies within 22 m of the sensor. */
export function scanPoints(row, n) {
  const r = random(1000 + row);
  const [sx] = sensorAt(row);
  const points = [];
  while (points.length < n) {
    const moving = r() < 0.18;
    const place = moving ? person(r, Math.floor(r() * PEOPLE.length), row) : surface(r);
    if (Math.abs(place[0] - sx) < 22) points.push({ place, moving, row });
  }
  return points;
}
