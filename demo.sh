#!/usr/bin/env bash
# Builds what the demonstration needs, runs it and says where its pictures are.
set -Eeuo pipefail

usage() {
    cat <<'TEXT'
usage: ./demo.sh [--help]

Builds two programs and what they use of the library in build/release, computes the Campbell diagram of the 600 kW
turbine and simulates its emergency stop. Files go to out/ (wt600_campbell.h5, .csv, .svg, .png and the mode shapes;
wt600_emergency_stop.h5, .svg, .png and the pictures of energies and spectra). Missing Debian packages are installed
(root or passwordless sudo); otherwise the command that installs them is printed. CARDAN_SKIP_PACKAGES=1 leaves out the
check.
TEXT
}

case "${1:-}" in
    "") ;;
    -h | --help) usage && exit 0 ;;
    *) usage >&2 && exit 2 ;;
esac

cd "$(dirname "${BASH_SOURCE[0]}")"
# shellcheck source=cmake/packages.sh
source cmake/packages.sh

heading() { printf '\n== %s\n' "$*"; }
trap 'echo "demo.sh: FAILED (line $LINENO)" >&2' ERR

out=out

heading "Packages"
require_packages "${cardan_build_packages[@]}"

heading "Build"
cmake --preset release
cmake --build --preset release --target wt600_campbell wt600_emergency_stop

heading "Campbell diagram of the 600 kW turbine"
mkdir -p "$out"
"build/release/examples/wt600_campbell" --modes --out "$out/wt600_campbell"

heading "Emergency stop of the 600 kW turbine"
"build/release/examples/wt600_emergency_stop" --out "$out/wt600_emergency_stop"

heading "Results"
echo "Campbell diagram  $PWD/$out/wt600_campbell.png (.svg)"
echo "by families       $PWD/$out/wt600_campbell_tower_yaw_tilt.png, wt600_campbell_flap_edge.png"
echo "mode shapes       $PWD/$out/wt600_campbell_modes/"
echo "emergency stop    $PWD/$out/wt600_emergency_stop.png (.svg), wt600_emergency_stop_energy.png, _spectrum.png"
echo "data              $PWD/$out/wt600_campbell.h5, wt600_campbell.csv, wt600_emergency_stop.h5"
