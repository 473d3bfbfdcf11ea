#!/usr/bin/env bash
# Builds and tests everything; the exit is non-zero if anything failed.
set -euo pipefail

usage() {
    cat <<'TEXT'
usage: ./test.sh [--full] [--keep-going] [--help]

  (nothing)  format check, release build with clang, a project of its own against the installed package, by GCC, and all
             tests but the slow ones
  --full     the same, the benchmarks built as well, then each header by itself, the reference, clang-tidy, GCC's build with
             its tests and a program of clang's, the tests under the address and undefined-behaviour sanitizers, sweeps,
             simulations and writers at once under the thread sanitizer, one minute of fuzzing for each reader, and the
             slow tests
  --keep-going
             a step that fails does not end the run; the failed ones are named at its end

Everything is written to build/. Missing Debian packages are installed (root or passwordless sudo); otherwise the
command that installs them is printed. Environment: CARDAN_JOBS, number of parallel jobs (default: all processors);
CARDAN_SKIP_PACKAGES=1, packages are not checked.
TEXT
}

full=0
keep_going=0
for argument in "$@"; do
    case "$argument" in
        --full) full=1 ;;
        --keep-going) keep_going=1 ;;
        -h | --help) usage && exit 0 ;;
        *) usage >&2 && exit 2 ;;
    esac
done

cd "$(dirname "${BASH_SOURCE[0]}")"
# shellcheck source=.ci/packages.sh
source .ci/packages.sh

jobs="${CARDAN_JOBS:-$(nproc)}"
failed=()

# step <name> <command>...: commands are functions of &&-lists, because errexit does not hold within a condition.
step() {
    local name="$1" start=$SECONDS
    shift
    printf '\n== %s\n' "$name"
    if ! "$@"; then
        echo "test.sh: FAILED in step: $name" >&2
        if ((!keep_going)); then exit 1; fi
        failed+=("$name")
    fi
    printf -- '-- %s: %d s, %d s in all\n' "$name" $((SECONDS - start)) "$SECONDS"
}

# The C++ files that git tracks; in a copy without git, all outside build/ and out/.
sources() {
    local file listed
    listed="$(git ls-files -- '*.cpp' '*.hpp' 2>/dev/null || true)"
    if [[ -z "$listed" ]]; then
        listed="$(find . \( -path ./build -o -path ./out \) -prune -o \( -name '*.cpp' -o -name '*.hpp' \) -print)"
    fi
    while IFS= read -r file; do
        if [[ -f "$file" ]]; then printf '%s\n' "$file"; fi
    done <<<"$listed"
}

check_format() {
    local files
    mapfile -t files < <(sources)
    if ((${#files[@]} == 0)); then
        echo "no C++ files found" >&2
        return 1
    fi
    printf '%s\0' "${files[@]}" | xargs -0 -P "$jobs" -n 100 clang-format --dry-run --Werror &&
        echo "${#files[@]} files are formatted"
}

build() { # <preset> [options of cmake]
    cmake --preset "$1" "${@:2}" && cmake --build --preset "$1" --parallel "$jobs"
}

# install <preset>: `prefix` holds a copy of what a build has made.
prefix="$PWD/build/packaging/prefix"
install() {
    rm -rf "$prefix" && cmake --install "build/$1" --prefix "$prefix" >/dev/null
}

# A project of its own, with find_package(cardan) and the system's compiler with its default flags.
check_package() {
    local consumer="$PWD/build/packaging/consumer"
    rm -rf build/packaging &&
        install release &&
        cmake -S tests/packaging -B "$consumer" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" &&
        cmake --build "$consumer" --parallel "$jobs" &&
        (cd "$consumer" && ./consumer && ./consumer_mbs && ./consumer_yaml && ./consumer_urdf && ./use_shared &&
            ./consumer_sanitized) &&
        (cd build/packaging && "$prefix/bin/cardan" modes wt600 >/dev/null)
}

# check_across_compilers <compiler>: its programs find what they call in the library that is installed.
check_across_compilers() {
    local across="$PWD/build/packaging/across"
    rm -rf "$across" &&
        cmake -S tests/packaging/across -B "$across" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$1" &&
        cmake --build "$across" --parallel "$jobs" &&
        "$across/across"
}

check_headers() {
    cmake -S tests/packaging -B build/packaging/headers -G Ninja -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER=clang++ &&
        cmake --build build/packaging/headers --target consumer_headers --parallel "$jobs"
}

# The libraries, the programs and the benchmarks, as the release build joins their sources. These include .cpp files, which
# are no mistake, and "headers" to report.
check_tidy() {
    local ours='(mbs|elements|turbines|solvers|programs|examples|bench)/[a-z0-9_/]+\.[ch]pp$'
    run-clang-tidy -quiet -j "$jobs" -p build/release -checks=-bugprone-suspicious-include -header-filter="$PWD/$ours" \
        "^$PWD/(build/release/(CMakeFiles|programs|examples|bench)|programs|examples|bench)/" 2>&1 |
        { grep -Ev '[0-9]+ warnings? generated\.$' || true; }
}

check_threads() { build thread && build/thread/tests/two_sweeps && build/thread/tests/writers; }

packages=("${cardan_build_packages[@]}" "${cardan_peer_packages[@]}" "${cardan_format_packages[@]}")
if ((full)); then packages+=("${cardan_check_packages[@]}" "${cardan_reference_packages[@]}"); fi

step "Packages" require_packages "${packages[@]}"
step "Format" check_format
step "Build, preset release" build release -D CARDAN_BUILD_BENCH="$( ((full)) && echo ON || echo OFF)"
step "Installed package" check_package
step "Program of GCC" check_across_compilers g++
step "Tests, preset release" ctest --preset release --parallel "$jobs"
if ((full)); then
    step "Headers, each by itself" check_headers
    step "Reference" cmake --build --preset release --target reference
    step "clang-tidy" check_tidy
    step "Build, preset gcc" build gcc
    step "Symbols of both compilers" tests/packaging/across/symbols.sh build/release build/gcc
    step "Installed package of GCC" install gcc
    step "Program of clang" check_across_compilers clang++
    step "Tests, preset gcc" ctest --preset gcc --parallel "$jobs"
    step "Build, preset sanitize" build sanitize
    step "Tests, preset sanitize" ctest --preset sanitize --parallel "$jobs"
    step "Thread sanitizer" check_threads
    step "Fuzzing" tests/fuzz/run.sh 60
    step "Slow tests" ctest --test-dir build/release --output-on-failure --no-tests=error --label-regex '^slow$' --parallel "$jobs"
fi

if ((${#failed[@]} > 0)); then
    printf '\ntest.sh: FAILED: %s\n' "${failed[@]}" >&2
    exit 1
fi
