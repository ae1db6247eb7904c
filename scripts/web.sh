#!/usr/bin/env bash
# Installs what is missing, and builds the page: web/dist, which any static server can host. Prints what a browser
# loads.
# usage: web.sh [--serve | --module | --types] [BUILD_DIRECTORY]
#   --serve   then serves web/dist at http://localhost:8000
#   --module  builds only the C interface as WebAssembly, with the module for JavaScript, in BUILD_DIRECTORY/web
#   --types   only checks the types of what is written in JavaScript
#
# The characters of web/characters.txt are from hanzi-writer-data, which npm downloads; without it, the page has those
# that are built in. CALLIGRAPHY_PROGRAM: the program that imports them; without it, `build` is built.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
what=page
case "${1:-}" in
  --serve | --module | --types) what=${1#--}; shift ;;
  -*) sed -n 's/^# usage: /usage: /p' "$0" >&2; exit 2 ;;
esac
build=${1:-build-web}
typescript=5.9.3
export NODE_PATH=${NODE_PATH:-/usr/share/nodejs}  # modules of Debian's em++, if node is not Debian's

build_module() {
  scripts/install_dependencies.sh web
  # -finline-functions, because em++ 3.1.6 turns it off below -O3: without it, a tick takes thirty times as long.
  # Eigen and utfcpp are header-only: those of this system, which emcmake would not look at.
  emcmake cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=MinSizeRel \
    -DCMAKE_CXX_FLAGS_MINSIZEREL="-Oz -DNDEBUG -finline-functions -flto" \
    -DCMAKE_PREFIX_PATH=/usr -DCMAKE_FIND_ROOT_PATH_MODE_PACKAGE=BOTH -DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=BOTH \
    -DCALLIGRAPHY_{IMPORTERS,PICTURES,PHANTOM,OPENHAPTICS,TOOLS,TESTS,EXAMPLES}=OFF > /dev/null
  cmake --build "$build" --target calligraphy_web
}

# print_sizes FILE...: of what a browser loads.
print_sizes() {
  node - "$@" << 'END'
const { readFileSync } = require("fs");
const { brotliCompressSync, gzipSync } = require("zlib");
const row = (name, ...sizes) => console.log(name.padEnd(28), ...sizes.map((size) => String(size).padStart(8)));
row("[bytes]", "raw", "gzip", "brotli");
const total = [0, 0, 0];
for (const path of process.argv.slice(2)) {
  const bytes = readFileSync(path);
  const sizes = [bytes.length, gzipSync(bytes, { level: 9 }).length, brotliCompressSync(bytes).length];
  row(path.replace(/.*\/(?=[^/]*\/)/, ""), ...sizes);
  sizes.forEach((size, i) => { total[i] += size; });
}
row("in total", ...total);
END
}

# What is written in JavaScript is checked in one directory, as it is served.
check_types() {
  local checked=$build/types
  rm -rf "$checked"
  mkdir -p "$checked"
  cp -r web/*.js web/*.d.ts web/page web/tsconfig.json "$checked"
  echo '{"type": "module"}' > "$checked/package.json"
  python3 web/layout.py include/calligraphy/c/calligraphy.h "$checked"
  if ! npm install --silent --no-fund --no-audit --prefix "$build/typescript" typescript@$typescript; then
    echo "TypeScript cannot be downloaded by npm: the types are not checked." >&2
    [[ -z ${CALLIGRAPHY_REQUIRE_DATA:-} ]]
    return
  fi
  "$build/typescript/node_modules/.bin/tsc" -p "$checked"
}

# The tarball of an npm package, which NAME_TARBALL may name.
tarball() {
  local given=$1_TARBALL
  if [[ -n ${!given:-} ]]; then echo "${!given}"; return; fi
  mkdir -p "$build/data"
  [[ -f $build/data/$2-$3.tgz ]] || (cd "$build/data" && npm pack --silent "$2@$3" > /dev/null) || return 1
  echo "$build/data/$2-$3.tgz"
}

import_characters() {
  local program=${CALLIGRAPHY_PROGRAM:-build/tools/calligraphy} characters letters
  if ! { characters=$(tarball CALLIGRAPHY_HANZI_WRITER_DATA hanzi-writer-data 2.0.1) &&
    letters=$(tarball CALLIGRAPHY_CNCHAR_ORDER cnchar-order 3.2.6); }; then
    echo "The characters cannot be downloaded by npm pack: the page has those that are built in." >&2
    return
  fi
  [[ -n ${CALLIGRAPHY_PROGRAM:-} ]] || scripts/build_program.sh
  "$program" import "$characters" --letters "$letters" --only "$(tr -d '\n' < web/characters.txt)" \
    --date "$(date -u +%F)" -o web/dist/characters.set > /dev/null
  cp web/characters.txt web/dist
  tar -xzOf "$characters" package/ARPHICPL.TXT > web/dist/ARPHICPL.TXT
}

build_page() {
  rm -rf web/dist
  mkdir -p web/dist
  cp -r web/index.html web/page "$build"/web/calligraphy{.js,_module.js,_module.wasm,_layout.js} LICENSE web/dist
  import_characters
}

if [[ $what == types ]]; then
  check_types
  exit
fi
build_module
if [[ $what == module ]]; then
  print_sizes "$build"/web/calligraphy{_module.wasm,_module.js,_layout.js,.js}
  exit
fi
build_page
# shellcheck disable=SC2046
print_sizes $(find web/dist -type f ! -name LICENSE ! -name ARPHICPL.TXT | sort)
if [[ $what == serve ]]; then
  python3 - << 'END'
import functools
import http.server


class Handler(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".js": "text/javascript"}

    def log_message(self, *_):
        pass


for port in range(8000, 8100):  # the first that is free
    try:
        server = http.server.ThreadingHTTPServer(("localhost", port), functools.partial(Handler, directory="web/dist"))
    except OSError:
        continue
    print(f"http://localhost:{port} (Ctrl-C ends it)", flush=True)
    try:
        server.serve_forever()
    except KeyboardInterrupt:
        break
END
fi
