#!/usr/bin/env bash
# From a fresh checkout to a character: installs packages, compiles, builds a recipe into out/<name>/.
#   scripts/build.sh [RECIPE]      (default: recipes/centaur.json)
set -euo pipefail
repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
recipe=$(realpath -- "${1:-$repository/recipes/centaur.json}")
cd "$repository"

scripts/setup.sh
cmake --preset release
cmake --build --preset release --target skinforge

echo "building $recipe" >&2
build/release/skinforge build --quiet --json "$recipe" | python3 -c '
import json, sys
for recipe in json.load(sys.stdin)["recipes"]:
    for file in recipe["files"]:
        print(recipe["out"] + "/" + file["name"])'
