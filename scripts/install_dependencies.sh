#!/usr/bin/env bash
# Installs the build dependencies on Debian 12 or 13 or Ubuntu 24.04, unless they are already installed.
# usage: install_dependencies.sh [python|tests|full|peers|web]
#   python  also those of the Python module
#   tests   also those of the tests, the Python module's included
#   full    also those of test.sh --full
#   peers   also the libraries that benchmarks/nearest_point/run.sh compares with, and valgrind
#   web     only those of web.sh
set -euo pipefail

packages=(cmake g++ gnuplot-nox libarchive-dev libcli11-dev libeigen3-dev libfmt-dev libfontconfig-dev libhidapi-dev
          libpugixml-dev librsvg2-dev libspdlog-dev libusb-1.0-0-dev libutfcpp-dev ninja-build nlohmann-json3-dev
          pkg-config zlib1g-dev)
if [[ ${1:-} == python ]]; then
  packages+=(python3 python3-dev python3-venv)
elif [[ ${1:-} == tests || ${1:-} == full ]]; then
  # clang, its run-time libraries and libc++ by unversioned names, which all of these systems have.
  packages+=(ca-certificates catch2 clang doxygen emscripten fish groff-base libbenchmark-dev libc++-dev libc++abi-dev
             libclang-rt-dev libumockdev-dev python3 python3-dev python3-venv udev umockdev zsh)
  command -v npm > /dev/null || packages+=(npm)
  if [[ $1 == full ]]; then
    packages+=(g++-aarch64-linux-gnu qemu-user)
    command -v node > /dev/null || packages+=(nodejs)
    # Ubuntu has Chromium only as a snap.
    if grep -qs '^ID=debian' /etc/os-release; then packages+=(chromium); fi
  fi
elif [[ ${1:-} == peers ]]; then
  packages+=(ca-certificates lib2geom-dev libbenchmark-dev libboost-dev python3 valgrind)
  command -v cargo > /dev/null || packages+=(cargo)
  command -v npm > /dev/null || packages+=(npm)
elif [[ ${1:-} == web ]]; then
  packages=(cmake emscripten libeigen3-dev libutfcpp-dev ninja-build python3)
  command -v node > /dev/null || packages+=(nodejs)
elif [[ $# -gt 0 ]]; then
  echo "usage: $0 [python|tests|full|peers|web]" >&2
  exit 2
fi

if ! command -v apt-get > /dev/null || ! command -v dpkg-query > /dev/null; then
  echo "This system has no apt-get. Install the equivalents of: ${packages[*]}" >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  state=$(dpkg-query -W -f '${Status}' "$package" 2> /dev/null || true)
  [[ $state == "install ok installed" ]] || missing+=("$package")
done
[[ ${#missing[@]} -gt 0 ]] || exit 0

as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo > /dev/null; then
    echo "Run as root, or install sudo: these packages are missing: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "installing: ${missing[*]}"
apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o Acquire::Retries=3 "$@"; }
for attempt in 1 2 3; do
  if apt update; then break; fi
  [[ $attempt -lt 3 ]] || echo "apt-get update failed three times; continuing with the existing package lists" >&2
  sleep $((attempt * 5))
done
apt install -y --no-install-recommends "${missing[@]}"
