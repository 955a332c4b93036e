#!/usr/bin/env bash
# Shows that the checks can fail: check_includes.sh finds every violation in bad_sample, and no other;
# check_names.sh finds the type that it has twice.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
if found=$(./check_includes.sh bad_sample); then
  echo "check_includes.sh let bad_sample pass"
  exit 1
fi
diff bad_sample/expected.txt - <<<"$found"
if found=$(./check_names.sh bad_sample); then
  echo "check_names.sh let bad_sample pass"
  exit 1
fi
diff - <<<"$found" <(echo "lambert::Unit: ./radiosity/core/looks_down.h, ./radiosity/patch/patch.h")
