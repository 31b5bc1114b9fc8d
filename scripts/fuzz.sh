#!/usr/bin/env bash
# Fuzzes every parser of untrusted bytes (tests/fuzz) with ASan and UBSan, each for so many minutes; needs clang.
#   scripts/fuzz.sh [MINUTES] [TARGET ...]        default 1 minute, all targets
#   scripts/fuzz.sh --coverage [TARGET ...]       lines of the parsers' files that the inputs so far reach; fails below 90 %
# Seeds: the hostile corpus and the assets of SKINFORGE_SHARED (default ../shared) where they are, data/ and recipes/, and what
# scripts/fuzz_seeds.py makes. What the fuzzers learn stays in build/fuzz/corpus/TARGET; a finding lands in build/fuzz/findings and fails the script. A fixed finding
# becomes a file in tests/data/fuzz/TARGET, which a test feeds to the parser.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=fuzz minutes=1
if [ "${1:-}" = --coverage ]; then
  preset=coverage
  shift
elif [ $# -gt 0 ]; then
  minutes=$1
  shift
fi
shared=$(realpath -m -- "${SKINFORGE_SHARED:-../shared}")
targets=("$@")
[ $# -gt 0 ] || targets=(gltf character scene rules fbx obj dae off tgf dmat image cache recipe_json recipe_yaml)

if ! command -v clang++ >/dev/null; then
  echo "fuzz.sh needs clang (Debian: clang, llvm)" >&2
  exit 2
fi
[ -f build/$preset/build.ninja ] || cmake --preset $preset >/dev/null
cmake --build --preset $preset --target skinforge_fuzz >&2
fuzzer=$PWD/build/$preset/tests/fuzz/skinforge_fuzz

is_wanted() { case " ${targets[*]} " in *" $1 "*) ;; *) return 1 ;; esac; }

# Small files of these endings, from everywhere: large ones only make each trial slow.
seeds() {
  local folder=build/fuzz/seeds/$1 ending file
  is_wanted "$1" || return 0
  shift
  rm -rf "$folder"
  mkdir -p "$folder"
  for ending in "$@"; do
    find data recipes "$shared" -type f -name "*.$ending" -size -40k -print0 2>/dev/null |
      while IFS= read -r -d '' file; do cp -f "$file" "$folder/$(sha256sum <"$file" | cut -c1-16)"; done || true
  done
}

# Scenes as the import child hands them over.
scene_seeds() {
  local folder=build/fuzz/seeds/scene
  is_wanted scene || return 0
  rm -rf $folder
  mkdir -p $folder
  find data "$shared/hostile" -type f \( -name '*.glb' -o -name '*.fbx' -o -name '*.obj' -o -name '*.dae' \) -size -40k -exec cp -f {} $folder/ \; || true
  (cd $folder && SKINFORGE_FUZZ_TARGET=seeds "$fuzzer" -- * && find . -type f ! -name '*.scene' -delete)
}

# Entries of a cache that a build left, with and without their header.
cache_seeds() {
  local cache=build/fuzz/cache folder=build/fuzz/seeds/cache file
  is_wanted cache || return 0
  if [ -x build/release/skinforge ] && [ ! -d $cache ]; then
    build/release/skinforge build recipes/tail.json --report none --cache $cache --out build/fuzz/out >/dev/null 2>&1 || true
  fi
  mkdir -p $cache $folder
  rm -f $folder/*
  find $cache -type f -size -20k | sort | head -60 | while read -r file; do
    { printf a; cat "$file"; } >"$folder/$(basename "$file")"
    { printf b; tail -n +2 "$file"; } >"$folder/$(basename "$file").json"
  done
}

seeds gltf glb gltf
seeds rules glb gltf
seeds character glb
seeds recipe_json json
seeds recipe_yaml yaml yml
# Their inputs must be there: without them nothing behind them is read.
mkdir -p build/fuzz/seeds/recipe_json build/fuzz/seeds/recipe_yaml
find build/fuzz/seeds/recipe_json build/fuzz/seeds/recipe_yaml -type f -exec sed -i -E 's#\.\./(assets|\.\./assets|models|data)/[^":, }]*#../data/horse.glb#' {} +
seeds tgf tgf
seeds dmat dmat
seeds off off
seeds obj obj mtl
seeds dae dae
seeds fbx fbx
seeds image png jpg
scene_seeds
cache_seeds
python3 scripts/fuzz_seeds.py build/fuzz/seeds "${targets[@]}"
mkdir -p build/fuzz/findings

# The words of a recipe, which no mutation finds.
python3 -c '
import json
def words(node):
    if isinstance(node, dict):
        yield from node.get("properties", {})
        yield from (word for word in node.get("enum", []) if isinstance(word, str))
    for part in node.values() if isinstance(node, dict) else node if isinstance(node, list) else []:
        yield from words(part)
for word in sorted(set(words(json.load(open("schemas/recipe.schema.json"))))):
    print(f"\"{word}\"")' >build/fuzz/recipe.dict

fuzz() {
  local target=$1 log=build/fuzz/$1.log failed=0
  SKINFORGE_FUZZ_TARGET=$target ASAN_OPTIONS=detect_leaks=0 "$fuzzer" "${@:2}" >"$log" 2>&1 || failed=1
  awk -v t="$target" '/number_of_executed_units/ {n=$2} /average_exec_per_sec/ {s=$2} /peak_rss_mb/ {m=$2} END {printf "%-12s %12d executions, %6d a second, %5d MB\n", t, n, s, m}' "$log"
  [ $failed = 0 ] || echo "$target: FINDING, see $log"
  return $failed
}

# Where the inputs of a target are: what the fuzzer learned, its seeds, the finds of old.
inputs=()
inputs_of() {
  mkdir -p "build/fuzz/corpus/$1"
  inputs=("build/fuzz/corpus/$1" "build/fuzz/seeds/$1")
  if [ -d "tests/data/fuzz/$1" ]; then inputs+=("tests/data/fuzz/$1"); fi
}

# Each file of a parser with the share of its lines that was reached.
coverage() {
  local profile=build/coverage/profile target
  rm -rf $profile
  mkdir -p $profile
  for target in "${targets[@]}"; do
    inputs_of "$target"
    SKINFORGE_FUZZ_TARGET=$target LLVM_PROFILE_FILE=$profile/$target.profraw "$fuzzer" -runs=0 "${inputs[@]}" >/dev/null 2>&1
  done
  llvm-profdata merge -o $profile/all.profdata $profile/*.profraw
  llvm-cov export "$fuzzer" -instr-profile $profile/all.profdata -summary-only \
    src/base/{base64,file_digest,text}.cpp src/io/{gltf,build_character,fbx}_*.cpp src/io/glb_{container,stamp}.cpp src/io/png_chunks.cpp src/io/build_character.cpp src/io/{raw_scene_check,obj_check,dae_check,dae_nodes,off_reader,tgf_reader,number_table,image_codec,inflate,trs}.cpp \
    src/pipeline/{cache,cache_gc,cache_usage,manifest,run_record}.cpp src/recipe/*.cpp | python3 -c '
import json, sys
files = []
for f in json.load(sys.stdin)["data"][0]["files"]:
    lines = f["summary"]["lines"]
    files.append((lines["percent"], lines["covered"], lines["count"], f["filename"].split("/src/")[-1]))
for percent, covered, count, name in sorted(files):
    print(f"{percent:6.1f} % {covered:5d} of {count:5d} lines  {name}")
covered, count = sum(f[1] for f in files), sum(f[2] for f in files)
print(f"{100 * covered / count:6.1f} % {covered:5d} of {count:5d} lines  together")
sys.exit(covered < 0.9 * count)'
}

if [ $preset = coverage ]; then
  coverage
  exit
fi
failed=0
for target in "${targets[@]}"; do
  inputs_of "$target"
  dictionary=
  case $target in recipe_*) dictionary=-dict=build/fuzz/recipe.dict ;; esac
  fuzz "$target" $dictionary -max_total_time=$((60 * minutes)) -timeout=30 -rss_limit_mb=3072 -malloc_limit_mb=2048 -max_len=40000 -print_final_stats=1 \
    -artifact_prefix="build/fuzz/findings/$target-" "${inputs[@]}" || failed=1
done
exit $failed
