#!/usr/bin/env bash
# Builds what the demonstration needs, runs it and says where its pictures are.
set -Eeuo pipefail

usage() {
    cat <<'TEXT'
usage: ./demo.sh [--help]

Builds two examples and what they use of the library in build/release, computes the Campbell diagram of the 600 kW
turbine and simulates its emergency stop. Files go to out/ (campbell_diagram.h5, .csv, .svg and its panels;
emergency_stop.h5, .svg). Missing Debian packages are installed (root or passwordless sudo); otherwise the command that
installs them is printed. CARDAN_SKIP_PACKAGES=1 leaves out the check.
TEXT
}

case "${1:-}" in
    "") ;;
    -h | --help) usage && exit 0 ;;
    *) usage >&2 && exit 2 ;;
esac

cd "$(dirname "${BASH_SOURCE[0]}")"
# shellcheck source=.ci/packages.sh
source .ci/packages.sh

heading() { printf '\n== %s\n' "$*"; }
trap 'echo "demo.sh: FAILED (line $LINENO)" >&2' ERR

out=out

heading "Packages"
require_packages "${cardan_build_packages[@]}"

heading "Build"
cmake --preset release
cmake --build --preset release --target campbell_diagram emergency_stop
programs="$PWD/build/release/examples"
mkdir -p "$out" && cd "$out"

heading "Campbell diagram of the 600 kW turbine"
"$programs/campbell_diagram"

heading "Emergency stop of the 600 kW turbine"
"$programs/emergency_stop"

heading "Results"
echo "Campbell diagram  $PWD/campbell_diagram.svg"
echo "by families       $PWD/campbell_diagram_panels.svg"
echo "emergency stop    $PWD/emergency_stop.svg"
echo "data              $PWD/campbell_diagram.h5, campbell_diagram.csv, emergency_stop.h5"
