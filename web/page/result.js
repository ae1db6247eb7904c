// The score of a character, and the remarks, each of which points at its place on the paper.
import { constants } from "../calligraphy.js";
import { em, margin } from "./desk.js";
import { colours } from "./paper.js";

/** @typedef {import("./score_worker.js").Score} Score */

const percent = (/** @type {number} */ share) => (Number.isNaN(share) ? "–" : `${Math.round(100 * share)} %`);
const ofSquare = (/** @type {number} */ metres) =>
  (Number.isNaN(metres) ? "–" : `${((100 * metres) / em).toFixed(1)} % of the square`);

/**
 * Shows a score.
 * @param {HTMLElement} element in which it is shown
 * @param {import("./lesson.js").Lesson} lesson
 * @param {import("./score_worker.js").Judgement} judgement
 */
export function showResult(element, lesson, { guided, own }) {
  const written = lesson.isGuided ? guided : own;
  const rows = [
    ["Strokes", `${written.strokes_completed} of ${written.stroke_count}`,
     `${percent(written.coverage)} of their length`],
    ["Off the strokes", ofSquare(written.rms_error),
     lesson.isGuided ? `your hand alone: ${ofSquare(own.rms_error)}` : ""],
    ["Right at once", `${written.stroke_count - lesson.missed.size} of ${written.stroke_count}`, ""],
    ["Time", Number.isNaN(written.time) ? "not completed" : `${written.time.toFixed(1)} s`, ""],
  ];
  const score = create("p", "score", String(Math.round(100 * written.fidelity)));
  score.append(create("small", "", " of 100"));
  const table = create("table");
  for (const [name, value, more] of rows) {
    const row = create("tr"), cell = create("td", "", value);
    if (more) cell.append(create("small", "", more));
    row.append(create("th", "", name), cell);
    table.append(row);
  }
  element.replaceChildren(score, table, remarksOf(lesson, written));
  element.hidden = false;
  lesson.point(() => markRemarks(lesson, written));
}

/** @param {import("./lesson.js").Lesson} lesson @param {Score} score */
function remarksOf(lesson, score) {
  if (score.remarks.length === 0) {
    return create("p", "praise", score.fidelity > 0.85 ? "Order, direction and shape are right."
      : "Order and direction are right, but the strokes are not in their places.");
  }
  const list = create("ol", "remarks");
  score.remarks.forEach((remark, i) => {
    const item = create("li"), button = create("button", "", remark.english);
    const chinese = create("small", "", remark.chinese);
    chinese.lang = "zh";
    button.append(chinese);
    const show = () => lesson.point(() => markRemarks(lesson, score, i));
    for (const event of ["pointerenter", "focus", "click"]) button.addEventListener(event, show);
    for (const event of ["pointerleave", "blur"]) {
      button.addEventListener(event, () => lesson.point(() => markRemarks(lesson, score)));
    }
    item.append(button);
    list.append(item);
  });
  return list;
}

/**
 * Numbers on the paper; of one remark, also what it is about.
 * @param {import("./lesson.js").Lesson} lesson @param {Score} score @param {number} [chosen] index of a remark
 */
function markRemarks(lesson, score, chosen) {
  const { paper, desk } = lesson, context = paper.contexts.marks;
  const taken = /** @type {[number, number][]} */ ([]);
  score.remarks.forEach((remark, i) => {
    if (i === chosen) {
      const strokes = range(remark.stroke, remark.stroke_count), paths = range(remark.path, remark.path_count);
      const isExtra = remark.stroke < 0, changedPlaces = !isExtra && remark.other_path >= 0;
      if (changedPlaces) paths.push(remark.other_path);
      if (changedPlaces || (isExtra && remark.other_stroke >= 0)) strokes.push(remark.other_stroke);
      context.globalAlpha = 0.45;
      for (const stroke of strokes) paper.fillStroke("marks", desk.strokes[stroke], colours.flash);
      context.globalAlpha = 0.8;
      for (const path of paths) {
        const penDown = lesson.penDownAt(score.pen_downs[path].begin);
        const lines = lesson.isGuided ? [penDown?.guided] : penDown?.own ?? [];
        for (const line of lines) line?.drawAll(context, colours.wrong);
      }
      context.globalAlpha = 1;
    }
    let [x, y] = [margin + em * remark.place[0], margin + em * remark.place[1]];
    const colour = i === chosen ? colours.wrong : "#8a8076";
    const isOnAll = remark.kind === constants.REMARK_STRAIGHT && remark.stroke_count > 1;
    if (remark.kind > constants.REMARK_PARTS && !isOnAll) {  // of form: the place itself is to be seen
      paper.markPlace(x, y, colour);
      x += em / 13;
    }
    while (taken.some(([a, b]) => Math.hypot(a - x, b - y) < em / 13)) x += em / 13;
    taken.push([x, y]);
    paper.markNumber(x, y, i + 1, colour);
  });
}

/** So many indices in a row. @param {number} first @param {number} count */
const range = (first, count) => Array.from({ length: count }, (_, i) => first + i);

/** @param {string} tag @param {string} [kind] its class @param {string} [text] */
function create(tag, kind = "", text = "") {
  const element = document.createElement(tag);
  if (kind) element.className = kind;
  element.textContent = text;
  return element;
}
