#!/usr/bin/env bash
# Every source file compiled on its own, which shows an #include that its neighbours in a unit have and it lacks.
# usage: each_file.sh [BUILD_DIRECTORY]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=${1:-build-full}

cmake -S . -B "$build/each_file" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DCALLIGRAPHY_UNITY=OFF \
  -DCALLIGRAPHY_BENCHMARKS=ON > /dev/null
cmake --build "$build/each_file"
