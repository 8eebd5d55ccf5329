// SPDX-License-Identifier: MIT
// The corrections in their order, with undo and redo.

export class EditList {
  #past = [];
  #future = [];
  #listeners = new Set();
  edits = [];

  watch(tell) {
    this.#listeners.add(tell);
  }

  /** What the server has; forgets what could be undone. */
  load(edits) {
    this.#past = [];
    this.#future = [];
    this.#become(edits);
  }

  add(edit) {
    this.#change([...this.edits, edit]);
  }

  remove(edit) {
    this.#change(this.edits.filter((other) => other !== edit));
  }

  undo() {
    if (this.#past.length === 0) return;
    this.#future.push(this.edits);
    this.#become(this.#past.pop());
  }

  redo() {
    if (this.#future.length === 0) return;
    this.#past.push(this.edits);
    this.#become(this.#future.pop());
  }

  get canUndo() {
    return this.#past.length > 0;
  }

  get canRedo() {
    return this.#future.length > 0;
  }

  #change(edits) {
    this.#past.push(this.edits);
    this.#future = [];
    this.#become(edits);
  }

  #become(edits) {
    const before = this.edits;
    this.edits = edits;
    for (const tell of this.#listeners) tell(edits, before);
  }
}
