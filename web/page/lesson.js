// A character being written: what the pen does becomes ink, hints and, at the end, a score.
import { constants } from "../calligraphy.js";
import { Animations } from "./animations.js";
import { Desk, em, sheet } from "./desk.js";
import { Brush, InkLine } from "./ink.js";
import { colours } from "./paper.js";
import { PenDown } from "./pen_down.js";
import { Recorder, verdicts } from "./recorder.js";
import { Trace } from "./trace.js";

/**
 * @typedef {import("../calligraphy_layout.js").Structs["tick"]} Tick
 * @typedef {"guided" | "vision" | "next" | "memory" | "watch"} ModeName
 * @typedef {object} Settings
 * @property {ModeName} mode
 * @property {number} strength of the guide, from 0 to 0.8
 * @property {number} tolerance such as constants.TOLERANCE_NORMAL
 * @property {"guided" | "own" | "both"} ink which ink is shown
 */

/** What each mode shows, and whether it guides. */
export const modes = {
  guided: { name: "Guided", template: "all", hasStart: true, isGuided: true },
  vision: { name: "Vision only", template: "all", hasStart: true, isGuided: false },
  next: { name: "Next stroke", template: "next", hasStart: true, isGuided: true },
  memory: { name: "From memory", template: "none", hasStart: false, isGuided: false },
  watch: { name: "Watch", template: "all", hasStart: false, isGuided: false },
};

const missesUntilShown = 2;
const patience = 250;     // time for which a hint must hold before it is shown [ms]
const rest = 1000;        // time without anything to draw after which no more pictures are drawn [ms]
const longestWork = 25;   // on ticks for one picture [ms]
const longestGap = 3000;  // between two pictures: what the pen did before is not made up for [ms]
const longestWay = 150;   // of the lifted pen across the sheet [ms]
const shortestLift = 0.052;  // of a pen; a score takes a shorter one for a bounce [s]
const longestDoubt = 1200;  // of a pen in the air about what it wrote: the last stroke is settled within it [ms]
const longestBounce = 0.15 * em;  // a pointer that is put down this near, with the pen still on the paper, writes on [m]

export class Lesson {
  animations = new Animations();
  /** @type {PenDown[]} */
  penDowns = [];
  /** @type {PenDown | undefined} */
  penDown;  // while the pen is on the paper
  /** @type {PenDown | undefined} */
  unjudged;  // the last that began a stroke, while it is not known whether it wrote it
  endOfDoubt = -Infinity;  // about it, if nothing is left to write [ms]
  recorder = new Recorder();
  trace = new Trace();  // what the pointer did
  /** @type {import("./pointer.js").PointerSample[]} */
  played = [];            // samples of a trace that is written again, the next one last
  endOfPlay = -Infinity;  // [ms]
  /** @type {number[]} */
  skipped = [];  // strokes
  misses = 0;    // of the stroke that is due
  /** @type {Set<number>} */
  missed = new Set();  // strokes that were skipped or written wrongly first
  isWritten = false;

  brush = new Brush();
  tip = [sheet / 2, sheet / 2];  // of the guided pen [m]
  isOnPaper = false;
  isGuideLate = false;  // its settings have changed while a stroke was being written
  hint = { kind: 0, age: 0 };  // why the pen is not guided, and for how long [ms]

  /** @type {InkLine[]} */
  own = [];  // since the last lift
  ownBrush = new Brush();
  /** @type {[number, number]} */
  ownAt = [sheet / 2, sheet / 2];  // where the pointer was last on the paper [m]
  ownTime = 0;                     // and when [ms]
  isDown = false;                  // the pointer
  mustLift = false;                // it was down when the lesson began
  hasPointer = false;              // has been seen
  /** @type {number | undefined} */
  pressure;

  isOpen = true;
  isAwake = false;
  time = 0;          // of the last tick [ms], as performance.now()
  lastActivity = 0;  // [ms]
  lastSample = 0;    // that was taken [ms]
  timeOnPaper = -Infinity;  // of the writer, when the pen was last on the paper [s]
  addedTime = 0;            // to the writer's, so that quick strokes are told apart [s]
  marks = () => {};  // draws what a remark points at

  /**
   * @param {import("../calligraphy.js").Library} library
   * @param {number} set
   * @param {string} character
   * @param {Settings} settings
   * @param {import("./paper.js").Paper} paper
   * @param {import("./pointer.js").Pointer} pointer
   * @param {{hint(text: string, x: number, y: number): void, changed(lesson: Lesson): void,
   *          written(lesson: Lesson): void}} display what else shows how it goes
   */
  constructor(library, set, character, settings, paper, pointer, display) {
    this.library = library;
    this.character = character;
    this.settings = settings;
    this.paper = paper;
    this.pointer = pointer;
    this.display = display;
    this.mustLift = pointer.isDown;
    this.desk = new Desk(library, set, character);
    this.#guide();
    display.hint("", 0, 0);
    display.changed(this);
    paper.clear("marks");
    this.redraw();
    if (settings.mode === "watch") this.#watch();
  }

  /** Ends it: nothing is drawn any more. */
  close() {
    this.isOpen = false;
    this.desk.free();
  }

  /** Takes other settings, but for the mode; of what is written, only which ink is shown. @param {Settings} settings */
  change(settings) {
    this.settings = this.isWritten ? { ...this.settings, ink: settings.ink } : settings;
    this.#guide();
    this.redraw();
  }

  get mode() {
    return modes[this.settings.mode];
  }

  /** Whether the pen is guided; without, what was written is what the pointer did. */
  get isGuided() {
    return this.mode.isGuided && this.settings.strength > 0;
  }

  /** Whether the stroke that is due was missed so often that it is shown. */
  get isStuck() {
    return this.misses >= missesUntilShown;
  }

  /** Writes a trace as if the pointer did it now, but faster. @param {Trace} trace */
  play(trace) {
    const last = trace.paths[trace.paths.length - 1].samples.at(-1)?.time ?? 0;
    trace.moveTo(Math.floor(performance.now() - rest - last));  // until now
    this.trace = trace;
    this.played = trace.played().reverse();
    this.time = this.lastSample = this.played[this.played.length - 1].time - rest;
    this.endOfPlay = this.played[0].time + rest;
    this.pointer.samples.length = 0;  // not seen
    this.display.changed(this);
    this.wake();
  }

  get isPlaying() {
    return this.time < this.endOfPlay;
  }

  /** Passes over the stroke that is due. */
  skip() {
    const stroke = this.desk.due;
    if (this.isWritten || !this.desk.skip()) return;
    if (this.penDown) Object.assign(this.penDown, { isPassed: true, isBegun: false });
    this.unjudged = undefined;
    this.skipped.push(stroke);
    this.missed.add(stroke);
    this.animations.clear();
    this.#strokeIsOver();
    this.#drawInk();
    if (this.desk.due === this.desk.strokes.length) this.#finish();
    this.wake();
  }

  /** Shows what a remark is about until the next call. @param {() => void} marks draws on the layer of marks */
  point(marks) {
    this.marks = marks;
    this.wake();
  }

  /** The pen-down during which a time was [s]. @param {number} time */
  penDownAt(time) {
    return this.penDowns.findLast(({ begin }) => begin <= time + 1e-6);
  }

  /** Draws from now on, until nothing changes. */
  wake() {
    this.lastActivity = performance.now();
    if (this.isAwake) return;
    this.isAwake = true;
    this.time = Math.max(this.time, this.lastActivity);
    requestAnimationFrame((now) => this.#picture(now));
  }

  redraw() {
    this.#drawSheet();
    this.#drawInk();
    this.paper.clear("pen");
    if (this.penDown) this.#drawLines("pen", { guided: this.penDown.guided, own: this.own }, true);
    this.wake();
  }

  /** The grid, and of the template what the mode shows. */
  #drawSheet() {
    const { paper } = this, { template } = this.mode;
    paper.drawGrid();
    this.desk.strokes.forEach((stroke, i) => {
      const isDue = i === this.desk.due && this.settings.mode !== "watch";
      const isShown = template === "all" || (isDue && (template === "next" || this.isStuck));
      if (isShown || this.isWritten) {
        paper.fillStroke("sheet", stroke, isDue ? colours.due : colours.template);
      }
    });
  }

  /** The ink that stays, or may stay. */
  #drawInk() {
    this.paper.clear("ink");
    for (const stroke of this.skipped) this.paper.fillStroke("ink", this.desk.strokes[stroke], colours.skipped);
    for (const penDown of this.penDowns) {
      const isOpen = penDown === this.unjudged;
      const colour = isOpen && penDown.isDoubted ? colours.skipped : colours.ink;
      if (penDown.finish || isOpen) this.#drawLines("ink", penDown, true, colour);
    }
  }

  #guide() {
    const { settings, mode } = this;
    this.isGuideLate = this.isOnPaper || this.unjudged !== undefined;  // what is being written is not disturbed
    if (!this.isGuideLate) this.desk.guide(mode.isGuided ? settings.strength : 0, settings.tolerance);
  }

  /** @param {number} now */
  #picture(now) {
    if (!this.isOpen) return;
    if (now - this.time > longestGap && !this.isPlaying) this.time = now - longestGap;
    for (let tick = 1; this.time < now; ++tick) {
      this.#skipRest();
      this.time += 1;
      this.#takeSamples();
      this.#advance();
      if (tick % 64 === 0 && performance.now() - now > longestWork) break;
    }
    this.#draw(now);
    const isMoving = this.isPlaying || this.animations.playing.length > 0;
    this.isAwake = this.#isBusy || isMoving || now - this.lastActivity < rest;
    if (this.isAwake) requestAnimationFrame((next) => this.#picture(next));
  }

  /** Whether the pen writes, or what it wrote may yet be decided while it is in the air. */
  get #isBusy() {
    return this.isDown || this.isOnPaper || (this.unjudged !== undefined && this.time < this.endOfDoubt);
  }

  /** Leaves out a time in which a lifted pen that is played did nothing: no pictures were drawn then, either. */
  #skipRest() {
    const next = this.played.at(-1)?.time ?? this.time;
    if (!this.#isBusy && this.time - this.lastSample >= rest) this.time = Math.max(this.time, next);
  }

  /** The next sample that is due, of those that are played first. */
  #nextSample() {
    const { played, time } = this, next = played.at(-1);
    if (next) return next.time <= time ? played.pop() : undefined;
    return this.isPlaying ? undefined : this.pointer.take(time);
  }

  /** Keeps what the pointer did. @param {import("./pointer.js").PointerSample} sample */
  #keep(sample) {
    const { trace } = this, hadPenDown = trace.hasPenDown;
    if (sample.isPalm && !this.penDown?.finish) trace.dropPenDown();
    else trace.add(sample);
    if (trace.hasPenDown !== hadPenDown) this.display.changed(this);
  }

  #takeSamples() {
    for (let sample = this.#nextSample(); sample; sample = this.#nextSample()) {
      this.mustLift &&= sample.isDown;
      if (this.settings.mode === "watch" || this.isWritten || this.mustLift) continue;
      if (!this.isPlaying) this.#keep(sample);
      this.lastSample = sample.time;
      if (sample.isPalm && this.penDown) this.penDown.isPalm = true;
      const begins = sample.isDown && !this.isDown;
      if (begins) {
        const jump = Math.hypot(sample.x - this.ownAt[0], sample.y - this.ownAt[1]);
        const isAway = this.isOnPaper ? jump > longestBounce : this.desk.isAwayFrom(sample.x, sample.y);
        if (isAway) this.#bring(sample.x, sample.y);
        if (!this.isOnPaper) this.own = [];
        this.own.push(new InkLine());
        this.ownBrush = new Brush();
      }
      if (sample.isDown) {
        const seconds = begins ? 0 : Math.max(1e-3, (sample.time - this.ownTime) * 1e-3);
        const way = Math.hypot(sample.x - this.ownAt[0], sample.y - this.ownAt[1]);
        const width = this.ownBrush.press(sample.stylus.pressure, seconds > 0 ? way / seconds : 0, seconds);
        if (!this.penDown?.isStray(sample.x, sample.y)) this.own.at(-1)?.add(sample.x, sample.y, width, this.paper.pixel);
        this.ownAt = [sample.x, sample.y];
        this.ownTime = sample.time;
      }
      this.hasPointer = true;
      this.isDown = sample.isDown;
      this.pressure = sample.isDown ? sample.stylus.pressure : 0;  // a pen that is lifted leaves a thin end
      this.desk.move(sample.x, sample.y, sample.isDown, sample.stylus, sample.buttons);
    }
  }

  /** Lifts the pen and takes it to where a finger touches the paper, in no time of the writer's.
   * @param {number} x @param {number} y */
  #bring(x, y) {
    for (let i = 0; i < longestWay && this.isOnPaper; ++i) this.#advance();
    this.desk.move(x, y, false);
    for (let i = 0; i < longestWay; ++i) this.#advance();
  }

  #advance() {
    const { desk, brush, unjudged } = this, before = desk.due;
    const tick = desk.advance(), [x, y] = tick.pen_tip, { events } = tick;
    const isLate = unjudged !== undefined && (events & verdicts) !== 0;  // of a pen-down that is over
    const isOnPaper = tick.state !== constants.SEPARATION;
    if (events & constants.CONTACT) this.#putDown();
    const time = this.#timeOfWriter();
    if (isOnPaper && this.penDown) {
      const speed = Math.hypot(x - this.tip[0], y - this.tip[1]) * 1000;
      const { penDown } = this, ink = penDown.isStray(x, y) ? penDown.stray : penDown.guided;
      ink.add(x, y, brush.press(this.pressure, speed, 1e-3), 0.7 * this.paper.pixel);
    }
    if (isLate) this.recorder.judge(unjudged.lifted, tick);
    const isStray = isOnPaper && events === 0 && this.penDown?.isStray(x, y);
    if ((isOnPaper && !isStray) || tick.events !== 0) this.recorder.add(tick, time, this.ownAt);
    if (isOnPaper) this.timeOnPaper = time;
    this.tip = [x, y];
    this.isOnPaper = isOnPaper;
    this.#readHint(tick);
    (unjudged ?? this.penDown)?.takeEvents(events & verdicts, [x, y]);
    this.penDown?.takeEvents(events & constants.STROKE_STARTED, [x, y]);
    if (isLate) {
      this.unjudged = undefined;
      this.#drawInk();
      this.#settle(unjudged);
    }
    if (events & constants.LIFT) this.#lift();
    if (desk.due !== before) this.#strokeIsOver();
    if (this.isGuideLate && !isOnPaper && !this.unjudged) this.#guide();
  }

  /** Another one is due. */
  #strokeIsOver() {
    this.misses = 0;
    this.display.hint("", 0, 0);
    this.#drawSheet();
    this.display.changed(this);
  }

  /** Of the writer, who may think longer than pictures are drawn [s]. */
  #timeOfWriter() {
    return this.time * 1e-3 + this.addedTime;
  }

  #putDown() {
    this.addedTime += Math.max(0, this.timeOnPaper + shortestLift - this.#timeOfWriter());
    this.animations.clear();
    this.display.hint("", 0, 0);
    this.brush = new Brush();
    this.penDown = new PenDown(this.#timeOfWriter(), this.recorder.count);
    this.penDowns.push(this.penDown);
  }

  #lift() {
    const { penDown } = this;
    this.penDown = undefined;
    if (!penDown) return;
    const isDown = this.isDown ? 1 : 0;  // that of the next stroke already
    penDown.own = this.own.splice(0, this.own.length - isDown);
    penDown.end = [this.tip[0], this.tip[1]];
    this.paper.clear("pen");
    if (penDown.isPalm && !penDown.finish) {
      this.recorder.count = penDown.recorded;
      if (penDown.isBegun) this.#guide();  // which forgets what it wrote
    } else if (penDown.isBegun) {
      penDown.lifted = this.recorder.count - 1;
      this.unjudged = penDown;
      this.endOfDoubt = this.time + longestDoubt;
      this.#drawInk();
    } else {
      if (penDown.finish) this.#drawLines("ink", penDown, true);
      this.#settle(penDown);
    }
  }

  /** What becomes of a pen-down that is over. @param {PenDown} penDown */
  #settle(penDown) {
    if (penDown.finish) {
      this.display.hint("", 0, 0);
      if (this.desk.due === this.desk.strokes.length) this.#finish();
    } else if (!this.isWritten && !penDown.isPassed) {
      this.#refuse(penDown);
    }
  }

  /** @param {PenDown} penDown */
  #refuse(penDown) {
    ++this.misses;
    this.missed.add(this.desk.due);
    const stroke = this.desk.strokes[this.desk.due], shows = this.isStuck;
    this.#fade(penDown);
    if (!this.penDown) {  // otherwise it is being written again
      this.#flash(stroke, () => shows && this.#demonstrate(this.desk.due));
      this.display.hint(penDown.whyNot(stroke) ?? this.#words(penDown.hint), penDown.end[0], penDown.end[1]);
    }
    if (shows) this.#drawSheet();
    this.display.changed(this);
  }

  /** The words for a hint where the pen is now, without the millimetres of a page that the screen shows at another
   * size. @param {number} hint */
  #words(hint) {
    const { library, desk: { tick } } = this, shown = tick.hint;
    tick.hint = hint;
    const words = library.hint(tick).replace(/\d+ mm /, "");
    tick.hint = shown;
    return words;
  }

  #finish() {
    this.isWritten = true;
    this.isDown = false;
    this.desk.move(this.tip[0], this.tip[1], false);
    this.#drawSheet();
    this.display.changed(this);
    this.display.written(this);
  }

  /** @param {Tick} tick */
  #readHint(tick) {
    const kind = tick.hint === constants.HINT_WRITE ? constants.HINT_NONE : tick.hint;
    this.hint = kind === this.hint.kind ? { kind, age: this.hint.age + 1 } : { kind, age: 0 };
    if (kind === constants.HINT_NONE) return;
    const isDoubt = kind === constants.HINT_LIFTED_EARLY, { unjudged } = this;
    if (isDoubt && unjudged && !unjudged.isDoubted) {
      unjudged.isDoubted = true;
      this.#drawInk();
    }
    const isOld = isDoubt && this.penDowns.at(-1) !== unjudged;  // one that was refused since has its own words
    if (this.hint.age === patience && !isOld) this.display.hint(this.#words(kind), this.tip[0], this.tip[1]);
    this.penDown?.takeHint(kind);
  }

  /** @param {number} now */
  #draw(now) {
    const { paper, penDown } = this;
    if (penDown) this.#drawLines("pen", { guided: penDown.guided, own: this.own }, false);
    penDown?.stray.drawOn(paper.contexts.pen, colours.skipped);
    paper.clear("marks");
    const due = this.desk.strokes[this.desk.due];
    if (this.mode.hasStart && due && !(penDown && !penDown.finish)) paper.markStart(due);
    this.animations.play(now);
    this.marks();
    if (this.hasPointer && !this.isWritten) paper.markPen(this.tip[0], this.tip[1], this.isOnPaper);
  }

  /** The ink that is to be seen of a pen-down. @param {"ink" | "pen"} layer
   * @param {{guided: InkLine, own: InkLine[]}} penDown @param {boolean} isWhole @param {string} [usual] its colour */
  #drawLines(layer, { guided, own }, isWhole, usual = colours.ink) {
    const context = this.paper.contexts[layer], ink = this.isGuided ? this.settings.ink : "own";
    const draw = (/** @type {InkLine} */ line, /** @type {string} */ colour, share = 1) =>
      (isWhole ? line.drawAll(context, colour, share) : line.drawOn(context, colour, share));
    if (ink !== "own") draw(guided, usual);
    if (ink === "own") for (const line of own) draw(line, usual);
    if (ink === "both") for (const line of own) draw(line, colours.own, 0.25);
  }

  /** Ink that was refused goes away. @param {PenDown} penDown */
  #fade(penDown) {
    this.animations.add(500, (share) => {
      const context = this.paper.contexts.marks;
      context.globalAlpha = 0.6 * (1 - share);
      penDown.guided.drawAll(context, colours.wrong);
      context.globalAlpha = 1;
    });
  }

  /** @param {import("./desk.js").Stroke} stroke @param {() => void} then */
  #flash(stroke, then) {
    this.animations.add(900, (share) => {
      const context = this.paper.contexts.marks;
      context.globalAlpha = Math.sin(2 * Math.PI * share) ** 2;
      this.paper.fillStroke("marks", stroke, colours.flash);
      context.globalAlpha = 1;
    }, then);
  }

  /** Writes a stroke on the layer of marks. @param {number} index @param {() => void} [then] */
  #demonstrate(index, then) {
    const stroke = this.desk.strokes[index];
    this.animations.add(250 + (400 * stroke.length) / em, (share) => {
      this.paper.fillBeginning("marks", stroke, then ? colours.ink : colours.flash, share);
    }, then);
  }

  /** Writes all strokes, one after the other. */
  #watch(index = 0) {
    const { strokes } = this.desk;
    if (index === strokes.length) return;
    this.#demonstrate(index, () => {
      this.paper.fillStroke("ink", strokes[index], colours.ink);
      this.animations.add(200, () => {}, () => this.#watch(index + 1));
    });
  }
}
