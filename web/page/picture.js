// The picture of a lesson: template, ink, marks, and what moves.
import { constants } from "../calligraphy.js";
import { Animations } from "./animations.js";
import { colours } from "./paper.js";

export class Picture {
  animations = new Animations();
  shown = "";          // what the layers of sheet and ink show
  hasPointer = false;  // has been seen
  marks = () => {};    // draws what a remark points at

  /** @param {import("./lesson.js").Lesson} lesson @param {import("./paper.js").Paper} paper */
  constructor(lesson, paper) {
    this.lesson = lesson;
    this.paper = paper;
  }

  /** A page has been begun. */
  clear() {
    this.marks = () => {};
    this.animations.clear();
    this.shown = "";
  }

  /** Ink that was refused goes away, and the stroke that is due flashes. @param {number} penDown its number */
  refuse(penDown) {
    const { paper, lesson, lesson: { due, view } } = this, context = paper.contexts.marks;
    this.animations.add(500, (share) => {
      context.globalAlpha = 0.6 * (1 - share);
      for (const ink of lesson.ink) if (ink.penDown === penDown) ink.guided.draw(context, colours.wrong);
      context.globalAlpha = 1;
    });
    if (view.demonstrated >= 0 || view.is_on_paper || !due) return;
    this.animations.add(900, (share) => {
      context.globalAlpha = Math.sin(2 * Math.PI * share) ** 2;
      paper.fillStroke("marks", due, colours.flash);
      context.globalAlpha = 1;
    });
  }

  /** @param {number} now */
  draw(now) {
    const { paper, lesson, lesson: { view, desk: { strokes }, settings: { mode } } } = this;
    const due = mode === "watch" ? -1 : view.due;
    const shows = JSON.stringify([view.due, view.demonstrated, strokes.map(({ fate, isShown }) => [fate, isShown]),
                                  lesson.ink.map(({ fate, isDoubted }) => [fate, isDoubted])]);
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
      for (const ink of lesson.ink) this.#drawInk(ink, true);
    } else if (lesson.ink.length > 0) {
      this.#drawInk(lesson.ink[lesson.ink.length - 1], false);
    }
    paper.clear("marks");
    if (view.shows_start && lesson.due) paper.markStart(lesson.due);
    this.animations.play(now);
    if (view.demonstrated >= 0) {
      const colour = mode === "watch" ? colours.ink : colours.flash;
      paper.fillBeginning("marks", strokes[view.demonstrated], colour, view.demonstrated_share);
    }
    this.marks();
    if (this.hasPointer && !view.is_finished) paper.markPen(view.pen_tip[0], view.pen_tip[1], view.is_on_paper !== 0);
  }

  /** The ink that is to be seen of a pen-down: all of it, or what is new. @param {import("./ink.js").Ink} ink
   * @param {boolean} isWhole */
  #drawInk({ fate, isDoubted, guided, own }, isWhole) {
    const isOpen = fate === constants.FATE_OPEN;
    if (!isOpen && fate !== constants.FATE_ACCEPTED) return;
    const context = this.paper.contexts[isOpen && !isDoubted ? "pen" : "ink"];
    const { isGuided, settings } = this.lesson, which = isGuided ? settings.ink : "own";
    const colour = isDoubted ? colours.skipped : colours.ink;
    if (which !== "own") guided.draw(context, colour, 1, isWhole);
    if (which === "own") own.draw(context, colour, 1, isWhole);
    if (which === "both") own.draw(context, colours.own, 0.25, isWhole);
  }
}

