// What the server shows, and what is wished of it. Addresses are relative: the page's own has the token in it.

async function post(name, wish) {
  const answer = await fetch(name, {
    method: "POST",
    headers: {"Content-Type": "application/json"},
    body: JSON.stringify(wish),
  });
  const text = await answer.text();
  if (!answer.ok) throw new Error(text.trim());
  return JSON.parse(text);
}

export const ask = (x, y) => post("ask", {x, y});
export async function askNumbers() {
  const answer = await fetch("numbers");
  if (!answer.ok) throw new Error(await answer.text());
  return answer.json();
}
export const writeNumbers = () => post("write_numbers", {});
export const writeCamera = () => post("write", {});

// Sends changes one after the other. Those that come while one is on its way are joined, so that a fast mouse leaves no
// queue behind.
export class Changes {
  #waiting = null;
  #isSending = false;
  #failed;
  version = 0; // at which the last change counts

  constructor(failed) {
    this.#failed = failed;
  }
  get arePending() {
    return this.#isSending || this.#waiting !== null;
  }
  async make(change) {
    this.#waiting = {...this.#waiting, ...change};
    if (this.#isSending) return;
    this.#isSending = true;
    while (this.#waiting !== null) {
      const next = this.#waiting;
      this.#waiting = null;
      try {
        this.version = (await post("change", next)).version;
      } catch (error) {
        this.#failed(error);
      }
    }
    this.#isSending = false;
  }
}

const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));

// Calls told(state, pixels) with every state that is shown, for ever; pixels are null while the picture stays the same.
// Calls lost() while the server does not answer.
export async function follow(told, lost) {
  let version = 0, picture = 0;
  while (true) {
    try {
      const answer = await fetch(`picture?after=${version}&picture=${picture}`);
      if (!answer.ok) throw new Error(await answer.text());
      const bytes = new Uint8Array(await answer.arrayBuffer());
      const end = bytes.indexOf(10);
      const state = JSON.parse(new TextDecoder().decode(bytes.subarray(0, end)));
      const isNew = bytes.length > end + 1;
      // Too many pages are open, and the server does not let this one wait.
      if (state.version === version) await pause(500);
      version = state.version;
      if (state.picture) picture = state.picture.number;
      told(state, isNew ? bytes.subarray(end + 1) : null);
    } catch (error) {
      lost(error);
      version = picture = 0;
      await pause(1000);
    }
  }
}
