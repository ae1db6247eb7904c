// Judges what was written, in a thread of its own: a long character takes longer than a picture may.
import { load } from "../calligraphy.js";
import { openCharacters, setWith } from "./characters.js";
import { layOut } from "./desk.js";

/**
 * @typedef {object} Task
 * @property {number} id
 * @property {string} character
 * @property {number} tolerance
 * @property {Float64Array} writing of a LessonHandle
 *
 * @typedef {ReturnType<typeof judged>} Judgement
 */

const ready = load().then(async (library) => ({ library, characters: await openCharacters(library) }));

self.onmessage = async (/** @type {MessageEvent<Task>} */ { data }) => {
  try {
    const { library, characters } = await ready;
    self.postMessage({ id: data.id, ...judged(library, setWith(library, characters, data.character), data) });
  } catch (error) {
    self.postMessage({ id: data.id, error: error instanceof Error ? error.message : String(error) });
  }
};

/** What there is to be said, in words, since no function reaches the other thread.
 * @param {import("../calligraphy.js").Library} library @param {number} set @param {Task} task */
function judged(library, set, { character, writing, tolerance }) {
  const page = layOut(library, set, character), whole = library.struct("character_score");
  const lesson = library.struct("lesson_score"), read = library.struct("lesson_remark");
  const strokes = new Int32Array(64);
  const score = library.score_writing(page, writing, writing.length, tolerance);
  try {
    library.score_character(score, 0, whole);
    library.score_lesson(score, 0, lesson);
    const remarks = Array.from({ length: lesson.remark_count }, (_, i) => {
      library.score_lesson_remark(score, 0, i, read, strokes, strokes.length);
      const text = (/** @type {string} */ language) => library.score_lesson_remark_text(score, 0, i, language);
      return { ...read.values(), strokes: [...strokes.subarray(0, read.stroke_count)], english: text("en"),
               chinese: text("zh") };
    });
    return { whole: whole.values(), lesson: lesson.values(), remarks };
  } finally {
    [whole, lesson, read].forEach((made) => library.discard(made));
    library.free(score);
    library.free(page);
  }
}
