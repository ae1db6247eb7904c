#!/usr/bin/env bash
# Builds the page, writes on it in Chromium, and checks that the forces there agree to 1e-9 with those of this system's
# compiler. Prints what the first load takes, long tasks and what a tick takes. Screenshots of the page go to
# BUILD_DIRECTORY/screenshots.
# usage: page.sh [BUILD_DIRECTORY]
#
# Skipped where there is no Chromium, or npm downloads nothing, unless CALLIGRAPHY_REQUIRE_DATA is set.
# CALLIGRAPHY_CHROMIUM: the browser; by default chromium. CALLIGRAPHY_PROGRAM: as for web.sh. CALLIGRAPHY_PEN_TRACES
# and CALLIGRAPHY_CHARACTER_FILE: pen traces of people (docs/pen-traces.md), and a set file with their characters: how
# many of their strokes the page accepts.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
export NODE_PATH=${NODE_PATH:-/usr/share/nodejs}  # modules of Debian's em++, if node is not Debian's
build=$(realpath -m "${1:-build-full}")
playwright=1.65.1

skip() {
  echo "The page is not tested in a browser: $1." >&2
  if [[ -n ${CALLIGRAPHY_REQUIRE_DATA:-} ]]; then exit 1; fi
  exit 0
}

CALLIGRAPHY_CHROMIUM=${CALLIGRAPHY_CHROMIUM:-$(command -v chromium || true)}
[[ -n $CALLIGRAPHY_CHROMIUM ]] || skip "Chromium is not installed"
npm install --silent --no-fund --no-audit --prefix "$build/playwright" playwright-core@$playwright ||
  skip "playwright-core cannot be downloaded by npm"
scripts/full/native.sh "$build"
scripts/web.sh "$build/web" > "$build/web.log" || { tail -n 40 "$build/web.log"; exit 1; }
[[ -f web/dist/characters.set ]] || skip "its characters cannot be downloaded by npm"

# A copy of which node knows that its files are modules.
rm -rf "$build"/{page,screenshots,chromium.forces}
mkdir -p "$build/screenshots"
cp -r web/dist "$build/page"
echo '{"type": "module"}' > "$build/page/package.json"
downloaded=$build/web/data/hanzi-writer-data-2.0.1.tgz
export CALLIGRAPHY_CHROMIUM CALLIGRAPHY_PROGRAM=${CALLIGRAPHY_PROGRAM:-build/tools/calligraphy}
export CALLIGRAPHY_HANZI_WRITER_DATA_TARBALL=${CALLIGRAPHY_HANZI_WRITER_DATA_TARBALL:-$downloaded}
export CALLIGRAPHY_FORCES=$build/chromium.forces CALLIGRAPHY_PRINT_FORCES=$build/native/print_forces
status=0
node tests/web/test_page.mjs "$build/page" "$build/playwright" "$build/screenshots" > "$build/page.log" || status=$?
# Of the test's output, what it measured, its failures, and the counts.
sed -n '/^not ok/,/^  \.\.\.$/p; /^# \(Subtest\|suites\|cancelled\|todo\|duration\)/d; /^# /p' "$build/page.log"
scripts/full/compare_numbers.py "$build/native.forces" "$build/chromium.forces" || status=$?
if [[ -n ${CALLIGRAPHY_PEN_TRACES:-} && -n ${CALLIGRAPHY_CHARACTER_FILE:-} ]]; then
  node --no-experimental-fetch tests/web/free_pens.mjs "$build/page" "$CALLIGRAPHY_CHARACTER_FILE" \
    "$CALLIGRAPHY_PEN_TRACES/handwriting_zh_TW.txt" > "$build/free_pens.log" || status=$?
  cat "$build/free_pens.log"
fi
exit $status
