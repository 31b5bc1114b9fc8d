#!/usr/bin/env bash
# Every case of the hostile corpus: assets by `inspect` and by a build of a recipe that names nothing else, recipes by
# `build`. Fails on a crash, a hang, more than 2 GB, a write outside the output folder, a connection, a wrong verdict, a
# failure without a word, an error without file and cause.
#   scripts/hostile.sh [PROGRAM]        default build/release/skinforge
# SKINFORGE_SHARED: folder of the shared test material (default ../shared).
# With a program built with sanitizers give it more memory and time: MEMORY=8192 SECONDS_EACH=60 scripts/hostile.sh build/dev/skinforge
# The fuzzer as PROGRAM (build/fuzz/tests/fuzz/skinforge_fuzz, made by scripts/fuzz.sh) only imports the assets, with sanitizers.
set -euo pipefail

# A recipe of one input and no operation, in the output folder.
if [ "${1:-}" = --build-asset ]; then
  program=$2 asset=$3 out=$4
  relative=$(realpath -m --relative-to="$out" "$asset")
  printf '{ "recipe_version": 1, "name": "one", "inputs": { "a": "%s" }, "base": "a", "ops": [] }\n' "$relative" >"$out/one.json"
  exec "$program" build "$out/one.json" --report none --out "$out/one" --cache "$out/cache"
fi

self=$(realpath "${BASH_SOURCE[0]}")
cd "$(dirname "$self")/.."
program=$(realpath "${1:-build/release/skinforge}")
shared=$(realpath -m -- "${SKINFORGE_SHARED:-../shared}")
if [ ! -f "$shared/hostile/index.json" ]; then
  echo "no $shared/hostile: set SKINFORGE_SHARED" >&2
  exit 2
fi
run() { bash "$shared/tools/run_hostile.sh" -w -m "${MEMORY:-2048}" -t "${SECONDS_EACH:-10}" "$@"; }
failed=0
if [ "$(basename "$program")" = skinforge_fuzz ]; then
  SKINFORGE_FUZZ_TARGET=import run "$shared/hostile" "$program {}"
  exit
fi
run "$shared/hostile" "$program inspect {}" || failed=1
run "$shared/hostile" "bash $self --build-asset $program {} {out}" || failed=1
run -k recipe "$shared/hostile" "$program build {} --out {out} --cache {out}/cache" || failed=1
exit $failed
