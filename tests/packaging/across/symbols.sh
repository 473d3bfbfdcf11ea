#!/usr/bin/env bash
# symbols.sh <build folder> <build folder>: fails when functions and objects of the libraries, made by a compiler in each
# folder, have other symbols in the one than in the other: what one compiler calls is not found in the other's library.
set -euo pipefail
export LC_ALL=C

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

archives() { (cd "$1" && find . -name 'libcardan_*.a' | sort); }

# "<strong or weak> <symbol>" of what archives of a folder define within cardan; instances of the standard library's
# templates are each compiler's own. A constructor or destructor has several symbols, as many as the compiler likes.
symbols() { # <build folder> <archives>
    (cd "$1" && xargs nm --defined-only --extern-only <"$2" 2>/dev/null) |
        awk 'NF == 3 && $3 ~ /^_ZN[VKRO]*6cardan/ { print ($2 ~ /[WVu]/ ? "weak" : "strong"), $3 }' |
        sed -E 's/([CD])[0-5]([EI])/\12\2/g' | sort -u
}

# Functions that are there once for each processor ("f.avx2", "f.resolver"): each compiler names these copies in its way,
# and clang has no "f" itself. So nothing but the source that defines them may call them.
clones() { sed -nE 's/^[a-z]+ (.*)\.resolver$/\1/p' "$1"; }
calls_from_elsewhere() { # <build folder> <archives> <clones>
    (cd "$1" && xargs nm --undefined-only <"$2" 2>/dev/null) | awk 'NF == 2 { print $2 }' | sed -E 's/\.(ifunc|resolver)$//' |
        sort -u | comm -12 - "$3"
}

archives "$1" >"$work/first"
archives "$2" >"$work/second"
comm -12 "$work/first" "$work/second" >"$work/both"
if [[ ! -s "$work/both" ]]; then
    echo "symbols of two compilers: no libraries that are in $1 and in $2" >&2
    exit 1
fi
symbols "$1" "$work/both" >"$work/first"
symbols "$2" "$work/both" >"$work/second"
cat <(clones "$work/first") <(clones "$work/second") | sort -u >"$work/clones"
for folder in "$1" "$2"; do
    if ! calls_from_elsewhere "$folder" "$work/both" "$work/clones" >"$work/called" || [[ -s "$work/called" ]]; then
        echo "symbols of two compilers: functions with a copy for each processor are called from another source in $folder:" >&2
        c++filt <"$work/called" >&2
        exit 1
    fi
done
# Without them and their copies.
for one in first second; do
    awk 'NR == FNR { clone[$1]; next } { name = $2; sub(/\..*/, "", name) } !(name in clone)' "$work/clones" "$work/$one" >"$work/$one.plain"
    mv "$work/$one.plain" "$work/$one"
done
for one in first second; do cut -d' ' -f2 "$work/$one" | sort -u >"$work/$one.names"; done

# What each has and the other has not: "<strong or weak> <symbol>".
join -1 2 -o 1.1,1.2 <(sort -k2 "$work/first") <(comm -23 "$work/first.names" "$work/second.names") -2 1 >"$work/first.only"
join -1 2 -o 1.1,1.2 <(sort -k2 "$work/second") <(comm -13 "$work/first.names" "$work/second.names") -2 1 >"$work/second.only"

# Functions of a .cpp are in both. Of templates each compiler keeps the instances it likes, but not under another name:
# "<name without parameters><tab><symbol>".
grep -h '^strong' "$work/first.only" "$work/second.only" | cut -d' ' -f2 >"$work/differ" || true
for one in first second; do
    cut -d' ' -f2 "$work/$one.only" >"$work/symbols"
    c++filt --no-params <"$work/symbols" >"$work/names"
    paste "$work/names" "$work/symbols" | grep -E $'>\t' | sort -t$'\t' -k1,1 >"$work/$one.instances" || true
done
join -t$'\t' -o 1.2,2.2 "$work/first.instances" "$work/second.instances" | tr '\t' '\n' >>"$work/differ"

if [[ -s "$work/differ" ]]; then
    echo "symbols of two compilers: not the same in $1 and in $2:" >&2
    sort -u "$work/differ" | while read -r symbol; do printf '  %s\n    %s\n' "$(c++filt "$symbol")" "$symbol" >&2; done
    exit 1
fi
echo "symbols of two compilers: $(wc -l <"$work/both") libraries, $(comm -12 "$work/first.names" "$work/second.names" | wc -l)" \
    "symbols in both, none that differs"
