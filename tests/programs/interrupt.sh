#!/usr/bin/env bash
# interrupt.sh FILE PROGRAM OPTIONS...: Ctrl-C half a second after the program has begun its FILE; its exit code.
set -um  # m: a background job can be interrupted
file=$1
shift
rm -f "$file"
"$@" &
pid=$!
until [ -s "$file" ]; do
    kill -0 "$pid" || break
    sleep 0.05
done
sleep 0.5
kill -INT "$pid"
wait "$pid"
