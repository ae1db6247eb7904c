#!/usr/bin/env bash
# Builds the components up to practice as WebAssembly, and checks that a page written with them in node agrees to 1e-9
# with that of this system's compiler. Requires emscripten 3.1.6 or newer and node 17 or newer.
# usage: wasm.sh [one | BUILD_DIRECTORY]
#   one   checks one translation unit that includes most of the headers, in seconds
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
export NODE_PATH=${NODE_PATH:-/usr/share/nodejs}  # modules of Debian's em++, if node is not Debian's

if [[ ${1:-} == one ]]; then
  exec em++ -std=c++20 -fwasm-exceptions -fsyntax-only -Iinclude -isystem /usr/include/eigen3 \
    tests/portability/print_page.cpp
fi
build=${1:-build-full}
scripts/full/native.sh "$build"
found() { sed -n "s/^$1:[A-Z]*=//p" "$build/native/CMakeCache.txt"; }  # header-only, the same for every processor
emcmake cmake -S tests/portability -B "$build/wasm" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_FLAGS=-fwasm-exceptions -DEigen3_DIR="$(found Eigen3_DIR)" \
  -DUTF8CPP_INCLUDE_DIR="$(found UTF8CPP_INCLUDE_DIR)" > /dev/null
cmake --build "$build/wasm" --target print_bits print_page
ls -l "$build"/wasm/*.wasm
node=(node --no-experimental-fetch)  # with fetch, Emscripten 3.1.6 would load files as if from a server
"${node[@]}" "$build/wasm/print_bits.js" > "$build/wasm.bits"
cmp "$build/native.bits" "$build/wasm.bits"
"${node[@]}" "$build/wasm/print_page.js" > "$build/wasm.page"
scripts/full/compare_numbers.py "$build/native.page" "$build/wasm.page"
