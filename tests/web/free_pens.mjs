// How many strokes of free pens the page accepts: recorded from people who saw no template, put in its place by their
// bounding boxes, each pen-down at the times at which it was recorded.
// usage: node free_pens.mjs DIST SET TRACES
//   SET     set file with the characters of the traces (CALLIGRAPHY_CHARACTER_FILE)
//   TRACES  file of pen traces (docs/pen-traces.md)
// Prints the counts; fails if the tolerance with which the page begins refuses more than one in twenty.
import { readFileSync } from "node:fs";
import { resolve } from "node:path";

const [dist, setFile, tracesFile] = process.argv.slice(2).map((path) => resolve(path));
const { constants, load } = await import(`${dist}/calligraphy.js`);
const { LessonHandle } = await import(`${dist}/page/desk.js`);
const library = await load(readFileSync(`${dist}/calligraphy_module.wasm`));
const bytes = readFileSync(setFile);
const set = library.set_from_memory(bytes, bytes.length, setFile);

/** Characters with their pen-downs, points [x, y, ms] with y downwards. */
function traces(text) {
  const found = [];
  for (const line of text.split("\n")) {
    const [kind, first, ...rest] = line.split(" ");
    if (kind === "C") found.push({ character: first, penDowns: [] });
    if (kind !== "S") continue;
    const values = rest.map(Number);
    found.at(-1).penDowns.push(Array.from({ length: values.length / 3 }, (_, i) => values.slice(3 * i, 3 * i + 3)));
  }
  return found;
}

/** Least and greatest x and y. */
function boxOf(points) {
  const [x, y] = [0, 1].map((axis) => points.map((point) => point[axis]));
  return { left: Math.min(...x), bottom: Math.min(...y), width: Math.max(...x) - Math.min(...x),
           height: Math.max(...y) - Math.min(...y) };
}

/** The pen-downs in the box of the strokes, y upwards. */
function placed(penDowns, strokes) {
  const from = boxOf(penDowns.flat().map(([x, y]) => [x, -y]));
  const to = boxOf(strokes.flatMap(({ path }) => Array.from({ length: path.length / 2 },
                                                            (_, i) => path.slice(2 * i, 2 * i + 2))));
  return penDowns.map((points) => points.map(([x, y, time]) => [
    to.left + ((x - from.left) * to.width) / (from.width || 1),
    to.bottom + ((-y - from.bottom) * to.height) / (from.height || 1), time]));
}

/** Writes pen-downs as the page would, and passes over each stroke that is refused: their number. One that is in doubt
 * is accepted if the next one begins, or nothing is left to write. */
function refused(desk, penDowns) {
  let count = 0, now = 0;
  const move = (x, y, isDown) => desk.move({ time: now, x, y, isDown, stylus: {}, buttons: -1, kind: "mouse" });
  const pass = (milliseconds) => desk.advance(now += milliseconds);
  for (const [i, points] of penDowns.entries()) {
    const isLast = i + 1 === penDowns.length, [x, y, begin] = points[0], down = now + 200 - begin;
    move(x, y, false);
    for (const [toX, toY, time] of points) {
      now = Math.max(now, down + time);
      move(toX, toY, true);
    }
    now += 8;
    move(points.at(-1)[0], points.at(-1)[1], false);
    pass(isLast ? 1300 : 200);
    desk.look();
    const inDoubt = desk.view.hint === constants.HINT_LIFTED_EARLY ? 1 : 0;
    if (desk.view.due + inDoubt > i) continue;
    for (; desk.view.due <= i; desk.look()) {
      library.lesson_send(desk.handle, constants.LESSON_SKIP);
      pass(1);
      count += 1;
    }
  }
  return count;
}

/** Whether the set has it. */
function isKnown(character) {
  try {
    return library.set_stroke_count(set, character.codePointAt(0)) > 0;
  } catch {
    return false;
  }
}

/** Whether they are the strokes of the character, in order and direction. */
function isRight(desk, penDowns) {
  const paths = penDowns.map((points) => points.map((point) => point.slice(0, 2)));
  return library.match(desk.pages[0], 0, paths).remarks.length === 0;
}

const counts = { characters: 0, strokes: 0, lenient: 0, normal: 0 };
for (const { character, penDowns } of traces(readFileSync(tracesFile, "utf8"))) {
  if (!isKnown(character)) continue;
  for (const [name, tolerance] of [["lenient", constants.TOLERANCE_LENIENT], ["normal", constants.TOLERANCE_NORMAL]]) {
    const desk = new LessonHandle(library, set, character, { mode: constants.LESSON_GUIDED, strength: 0.6, tolerance });
    desk.advance(0);
    desk.look();
    const pens = placed(penDowns, desk.strokes);
    if (isRight(desk, pens)) {
      counts[name] += refused(desk, pens);
      counts.characters += name === "normal" ? 1 : 0;
      counts.strokes += name === "normal" ? penDowns.length : 0;
    }
    for (const handle of [desk.handle, ...desk.pages]) library.free(handle);
  }
}
const { characters, strokes, lenient, normal } = counts;
console.log(`${strokes} strokes of ${characters} characters without remarks: lenient accepts ${strokes - lenient}, ` +
            `normal ${strokes - normal}`);
if (strokes === 0 || lenient > strokes / 20) throw new Error("more than one in twenty is refused");
