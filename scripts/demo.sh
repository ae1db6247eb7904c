#!/usr/bin/env bash
# Installs missing packages, builds, and writes four characters without and with guidance.
# Options, such as --repeat 20, are passed to `calligraphy write`; the text is fixed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/build_program.sh
build/tools/calligraphy write 北京航空 --out demo --force "$@"

cat << END

In $PWD/demo, which the next run of this script replaces:
  NN-CHARACTER-MODE-writing.svg what was written of a character: strokes numbered, mistakes red
  page-N-MODE-writing.svg       the whole page
  NN-CHARACTER-force-plot.svg   force over time
  page-N-MODE-1.recording.gz    everything that came in; \`calligraphy replay\` makes the forces again
  strokes.csv                   a line per stroke
  summary.json                  the table above, scores, and the reason of each mistake

Other characters, and what force changes over 20 pairs of trials:
  build/tools/calligraphy write 永 --repeat 20 --out yong
The program, task by task: docs/program.md
To write yourself, with a mouse, a finger or a pen, in a browser:
  scripts/web.sh --serve
END
