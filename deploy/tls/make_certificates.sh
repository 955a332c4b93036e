#!/usr/bin/env bash
# Certificates for a small farm, signed by a CA of its own, in FOLDER:
#   make_certificates.sh FOLDER server|merger HOST...    server.crt, server.key or merger.crt, merger.key, for these
#                                                        names and addresses; a merge shard's is also its role's
#   make_certificates.sh FOLDER client|worker|admin NAME ROLE-NAME.crt, ROLE-NAME.key
# The first call makes the CA: ca.crt, which every program is given, and ca.key, which belongs on
# no machine of the farm. Certificates last 825 days. A role's certificate has the one URI
# spiffe://lambert/ROLE/NAME; that is what the server goes by.
set -euo pipefail

days=825
usage() {
  sed -n '2,6s/^# //p' "${BASH_SOURCE[0]}" >&2
  exit 2
}
(($# >= 3)) || usage
folder=$1 role=$2
shift 2
mkdir -p "$folder"
umask 077

if [[ ! -e $folder/ca.key ]]; then
  openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -noenc -sha256 -days 3650 \
    -subj "/CN=Lambert farm CA" -addext "basicConstraints=critical,CA:TRUE,pathlen:0" \
    -addext "keyUsage=critical,keyCertSign,cRLSign" \
    -keyout "$folder/ca.key" -out "$folder/ca.crt" 2>/dev/null
fi

# sign FILE NAME USAGE ALTERNATIVE_NAMES: FILE.crt and FILE.key.
sign() {
  local extensions
  extensions=$(printf '%s\n' "basicConstraints=critical,CA:FALSE" "keyUsage=critical,digitalSignature" \
    "extendedKeyUsage=$3" "subjectAltName=$4")
  openssl req -newkey ec -pkeyopt ec_paramgen_curve:P-256 -noenc -subj "/CN=$2" \
    -keyout "$folder/$1.key" 2>/dev/null |
    openssl x509 -req -sha256 -days "$days" -CA "$folder/ca.crt" -CAkey "$folder/ca.key" \
      -extfile <(echo "$extensions") -out "$folder/$1.crt" 2>/dev/null
}

case $role in
  server | merger)
    names=
    for host in "$@"; do
      kind=DNS
      [[ $host =~ ^[0-9.]+$ || $host == *:* ]] && kind=IP
      names+=${names:+,}$kind:$host
    done
    if [[ $role == server ]]; then
      sign server "$1" serverAuth "$names"
    else
      sign merger "$1" serverAuth,clientAuth "$names,URI:spiffe://lambert/merger/merger"
    fi
    ;;
  client | worker | admin)
    [[ $# -eq 1 && $1 =~ ^[a-z][a-z0-9-]{0,39}$ ]] || usage
    sign "$role-$1" "$1" clientAuth "URI:spiffe://lambert/$role/$1"
    ;;
  *) usage ;;
esac
