#!/usr/bin/env bash
# Builds the programs that no test runs (benchmarks, judges of the guidance and of stroke matching, long fuzz and soak
# runs), and runs them for an instant, so that they cannot rot; fuzz and soak also under sanitizers.
# usage: programs.sh [BUILD_DIRECTORY]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=${1:-build-full}

cmake -S . -B "$build/programs" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCALLIGRAPHY_BENCHMARKS=ON > /dev/null
cmake --build "$build/programs" --target programs
ctest --test-dir "$build/programs" --output-on-failure --no-tests=error -R "/the benchmark of "
"$build/programs/tests/guidance/guidance_judge" pairs --cases 2 > /dev/null
"$build/programs/tests/stroke_judge/stroke_judge" --written 4 --cases 2 > /dev/null
"$build/programs/tests/stability/guidance_sweep" --cases 2 > /dev/null
"$build/programs/tests/stability/energy_account" --ticks 100 --draw 2 > /dev/null
"$build/programs/tests/fuzz/nearest_point_fuzz" --queries 20000 --ticks 20000 > /dev/null
"$build/programs/tests/soak/session_soak" --ticks 200000 > /dev/null

cmake -S . -B "$build/programs_sanitized" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" \
  -DCMAKE_CXX_COMPILER="${CXX:-clang++}" -DCALLIGRAPHY_SANITIZE=address,undefined > /dev/null
cmake --build "$build/programs_sanitized" --target nearest_point_fuzz session_soak
"$build/programs_sanitized/tests/fuzz/nearest_point_fuzz" --queries 100000 --ticks 100000
"$build/programs_sanitized/tests/soak/session_soak" --ticks 200000
