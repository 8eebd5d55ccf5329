// SPDX-License-Identifier: MIT
// The requests of `dynamicfilter serve --edit`; docs/editing.md.

export const editToken = () => (location.protocol.startsWith("http") ? new URLSearchParams(location.search).get("edit") : null);

async function ask(token, method, path, body) {
  const answer = await fetch(path, { method, body, headers: { "X-Edit-Token": token } })
    .catch(() => { throw new Error("the server does not answer; start `dynamicfilter serve RUN --edit` again and open the address that it prints"); });
  if (!answer.ok) throw new Error(await answer.text() || `the server refuses (${answer.status})`);
  return answer.json();
}

export class EditServer {
  #saving = Promise.resolve();

  constructor(token) {
    this.token = token;
  }

  load() {
    return ask(this.token, "GET", "/edits");
  }

  /** One after the other, so that the last is the one that stays. */
  save(document) {
    this.#saving = this.#saving.catch(() => {}).then(() => ask(this.token, "POST", "/edits", JSON.stringify(document)));
    return this.#saving;
  }

  async apply() {
    await this.#saving;
    return ask(this.token, "POST", "/apply", "");
  }
}
