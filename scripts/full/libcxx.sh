#!/usr/bin/env bash
# The library with clang and libc++, phantom and openhaptics aside, and a page written with it, which agrees with that
# of this system's compiler to 1e-9. Needs clang-14 and libc++-14-dev, or newer ones by CXX.
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
