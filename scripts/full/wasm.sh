#!/usr/bin/env bash
# Builds the components up to practice and the C interface as WebAssembly, tests the latter in JavaScript, and checks
# that pages written with them in node agree to 1e-9 with those of this system's compiler. Prints the size of the module
# and what a tick takes. Requires emscripten 3.1.6 or newer and node 18 or newer.
# usage: wasm.sh [one | BUILD_DIRECTORY]
#   one   checks one translation unit with most of the headers and the C interface's sources and layout, in seconds
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
export NODE_PATH=${NODE_PATH:-/usr/share/nodejs}  # modules of Debian's em++, if node is not Debian's

if [[ ${1:-} == one ]]; then
  layout=$(mktemp -d)
  trap 'rm -rf "$layout"' EXIT
  python3 web/layout.py include/calligraphy/c/calligraphy.h "$layout"
  printf '#include "%s"\n' tests/portability/print_page.cpp src/c/*.cpp "$layout/layout_check.cpp" |
    em++ -std=c++20 -fwasm-exceptions -msimd128 -fsyntax-only -DCALLIGRAPHY_LIBRARY_VERSION='""' -I. -Iinclude -Isrc \
      -isystem /usr/include/eigen3 -x c++ -
  exit
fi
build=${1:-build-full}
scripts/full/native.sh "$build"
found() { sed -n "s/^$1:[A-Z]*=//p" "$build/native/CMakeCache.txt"; }  # header-only, the same for every processor
emcmake cmake -S tests/portability -B "$build/wasm" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_FLAGS="-fwasm-exceptions -msimd128" -DEigen3_DIR="$(found Eigen3_DIR)" \
  -DUTF8CPP_INCLUDE_DIR="$(found UTF8CPP_INCLUDE_DIR)" > /dev/null
cmake --build "$build/wasm" --target print_bits print_page
ls -l "$build"/wasm/*.wasm
# With fetch, Emscripten 3.1.6 would load files as if from a server. With threads of its own, V8 of node 20 may wait at
# the end for a garbage collection that does not come.
node=(node --no-experimental-fetch --single-threaded)
"${node[@]}" "$build/wasm/print_bits.js" > "$build/wasm.bits"
cmp "$build/native.bits" "$build/wasm.bits"
"${node[@]}" "$build/wasm/print_page.js" > "$build/wasm.page"
scripts/full/compare_numbers.py "$build/native.page" "$build/wasm.page"

scripts/web.sh --module "$build/web"
"${node[@]}" tests/c/web/test_interface.mjs "$build/web/web"
"${node[@]}" tests/portability/print_forces.mjs "$build/web/web" > "$build/wasm.forces"
scripts/full/compare_numbers.py "$build/native.forces" "$build/wasm.forces"
