#!/usr/bin/env bash
# completion.sh COMPLETION CARDAN: what is offered after the beginnings of some command lines.
set -eu
# shellcheck source=/dev/null
source "$1"
cardan=$2
# Where no file is offered instead.
empty=$(mktemp -d)
trap 'rmdir "$empty"' EXIT
cd "$empty"

offered() { # WORDS...: those offered in the place of the last one
    COMP_WORDS=("$cardan" "$@")
    COMP_CWORD=$#
    COMPREPLY=()
    _cardan
    printf '%s\n' "${COMPREPLY[@]}"
}
expect() { # WORD WORDS...
    local word=$1
    shift
    offered "$@" | grep -qx -- "$word" || { echo "FAILED: '$word' is not offered after '$*': $(offered "$@" | tr '\n' ' ')"; exit 1; }
}

expect campbell ca
expect --version --v
expect simulate help si
expect --blade-elements campbell nrel5mw --bl
expect nrel5mw-spar modes nrel
expect locked campbell wt600 --generator lo
expect equilibrium campbell nrel5mw --wake eq
expect oye campbell nrel5mw --wake = oy
expect none steady nrel5mw --wake =
expect --blade-damping modes nrel5mw --blade-d
expect wind wi
expect mann wind nrel5mw --spectrum ma
expect --plane-order wind nrel5mw --pl
[ "$(offered campbell wt600 --generator lo | grep -c .)" = 1 ] || { echo "FAILED: more than one value"; exit 1; }
echo "completion: all is well"
