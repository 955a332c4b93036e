#!/usr/bin/env bash
# check_reasons.sh ROOT: every call of the protocol says which errors it gives; every reason that the
# protos or the table of docs/protocol.md name is one that the programs' code gives; and the table has
# every reason that the server's own code gives. Prints what does not hold and ends with 1.
set -euo pipefail
cd "$1"
bad=0
complain() {
  echo "$1"
  bad=1
}
word='[A-Z][A-Z0-9]*(_[A-Z0-9]+)+'

given() { grep -rhoE "[{(]\"$word\"" --include='*.cc' --include='*.h' "$@" | grep -oE "$word" | sort -u; }
# Of a server that does not start, of files of its own, and no reason.
not_of_calls='ADDRESS_IN_USE|INSECURE_ADDRESS|FILE_NOT_FOUND|LAMBERT_FAILPOINT'
table() {
  sed -n '/^## Errors/,/^## Limits/p' docs/protocol.md | grep '^| [A-Z]' | cut -d'|' -f3 |
    grep -oE "$word" | sort -u
}
# Comments of the protos from `Errors:` to the call that they are about, and of the services.
named() {
  awk '/^ *\/\//{ text = text $0; next }
       /^ *rpc /{ if (match(text, /Errors:.*/)) print substr(text, RSTART) }
       /^service /{ if (match(text, /may fail with .*/)) print substr(text, RSTART) }
       { text = "" }' "$@" | grep -oE "$word" | sort -u
}
protos=(proto/lambert/v1/*.proto proto/lambert/worker/v1/*.proto)
codes='UNAUTHENTICATED|PERMISSION_DENIED'

while read -r reason; do
  complain "the protos name $reason, which no code gives"
done < <(comm -23 <(named "${protos[@]}" | grep -vxE "$codes") <(given radiosity server))
while read -r reason; do
  complain "docs/protocol.md names $reason, which no code gives"
done < <(comm -23 <(table) <(given radiosity server))
while read -r reason; do
  complain "the protos name $reason, which the table of docs/protocol.md lacks"
done < <(comm -23 <(named "${protos[@]}" | grep -vxE "$codes") <(table))
while read -r reason; do
  complain "the server gives $reason, which the table of docs/protocol.md lacks"
done < <(comm -23 <(given server | grep -vxE "$not_of_calls") <(table))

silent=$(awk '/^ *\/\//{ text = text $0; next }
     /^ *rpc /{ if (text !~ /Errors:/) print FILENAME ": " $2 }
     { text = "" }' "${protos[@]}")
# Closing what is closed is no error.
silent=$(grep -v 'DeleteWorkerSession' <<<"$silent" || true)
[[ -z $silent ]] || complain "these calls do not say which errors they give: $silent"
exit "$bad"
