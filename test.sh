#!/usr/bin/env bash
# Builds and tests everything; the exit is non-zero if anything failed.
set -euo pipefail

usage() {
    cat <<'TEXT'
usage: ./test.sh [--full] [--keep-going] [--help]

  (nothing)  format check, release build with clang, which takes two thirds of GCC's time, installed-package consumer, and
             one that GCC makes, all tests but the slow ones and those of the studies (other beams to compare with, papers,
             the teetered machine), which are not built
  --full     the same with GCC (a consumer that clang makes) and the studies, then each header by itself, the reference,
             clang-tidy, the benchmarks parsed, clang's build, which has GCC's symbols, and the tests without studies under
             its address and undefined-behaviour sanitizers, C++ blocks of the documents, two sweeps at once under the
             thread sanitizer, one minute of fuzzing for each reader, and the slow tests
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
# shellcheck source=cmake/packages.sh
source cmake/packages.sh

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

# Of the release build.
preset=clang
if ((full)); then preset=release; fi

build() { # <preset> [options of cmake]
    cmake --preset "$1" "${@:2}" && cmake --build --preset "$1" --parallel "$jobs"
}

# A project of its own, with find_package(cardan) and the compiler's default flags, against an installed copy.
check_package() {
    local prefix="$PWD/build/packaging/prefix" consumer="$PWD/build/packaging/consumer"
    rm -rf build/packaging &&
        cmake --install "build/$preset" --prefix "$prefix" >/dev/null &&
        cmake -S tests/packaging -B "$consumer" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" &&
        cmake --build "$consumer" --parallel "$jobs" &&
        (cd "$consumer" && ./consumer && ./consumer_mbs && ./consumer_yaml && ./consumer_urdf && ./use_shared &&
            ./consumer_sanitized) &&
        "$prefix/bin/cardan-wt600-campbell" --help >/dev/null
}

# A program made by the compiler that the library is not made by: it finds what it calls.
check_across_compilers() {
    local compiler=g++ across="$PWD/build/packaging/across"
    if ((full)); then compiler=clang++; fi
    if ! command -v "$compiler" >/dev/null; then
        echo "there is no $compiler here: that its programs link the library is not tested"
        return 0
    fi
    rm -rf "$across" &&
        cmake -S tests/packaging/across -B "$across" -G Ninja -DCMAKE_PREFIX_PATH="$PWD/build/packaging/prefix" \
            -DCMAKE_CXX_COMPILER="$compiler" &&
        cmake --build "$across" --parallel "$jobs" &&
        "$across/across"
}

# With clang, which reads Eigen in less time.
check_headers() {
    cmake -S tests/packaging -B build/packaging/headers -G Ninja -DCMAKE_PREFIX_PATH="$PWD/build/packaging/prefix" \
        -DCMAKE_CXX_COMPILER=clang++ &&
        cmake --build build/packaging/headers --target consumer_headers --parallel "$jobs"
}

# run-clang-tidy <options>... <regular expression of sources>, on the compile commands of preset tidy: sources joined across
# targets (cmake/cardanTidy.cmake).
tidy() {
    run-clang-tidy -quiet -j "$jobs" -p build/tidy "$@" 2>&1 | { grep -Ev '[0-9]+ warnings? generated\.$' || true; }
}

# The library and the programs. A joined source includes .cpp files, which are no mistake and "headers" to report.
check_tidy() {
    local ours='(mbs|elements|turbines|solvers|examples)/[a-z0-9_/]+\.[ch]pp$'
    cmake --preset tidy >/dev/null &&
        tidy -checks=-bugprone-suspicious-include -header-filter="$PWD/$ours" '^(?!.*(tests/peers|bench_))'
}

# After check_tidy, which makes the compile commands. Interfaces move, and nothing else here compiles the benchmarks: they
# are read by the parser only, with one check that finds nothing in them.
check_benchmarks() {
    grep -q bench_air build/tidy/compile_commands.json && tidy -checks='-*,misc-unused-using-decls' bench_
}

# The blocks of C++ in the documents. With clang, which reads them in three quarters of GCC's time.
check_documents() { ctest --test-dir build/sanitize --output-on-failure --no-tests=error --tests-regex '^document_snippets$'; }

check_threads() { build thread && build/thread/tests/two_sweeps; }

packages=("${cardan_build_packages[@]}" "${cardan_clang_packages[@]}" "${cardan_peer_packages[@]}" "${cardan_format_packages[@]}")
if ((full)); then packages+=("${cardan_check_packages[@]}" "${cardan_reference_packages[@]}"); fi

step "Packages" require_packages "${packages[@]}"
step "Format" check_format
step "Build, preset $preset" build "$preset" -D CARDAN_BUILD_STUDIES="$( ((full)) && echo ON || echo OFF)"
step "Installed package" check_package
step "Program of the other compiler" check_across_compilers
step "Tests, preset $preset" ctest --preset "$preset" --parallel "$jobs"
if ((full)); then
    step "Headers, each by itself" check_headers
    step "Reference" cmake --build --preset release --target reference
    step "clang-tidy" check_tidy
    step "Benchmarks, parsed" check_benchmarks
    step "Build with clang and sanitizers" build sanitize -D CARDAN_BUILD_STUDIES=OFF
    step "Symbols of both compilers" tests/packaging/across/symbols.sh build/release build/sanitize
    step "Tests, sanitizers" ctest --preset sanitize --parallel "$jobs"
    step "C++ in documents" check_documents
    step "Thread sanitizer" check_threads
    step "Fuzzing" tests/fuzz/run.sh 60
    step "Slow tests" ctest --test-dir build/release --output-on-failure --no-tests=error --label-regex '^slow$' \
        --exclude-regex '^document_snippets$' --parallel "$jobs"
fi

if ((${#failed[@]} > 0)); then
    printf '\ntest.sh: FAILED: %s\n' "${failed[@]}" >&2
    exit 1
fi
