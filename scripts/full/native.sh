#!/usr/bin/env bash
# Builds the reference for the other scripts here: tests/portability with this system's compiler. The output of its
# programs is written to BUILD_DIRECTORY/native.bits, native.page and native.forces.
# usage: native.sh BUILD_DIRECTORY
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=$1
cmake -S tests/portability -B "$build/native" -G Ninja -DCMAKE_BUILD_TYPE=Release > /dev/null
cmake --build "$build/native" --target print_bits print_page print_forces
"$build/native/print_bits" > "$build/native.bits"
"$build/native/print_page" > "$build/native.page"
"$build/native/print_forces" > "$build/native.forces"
