#!/usr/bin/env bash
# The components up to practice as WebAssembly, and a page written with them in node, which agrees with that of this
# system's compiler to 1e-9. Needs emscripten 3.1.6 or newer and node 17 or newer.
# usage: wasm.sh [one | BUILD_DIRECTORY]
#   one   checks one translation unit that includes most of the headers, in seconds
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
export NODE_PATH=${NODE_PATH:-/usr/share/nodejs}  # of Debian's em++, where node is not Debian's

if [[ ${1:-} == one ]]; then
  exec em++ -std=c++20 -fwasm-exceptions -fsyntax-only -Iinclude -isystem /usr/include/eigen3 \
    tests/portability/print_page.cpp
fi
build=${1:-build-full}
scripts/full/native.sh "$build"
found() { sed -n "s/^$1:[A-Z]*=//p" "$build/native/CMakeCache.txt"; }  # headers alone, the same for every processor
emcmake cmake -S tests/portability -B "$build/wasm" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_FLAGS=-fwasm-exceptions -DEigen3_DIR="$(found Eigen3_DIR)" \
  -DUTF8CPP_INCLUDE_DIR="$(found UTF8CPP_INCLUDE_DIR)" > /dev/null
cmake --build "$build/wasm" --target print_bits print_page
ls -l "$build"/wasm/*.wasm
node=(node --no-experimental-fetch)  # by which Emscripten 3.1.6 would load files as from a server
"${node[@]}" "$build/wasm/print_bits.js" > "$build/wasm.bits"
cmp "$build/native.bits" "$build/wasm.bits"
"${node[@]}" "$build/wasm/print_page.js" > "$build/wasm.page"
scripts/full/compare_numbers.py "$build/native.page" "$build/wasm.page"
