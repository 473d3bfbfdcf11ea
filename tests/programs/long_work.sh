#!/usr/bin/env bash
# long_work.sh CARDAN: a command that takes long says so where there is no terminal, a signal leaves the points that are
# done, a second one ends it at once; short work says nothing.
set -eum  # m: background jobs have signals of their own
cardan=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
few="--blade-elements 1 --tower-elements 1"

fail() {
    echo "FAILED: $*"
    exit 1
}
begin() { # NAME COMMAND...: a command in the background
    "$cardan" "${@:2}" --out "$1" >"$1.log" 2>"$1.err" &
    pid=$!
}
ended() { # CODE NAME
    local code=0
    wait "$pid" || code=$?
    [ "$code" = "$1" ] || fail "$2 ends with $code: $(cat "$2.err" "$2.log")"
}

# Ten seconds later, of which it has slept most: a line.
begin told campbell nrel5mw --wind 4:24:0.01 $few
sleep 3
kill -STOP "$pid"
sleep 8
kill -CONT "$pid"
line='^cardan campbell: wind speed [1-9][0-9]* of 2001, after [0-9]* s$'
for _ in $(seq 600); do # a busy computer has no point yet when it first tells
    grep -q "$line" told.err && break
    sleep 0.1
done
grep -q "$line" told.err || fail "it says: $(cat told.err)"
kill -TERM "$pid"
ended 143 told
grep -q "stopping, and keeping what is done" told.err || fail "it does not say that it stops: $(cat told.err)"
"$cardan" info told.h5 >/dev/null || fail "nothing is left: $(cat told.err)"
grep -qE "^files: told.h5" told.log || fail "$(cat told.log)"

# Nothing is done yet: at once.
begin before steady nrel5mw --wind 8,12 --harmonics 120 --blade-elements 30
sleep 1
kill -INT "$pid"
ended 130 before
[ ! -e before.h5 ] || fail "it has left a result"

"$cardan" campbell wt600 --rpm 0 $few --out short >short.log 2>short.err
[ ! -s short.err ] || fail "short work says: $(cat short.err)"
echo "long work: all is well"
