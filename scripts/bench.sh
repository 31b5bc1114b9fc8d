#!/usr/bin/env bash
# Measures: the kernels (Google Benchmark), then a cold build of d1_centaur stage by stage, as it is and with every
# triangle split into nine (33k triangles), and the goals of speed beside their bars (status 1 where one is missed).
#   scripts/bench.sh [--no-kernels]
# SKINFORGE_SHARED: folder of the shared test material (default ../shared); without it the centaur of recipes/ is built.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
binary=$PWD/build/release/skinforge
fbx2gltf=$PWD/build/node/node_modules/fbx2gltf/bin/Linux/FBX2glTF
assets=${SKINFORGE_SHARED:-../shared}/assets

scripts/setup.sh --node
cmake --preset release >/dev/null
cmake --build --preset release --target skinforge skinforge_benchmarks

if [ "${1:-}" != --no-kernels ]; then
  build/release/tests/benchmarks/skinforge_benchmarks
fi

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
recipe=$assets/../recipes/d1_centaur.json
if [ ! -f "$recipe" ]; then
  echo "no $recipe: the centaur of recipes/ instead" >&2
  scripts/bench_stages.py "$binary" recipes/centaur.json
  exit
fi
scripts/bench_stages.py "$binary" "$recipe"
missed=0
scripts/bench_goals.py "$binary" "$assets" || missed=$?

if [ ! -x "$fbx2gltf" ]; then
  echo "no fbx2gltf: the subdivided inputs are left out" >&2
  exit $missed
fi
mkdir -p "$scratch"/assets/quaternius_{horse,man} "$scratch/recipes"
"$fbx2gltf" --binary --input "$assets/quaternius_man/man.fbx" --output "$scratch/man.glb" >/dev/null 2>&1
scripts/subdivide_glb.py "$assets/quaternius_horse/horse.glb" "$scratch/assets/quaternius_horse/horse.glb" >/dev/null
scripts/subdivide_glb.py "$scratch/man.glb" "$scratch/assets/quaternius_man/man.glb" >/dev/null
sed 's/man\.fbx/man.glb/; s/"d1_centaur"/"d1_centaur_33k"/' "$recipe" >"$scratch/recipes/d1_centaur_33k.json"
scripts/bench_stages.py "$binary" "$scratch/recipes/d1_centaur_33k.json"
exit $missed
