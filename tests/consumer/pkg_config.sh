#!/usr/bin/env bash
# Builds a program in C11 as pkg-config says, with an installed copy that was moved, and runs it.
# usage: pkg_config.sh PROGRAM PREFIX LIBRARY_DIRECTORY
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/moved/$3/pkgconfig"
cp -a "$2/$3"/libcalligraphy_c.so* "$work/moved/$3"
cp "$2/$3/pkgconfig/calligraphy_c.pc" "$work/moved/$3/pkgconfig"
cp -a "$2/include" "$work/moved"
export PKG_CONFIG_PATH=$work/moved/$3/pkgconfig
read -ra flags <<< "$(pkg-config --cflags --libs calligraphy_c)"
"${CC:-cc}" -std=c11 -Wall -Wextra -Wconversion -Werror -pedantic "$1" -o "$work/program" "${flags[@]}" \
  -Wl,-rpath,"$work/moved/$3"
"$work/program"
