// What is drawn for a while, picture by picture.

/**
 * @typedef {object} Animation
 * @property {number} duration [ms]
 * @property {number} [begin] time of its first picture [ms]
 * @property {(share: number) => void} draw with the share of it that has passed
 * @property {() => void} [then]
 */

export class Animations {
  /** @type {Animation[]} */
  playing = [];

  /** @param {number} duration [ms] @param {(share: number) => void} draw @param {() => void} [then] */
  add(duration, draw, then) {
    this.playing.push({ duration, draw, then });
  }

  /** Draws a picture of each. @param {number} now [ms] */
  play(now) {
    const { playing } = this;
    const ended = playing.filter((animation) => {
      animation.begin ??= now;
      const share = Math.min(1, (now - animation.begin) / animation.duration);
      animation.draw(share);
      return share === 1;
    });
    this.playing = playing.filter((animation) => !ended.includes(animation));
    for (const { then } of ended) then?.();
  }

  /** Ends all, and nothing comes after them. */
  clear() {
    this.playing = [];
  }
}
