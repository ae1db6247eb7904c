#!/usr/bin/env bash
# Fetches the peers, builds, and compares every nearest-point method with them. Missing peers are omitted and listed.
# usage: run.sh [--instructions] [options of benchmark_nearest_point]
#   --instructions   also count instructions per query with valgrind's callgrind
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

instructions=
if [[ ${1:-} == --instructions ]]; then
  instructions=yes
  shift
fi

build=$PWD/build-peers
scripts/install_dependencies.sh tests
scripts/install_dependencies.sh peers || echo "== could not install all packages of the peers" >&2

# bezier.js: pinned, unpacked into the build directory.
bezier_js=$build/bezier-js-6.1.4
if [[ ! -f $bezier_js/package.json ]] && command -v npm > /dev/null && command -v node > /dev/null; then
  mkdir -p "$build/unpacking"
  (cd "$build/unpacking" && npm pack --loglevel=error bezier-js@6.1.4 > /dev/null && tar -xzf ./*.tgz) &&
    mv "$build/unpacking/package" "$bezier_js" || echo "== could not fetch bezier-js with npm pack" >&2
  rm -rf "$build/unpacking"
fi
[[ ! -f $bezier_js/package.json ]] || set -- --bezier_js "$bezier_js" "$@"

configure() {
  cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCALLIGRAPHY_BENCHMARKS=ON -DCALLIGRAPHY_TESTS=OFF \
    -DCALLIGRAPHY_TOOLS=OFF -DCALLIGRAPHY_EXAMPLES=OFF -DCALLIGRAPHY_BENCHMARK_PEERS=ON "$@" > /dev/null
}
configure -UCARGO
if ! cmake --build "$build" --target kurbo_peer > "$build/kurbo.log" 2>&1; then
  echo "== could not build kurbo, see $build/kurbo.log" >&2
  configure -DCARGO=OFF
fi
cmake --build "$build" --target benchmark_nearest_point nearest_point_instructions
"$build/benchmarks/nearest_point/benchmark_nearest_point" "$@"
if [[ -n $instructions ]]; then
  if command -v valgrind > /dev/null; then
    python3 benchmarks/nearest_point/instructions.py "$build/benchmarks/nearest_point/nearest_point_instructions"
  else
    echo "omitted: instructions (needs valgrind)"
  fi
fi
