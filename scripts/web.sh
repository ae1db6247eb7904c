#!/usr/bin/env bash
# Installs what is missing and builds the C interface as WebAssembly, with all that a page needs to use it, in
# BUILD_DIRECTORY/web; prints its size.
# usage: web.sh [BUILD_DIRECTORY]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=${1:-build-web}
scripts/install_dependencies.sh web
export NODE_PATH=${NODE_PATH:-/usr/share/nodejs}  # modules of Debian's em++, if node is not Debian's

# -finline-functions, because em++ 3.1.6 turns it off with -Oz: without it, a tick takes seven times as long.
# Eigen and utfcpp are header-only: those of this system, which emcmake would not look at.
emcmake cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=MinSizeRel \
  -DCMAKE_CXX_FLAGS_MINSIZEREL="-Oz -DNDEBUG -finline-functions -flto" \
  -DCMAKE_PREFIX_PATH=/usr -DCMAKE_FIND_ROOT_PATH_MODE_PACKAGE=BOTH -DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=BOTH \
  -DCALLIGRAPHY_{IMPORTERS,PICTURES,PHANTOM,OPENHAPTICS,TOOLS,TESTS,EXAMPLES}=OFF > /dev/null
cmake --build "$build" --target calligraphy_web
node - "$build"/web/calligraphy{.wasm,.mjs,_layout.mjs,.js} << 'END'
const { readFileSync } = require("fs");
const { brotliCompressSync, gzipSync } = require("zlib");
const row = (name, ...sizes) => console.log(name.padEnd(22), ...sizes.map((size) => String(size).padStart(8)));
row("[bytes]", "raw", "gzip", "brotli");
const total = [0, 0, 0];
for (const path of process.argv.slice(2)) {
  const bytes = readFileSync(path);
  const sizes = [bytes.length, gzipSync(bytes, { level: 9 }).length, brotliCompressSync(bytes).length];
  row(path.replace(/.*\//, ""), ...sizes);
  sizes.forEach((size, i) => { total[i] += size; });
}
row("in total", ...total);
END
