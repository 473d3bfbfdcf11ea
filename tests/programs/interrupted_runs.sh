#!/usr/bin/env bash
# interrupted_runs.sh PROGRAM CARDAN OPTIONS...: signals save what was computed, a run that goes on is the uninterrupted
# one bit for bit, and of two runs with the same --out the first one has the files.
set -eum  # m: background jobs have signals of their own
run=$1 cardan=$2
shift 2
options=$*
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() {
    echo "FAILED: $*"
    exit 1
}
rows() { # of a history, as far as it is safe; 0 without one
    "$cardan" info "$1" 2>/dev/null | sed -n 's/^rows *\([0-9]*\).*/\1/p' | grep . || echo 0
}
begin() { # NAME: a long run in the background, with rows in its file
    "$run" $options --duration 100000 --out "$1" >"$1.log" 2>&1 &
    pid=$!
    for _ in $(seq 600); do
        [ "$(rows "$1.h5")" -gt 100 ] && return
        sleep 0.1
    done
    fail "$1 does not begin: $(cat "$1.log")"
}

for signal in INT:130 TERM:143 HUP:129; do
    name=${signal%:*}
    begin "$name"
    kill "-$name" "$pid"
    code=0
    wait "$pid" || code=$?
    [ "$code" = "${signal#*:}" ] || fail "SIG$name ends with $code: $(cat "$name.log")"
    "$cardan" info "$name.h5" >info
    grep -q "broken off" info || fail "SIG$name: $(cat info)"
    [ -s "$name.svg" ] || fail "SIG$name: no picture"
done

# To the end of the last whole second and 5 s on; and the same without an interruption.
end=$("$cardan" info TERM.h5 | sed -n 's/^rows .*\.\.\. \([0-9]*\).*/\1/p')
"$run" $options --duration $((end + 5)) --out TERM --resume >/dev/null || [ $? = 1 ]
"$run" $options --duration $((end + 5)) --out whole >/dev/null || [ $? = 1 ]
for name in TERM whole; do "$cardan" convert "$name.h5" "$name.csv" >/dev/null; done
cmp TERM.csv whole.csv || fail "the resumed run is not the uninterrupted one"

# The second run on one --out tells who has it, and does the first one no harm.
begin one
code=0
"$run" $options --duration 1 --out one >second 2>&1 || code=$?
[ "$code" = 1 ] || fail "a second run ends with $code"
grep -q "process $pid)" second || fail "it does not name $pid: $(cat second)"
kill -TERM "$pid"
wait "$pid" || true
[ "$(rows one.h5)" -gt 100 ] || fail "the first run has lost its rows"

# If several begin at once, one wins and the others say so.
pids=
for k in 1 2 3 4; do
    "$run" $options --duration 100000 --out new >"new$k.log" 2>&1 &
    pids="$pids $!"
done
for _ in $(seq 600); do
    [ "$(jobs -r | wc -l)" = 1 ] && [ "$(rows new.h5)" -gt 10 ] && break
    sleep 0.1
done
[ "$(jobs -r | wc -l)" = 1 ] || fail "$(jobs -r | wc -l) runs go on"
[ "$(cat new?.log | grep -c 'has it open (process ')" = 3 ] || fail "$(cat new?.log)"
kill -TERM $(jobs -pr)
wait || true
[ "$(rows new.h5)" -gt 10 ] || fail "the winner has lost its rows"

# What a run that was killed has left behind is named.
echo "half a picture" >left.svg.partial
"$run" $options --duration 1 --out left >left.log 2>&1 || true
grep -q "left.svg.partial was left behind by a run that was killed" left.log || fail "$(cat left.log)"
[ ! -e left.svg.partial ] || fail "left.svg.partial is still there"

# A limit on the size of files is an error as a full disk is, and what was written stays.
code=0
(ulimit -f 1500 && exec "$run" $options --duration 100000 --out limited >limited.log 2>&1) || code=$?
[ "$code" = 1 ] || fail "at the limit of a file's size it ends with $code: $(cat limited.log)"
grep -q "limited.h5: .*File too large" limited.log || fail "$(cat limited.log)"
"$cardan" info limited.h5 >info || fail "limited.h5 cannot be read: $(cat info)"
echo "interrupted runs: all is well"
