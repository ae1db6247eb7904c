// Draws a lesson, and passes on what is done: what is decided, the library decides.
import { constants } from "../calligraphy.js";
import { Animations } from "./animations.js";
import { LessonHandle } from "./desk.js";
import { Ink } from "./ink.js";
import { colours } from "./paper.js";
import { Trace } from "./trace.js";

/**
 * @typedef {"guided" | "vision" | "next" | "memory" | "watch"} ModeName
 * @typedef {object} Settings
 * @property {ModeName} mode
 * @property {number} strength of the guide, from 0 to 0.8
 * @property {number} tolerance such as constants.TOLERANCE_NORMAL
 * @property {"guided" | "own" | "both"} ink which ink is shown
 */

export const modes = {
  guided: { name: "Guided", kind: constants.LESSON_GUIDED, isGuided: true },
  vision: { name: "Vision only", kind: constants.LESSON_VISION, isGuided: false },
  next: { name: "Next stroke", kind: constants.LESSON_NEXT_STROKE, isGuided: true },
  memory: { name: "From memory", kind: constants.LESSON_MEMORY, isGuided: false },
  watch: { name: "Watch", kind: constants.LESSON_WATCH, isGuided: false },
};

const rest = 1000;       // time without anything to draw after which no more pictures are drawn [ms]
const longestWork = 12;  // on a trace that is played, for one picture [ms]

export class Lesson {
  animations = new Animations();
  trace = new Trace();  // what the pointer did
  /** @type {import("./pointer.js").PointerSample[]} */
  played = [];          // samples of a trace that is written again, the last one first
  added = 0;            // to the time, for traces that were played [ms]
  time = 0;             // of the lesson [ms]
  /** @type {Ink[]} */
  ink = [];             // by pen-down
  shown = "";           // what the layers of sheet and ink show
  hasPointer = false;   // has been seen
  isAwake = false;
  lastActivity = 0;     // [ms]
  marks = () => {};     // draws what a remark points at

  /**
   * @param {import("../calligraphy.js").Library} library
   * @param {number} set
   * @param {string} character
   * @param {Settings} settings
   * @param {import("./paper.js").Paper} paper
   * @param {import("./pointer.js").Pointer} pointer
   * @param {{hint(text: string, x: number, y: number): void, changed(lesson: Lesson, isNew?: boolean): void,
   *          written(lesson: Lesson): void}} display what else shows how it goes
   */
  constructor(library, set, character, settings, paper, pointer, display) {
    this.library = library;
    this.settings = settings;
    this.paper = paper;
    this.pointer = pointer;
    this.display = display;
    this.desk = new LessonHandle(library, set, character, { ...settings, mode: this.mode.kind });
    this.character = character;
    this.wake();
  }

  /** Begins with a character. @param {number} set @param {string} character */
  begin(set, character) {
    this.desk.begin(set, character);
    this.character = character;
    this.trace = new Trace();
    this.wake();
  }

  again() {
    this.desk.again();
    this.trace = new Trace();
    this.wake();
  }

  /** Takes other settings. @param {Settings} settings */
  change(settings) {
    if (settings.mode !== this.settings.mode) this.trace = new Trace();
    this.settings = settings;
    this.desk.change({ ...settings, mode: this.mode.kind });
    this.redraw();
  }

  /** @param {number} command such as constants.LESSON_SKIP */
  send(command) {
    this.library.lesson_send(this.desk.handle, command);
    this.wake();
  }

  get mode() {
    return modes[this.settings.mode];
  }

  /** Whether the pen is guided; without, what was written is what the pointer did. */
  get isGuided() {
    return this.mode.isGuided && this.settings.strength > 0;
  }

  /** Whether all is written or skipped, and the pen lifted. */
  get isWritten() {
    return this.view.is_finished !== 0 && this.settings.mode !== "watch";
  }

  get view() {
    return this.desk.view;
  }

  /** The stroke that is due. */
  get due() {
    return this.desk.strokes[this.view.due];
  }

  /** Writes a trace as if the pointer did it now, but faster. @param {Trace} trace */
  play(trace) {
    const last = trace.paths[trace.paths.length - 1].samples.at(-1)?.time ?? 0;
    trace.moveTo(Math.floor(performance.now() - rest - last));  // until now
    this.trace = trace;
    this.played = trace.played().reverse();
    const first = this.played[this.played.length - 1].time;
    this.added += Math.ceil(Math.max(0, this.time + rest - this.added - first));
    this.time = first + this.added - rest;
    this.pointer.samples.length = 0;  // not seen
    this.display.changed(this);
    this.wake();
  }

  /** Shows what a remark is about until the next call. @param {() => void} marks draws on the layer of marks */
  point(marks) {
    this.marks = marks;
    this.wake();
  }

  /** Draws from now on, until nothing changes. */
  wake() {
    this.lastActivity = performance.now();
    if (this.isAwake) return;
    this.isAwake = true;
    requestAnimationFrame((now) => this.#picture(now));
  }

  redraw() {
    this.shown = "";
    this.wake();
  }

  /** @param {number} now */
  #picture(now) {
    const isBusy = this.played.length > 0 ? this.#play(now) : this.#goOn(now);
    this.#look();
    this.#draw(now);
    const isMoving = this.played.length > 0 || this.animations.playing.length > 0;
    this.isAwake = isBusy || isMoving || now - this.lastActivity < rest;
    if (this.isAwake) requestAnimationFrame((next) => this.#picture(next));
  }

  /** Up to now. @param {number} now */
  #goOn(now) {
    for (let sample = this.pointer.take(now); sample; sample = this.pointer.take(now)) {
      if (sample.isPalm) this.trace.dropPenDown();
      else if (!this.view.is_finished && this.settings.mode !== "watch") this.trace.add(sample);
      this.#move(sample);
    }
    this.time = Math.max(this.time, now + this.added);
    return this.desk.advance(this.time);
  }

  /** A part of a trace. @param {number} now */
  #play(now) {
    this.pointer.samples.length = 0;
    do {
      const sample = /** @type {import("./pointer.js").PointerSample} */ (this.played.pop());
      this.#move(sample);
      this.time = Math.max(this.time, sample.time + this.added);
      this.desk.advance(this.time);
    } while (this.played.length > 0 && performance.now() - now < longestWork);
    if (this.played.length > 0) return true;
    this.added = Math.ceil(Math.max(this.added, this.time + rest - now));
    return this.desk.advance(this.time += rest);
  }

  /** @param {import("./pointer.js").PointerSample} sample */
  #move(sample) {
    this.hasPointer = true;
    this.desk.move({ ...sample, time: sample.time + this.added });
  }

  /** What has happened since the last picture. */
  #look() {
    const { desk, view, display } = this, hadPenDown = this.trace.hasPenDown;
    const events = desk.look();
    for (const event of events) {
      if (event.kind === constants.LESSON_RESTARTED) this.#restart();
      if (event.kind === constants.LESSON_REFUSED) this.#refuse(event);
      const isTold = event.kind === constants.LESSON_REFUSED || event.kind === constants.LESSON_HINTED;
      if (isTold) display.hint(desk.hint(), event.place[0], event.place[1]);
    }
    if (view.hint === constants.HINT_NONE && view.reason === constants.REFUSAL_NONE) display.hint("", 0, 0);
    this.ink.length = view.ink_count;
    for (let i = 0; i < view.ink_count; ++i) (this.ink[i] ??= new Ink()).take(desk, i, this.paper.pixel);
    const isNew = events.every(({ kind }) => kind === constants.LESSON_RESTARTED);
    if (events.length > 0 || hadPenDown !== this.trace.hasPenDown) display.changed(this, isNew);
    if (events.some(({ kind }) => kind === constants.LESSON_FINISHED) && this.settings.mode !== "watch") {
      display.written(this);
    }
  }

  /** A page has been begun. */
  #restart() {
    this.ink = [];
    this.marks = () => {};
    this.animations.clear();
    this.redraw();
  }

  /** Ink that was refused goes away, and the stroke that is due flashes. @param {{pen_down: number}} event */
  #refuse({ pen_down }) {
    const { paper, due } = this, context = paper.contexts.marks;
    this.animations.add(500, (share) => {
      context.globalAlpha = 0.6 * (1 - share);
      for (const ink of this.ink) if (ink.penDown === pen_down) ink.guided.draw(context, colours.wrong);
      context.globalAlpha = 1;
    });
    if (this.view.demonstrated >= 0 || this.view.is_on_paper || !due) return;
    this.animations.add(900, (share) => {
      context.globalAlpha = Math.sin(2 * Math.PI * share) ** 2;
      paper.fillStroke("marks", due, colours.flash);
      context.globalAlpha = 1;
    });
  }

  /** @param {number} now */
  #draw(now) {
    const { paper, view, desk: { strokes }, settings: { mode } } = this;
    const due = mode === "watch" ? -1 : view.due;
    const shows = JSON.stringify([view.due, view.demonstrated, strokes.map(({ fate, isShown }) => [fate, isShown]),
                                  this.ink.map(({ fate, isDoubted }) => [fate, isDoubted])]);
    if (shows !== this.shown) {
      this.shown = shows;
      paper.drawGrid();
      strokes.forEach((stroke, i) => {
        if (stroke.isShown) paper.fillStroke("sheet", stroke, i === due ? colours.due : colours.template);
      });
      paper.clear("ink");
      paper.clear("pen");
      strokes.forEach((stroke, i) => {
        const isDemonstrated = mode === "watch" && (view.is_finished || i < view.demonstrated);
        if (stroke.fate === constants.FATE_SKIPPED) paper.fillStroke("ink", stroke, colours.skipped);
        if (isDemonstrated) paper.fillStroke("ink", stroke, colours.ink);
      });
      for (const ink of this.ink) this.#drawInk(ink, true);
    } else if (this.ink.length > 0) {
      this.#drawInk(this.ink[this.ink.length - 1], false);
    }
    paper.clear("marks");
    if (view.shows_start && this.due) paper.markStart(this.due);
    this.animations.play(now);
    if (view.demonstrated >= 0) {
      const colour = mode === "watch" ? colours.ink : colours.flash;
      paper.fillBeginning("marks", strokes[view.demonstrated], colour, view.demonstrated_share);
    }
    this.marks();
    if (this.hasPointer && !view.is_finished) paper.markPen(view.pen_tip[0], view.pen_tip[1], view.is_on_paper !== 0);
  }

  /** The ink that is to be seen of a pen-down: all of it, or what is new. @param {Ink} ink @param {boolean} isWhole */
  #drawInk({ fate, isDoubted, guided, own }, isWhole) {
    const isOpen = fate === constants.FATE_OPEN;
    if (!isOpen && fate !== constants.FATE_ACCEPTED) return;
    const context = this.paper.contexts[isOpen && !isDoubted ? "pen" : "ink"];
    const which = this.isGuided ? this.settings.ink : "own", colour = isDoubted ? colours.skipped : colours.ink;
    if (which !== "own") guided.draw(context, colour, 1, isWhole);
    if (which === "own") own.draw(context, colour, 1, isWhole);
    if (which === "both") own.draw(context, colours.own, 0.25, isWhole);
  }
}

