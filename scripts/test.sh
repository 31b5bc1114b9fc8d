#!/usr/bin/env bash
# All tests on a fresh checkout: installs packages, compiles everything, runs ctest. Arguments go to ctest.
#   scripts/test.sh [-R NAME ...]
# SKINFORGE_SHARED: folder of the shared test material (default ../shared); tests that need it skip without it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh --node
fbx2gltf=$PWD/build/node/node_modules/fbx2gltf/bin/Linux/FBX2glTF
if [ -x "$fbx2gltf" ]; then export SKINFORGE_FBX2GLTF=$fbx2gltf; fi

SKINFORGE_SHARED=$(realpath -m -- "${SKINFORGE_SHARED:-../shared}")
export SKINFORGE_SHARED
if [ ! -d "$SKINFORGE_SHARED/assets" ]; then
  printf '\n********** no %s/assets: tests on real characters are skipped **********\n\n' "$SKINFORGE_SHARED" >&2
fi

cmake --preset release
cmake --build --preset release
ctest --preset release --parallel 2 "$@"
