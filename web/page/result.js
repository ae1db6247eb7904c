// The score of a character, and the remarks, each of which points at its place on the paper.
import { constants } from "../calligraphy.js";
import { em, margin } from "./desk.js";
import { colours } from "./paper.js";

/** @typedef {import("./score_worker.js").Judgement} Judgement */

const remarksAtOnce = 3;  // the others on request

const percent = (/** @type {number} */ share) => (Number.isNaN(share) ? "–" : `${Math.round(100 * share)} %`);
const ofSquare = (/** @type {number} */ metres) =>
  (Number.isNaN(metres) ? "–" : `${((100 * metres) / em).toFixed(1)} % of the square`);

/**
 * Shows a score.
 * @param {HTMLElement} element in which it is shown
 * @param {import("./lesson.js").Lesson} shown
 * @param {Judgement} judgement
 */
export function showResult(element, shown, { whole, lesson, remarks }) {
  const rows = [
    ["Strokes", `${lesson.accepted} of ${whole.stroke_count}`, `${percent(whole.coverage)} of their length`],
    ["Off the strokes", ofSquare(whole.rms_error),
     shown.isGuided ? `with the guide: ${ofSquare(lesson.guided_error)}` : ""],
    ["Right at once", `${lesson.right_at_once} of ${whole.stroke_count}`, ""],
    ["Time", Number.isNaN(whole.time) ? "not completed" : `${whole.time.toFixed(1)} s`, ""],
  ];
  const score = create("p", "score", String(Math.round(100 * whole.fidelity)));
  score.append(create("small", "", " of 100"));
  const table = create("table");
  for (const [name, value, more] of rows) {
    const row = create("tr"), cell = create("td", "", value);
    if (more) cell.append(create("small", "", more));
    row.append(create("th", "", name), cell);
    table.append(row);
  }
  const few = remarks.slice(0, remarksAtOnce), rest = remarks.slice(remarksAtOnce);
  const said = remarks.length > 0 ? [listOf(shown, few, 0)]
    : [create("p", "praise", whole.fidelity > 0.85 ? "Order, direction and shape are right."
      : "Order and direction are right, but the strokes are not in their places.")];
  if (rest.length > 0) {
    const more = create("details");
    more.append(create("summary", "", `${rest.length} more`), listOf(shown, rest, few.length));
    more.addEventListener("toggle", () => {
      shown.point(() => markRemarks(shown, /** @type {any} */ (more).open ? remarks : few));
    });
    said.push(more);
  }
  element.replaceChildren(score, table, ...said);
  element.hidden = false;
  shown.point(() => markRemarks(shown, few));
}

/** @param {import("./lesson.js").Lesson} shown @param {Judgement["remarks"]} remarks @param {number} before number of
 * those before them */
function listOf(shown, remarks, before) {
  const list = create("ol", "remarks");
  list.setAttribute("start", String(before + 1));
  remarks.forEach((remark, i) => {
    const item = create("li"), button = create("button", "", remark.english);
    const chinese = create("small", "", remark.chinese);
    chinese.lang = "zh";
    button.append(chinese);
    const show = () => shown.point(() => markRemarks(shown, remarks, i, before));
    for (const event of ["pointerenter", "focus", "click"]) button.addEventListener(event, show);
    for (const event of ["pointerleave", "blur"]) {
      button.addEventListener(event, () => shown.point(() => markRemarks(shown, remarks, undefined, before)));
    }
    item.append(button);
    list.append(item);
  });
  return list;
}

/**
 * Numbers on the paper; of one remark, also what it is about.
 * @param {import("./lesson.js").Lesson} shown @param {Judgement["remarks"]} remarks
 * @param {number} [chosen] index of a remark @param {number} [before] number of those before them
 */
function markRemarks(shown, remarks, chosen, before = 0) {
  const { paper, desk } = shown, context = paper.contexts.marks;
  const taken = /** @type {[number, number][]} */ ([]);
  remarks.forEach(({ kind, remark, strokes, place }, i) => {
    const isWritten = kind === constants.LESSON_REMARK_WRITTEN;
    if (i === chosen) {
      context.globalAlpha = 0.45;
      for (const stroke of strokes) paper.fillStroke("marks", desk.strokes[stroke], colours.flash);
      context.globalAlpha = 0.8;
      const penDowns = isWritten ? strokes.map((stroke) => desk.strokes[stroke].penDown) : [];
      for (const ink of shown.ink) {
        if (penDowns.includes(ink.penDown)) (shown.isGuided ? ink.guided : ink.own).draw(context, colours.wrong);
      }
      context.globalAlpha = 1;
    }
    let [x, y] = [margin + em * place[0], margin + em * place[1]];
    const colour = i === chosen ? colours.wrong : "#8a8076";
    const isOnAll = remark === constants.REMARK_STRAIGHT && strokes.length > 1;
    if (isWritten && remark > constants.REMARK_PARTS && !isOnAll) {  // of form: the place itself is to be seen
      paper.markPlace(x, y, colour);
      x += em / 13;
    }
    while (taken.some(([a, b]) => Math.hypot(a - x, b - y) < em / 13)) x += em / 13;
    taken.push([x, y]);
    paper.markNumber(x, y, before + i + 1, colour);
  });
}

/** @param {string} tag @param {string} [kind] its class @param {string} [text] */
function create(tag, kind = "", text = "") {
  const element = document.createElement(tag);
  if (kind) element.className = kind;
  element.textContent = text;
  return element;
}
