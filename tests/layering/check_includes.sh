#!/usr/bin/env bash
# check_includes.sh ROOT [TABLE]: holds every #include of the rooms under ROOT against rooms.txt.
# Prints one line a violation, `FILE:LINE: WHAT`, and ends with 1 where there is one.
set -euo pipefail
table=$(realpath "${2:-$(dirname "${BASH_SOURCE[0]}")/rooms.txt}")
cd "$1"

# Every folder with C++ in it, but for the tests, which may include any room.
mapfile -t folders < <(find . -mindepth 1 -maxdepth 1 -type d ! -name 'build*' ! -name '.*' \
  ! -name tests ! -name out ! -name node_modules -printf '%f\n' | sort)

find "${folders[@]}" \( -name '*.h' -o -name '*.cc' \) -print0 | sort -z |
  xargs -0 -r grep -HnE '^[[:space:]]*#[[:space:]]*include[[:space:]]*[<"]' -- /dev/null |
  awk -v table="$table" '
    function room_of(path,    prefix) {  # the room that holds `path`, or ""
      for (prefix = path; sub(/\/[^\/]*$/, "", prefix);) if (prefix in allowed) return prefix
      return ""
    }
    function complain(what) { print place ": " what; bad = 1 }
    BEGIN {
      while ((getline line < table) > 0) {
        if (line ~ /^#/ || line !~ /:/) continue
        split_at = index(line, ": ")
        name = split_at ? substr(line, 1, split_at - 1) : substr(line, 1, length(line) - 1)
        rest = split_at ? " " substr(line, split_at + 2) " " : " "
        if (sub(/^only /, "", name)) { only[name] = rest; continue }
        count = split(rest, parts, " ")
        for (i = 1; i <= count; ++i)
          if (!(parts[i] in allowed)) {
            place = "rooms.txt"
            complain(name " may not look down at " parts[i])
          }
        allowed[name] = rest
      }
      if (length(allowed) == 0) { print table ": no rooms"; bad = 1 }
    }
    {
      split($0, field, ":")
      file = field[1]; place = file ":" field[2]
      header = $0
      sub(/^[^<"]*[<"]/, "", header); sub(/[>"].*$/, "", header)
      from = room_of(file)
      if (from == "") { complain("not in a room of rooms.txt"); next }
      if (header ~ /(^|\/)\.\.?\//) complain("includes " header "; write the path from the root")
      if (header !~ /\// && $0 ~ /"/) {
        sibling = file; sub(/[^\/]*$/, header, sibling)
        if ((getline line < sibling) >= 0) complain("includes " header "; write the path from the root")
        close(sibling)
      }
      to = header ~ /^lambert\// ? "proto" : room_of(header)  # lambert/v1/*.pb.h are generated
      if (header ~ /^(radiosity|tests)\// && to == "") complain(from " includes " header)
      if (to != "" && to != from && index(allowed[from], " " to " ") == 0)
        complain(from " includes " to " (" header ")")
      for (pattern in only)
        if (header ~ pattern && index(only[pattern], " " from " ") == 0)
          complain(from " includes " header ", which belongs to:" substr(only[pattern], 1, length(only[pattern]) - 1))
    }
    END { exit bad }'
