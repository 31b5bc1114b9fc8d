#!/usr/bin/env bash
# Fuzzes every parser of untrusted bytes (tests/fuzz) with ASan and UBSan, each for so many minutes; needs clang.
#   scripts/fuzz.sh [MINUTES] [TARGET ...]        default 1 minute, all targets
# Seeds: the hostile corpus and the assets of SKINFORGE_SHARED (default ../shared) where they are, data/ and recipes/. What the
# fuzzers learn stays in build/fuzz/corpus/TARGET; a finding lands in build/fuzz/findings and fails the script. A fixed finding
# becomes a file in tests/data/fuzz/TARGET, which a test feeds to the parser.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
minutes=${1:-1}
shift || true
shared=$(realpath -m -- "${SKINFORGE_SHARED:-../shared}")

if ! command -v clang++ >/dev/null; then
  echo "fuzz.sh needs clang (Debian: clang, llvm)" >&2
  exit 2
fi
[ -f build/fuzz/build.ninja ] || cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target skinforge_fuzz >&2
fuzzer=$PWD/build/fuzz/tests/fuzz/skinforge_fuzz
targets=("$@")
[ $# -gt 0 ] || targets=(gltf character scene fbx obj dae off tgf dmat image cache recipe_json recipe_yaml)

# Small files of these endings, from everywhere.
seeds() {
  local folder=build/fuzz/seeds/$1 ending file
  shift
  mkdir -p "$folder"
  for ending in "$@"; do
    find data recipes "$shared" -type f -name "*.$ending" -size -200k -print0 2>/dev/null |
      while IFS= read -r -d '' file; do cp -f "$file" "$folder/$(sha256sum <"$file" | cut -c1-16)"; done
  done
}
seeds gltf glb gltf
seeds character glb
seeds recipe_json json
seeds recipe_yaml yaml yml
seeds tgf tgf
seeds dmat dmat
seeds off off
seeds obj obj mtl
seeds dae dae
seeds fbx fbx
seeds image png jpg
mkdir -p build/fuzz/seeds/{scene,cache} build/fuzz/findings
find data "$shared/hostile" -type f \( -name '*.glb' -o -name '*.fbx' -o -name '*.obj' -o -name '*.dae' \) -size -100k -exec cp -f {} build/fuzz/seeds/scene/ \; || true
(cd build/fuzz/seeds/scene && SKINFORGE_FUZZ_TARGET=seeds "$fuzzer" -- * && find . -type f ! -name '*.scene' -delete)
# Entries of a cache: of one that a build left, with and without their header.
cache=build/fuzz/cache
if [ -x build/release/skinforge ] && [ ! -d $cache ]; then
  build/release/skinforge build recipes/tail.json --report none --cache $cache --out build/fuzz/out >/dev/null 2>&1 || true
fi
mkdir -p $cache
find $cache -type f -size -50k | sort | head -60 | while read -r file; do
  { printf a; cat "$file"; } >"build/fuzz/seeds/cache/$(basename "$file")"
  { printf b; tail -n +2 "$file"; } >"build/fuzz/seeds/cache/$(basename "$file").json"
done

failed=0
for target in "${targets[@]}"; do
  mkdir -p "build/fuzz/corpus/$target"
  log=build/fuzz/$target.log
  known=tests/data/fuzz/$target
  [ -d "$known" ] || known=
  if ! SKINFORGE_FUZZ_TARGET=$target ASAN_OPTIONS=detect_leaks=0 "$fuzzer" \
    -max_total_time=$((60 * minutes)) -timeout=10 -rss_limit_mb=3072 -malloc_limit_mb=2048 -print_final_stats=1 \
    -artifact_prefix="build/fuzz/findings/$target-" "build/fuzz/corpus/$target" "build/fuzz/seeds/$target" ${known:+"$known"} >"$log" 2>&1; then
    echo "$target: FINDING, see $log"
    failed=1
  fi
  awk -v t="$target" '/number_of_executed_units/ {n=$2} /average_exec_per_sec/ {s=$2} /peak_rss_mb/ {m=$2} END {printf "%-12s %12d executions, %6d a second, %5d MB\n", t, n, s, m}' "$log"
done
exit $failed
