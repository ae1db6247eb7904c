#!/usr/bin/env bash
# Builds the reference of the C++ interface, with the pages in docs/, as HTML. Fails if Doxygen warns: a public name
# without a comment, a link that leads nowhere.
# usage: docs.sh [DIRECTORY]   default: build-docs
set -euo pipefail
if [[ $# -gt 1 || ${1:-} == -* ]]; then
  echo "usage: $0 [DIRECTORY]" >&2
  exit 2
fi
directory=$(realpath -m "${1:-$(dirname "${BASH_SOURCE[0]}")/../build-docs}")
cd "$(dirname "${BASH_SOURCE[0]}")/.."

for program in doxygen python3; do
  command -v "$program" > /dev/null && continue
  echo "$program is missing; scripts/install_dependencies.sh tests installs it" >&2
  exit 1
done
mkdir -p "$directory"
export CALLIGRAPHY_REFERENCE=$directory
doxygen - < <(cat docs/Doxyfile && echo "OUTPUT_DIRECTORY = \"$directory\"")
echo "$directory/html/index.html"
