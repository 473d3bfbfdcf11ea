# Debian packages Cardan is built with, and how they are installed. Sourced by demo.sh and test.sh.
# shellcheck shell=bash disable=SC2034

cardan_build_packages=(
    clang g++ cmake ninja-build lld
    libeigen3-dev libsundials-dev liburdfdom-dev libhdf5-dev libmatio-dev libcli11-dev catch2 libbenchmark-dev libboost-dev
    libtbb-dev libyaml-dev gnuplot-nox help2man locales
)
# Other engines that the tests and benchmarks compare with, and programs that read our files; without them these comparisons are left out.
cardan_peer_packages=(libsimbody-dev libmujoco-dev python3-xarray python3-netcdf4 python3-h5netcdf netcdf-bin)
cardan_format_packages=(clang-format)
cardan_reference_packages=(doxygen graphviz libjs-mathjax python3)
cardan_check_packages=(clang-tidy libclang-rt-14-dev)
cardan_debian_packages=(debootstrap dpkg-dev)

# require_packages <package>...: installs what is missing and says which. Without apt, or without root and sudo, prints
# the command to run and returns non-zero. CARDAN_SKIP_PACKAGES=1: trusts that everything is there.
require_packages() {
    if [[ "${CARDAN_SKIP_PACKAGES:-0}" == 1 ]]; then
        echo "CARDAN_SKIP_PACKAGES=1: packages not checked"
        return 0
    fi
    local package missing=()
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        echo "This system has no apt. Cardan needs what these Debian packages contain; on Debian or Ubuntu:" >&2
        echo "    apt-get update && apt-get install -y $*" >&2
        echo "With all of it installed in another way, run again with CARDAN_SKIP_PACKAGES=1." >&2
        return 1
    fi
    for package in "$@"; do
        # shellcheck disable=SC2016 # the ${} is dpkg-query's
        if [[ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" != installed ]]; then
            missing+=("$package")
        fi
    done
    if ((${#missing[@]} == 0)); then
        echo "packages: nothing missing"
        return 0
    fi
    echo "packages missing: ${missing[*]}"

    local as_root=()
    if ((EUID != 0)); then
        if command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
            as_root=(sudo -n)
        else
            echo "Installing them needs root. Run this, then run again:" >&2
            echo "    sudo apt-get update && sudo apt-get install -y ${missing[*]}" >&2
            return 1
        fi
    fi
    echo "installing them with apt-get ..."
    as_root+=(env DEBIAN_FRONTEND=noninteractive apt-get)
    "${as_root[@]}" update -qq || echo "apt-get update failed; going on with the package lists at hand" >&2
    if ! "${as_root[@]}" install -y -qq --no-install-recommends "${missing[@]}"; then
        echo "The packages could not be installed. Run this, then run again:" >&2
        echo "    apt-get update && apt-get install -y ${missing[*]}" >&2
        return 1
    fi
}
