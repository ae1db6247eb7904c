#!/usr/bin/env bash
# Builds the library without phantom and openhaptics with clang and libc++, and checks that a page written with it agrees
# to 1e-9 with that of this system's compiler. Requires clang-14 and libc++-14-dev, or newer ones set by CXX.
# usage: libcxx.sh [one | BUILD_DIRECTORY]
#   one   checks one translation unit that includes most of the headers, in seconds
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
compiler=${CXX:-clang++-14}

if [[ ${1:-} == one ]]; then
  exec "$compiler" -std=c++20 -stdlib=libc++ -fsyntax-only -Wall -Wextra -Iinclude -isystem /usr/include/eigen3 \
    tests/portability/print_page.cpp
fi
build=${1:-build-full}
scripts/full/native.sh "$build"
cmake -S tests/portability -B "$build/libcxx" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_CXX_FLAGS=-stdlib=libc++ -DCALLIGRAPHY_IMPORTERS=ON -DCALLIGRAPHY_PICTURES=ON > /dev/null
cmake --build "$build/libcxx"
"$build/libcxx/print_bits" > "$build/libcxx.bits"
cmp "$build/native.bits" "$build/libcxx.bits"
"$build/libcxx/print_page" > "$build/libcxx.page"
scripts/full/compare_numbers.py "$build/native.page" "$build/libcxx.page"
