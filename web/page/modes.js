// The modes of a lesson, and what else of it can be set.
import { constants } from "../calligraphy.js";

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
