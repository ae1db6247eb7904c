#!/bin/sh
# Runs a test program under umockdev: in_test_bed.sh PROGRAM ARGUMENT...
# Without umockdev-wrapper the test is skipped (77), except in CI, where it must be there.
case " $* " in
  *" --list-"*) exec "$@" ;;  # what CTest asks when it is built
esac
if ! command -v umockdev-wrapper > /dev/null; then
  echo "umockdev-wrapper is missing: install umockdev to run the tests on an emulated device" >&2
  if [ -n "$CI" ] && [ "$CI" != false ]; then exit 1; fi
  exit 77
fi
LSAN_OPTIONS="suppressions=$(dirname "$0")/leaks_of_others.txt:print_suppressions=0:$LSAN_OPTIONS"
export LSAN_OPTIONS
exec umockdev-wrapper "$@"
