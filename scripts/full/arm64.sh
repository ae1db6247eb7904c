#!/usr/bin/env bash
# Nearest points and forces of this processor and of an emulated arm64, bit by bit: cross-compiles the library and
# tests/portability/print_bits.cpp and compares what they print. Needs g++-aarch64-linux-gnu and qemu-user.
# usage: arm64.sh [BUILD_DIRECTORY]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=${1:-build-full}

build_for() {
  cmake -S tests/portability -B "$build/$1" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCALLIGRAPHY_PRACTICE=OFF \
    -DCALLIGRAPHY_PHANTOM=OFF -DCALLIGRAPHY_OPENHAPTICS=OFF "${@:2}" > /dev/null
  cmake --build "$build/$1" --target print_bits
}
build_for native
build_for arm64 -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 \
  -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++

"$build/native/print_bits" > "$build/native.bits"
qemu-aarch64 -L /usr/aarch64-linux-gnu "$build/arm64/print_bits" > "$build/arm64.bits"
different=$(paste "$build/native.bits" "$build/arm64.bits" | awk '$1 != $2' | wc -l)
echo "$different of $(wc -l < "$build/native.bits") numbers differ on arm64"
cmp "$build/native.bits" "$build/arm64.bits"
