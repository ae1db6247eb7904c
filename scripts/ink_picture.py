"""Draws characters of hanzi-writer-data as SVG: their outlines in grey, beside them in black the ink imported from these.

    python3 scripts/ink_picture.py hanzi-writer-data-2.0.1.tgz 永的我龜心飛道北京 docs/images/ink.svg
    python3 scripts/ink_picture.py hanzi-writer-data-2.0.1.tgz 枕疤九北心我风回白永之饯 sheet.svg 400

The last argument is the size of an em square in pixels. Needs the Python module.
"""

import json
import sys
import tarfile

import calligraphy as cal

IN_A_ROW = 3

source, text, out = sys.argv[1:4]
SIZE = int(sys.argv[4]) if len(sys.argv) > 4 else 150  # of an em square [px]
characters, _ = cal.import_characters(source, only=text)

with tarfile.open(source) as package:
    outlines = {}
    for character in text:
        with package.extractfile(f"package/{character}.json") as file:
            outlines[character] = json.load(file)["strokes"]


def ink(character):
    """The outlines of the ink as SVG paths, in pixels."""
    for stroke in characters[character].strokes():
        points = " ".join(f"{SIZE * x:.1f},{SIZE * (1 - y):.1f}" for x, y in cal.ink_outline(stroke, 1e-3))
        yield f'<polygon points="{points}"/>'


rows = -(-len(text) // IN_A_ROW)
with open(out, "w", encoding="utf-8") as file:
    file.write(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{2 * IN_A_ROW * SIZE}" height="{rows * SIZE}">\n'
        "<title>Outlines of hanzi-writer-data and the ink imported from them</title>\n"
        "<desc>Arphic Technology, Make Me a Hanzi, Hanzi Writer; Arphic Public License</desc>\n"
        '<rect width="100%" height="100%" fill="#ffffff"/>\n'
    )
    for index, character in enumerate(text):
        x, y = 2 * SIZE * (index % IN_A_ROW), SIZE * (index // IN_A_ROW)
        scale = SIZE / 1024
        file.write(f'<g fill="#999999" transform="translate({x} {y}) scale({scale} {-scale}) translate(0 -900)">\n')
        file.writelines(f'<path d="{path}"/>\n' for path in outlines[character])
        file.write(f'</g>\n<g fill="#111111" transform="translate({x + SIZE} {y})">\n')
        file.writelines(path + "\n" for path in ink(character))
        file.write("</g>\n")
    file.write("</svg>\n")
