// SPDX-License-Identifier: MIT
// The panel "Edit".
import { checkbox, h } from "./dom.js";
import { pictureOf } from "./edit_picture.js";
import { count, plural } from "./format.js";

const TOOLS = [["instance", "Instance"], ["rectangle", "Rectangle"], ["lasso", "Lasso"]];
const HINTS = {
  instance: "Click a point: all that touches it and has the same verdict is chosen, without the ground.",
  rectangle: "Drag a rectangle: all points shown in it are chosen, near and far. Right drag or Shift moves the view.",
  lasso: "Draw around points: all points shown in it are chosen, near and far. Right drag or Shift moves the view.",
};
const LABELS = [["static", "Static", "J"], ["dynamic", "Dynamic", "K"], ["unknown", "Unknown", "U"]];
const MOST_LISTED = 200;
const pictures = new WeakMap();  // by edit

function picture(edit) {
  if (!pictures.has(edit)) pictures.set(edit, pictureOf(edit));
  return pictures.get(edit);
}

/** `editor`: choose(tool), mark(label), undo(), redo(), apply(), remove(edit), show(edit), setOneScan(on). */
export function editPanel(editor) {
  const tools = TOOLS.map(([id, label]) => h("button", { type: "button", "data-tool": id, onclick: () => editor.choose(id) }, label));
  const hint = h("p", { class: "muted" }), chosen = h("p", { class: "edit-chosen", role: "status" });
  const marks = LABELS.map(([id, label, key]) =>
    h("button", { type: "button", "data-mark": id, title: `Key ${key}`, onclick: () => editor.mark(id) }, label));
  const undo = h("button", { type: "button", title: "Ctrl Z", onclick: () => editor.undo() }, "Undo");
  const redo = h("button", { type: "button", title: "Ctrl Shift Z", onclick: () => editor.redo() }, "Redo");
  const apply = h("button", { type: "button", class: "apply", onclick: () => editor.apply() }, "Apply");
  const status = h("p", { class: "edit-status muted", role: "status" });
  const list = h("ul", { class: "edits" }), title = h("h2", {}, "Edits"), more = h("p", { class: "muted" });
  const element = h("div", {},
    h("section", {}, h("h2", {}, "Choose"), h("div", { class: "buttons" }, tools), hint,
      checkbox("Only the scan at the slider", false, (on) => editor.setOneScan(on)).element),
    h("section", {}, h("h2", {}, "Mark as"), chosen, h("div", { class: "buttons" }, marks)),
    h("section", {}, h("h2", {}, "Labels and maps on disk"), h("div", { class: "buttons" }, undo, redo, apply), status),
    h("section", {}, title, list, more));

  function item(edit, number) {
    const words = `${number}. ${edit.how ?? "edit"} → ${edit.label}`;
    const rows = edit.scans ? (edit.scans[0] === edit.scans[1] ? `scan ${edit.scans[0]}` : `scans ${edit.scans[0]} to ${edit.scans[1]}`) : "all scans";
    return h("li", {},
      h("button", { type: "button", class: "quiet edit-show", "aria-label": `Show edit ${number}`, onclick: () => editor.show(edit) }, picture(edit)),
      h("div", {}, h("b", {}, words), h("small", {}, rows)),
      h("button", { type: "button", class: "quiet", "aria-label": `Remove edit ${number}`, onclick: () => editor.remove(edit) }, "Remove"));
  }

  return {
    element,
    say: (text, kind = "") => {
      status.textContent = text;
      status.dataset.kind = kind;
    },
    setTool: (tool) => {
      tools.forEach((button) => button.setAttribute("aria-pressed", button.dataset.tool === tool));
      hint.textContent = HINTS[tool];
    },
    setChosen: (selection) => {
      marks.forEach((button) => (button.disabled = !selection));
      chosen.textContent = selection
        ? `${plural(selection.points.length, "point")} chosen${selection.cut ? ", not all of it: an instance ends 20 m from the click" : ""}`
        : "Nothing is chosen yet.";
    },
    setList: ({ edits, canUndo, canRedo }) => {
      undo.disabled = !canUndo;
      redo.disabled = !canRedo;
      title.textContent = `Edits: ${count(edits.length)}`;
      list.replaceChildren(...edits.map((edit, i) => [edit, i + 1]).slice(-MOST_LISTED).reverse().map(([edit, i]) => item(edit, i)));
      more.textContent = edits.length > MOST_LISTED ? `The newest ${MOST_LISTED} are listed.` : "";
    },
    setBusy: (busy) => (apply.disabled = busy),
  };
}
