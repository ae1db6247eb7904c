// Prints the numbers of scripted_forces.mjs, one a line, and what a tick takes to the standard error.
// usage: node print_forces.mjs DIRECTORY, where scripts/web.sh built the module
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { nanosecondsPerTick, scriptedForces } from "./scripted_forces.mjs";

const directory = resolve(process.argv[2]);
const { constants, load } = await import(`${directory}/calligraphy.js`);
const library = await load(readFileSync(`${directory}/calligraphy_module.wasm`));
const written = scriptedForces(library, constants);
console.log(written.numbers.join("\n"));
console.error(`${nanosecondsPerTick(library, written)} ns per tick in JavaScript`);
