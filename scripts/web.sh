#!/usr/bin/env bash
# Installs what is missing and builds the C interface as WebAssembly, with all that a page needs to use it, in
# BUILD_DIRECTORY/web; prints its size.
# usage: web.sh [BUILD_DIRECTORY]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=${1:-build-web}
scripts/install_dependencies.sh web
export NODE_PATH=${NODE_PATH:-/usr/share/nodejs}  # modules of Debian's em++, if node is not Debian's

# Eigen and utfcpp are header-only: those of this system, which emcmake would not look at.
emcmake cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=/usr \
  -DCMAKE_FIND_ROOT_PATH_MODE_PACKAGE=BOTH -DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=BOTH \
  -DCALLIGRAPHY_{IMPORTERS,PICTURES,PHANTOM,OPENHAPTICS,TOOLS,TESTS,EXAMPLES}=OFF > /dev/null
cmake --build "$build" --target calligraphy_web
for file in calligraphy.wasm calligraphy.mjs calligraphy_layout.mjs calligraphy.js; do
  printf '%-23s %7d bytes, %6d compressed by gzip\n' "$file" "$(wc -c < "$build/web/$file")" \
    "$(gzip -9 < "$build/web/$file" | wc -c)"
done
