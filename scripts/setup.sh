#!/usr/bin/env bash
# Installs what is missing (Debian 12, as root or with sudo); says and does nothing when all is there.
#   scripts/setup.sh [--node]
# Without options: the packages of scripts/packages.txt. --node: nodejs and npm (unless some node and npm are installed),
# and from npm, in build/node, three.js and a bundler for the 3D view of reports, and for the tests the Khronos validator,
# a second FBX reader, two optimisers and the language service of editors; chromium, in which the tests open reports. Those are optional: without them
# reports have no 3D view, and tests skip.
set -euo pipefail
repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
node_folder=$repository/build/node
node_packages=(three@0.170.0 esbuild@0.24.0 gltf-validator@2.0.0-dev.3.10 fbx2gltf@0.9.7 @gltf-transform/cli@4.5.1 gltfpack@1.3 \
  vscode-json-languageservice@5.7.2)

warn() { printf '\n********** setup: %s **********\n\n' "$*" >&2; }

wanted() { sed 's/#.*//' "$repository/scripts/packages.txt" | tr -s '[:space:]' '\n' | sed '/^$/d'; }

# Wanted packages that dpkg does not list as installed.
missing() {
  local installed
  installed=$(dpkg-query --show --showformat='${Package} ${db:Status-Status}\n' | sed -n 's/ installed$//p' | sort -u)
  comm -23 <(wanted | sort -u) <(printf '%s\n' "$installed")
}

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"
  elif command -v sudo >/dev/null; then sudo "$@"
  else
    echo "setup: there is neither root nor sudo; as root: $*" >&2
    return 1
  fi
}

apt_get() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get --quiet=2 --option Acquire::Retries=3 "$@" >/dev/null
}

install() {
  [ $# -gt 0 ] || return 0
  if ! command -v apt-get >/dev/null; then
    echo "setup: no apt here, install these yourself: $*" >&2
    return 1
  fi
  echo "setup: installing $*" >&2
  apt_get update && apt_get install --yes --no-install-recommends "$@"
}

install_node() {
  local packages=()
  command -v node >/dev/null || packages+=(nodejs)
  command -v npm >/dev/null || packages+=(npm)
  install "${packages[@]}"
}

install_browser() {
  command -v chromium >/dev/null || install chromium
}

install_node_packages() {
  local fbx2gltf=$node_folder/node_modules/fbx2gltf/bin/Linux/FBX2glTF
  local bin=$node_folder/node_modules/.bin
  [ -x "$fbx2gltf" ] && [ -d "$node_folder/node_modules/gltf-validator" ] && [ -e "$bin/gltfpack" ] &&
    [ -e "$bin/gltf-transform" ] && [ -d "$node_folder/node_modules/three" ] && [ -e "$bin/esbuild" ] &&
    [ -d "$node_folder/node_modules/vscode-json-languageservice" ] && return 0
  mkdir -p "$node_folder"
  timeout 300 npm install --prefix "$node_folder" --no-save --no-audit --no-fund --loglevel=error \
    "${node_packages[@]}" >&2 && chmod +x "$fbx2gltf" # it comes without
}

if command -v dpkg-query >/dev/null; then
  mapfile -t packages < <(missing)
  install "${packages[@]}"
else
  warn "no dpkg here: the packages of scripts/packages.txt are taken to be there"
fi
if [ "${1:-}" = --node ]; then
  if ! install_node || ! install_node_packages; then
    warn "no npm packages: reports have no 3D view, and tests against gltf-validator, fbx2gltf, gltf-transform, gltfpack and an editor are skipped"
  fi
  if ! install_browser; then warn "no chromium: tests that open reports are skipped"; fi
fi
