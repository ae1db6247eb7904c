#!/usr/bin/env bash
# Installs what is missing, and builds the program: build/tools/calligraphy. A build directory of your own keeps its
# other options.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_dependencies.sh
options=()
if [[ ! -f build/CMakeCache.txt ]]; then
  options=(-G Ninja -DCMAKE_BUILD_TYPE=Release -DCALLIGRAPHY_TESTS=OFF -DCALLIGRAPHY_EXAMPLES=OFF)
fi
cmake -S . -B build "${options[@]}" -DCALLIGRAPHY_TOOLS=ON
cmake --build build --target calligraphy_program
