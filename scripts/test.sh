#!/usr/bin/env bash
# Installs what is missing, builds and runs every test, then all of them again under the sanitizers.
# The last line is "N passed, N failed".
#
# CALLIGRAPHY_REQUIRE_DATA=1 (and any CI): hanzi-writer-data must be had; else the tests on it are skipped.
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

fetch_data() {
  local cache=$build/data unpacked=$build/data/hanzi-writer-data-2.0.1
  if [[ ! -f $unpacked/package.json ]]; then
    mkdir -p "$cache"
    rm -rf "$cache/unpacking"
    mkdir "$cache/unpacking"
    command -v npm > /dev/null || { echo "npm is not installed" >&2; return 1; }
    (cd "$cache/unpacking" && npm pack --loglevel=error hanzi-writer-data@2.0.1 > /dev/null && tar -xzf ./*.tgz) ||
      return 1
    mv "$cache/unpacking/package" "$unpacked"
    rm -rf "$cache/unpacking"
  fi
  export CALLIGRAPHY_HANZI_WRITER_DATA=$unpacked
}

# test_build NAME CMAKE_OPTION...
test_build() {
  local name=$1 directory=$build/$1 junit=$build/$1.xml
  shift
  rm -f "$junit"
  step cmake -S . -B "$directory" -G Ninja "$@" || return 0
  step cmake --build "$directory" || return 0
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
if ! fetch_data; then
  echo "== hanzi-writer-data@2.0.1 could not be had by npm pack: the tests on it are skipped" >&2
  if [[ -n ${CALLIGRAPHY_REQUIRE_DATA:-} ]]; then broken=$((broken + 1)); fi
fi
everything=(-DCALLIGRAPHY_TESTS=ON -DCALLIGRAPHY_EXAMPLES=ON -DCALLIGRAPHY_TOOLS=ON)
test_build release -DCMAKE_BUILD_TYPE=Release -DCALLIGRAPHY_BENCHMARKS=ON "${everything[@]}"
test_build sanitized -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" -DCALLIGRAPHY_BENCHMARKS=OFF \
  -DCALLIGRAPHY_SANITIZE=address,undefined "${everything[@]}"
finish
