#!/usr/bin/env bash
# tests/documents/withdrawn.sh <folder of the sources>: fails where headers, documents or the texts of the command have a
# word of withdrawn.txt, and where the first sentence of a header's doc comment leans on its neighbour ("Of a beam
# element", "Likewise with states"), since a hover and the reference site show it alone.
set -euo pipefail
export LC_ALL=C
words="$(cd "$(dirname "$0")" && pwd)/withdrawn.txt"
cd "$1"
rooms=(mbs elements solvers turbines programs examples)
unchecked='^$'

# Lines "<file>:<number>:<text>": of headers and documents whole, of the command what stands in quotes.
lines="$(mktemp)"
trap 'rm -f "$lines"' EXIT
find "${rooms[@]}" -name '*.hpp' -exec grep -nH '' {} + | grep -vE "$unchecked" >"$lines"
# The glossary names OpenFAST's words as well.
grep -nH '' README.md $(find docs -name '*.md' ! -name glossary.md) >>"$lines"
find programs -name '*.cpp' -exec grep -nHo '"[^"]*"' {} + >>"$lines"

failures=0 count=0
while IFS=$'\t' read -r word successor allowed; do
    [[ -z $word || $word == '#'* ]] && continue
    count=$((count + 1))
    found="$(grep -iE "(^|[^A-Za-z0-9_])($word)([^A-Za-z0-9_]|$)" "$lines" | grep -vE "${allowed:-^$}" || true)"
    if [[ -n $found ]]; then
        printf '%s\n  withdrawn, now: %s\n' "$found" "$successor" >&2
        failures=$((failures + 1))
    fi
done <"$words"

# The first line of a block of "///", behind "@file" and the name of the file, if they are there.
leaning="$(find "${rooms[@]}" -name '*.hpp' -exec awk '
    FNR == 1 { inside = 0 }
    !/^ *\/\/\// { inside = 0; next }
    {
        text = $0
        sub(/^ *\/\/\/ ?/, "", text)
        if (inside) next
        if (text ~ /^@file/) { sub(/^@file *([^ ]*\.hpp)? */, "", text); if (text == "") next }
        inside = 1
        if (text ~ /^(Of|What|The same|Likewise|That|Those|With|Without|Where|Which|Whose|How|Why|As above|Its|Their|Both)[ ,:]/)
            printf "%s:%d: %s\n", FILENAME, FNR, text
    }' {} + | grep -vE "$unchecked" || true)"
if [[ -n $leaning ]]; then
    printf '%s\n  a first sentence that does not stand alone\n' "$leaning" >&2
    failures=$((failures + 1))
fi

((failures == 0 && count > 0)) || exit 1
echo "withdrawn: none of $count words is in headers, documents and help, and first sentences stand alone"
