#!/usr/bin/env bash
# Builds the programs that no test runs (benchmarks, judges of the guidance, long fuzz and soak runs), and runs the
# benchmarks for an instant, so that they cannot rot.
# usage: programs.sh [BUILD_DIRECTORY]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=${1:-build-full}

cmake -S . -B "$build/programs" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCALLIGRAPHY_BENCHMARKS=ON > /dev/null
cmake --build "$build/programs" --target programs
ctest --test-dir "$build/programs" --output-on-failure --no-tests=error -R "/the benchmark of "
