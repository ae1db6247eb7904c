// The characters that can be written: those of the file beside the page, or those that are built in.

/**
 * @param {import("../calligraphy.js").Library} library
 * @returns {Promise<{set: number, characters: string[], isImported: boolean}>} its handle, its characters in the order
 * in which they are offered, and whether they are those of the file
 */
export async function openCharacters(library) {
  const [set, list] = await Promise.all(["characters.set", "characters.txt"].map(fetched));
  if (set && list) {
    const handle = library.set_from_memory(set, set.length, "characters.set");
    const known = new Set(listed(library, handle)), wanted = new TextDecoder().decode(list);
    return { set: handle, characters: [...new Set(wanted)].filter((each) => known.has(each)), isImported: true };
  }
  const handle = library.set_built_in();
  return { set: handle, characters: listed(library, handle), isImported: false };
}

/**
 * The first character of a text, as the set has it, and what is to be told of that.
 * @param {import("../calligraphy.js").Library} library @param {number} set @param {string} text
 */
export function readCharacter(library, set, text) {
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
