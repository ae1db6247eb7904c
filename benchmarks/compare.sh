#!/usr/bin/env bash
# Compares the servo tick of this tree with that of another revision, in one run: times, instructions, forces.
# usage: compare.sh REVISION [options of compare/compare.py]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [[ $# -eq 0 ]]; then
  echo "usage: $0 REVISION [--rounds N] [--lines N] [--cold-rounds N] [--options NAME,NAME] [--noise UM] [--step UM]" >&2
  exit 2
fi

revision=$(git rev-parse --quiet --verify "$1^{commit}") || { echo "$0: no such revision: $1" >&2; exit 2; }
shift
work=$PWD/build-compare
tree=$work/$revision
if [[ ! -d $tree ]]; then
  mkdir -p "$tree.new"
  git archive "$revision" | tar -x -C "$tree.new"
  mv "$tree.new" "$tree"
fi

build() {  # tree, name
  # Line numbers, so that callgrind can say which file an inlined instruction is from.
  cmake -S benchmarks/compare -B "$work/build-$2" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=-g1 \
    -DTREE="$1" > /dev/null
  cmake --build "$work/build-$2" --target tick_replay
}
build "$tree" "$revision"
build "$PWD" this
exec python3 benchmarks/compare/compare.py "$work/build-$revision/tick_replay" "$work/build-this/tick_replay" "$@"
