#!/usr/bin/env bash
# Builds every recipe of recipes/ and of the shared material, checks each result, prints a line for each.
#   scripts/build_all.sh [FOLDER]      (default: out/all)
# SKINFORGE_SHARED: folder of the shared test material (default ../shared). SKINFORGE_REPORT: json, or full (the
# default) with pictures. Exit status 1 when a recipe fails; what is checked: scripts/validate_all.py.
set -euo pipefail
repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=$(realpath -m -- "${1:-$repository/out/all}")
cd "$repository"

scripts/setup.sh --node
cmake --preset release >/dev/null
cmake --build --preset release --target skinforge

shopt -s nullglob
recipes=(recipes/*.json "${SKINFORGE_SHARED:-../shared}"/recipes/*.json)
mkdir -p "$folder"
exec scripts/validate_all.py --out "$folder" --report "${SKINFORGE_REPORT:-full}" "${recipes[@]}"
