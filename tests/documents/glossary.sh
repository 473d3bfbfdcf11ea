#!/usr/bin/env bash
# tests/documents/glossary.sh <folder of the sources>: fails when the second column of a table in docs/glossary.md names
# what the sources do not have outside of comments: an option (--name), a name or a text as whole words, the two words of
# Type::member in one file.
set -euo pipefail
export LC_ALL=C
cd "$1"

# A line per file.
code="$(mktemp)"
trap 'rm -f "$code"' EXIT
find mbs elements solvers turbines programs examples -name '*.[ch]pp' -exec \
    awk 'FNR == 1 && NR > 1 { print "" } { sub("//.*", ""); printf "%s ", $0 } END { print "" }' {} + >"$code"

found() { # <name>
    case "$1" in
        --*) grep -qF -- "\"$1\"" "$code" ;;
        *::*) grep -wF -- "${1%%::*}" "$code" | grep -wF -- "${1##*::}" >/dev/null ;;
        *) grep -qwF -- "$1" "$code" ;;
    esac
}

count=0 missing=()
while read -r name; do
    count=$((count + 1))
    found "$name" || missing+=("$name")
done < <(awk -F '|' '/^\| / { n = split($3, part, "`"); for (i = 2; i <= n; i += 2) print part[i] }' docs/glossary.md)

if ((${#missing[@]} > 0 || count < 200)); then
    echo "docs/glossary.md has $count names; not in the sources: ${missing[*]@Q}" >&2
    exit 1
fi
echo "glossary: the sources have all $count names"
