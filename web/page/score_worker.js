// Judges what was written, in a thread of its own: a long character takes longer than a picture may.
import { load } from "../calligraphy.js";
import { openCharacters, setWith } from "./characters.js";
import { layOut } from "./desk.js";
import { replay } from "./recorder.js";

/**
 * @typedef {object} Task
 * @property {number} id
 * @property {string} character
 * @property {number} tolerance
 * @property {Float64Array} recorded by a Recorder
 *
 * @typedef {object} Judgement
 * @property {number} id of the task
 * @property {Score} guided of where the pen was
 * @property {Score} own of where the pointer was
 *
 * @typedef {ReturnType<typeof said>} Score
 */

/**
 * A score with the texts of its remarks, since no function reaches the other thread.
 * @param {ReturnType<import("../calligraphy.js").Library["score"]>} score
 */
const said = (score) => ({
  ...score,
  remarks: score.remarks.map(({ text, ...remark }) => ({ ...remark, english: text("en"), chinese: text("zh") })),
});

const ready = load().then(async (library) => ({ library, characters: await openCharacters(library) }));

self.onmessage = async (/** @type {MessageEvent<Task>} */ { data }) => {
  try {
    const { library, characters } = await ready;
    self.postMessage({ id: data.id, ...judged(library, setWith(library, characters, data.character), data) });
  } catch (error) {
    self.postMessage({ id: data.id, error: error instanceof Error ? error.message : String(error) });
  }
};

/** @param {import("../calligraphy.js").Library} library @param {number} set @param {Task} task */
function judged(library, set, { character, recorded, tolerance }) {
  const page = layOut(library, set, character);
  const tick = library.struct("tick");
  const score = (/** @type {boolean} */ isOwn) => {
    const recording = library.recording_create(page, 1000);
    try {
      replay(recorded, tick, isOwn, () => library.recording_add(recording, tick));
      return said(library.score(recording, 0, tolerance));
    } finally {
      library.free(recording);
    }
  };
  try {
    return { guided: score(false), own: score(true) };
  } finally {
    library.discard(tick);
    library.free(page);
  }
}
