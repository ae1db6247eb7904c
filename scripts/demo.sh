#!/usr/bin/env bash
# Installs missing packages, builds, and writes four characters without and with guidance.
# Arguments are passed to `calligraphy write`.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_dependencies.sh
if [[ ! -f build/CMakeCache.txt ]]; then  # a build directory of your own keeps its options
  cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCALLIGRAPHY_TESTS=OFF -DCALLIGRAPHY_EXAMPLES=OFF
fi
cmake --build build --target calligraphy_program
build/tools/calligraphy write 北京航空 --out out "$@"

cat << END

In $PWD/out:
  NN-CHARACTER-MODE.svg        the page: template blue, active character yellow, trace green
  NN-CHARACTER-MODE-force.svg  force over time
  NN-CHARACTER-MODE.csv        the trace, tick by tick
  summary.json                 the table above
END
