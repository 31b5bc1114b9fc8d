#!/usr/bin/env bash
# All tests on a fresh checkout: installs packages, compiles everything, runs ctest. Arguments go to ctest.
#   scripts/test.sh [-R NAME ...]
# SKINFORGE_SHARED: folder of the shared test material (default ../shared); tests that need it skip without it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
node_folder=$PWD/build/node
node_packages=(gltf-validator@2.0.0-dev.3.10 fbx2gltf@0.9.7)
fbx2gltf=$node_folder/node_modules/fbx2gltf/bin/Linux/FBX2glTF

warn() { printf '\n********** %s **********\n\n' "$*" >&2; }

# The Khronos validator and a second FBX reader, from npm. Tests that need them skip when the network fails.
install_node_packages() {
  [ -e "$node_folder/node_modules/gltf-validator" ] && [ -e "$fbx2gltf" ] && return
  mkdir -p "$node_folder"
  timeout 300 npm install --prefix "$node_folder" --no-save --no-audit --no-fund --loglevel=error \
    "${node_packages[@]}" >&2
}

scripts/setup.sh --node
install_node_packages || warn "npm install failed: tests against gltf-validator and fbx2gltf are skipped"
if [ -f "$fbx2gltf" ]; then
  chmod +x "$fbx2gltf" # not executable as it comes
  export SKINFORGE_FBX2GLTF=$fbx2gltf
fi

SKINFORGE_SHARED=$(realpath -m -- "${SKINFORGE_SHARED:-../shared}")
export SKINFORGE_SHARED
[ -d "$SKINFORGE_SHARED/assets" ] || warn "no $SKINFORGE_SHARED/assets: tests on real characters are skipped"

cmake --preset release
cmake --build --preset release
ctest --preset release --parallel 2 "$@"
