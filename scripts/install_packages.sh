#!/bin/bash
# Installs the Debian packages of packages.txt that are missing; does nothing when none is.
set -euo pipefail

list="$(dirname "$(readlink -f "$0")")/../packages.txt"
mapfile -t wanted < <(sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$list")

fail() {
  echo "install_packages.sh: $*" >&2
  exit 1
}

command -v dpkg-query > /dev/null || fail "this is not a Debian system; needed are: ${wanted[*]}"
installed=$(dpkg-query --show --showformat '${Package} ${db:Status-Status}\n' "${wanted[@]}" \
  2> /dev/null | sed -n 's/ installed$//p' || true)
mapfile -t missing < <(comm -23 <(printf '%s\n' "${wanted[@]}" | sort) <(sort -u <<< "$installed"))
[[ ${#missing[@]} -gt 0 ]] || exit 0

echo "Installing ${#missing[@]} missing packages: ${missing[*]}"
as_root=()
if [[ $(id -u) -ne 0 ]]; then
  command -v sudo > /dev/null || fail "neither root nor sudo; please install: ${missing[*]}"
  as_root=(sudo)
fi
"${as_root[@]}" apt-get update || fail "apt-get update failed"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install --yes --no-install-recommends "${missing[@]}" ||
  fail "apt-get could not install: ${missing[*]}"
