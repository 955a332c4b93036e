#!/usr/bin/env bash
# Shows that check_includes.sh can fail: it finds every violation in bad_sample, and no other.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
if found=$(./check_includes.sh bad_sample); then
  echo "check_includes.sh let bad_sample pass"
  exit 1
fi
diff bad_sample/expected.txt - <<<"$found"
