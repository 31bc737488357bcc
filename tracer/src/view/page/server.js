// Communication with the server. Addresses are relative, because the page's own address contains the token.

export const noAnswer = "The server does not answer; it may have been stopped.";

// The server's answer. Throws an error with the server's message if the request is rejected.
async function answerTo(address, request) {
  let answer;
  try {
    answer = await fetch(address, request);
  } catch {
    throw new Error(noAnswer);
  }
  if (!answer.ok) throw Object.assign(new Error((await answer.text()).trim()), {status: answer.status});
  return answer;
}

async function post(name, body) {
  const answer = await answerTo(name, {
    method: "POST",
    headers: {"Content-Type": "application/json"},
    body: JSON.stringify(body),
  });
  return answer.json();
}

export const ask = (x, y) => post("ask", {x, y});
export const askSelected = (parts) => post("selected", parts);
export const askFiles = async (type, kind) => (await answerTo(`files?type=${encodeURIComponent(type)}&kind=${encodeURIComponent(kind)}`)).json();
export const grabAt = (x, y) => post("grab", {x, y});
export const dragTo = (drag) => post("drag", drag);
export const askFile = async (name) => (await answerTo(name)).blob();
export const writeCamera = () => post("write", {});
export const askStarts = async () => (await answerTo("starts")).json();
export const askCatalogue = async () => (await answerTo("catalogue")).json();
export const askDocument = async (after, text) => (await answerTo(`document?after=${after}&text=${text}`)).json();

// The server rejected a step. `place` has the message, line and column if the result would be wrong; `isOutdated` if the
// scene has changed meanwhile.
export class Rejected extends Error {
  constructor(status, text) {
    let place = null;
    try {
      place = JSON.parse(text).error;
    } catch {
      // A plain message.
    }
    super(place?.message ?? text.trim());
    this.place = place;
    this.isOutdated = status === 409;
  }
}

// What is wrong, without the place in the file and the lines quoted from it.
export const shortMessage = (error) => error.message.split("\n")[0].replace(/^\S*?:\d+:\d+: /, "");

async function postStep(name, body) {
  let answer;
  try {
    answer = await fetch(name, {method: "POST", headers: {"Content-Type": "application/json"}, body: JSON.stringify(body)});
  } catch {
    throw new Error(noAnswer);
  }
  if (!answer.ok) throw new Rejected(answer.status, await answer.text());
  return (await answer.json()).version;
}

export const sendStep = (step) => postStep("document", step);
export const undo = () => postStep("undo", {});
export const redo = () => postStep("redo", {});
export const save = () => postStep("save", {});

// Sends changes one at a time. Changes made while one is being sent are merged, so that a fast mouse does not build up
// a queue. Calls `done` after each accepted change and `failed(error)` after each rejected one.
export class Changes {
  #waiting = null;
  #isSending = false;
  #done;
  #failed;
  version = 0; // states from this version on include the last change

  constructor(done, failed) {
    this.#done = done;
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
        this.#done();
      } catch (error) {
        this.#failed(error);
      }
    }
    this.#isSending = false;
  }
}

export const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));

// Calls told(state, pixels) with every state shown, forever; pixels are null while the picture stays the same. Calls
// lost(error) while the server does not answer or rejects requests.
export async function follow(told, lost) {
  let version = 0, picture = 0;
  while (true) {
    try {
      const answer = await answerTo(`picture?after=${version}&picture=${picture}`);
      const bytes = new Uint8Array(await answer.arrayBuffer());
      const end = bytes.indexOf(10);
      const state = JSON.parse(new TextDecoder().decode(bytes.subarray(0, end)));
      const isNew = bytes.length > end + 1;
      // Too many pages are open, so the server did not let this one wait.
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
