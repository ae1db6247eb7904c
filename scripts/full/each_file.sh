#!/usr/bin/env bash
# Compiles every source file on its own, which detects missing includes that unity builds hide.
# usage: each_file.sh [BUILD_DIRECTORY]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=${1:-build-full}

cmake -S . -B "$build/each_file" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DCALLIGRAPHY_UNITY=OFF \
  -DCALLIGRAPHY_BENCHMARKS=ON > /dev/null
cmake --build "$build/each_file" --target all programs
