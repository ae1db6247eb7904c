// A lesson on the page: passes on what is done, and tells what has happened. What is decided, the library decides.
import { constants } from "../calligraphy.js";
import { LessonHandle } from "./desk.js";
import { Ink } from "./ink.js";
import { modes } from "./modes.js";
import { Picture } from "./picture.js";
import { Trace } from "./trace.js";

const rest = 1000;       // time without anything to draw after which no more pictures are drawn [ms]
const longestWork = 12;  // on a trace that is played, for one picture [ms]

export class Lesson {
  trace = new Trace();  // what the pointer did
  /** @type {import("./pointer.js").PointerSample[]} */
  played = [];          // samples of a trace that is written again, the last one first
  added = 0;            // to the time, for traces that were played [ms]
  time = 0;             // of the lesson [ms]
  /** @type {Ink[]} */
  ink = [];             // by pen-down
  isAwake = false;
  lastActivity = 0;     // [ms]

  /**
   * @param {import("../calligraphy.js").Library} library
   * @param {number} set
   * @param {string} character
   * @param {import("./modes.js").Settings} settings
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
    this.picture = new Picture(this, paper);
    this.desk = new LessonHandle(library, set, character, { ...settings, mode: this.mode.kind });
    this.character = character;
    this.wake();
  }

  /** Begins with a character. @param {number} set @param {string} character */
  begin(set, character) {
    this.desk.begin(set, character);
    this.character = character;
    this.trace = new Trace();
    this.display.changed(this, true);
    this.wake();
  }

  again() {
    this.desk.again();
    this.trace = new Trace();
    this.display.changed(this, true);
    this.wake();
  }

  /** Takes other settings. @param {import("./modes.js").Settings} settings */
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
    this.picture.marks = marks;
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
    this.picture.shown = "";
    this.wake();
  }

  /** @param {number} now */
  #picture(now) {
    const isBusy = this.played.length > 0 ? this.#play(now) : this.#goOn(now);
    this.#look();
    this.picture.draw(now);
    const isMoving = this.played.length > 0 || this.picture.animations.playing.length > 0;
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
    this.picture.hasPointer = true;
    this.desk.move({ ...sample, time: sample.time + this.added });
  }

  /** What has happened since the last picture. */
  #look() {
    const { desk, view, display } = this, hadPenDown = this.trace.hasPenDown;
    const events = desk.look();
    for (const event of events) {
      if (event.kind === constants.LESSON_RESTARTED) this.#restart();
      if (event.kind === constants.LESSON_REFUSED) this.picture.refuse(event.pen_down);
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
    this.picture.clear();
    this.wake();
  }
}
