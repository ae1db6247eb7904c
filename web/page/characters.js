// The characters that can be written: those of the file beside the page, or those that are built in.

/**
 * @param {import("../calligraphy.js").Library} library
 * @returns {Promise<{set: number, strokes: number, characters: string[], isImported: boolean}>} handles of the set and of
 * the typical strokes, the set's characters in the order in which they are offered, and whether they are of the file
 */
export async function openCharacters(library) {
  const strokes = library.set_typical_strokes();
  const [set, list] = await Promise.all(["characters.set", "characters.txt"].map(fetched));
  if (set && list) {
    const handle = library.set_from_memory(set, set.length, "characters.set");
    const known = new Set(listed(library, handle)), wanted = new TextDecoder().decode(list);
    const characters = [...new Set(wanted)].filter((each) => known.has(each));
    return { set: handle, strokes, characters, isImported: true };
  }
  const handle = library.set_built_in();
  return { set: handle, strokes, characters: listed(library, handle), isImported: false };
}

/**
 * What is to be written of a text: its first character as the set has it, or a typical stroke, also by its number.
 * @param {import("../calligraphy.js").Library} library
 * @param {Awaited<ReturnType<typeof openCharacters>>} from
 * @param {string} text
 * @returns {{character: string, note: string}} and what is to be told of how it was read
 */
export function readCharacter(library, { set, strokes }, text) {
  if (/^\d+$/.test(text)) {
    const numbered = listed(library, strokes).filter((stroke) => !/[\u31C0-\u31EF]/.test(stroke));
    return { character: numbered[Number(text) - 1] ?? text, note: "" };
  }
  const read = library.struct("text_character");
  try {
    library.text_read(set, text, 0, read);
    return { character: String.fromCodePoint(read.code), note: library.text(read.note) };
  } catch {
    return { character: text, note: "" };  // it has none
  } finally {
    library.discard(read);
  }
}

/**
 * The set that has a character: of both, the typical strokes last.
 * @param {import("../calligraphy.js").Library} library
 * @param {{set: number, strokes: number}} from
 * @param {string} character
 */
export function setWith(library, { set, strokes }, character) {
  return !has(library, set, character) && has(library, strokes, character) ? strokes : set;
}

/** @param {import("../calligraphy.js").Library} library @param {number} set @param {string} character */
function has(library, set, character) {
  const code = character.codePointAt(0) ?? 0;
  try {
    return library.set_next(set, code) === code;
  } catch {
    return false;  // it is past the last one
  }
}

/** The bytes of a file beside the page; none where it is missing. @param {string} name */
async function fetched(name) {
  const response = await fetch(new URL(`../${name}`, import.meta.url));
  return response.ok ? new Uint8Array(await response.arrayBuffer()) : undefined;
}

/** All characters of a set, 永 first. @param {import("../calligraphy.js").Library} library @param {number} set */
function listed(library, set) {
  const found = [];
  try {
    for (let code = library.set_next(set, 0); ; code = library.set_next(set, code + 1)) found.push(code);
  } catch {
    // The last one was listed.
  }
  const characters = found.map((code) => String.fromCodePoint(code));
  return characters.sort((one, other) => Number(other === "永") - Number(one === "永"));
}
