#!/usr/bin/env bash
# Nearest points and forces of this processor and of an emulated arm64, bit by bit; a written page to 1e-9.
# Needs g++-aarch64-linux-gnu and qemu-user.
# usage: arm64.sh [BUILD_DIRECTORY]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=${1:-build-full}

scripts/full/native.sh "$build"
cmake -S tests/portability -B "$build/arm64" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_SYSTEM_NAME=Linux \
  -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++ > /dev/null
cmake --build "$build/arm64" --target print_bits print_page
arm64=(qemu-aarch64 -L /usr/aarch64-linux-gnu)
"${arm64[@]}" "$build/arm64/print_bits" > "$build/arm64.bits"
different=$(paste "$build/native.bits" "$build/arm64.bits" | awk '$1 != $2' | wc -l)
echo "$different of $(wc -l < "$build/native.bits") numbers differ on arm64"
cmp "$build/native.bits" "$build/arm64.bits"
"${arm64[@]}" "$build/arm64/print_page" > "$build/arm64.page"
scripts/full/compare_numbers.py "$build/native.page" "$build/arm64.page"
