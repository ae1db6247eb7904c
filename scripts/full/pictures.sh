#!/usr/bin/env bash
# Draws every picture that the program makes, on small inputs, and puts them on one page with their names, DIR/index.html:
# open it in a browser and look at each. Labels on one another, clipped words and pale colours are seen there alone.
# usage: pictures.sh DIR
#
# CALLIGRAPHY_PROGRAM: the program; by default build/tools/calligraphy.
set -euo pipefail
program=$(realpath "${CALLIGRAPHY_PROGRAM:-$(dirname "${BASH_SOURCE[0]}")/../../build/tools/calligraphy}")
pupil=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../examples/pupil.txt")
mkdir -p "${1:?usage: pictures.sh DIR}"
cd "$1"

draw() { "$program" "$@" --force > /dev/null; }

draw write 永航 --out write
draw write 永 --lines --out write-lines
draw write 永 --language zh --out write-zh
draw write 永 --rules wang2006 --out write-wang2006       # a character that is given up
draw write 十一㇏㇇ --out write-small
draw write 永北京 --repeat 10 --out write-repeated        # errors by character
draw write 永 --repeat 10 --language zh --out write-one
draw replay "$pupil" --out replay
draw replay "$pupil" --device desktop --language zh --out replay-guided
draw replay write/page-1-force-1.recording.gz --out replay-recording
"$program" strokes --out strokes.svg > /dev/null
"$program" strokes --lines --out strokes-lines.svg > /dev/null
draw tradeoff --quick --out tradeoff
draw stability --quick --out stability

{
  echo '<!DOCTYPE html><meta charset="utf-8"><title>Pictures</title>'
  echo '<style>body { font-family: sans-serif; columns: 2; } figure { break-inside: avoid; margin: 0 0 2em; }'
  echo 'img { max-width: 100%; border: 1px solid #ccc; }</style>'
  find . -name '*.svg' | LC_ALL=C sort | while IFS= read -r picture; do
    name=${picture#./}
    echo "<figure><figcaption>$name</figcaption><img src=\"$name\" alt=\"$name\"></figure>"
  done
} > index.html
echo "$(find . -name '*.svg' | wc -l) pictures: $PWD/index.html"
