#!/usr/bin/env bash
# Installs the packages of packages.txt that are missing. Needs Debian 12, and root or sudo only
# where something is missing. Asks nothing; does nothing, quickly, where all is there.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

mapfile -t wanted < <(sed 's/#.*//' packages.txt | tr -s ' \t\n' '\n' | sed '/^$/d')

# dpkg-query exits 1 where one of the names is unknown to it; the rest is still printed.
installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "${wanted[@]}" 2>/dev/null |
  awk '$2 == "installed" { print $1 }' || true)
mapfile -t missing < <(printf '%s\n' "${wanted[@]}" | grep -vxF -f <(printf '%s\n' "$installed") || true)
if ((${#missing[@]} == 0)); then
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "error: setup: ${#missing[@]} packages are missing and this is not root;" \
      "run as root: apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "setup: installing ${#missing[@]} Debian packages: ${missing[*]}" >&2
"${as_root[@]}" apt-get -qq update </dev/null >&2
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -y --no-install-recommends \
  -o Dpkg::Use-Pty=0 install "${missing[@]}" </dev/null >&2
echo "setup: done" >&2
