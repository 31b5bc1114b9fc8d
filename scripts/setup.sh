#!/usr/bin/env bash
# Installs the packages of scripts/packages.txt that are missing (Debian 12, as root or with sudo); says and
# does nothing when all are there.
#   scripts/setup.sh [--node]
# --node: nodejs and npm too, unless some node and npm are installed already.
set -euo pipefail
scripts=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

wanted() { sed 's/#.*//' "$scripts/packages.txt" | tr -s '[:space:]' '\n' | sed '/^$/d'; }

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
    echo "setup: packages are missing and there is neither root nor sudo; as root: $*" >&2
    exit 1
  fi
}

apt_get() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get --quiet=2 --option Acquire::Retries=3 \
    --option Dpkg::Use-Pty=0 "$@" >&2
}

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "setup: no apt here; the packages of scripts/packages.txt must be there already" >&2
  exit 0
fi

mapfile -t packages < <(missing)
if [ "${1:-}" = --node ]; then
  command -v node >/dev/null || packages+=(nodejs)
  command -v npm >/dev/null || packages+=(npm)
fi
if [ "${#packages[@]}" -gt 0 ]; then
  echo "setup: installing ${packages[*]}" >&2
  apt_get update
  apt_get install --yes --no-install-recommends "${packages[@]}"
fi
