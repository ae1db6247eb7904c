#!/usr/bin/env bash
# What the other scripts here compare with: tests/portability by this system's compiler, and what its programs print as
# BUILD_DIRECTORY/native.bits and native.page.
# usage: native.sh BUILD_DIRECTORY
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=$1
cmake -S tests/portability -B "$build/native" -G Ninja -DCMAKE_BUILD_TYPE=Release > /dev/null
cmake --build "$build/native" --target print_bits print_page
"$build/native/print_bits" > "$build/native.bits"
"$build/native/print_page" > "$build/native.page"
