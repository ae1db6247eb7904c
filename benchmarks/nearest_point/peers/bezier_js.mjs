// Times bezier.js on the queries of a file: node bezier_js.mjs PACKAGE QUERIES ANSWERS
import { readFileSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [packageDirectory, queriesFile, answersFile] = process.argv.slice(2);
const { Bezier } = await import(pathToFileURL(resolve(packageDirectory, "src/bezier.js")));

const { curves: input, rounds } = JSON.parse(readFileSync(queriesFile, "utf8"));
const curves = input.map(({ control_points, queries }) => {
  const points = [];
  for (let i = 0; i < queries.length; i += 2) points.push({ x: queries[i], y: queries[i + 1] });
  const curve = new Bezier(...control_points);
  curve.getLUT();
  return { curve, points };
});
const count = curves.reduce((sum, { points }) => sum + points.length, 0);
const answers = new Float64Array(4 * count);

const pass = () => {
  let at = 0;
  for (const { curve, points } of curves) {
    for (const point of points) {
      const foot = curve.project(point);
      answers[at++] = foot.t;
      answers[at++] = foot.x;
      answers[at++] = foot.y;
      answers[at++] = foot.d;
    }
  }
};

// Warm-up for the JIT compiler of the engine.
for (const start = process.hrtime.bigint(); process.hrtime.bigint() - start < 300_000_000n; ) pass();
const nanoseconds = [];
for (let round = 0; round < rounds; ++round) {
  const start = process.cpuUsage();
  pass();
  const { user, system } = process.cpuUsage(start); // processor time [us], like the other methods' times
  nanoseconds.push((1000 * (user + system)) / count);
}
writeFileSync(answersFile, JSON.stringify({ nanoseconds, answers: Array.from(answers) }));
