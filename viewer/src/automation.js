// SPDX-License-Identifier: MIT
// window.viewer: what tests and scripts may rely on. viewer/README.md describes it.

function settled(views) {
  return new Promise((done) => {
    const look = () => (views.every((view) => !view.moving && view.drawn >= view.total) ? done() : setTimeout(look, 20));
    setTimeout(look, 20);
  });
}

const plain = (point) => point && {
  run: point.owner.run.number ?? 0, source: point.source, index: point.index, position: point.position,
  verdict: point.verdict, voxel: point.voxel, row: point.row,
};

function camera({ target, yaw, pitch, distance }) {
  return { target, yaw, pitch, distance };
}

/** `more`: functions of a kind of page. */
export function expose(session, more = {}) {
  let done, failed;
  const times = {};
  const ready = new Promise((resolve, reject) => ([done, failed] = [resolve, reject]));
  ready.catch(() => {});  // the page says it itself
  const viewsOf = () => session.views.map(({ view }) => view);
  window.viewer = {
    ready,
    state: () => {
      const { selection, ...values } = session.store.values;
      return { ...values, selection: plain(selection), camera: camera(session.orbit) };
    },
    set: (patch) => session.store.set(patch),
    setCamera: (patch) => session.orbit.set(patch),
    stats: () => ({
      times, views: session.views.map((view) => ({
        name: view.name, frames: view.view.frames, pointsDrawn: view.view.drawn, pointsTotal: view.view.total,
        budget: Math.round(view.view.budget), row: view.row, scanIsShown: view.scanIsShown,
        sight: view.overlay.sight.visible, box: view.overlay.box.visible, way: view.overlay.way.visible,
      })),
    }),
    settled: () => settled(viewsOf()),
    project: (place, run = 0) => session.views[run].project(place),
    pick: (x, y, run = 0) => plain(session.views[run].pickAt(x, y)),
    ...more,
  };
  return {
    mapIsShown: () => (times.firstPoints = performance.now()),
    done: () => {
      times.ready = performance.now();
      done();
    },
    failed,
  };
}
