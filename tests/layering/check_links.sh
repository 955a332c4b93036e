#!/usr/bin/env bash
# check_links.sh BINARY REGEX: fails where BINARY needs a shared library that matches, itself or
# through another, and prints which.
set -euo pipefail
libraries=$(ldd "$1")
if grep -iE "$2" <<<"$libraries"; then
  echo "$1 must not need these"
  exit 1
fi
