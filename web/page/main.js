// The page: what is chosen, and how it goes.
import { CalligraphyError, constants, load } from "../calligraphy.js";
import { openCharacters, readCharacter, setWith } from "./characters.js";
import { Lesson } from "./lesson.js";
import { modes } from "./modes.js";
import { Paper } from "./paper.js";
import { Pointer } from "./pointer.js";
import { showResult } from "./result.js";
import { openTrace, packed } from "./trace.js";

const begun = performance.now();
const missesUntilOffered = 2;  // of a stroke: the next time, it may rather be skipped
const find = (/** @type {string} */ id) => /** @type {HTMLElement} */ (document.getElementById(id));
const input = (/** @type {string} */ id) => /** @type {HTMLInputElement} */ (document.getElementById(id));

const tolerances = { lenient: constants.TOLERANCE_LENIENT, normal: constants.TOLERANCE_NORMAL,
                     strict: constants.TOLERANCE_STRICT };

/** The date and the time here, with what they are ahead of UTC. */
function localTime() {
  const now = new Date(), ahead = -now.getTimezoneOffset();  // [min]
  const two = (/** @type {number} */ number) => String(number).padStart(2, "0");
  const offset = `${ahead < 0 ? "-" : "+"}${two(Math.floor(Math.abs(ahead) / 60))}:${two(Math.abs(ahead) % 60)}`;
  return new Date(now.getTime() + ahead * 60e3).toISOString().slice(0, 19) + offset;
}

/** Buttons of which one is chosen. @param {string} id @param {Record<string, string>} names @param {string} chosen
 * @param {(value: string) => void} choose */
function offer(id, names, chosen, choose) {
  for (const [value, name] of Object.entries(names)) {
    const label = document.createElement("label"), radio = document.createElement("input");
    Object.assign(radio, { type: "radio", name: id, value, checked: value === chosen });
    radio.addEventListener("change", () => choose(value));
    label.append(radio, name);
    find(id).append(label);
  }
}

/** The character that the address names; empty if it names none. */
function asked() {
  try {
    return decodeURIComponent(location.hash.slice(1));
  } catch {
    return location.hash.slice(1);
  }
}

async function main() {
  const library = await load();
  const opened = await openCharacters(library), { characters, isImported } = opened;
  const hint = find("hint"), paperElement = find("paper"), result = find("result");
  const paper = new Paper(paperElement, () => lesson.redraw());
  const pointer = new Pointer(paperElement, paper, () => lesson.wake());
  let settings = /** @type {import("./modes.js").Settings} */ (
    { mode: "guided", strength: 0.6, tolerance: constants.TOLERANCE_LENIENT, ink: "guided" });
  let note = "";  // that is shown until something is done
  let task = 0;  // number of the last one that the worker was given
  let lesson = /** @type {Lesson} */ (/** @type {unknown} */ (undefined));  // begun below

  /** Words beside the pen, for a while. @param {string} text @param {number} x @param {number} y */
  function showHint(text, x, y) {
    hint.hidden = text === "";
    hint.textContent = text;
    const [left, top] = paper.onScreen(x, y), goal = lesson?.due;
    const width = hint.offsetWidth, height = hint.offsetHeight, size = paperElement.clientWidth;
    const isBelow = goal ? goal.start[1] > y : top < 80;  // so that it does not hide where to begin
    const within = (/** @type {number} */ place, /** @type {number} */ extent) =>
      `${Math.max(4, Math.min(size - extent - 4, place))}px`;
    hint.style.left = within(left - width / 2, width);
    hint.style.top = within(isBelow ? top + 28 : top - 28 - height, height);
    hint.classList.remove("passing");
    void hint.offsetWidth;  // begins the animation anew
    hint.classList.add("passing");
  }

  /** @param {Lesson} lesson */
  function showProgress({ view, due, isWritten, isGuided, mode, settings, trace }, isNew = false) {
    const isWatched = settings.mode === "watch", count = view.stroke_count;
    if (!isNew) note = "";
    find("progress").textContent = note || (isWatched ? `${count} strokes`
      : !isWritten ? `Stroke ${Math.min(view.due + 1, count)} of ${count}`
      : view.skipped > 0 ? `${view.accepted} of ${count} strokes written` : "Written");
    if (isWritten && document.activeElement === find("skip")) find("next").focus();
    input("skip").disabled = isWritten || isWatched;
    input("save").disabled = !trace.hasPenDown;
    input("undo").disabled = view.due === 0 || isWatched;
    input("show").disabled = isWritten || isWatched;
    find("skip").classList.toggle("offered", (due?.misses ?? 0) >= missesUntilOffered);
    find("strength").closest("label")?.toggleAttribute("hidden", !mode.isGuided);
    find("ink").hidden = !isGuided;
    if (!isWritten) result.hidden = true;
  }

  const worker = new Worker(new URL("score_worker.js", import.meta.url), { type: "module" });
  /** @param {Lesson} lesson */
  function judge({ character, settings: { tolerance }, desk }) {
    const writing = desk.writing();
    worker.postMessage({ id: ++task, character, tolerance, writing }, [writing.buffer]);
  }
  worker.onerror = () => { find("progress").textContent = "It cannot be judged: the console says why"; };
  worker.onmessage = ({ data }) => {
    if (data.id !== task || !lesson.isWritten) return;
    if (data.error) find("progress").textContent = `It cannot be judged: ${data.error}`;
    else showResult(result, lesson, data);
  };

  const isKnown = (/** @type {string} */ character) => (
    characters.includes(character) || setWith(library, opened, character) === opened.strokes);

  /** Whether it could begin. @param {string} character */
  function begin(character) {
    try {
      const set = setWith(library, opened, character);
      if (lesson) lesson.begin(set, character);
      else lesson = new Lesson(library, set, character, settings, paper, pointer,
                               { hint: showHint, changed: showProgress, written: judge });
    } catch (error) {
      find("progress").textContent = `${character} cannot be written: ${/** @type {Error} */ (error).message}`;
      return false;
    }
    task += 1;  // what the worker still says is of another one
    find("character").textContent = character;
    find("source").hidden = !isImported || !characters.includes(character);
    document.title = `${character} · Calligraphy`;
    if (asked() !== character) history.replaceState(null, "", `#${character}`);
    return true;
  }

  /** Begins the first one from an index on that can be. @param {number} index */
  function beginFrom(index) {
    const inOrder = characters.map((_, i) => characters[(index + i) % characters.length]);
    if (!inOrder.some(begin)) throw new Error("none of the characters can be written");
  }

  /** @param {Partial<import("./modes.js").Settings>} changed */
  function change(changed) {
    settings = { ...settings, ...changed };
    lesson.change(settings);
    showProgress(lesson, true);
  }

  /** What a file says of how it was written. */
  function notice() {
    const { character, settings, mode, desk, isGuided, trace } = lesson;
    if (!trace.isContinued) return trace.notice;
    const list = (/** @type {unknown[]} */ items) => items.join(", ") || "none";
    const skipped = desk.strokes.flatMap(({ fate }, i) => (fate === constants.FATE_SKIPPED ? [i + 1] : []));
    const tolerance = Object.entries(tolerances).find(([, value]) => value === settings.tolerance)?.[0];
    return [...(trace.notice ? [trace.notice] : []), `written on the page of calligraphy ${library.version()}`,
            `character: ${character}`, `mode: ${mode.name}`,
            `guide: ${isGuided ? `${Math.round(100 * settings.strength)} %` : "none"}`, `tolerance: ${tolerance}`,
            `skipped strokes: ${list(skipped)}`, `pointer: ${list(trace.kinds)}`,
            `date: ${localTime()}`].join("\n");
  }

  /** Hands out what the pen did as a file. */
  async function save() {
    const { character, trace } = lesson;
    try {
      const { blob, ending } = await packed(trace.text(library, character, notice()));
      const download = `${character}-${localTime().slice(0, 16).replace(":", "-")}${ending}`;
      const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 60e3);  // once it was taken
    } catch (error) {
      find("progress").textContent = `It cannot be saved: ${/** @type {Error} */ (error).message}`;
    }
  }

  /** Begins with the character of a file, and writes as the pen did. @param {File | undefined} file */
  async function openFile(file) {
    if (!file) return;
    try {
      const { character, trace } = await openTrace(library, file, (each) => {
        const { character } = readCharacter(library, opened, each);
        return isKnown(character) ? character : "";
      });
      if (settings.mode === "watch") find("modes").querySelector("input")?.click();  // in which is written
      if (begin(character)) lesson.play(trace);
    } catch (error) {
      const { message } = /** @type {Error} */ (error);  // that of the library names the file and the line
      const why = error instanceof CalligraphyError ? message.replace(/^\w+: /, "") : `${file.name}: ${message}`;
      find("progress").textContent = `It cannot be opened. ${why}`;
    }
  }

  function beginAsked() {
    const { character, note: said } = readCharacter(library, opened, asked());
    const isOffered = characters.includes(character);
    if (isOffered || !isKnown(character) || !begin(character)) beginFrom(Math.max(0, characters.indexOf(character)));
    if (character && character !== lesson.character) {
      note = `${character} is not among the ${characters.length} characters`;
    } else {
      note = said;
    }
    showProgress(lesson, true);
  }

  offer("modes", Object.fromEntries(Object.entries(modes).map(([mode, { name }]) => [mode, name])), "guided",
        (mode) => change({ mode: /** @type {import("./modes.js").ModeName} */ (mode) }));
  offer("ink", { guided: "Guided ink", own: "My own ink", both: "Both, mine in blue" }, "guided",
        (ink) => change({ ink: /** @type {"guided" | "own" | "both"} */ (ink) }));
  for (const [name, value] of Object.entries(tolerances)) input("tolerance").append(new Option(name, String(value)));
  input("tolerance").addEventListener("change", () => change({ tolerance: Number(input("tolerance").value) }));
  const changeStrength = () => {
    find("strength-shown").textContent = `${input("strength").value} %`;
    change({ strength: Number(input("strength").value) / 100 });
  };
  input("strength").addEventListener("input", changeStrength);
  find("again").addEventListener("click", () => lesson.again());
  find("skip").addEventListener("click", () => lesson.send(constants.LESSON_SKIP));
  find("undo").addEventListener("click", () => lesson.send(constants.LESSON_UNDO));
  find("show").addEventListener("click", () => lesson.send(constants.LESSON_SHOW));
  find("next").addEventListener("click", () => {
    beginFrom(characters.indexOf(lesson.character) + 1);
  });
  find("save").addEventListener("click", save);
  find("open").addEventListener("click", () => input("file").click());
  input("file").addEventListener("change", () => {
    openFile(input("file").files?.[0]);
    input("file").value = "";  // so that the same file can be opened again
  });
  window.addEventListener("dragover", (event) => event.preventDefault());
  window.addEventListener("drop", (event) => {
    event.preventDefault();
    openFile(event.dataTransfer?.files[0]);
  });
  for (const character of characters) {
    const button = document.createElement("button");
    button.textContent = character;
    button.addEventListener("click", () => begin(character));
    find("characters").append(button);
  }
  window.addEventListener("hashchange", beginAsked);
  beginAsked();
  changeStrength();
  performance.measure("ready", { start: 0, end: performance.now() });
  document.body.dataset.ready = String(Math.round(performance.now() - begun));
}

main().catch((error) => {
  find("progress").textContent = `The page cannot begin: ${error.message}`;
  throw error;
});
