#!/usr/bin/env bash
# tests/fuzz/run.sh [seconds] [target]...: runs the targets in build/sanitize, 60 s each, as many at a time as there are
# processors (CARDAN_JOBS: another number). With CARDAN_INPUTS=1000000 each ends after as many inputs instead.
# Seeds: those in tests/fuzz/seeds, the models of tests/data, and what earlier runs found worth keeping
# (build/fuzz/corpus). A finding ends it: the input lies in build/fuzz/findings.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

seconds="${1:-60}"
shift || true
targets=("$@")
if ((${#targets[@]} == 0)); then targets=(urdf csv openfast aerodyn controller wind wind_box description windio checkpoint history diagram); fi

# The first byte of a seed of `openfast` says which file it replaces, in the order of fuzz_openfast.cpp.
seeds_of_openfast() { # <folder>
    local file digit=0
    for file in small.fst small_ElastoDyn.dat small_Blade.dat small_Tower.dat small_BeamDyn.fst small_BeamDyn.dat \
        small_BeamDyn_Blade.dat small_ServoDyn.dat; do
        { printf '%d' "$digit" && cat "tests/data/openfast/$file"; } >"$1/$file"
        digit=$((digit + 1))
    done
}

# Likewise, in the order of fuzz_aerodyn.cpp.
seeds_of_aerodyn() { # <folder>
    local file digit=0
    for file in small_AeroDyn.dat small_AeroDyn_Blade.dat small_Polar_1.dat small_Polar_2.dat; do
        { printf '%d' "$digit" && cat "tests/data/aerodyn/$file"; } >"$1/$file"
        digit=$((digit + 1))
    done
}

# Likewise, in the order of fuzz_wind_box.cpp.
seeds_of_wind_box() { # <folder>
    local file digit=0
    for file in data/wind/box7.bts data/wind/nrel.wnd data/wind/nrel.sum fuzz/seeds/wind_box/tower.twr \
        data/wind/native.wnd data/wind/native.ipt data/wind/hawc_u.bin; do
        { printf '%d' "$digit" && cat "tests/$file"; } >"$1/$(basename "$file")"
        digit=$((digit + 1))
    done
    { printf '7\020\004\005\003' && cat tests/data/wind/hawc_{u,v,w}.bin; } >"$1/hawc.bin"
}

# Inputs take a second; the limit of one is 300 s of the clock, since beside other work these programs, as the nicest, may
# get no processor for long.
fuzz() { # <target>
    local target="$1" seeds="build/fuzz/seeds/$1" corpus="build/fuzz/corpus/$1" log="build/fuzz/$1.log"
    mkdir -p "$seeds" "$corpus"
    case "$target" in
        openfast) seeds_of_openfast "$seeds" ;;
        aerodyn) seeds_of_aerodyn "$seeds" ;;
        wind_box) seeds_of_wind_box "$seeds" ;;
        windio) cp tests/data/windio/*.yaml "$seeds" ;;
        urdf) cp tests/fuzz/seeds/urdf/* examples/data/*.urdf "$seeds" ;;
        *) cp "tests/fuzz/seeds/$target/"* "$seeds" ;;
    esac
    if ! nice -n 19 "build/sanitize/tests/fuzz/fuzz_$target" "$limit" -timeout=300 -rss_limit_mb=2048 \
        -max_len=16384 -artifact_prefix=build/fuzz/findings/ -print_final_stats=1 "$corpus" "$seeds" >"$log" 2>&1; then
        tail -40 "$log" >&2
        echo "fuzzing: $target has a finding, see build/fuzz/findings and $log" >&2
        return 255 # xargs stops
    fi
    echo "$target: $(grep -o 'number_of_executed_units: .*' "$log" | grep -o '[0-9]*$') inputs, no finding"
}

mkdir -p build/fuzz/findings
export -f fuzz seeds_of_openfast seeds_of_aerodyn seeds_of_wind_box
if [[ -n "${CARDAN_INPUTS:-}" ]]; then limit="-runs=$CARDAN_INPUTS"; else limit="-max_total_time=$seconds"; fi
export limit
printf '%s\n' "${targets[@]}" | xargs -P "${CARDAN_JOBS:-$(nproc)}" -I '{}' bash -euo pipefail -c 'fuzz {}'
