# How the libraries Cardan stands on are found. Used by the build and, installed beside the package config, by
# consumers: both see the same targets. Those of a name, SUNDIALS::kinsol, are found by cardan_find_<name>, sundials.

# cardan_not_found(<message>): ends the configuration of the build. In find_package(cardan), which may be QUIET or ask for
# what is optional, it ends the package config instead; CMake gives the message where it is wanted.
macro(cardan_not_found message)
    if(CMAKE_FIND_PACKAGE_NAME STREQUAL "cardan")
        set(cardan_FOUND FALSE)
        set(cardan_NOT_FOUND_MESSAGE "${message}")
        return()
    endif()
    message(FATAL_ERROR "${message}")
endmacro()

# cardan_need(<target> <message>)
macro(cardan_need target message)
    if(NOT TARGET ${target})
        cardan_not_found("${message}")
    endif()
endmacro()

macro(cardan_find_eigen3)
    if(NOT TARGET Eigen3::Eigen)
        find_package(Eigen3 3.4 QUIET NO_MODULE)
        cardan_need(Eigen3::Eigen "cardan needs Eigen 3.4 (Debian: libeigen3-dev; elsewhere set Eigen3_DIR).")
    endif()
endmacro()

set(CARDAN_SUNDIALS_COMPONENTS kinsol cvode arkode nvecserial sunmatrixdense sunnonlinsolfixedpoint)

# SUNDIALS' own config asks for OpenMP, which clang has only with libomp, and which none of our components uses.
# Its targets exist by then, so the targets are what is asked for here, not SUNDIALS_FOUND.
macro(cardan_find_sundials)
    find_package(SUNDIALS QUIET CONFIG COMPONENTS ${CARDAN_SUNDIALS_COMPONENTS})
    foreach(_cardan_part IN LISTS CARDAN_SUNDIALS_COMPONENTS)
        cardan_need(SUNDIALS::${_cardan_part}
                    "cardan needs SUNDIALS 6 or newer with ${_cardan_part} (Debian: libsundials-dev; elsewhere set SUNDIALS_DIR).")
    endforeach()
    if(SUNDIALS_VERSION AND SUNDIALS_VERSION VERSION_LESS 6)
        cardan_not_found("cardan needs SUNDIALS 6 or newer (SUNContext); found ${SUNDIALS_VERSION}.")
    endif()
    unset(_cardan_part)
endmacro()

# FindHDF5 compiles a C program to look for the C library.
macro(cardan_find_hdf5)
    if(NOT TARGET hdf5::hdf5_hl)
        enable_language(C)
        find_package(HDF5 1.10 QUIET COMPONENTS C HL)
        cardan_need(hdf5::hdf5_hl "cardan needs HDF5 1.10 or newer, C and HL (Debian: libhdf5-dev; elsewhere set HDF5_ROOT).")
    endif()
endmacro()

# cardan_find_plain(<name> <VARIABLES> <header> <library> <message>): the target <name>::<name> of a C library that has no
# package config of its own.
macro(cardan_find_plain name variables header library message)
    if(NOT TARGET ${name}::${name})
        find_path(${variables}_INCLUDE_DIR ${header})
        find_library(${variables}_LIBRARY ${library})
        mark_as_advanced(${variables}_INCLUDE_DIR ${variables}_LIBRARY)
        if(NOT ${variables}_INCLUDE_DIR OR NOT ${variables}_LIBRARY)
            cardan_not_found("${message}; elsewhere set ${variables}_INCLUDE_DIR and ${variables}_LIBRARY).")
        endif()
        add_library(${name}::${name} UNKNOWN IMPORTED)
        set_target_properties(${name}::${name} PROPERTIES IMPORTED_LOCATION "${${variables}_LIBRARY}"
                                                          INTERFACE_INCLUDE_DIRECTORIES "${${variables}_INCLUDE_DIR}")
    endif()
endmacro()

macro(cardan_find_matio)
    cardan_find_plain(matio MATIO matio.h matio "cardan needs libmatio (Debian: libmatio-dev")
endmacro()

macro(cardan_find_libyaml)
    cardan_find_plain(libyaml LIBYAML yaml.h yaml "cardan needs libyaml 0.2 (Debian: libyaml-dev")
endmacro()

macro(cardan_find_tbb)
    if(NOT TARGET TBB::tbb)
        find_package(TBB 2021 QUIET CONFIG COMPONENTS tbb)
        cardan_need(TBB::tbb "cardan needs oneTBB 2021 or newer (Debian: libtbb-dev; elsewhere set TBB_DIR).")
    endif()
endmacro()

macro(cardan_find_urdfdom)
    if(NOT TARGET urdfdom::urdfdom_model)
        find_package(urdfdom QUIET CONFIG)
        cardan_need(urdfdom::urdfdom_model "cardan needs urdfdom (Debian: liburdfdom-dev; elsewhere set urdfdom_DIR).")
    endif()
endmacro()
