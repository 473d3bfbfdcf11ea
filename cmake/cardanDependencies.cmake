# How the libraries Cardan stands on are found. Used by the build and, installed beside the package config, by
# consumers: both see the same targets.

macro(cardan_find_eigen)
    if(NOT TARGET Eigen3::Eigen)
        find_package(Eigen3 3.4 REQUIRED NO_MODULE)
    endif()
endmacro()

set(CARDAN_SUNDIALS_COMPONENTS kinsol cvode arkode nvecserial sunmatrixdense sunlinsoldense
                               sunnonlinsolfixedpoint)

# SUNDIALS' own config asks for OpenMP, which clang has only with libomp, and which none of our components uses.
# Its targets exist by then, so the targets are what is asked for here, not SUNDIALS_FOUND.
macro(cardan_find_sundials)
    find_package(SUNDIALS QUIET CONFIG COMPONENTS ${CARDAN_SUNDIALS_COMPONENTS})
    foreach(_cardan_part IN LISTS CARDAN_SUNDIALS_COMPONENTS)
        if(NOT TARGET SUNDIALS::${_cardan_part})
            message(FATAL_ERROR "cardan needs SUNDIALS 6 or newer with ${CARDAN_SUNDIALS_COMPONENTS}; "
                                "SUNDIALS::${_cardan_part} was not found (Debian: libsundials-dev; elsewhere "
                                "set SUNDIALS_DIR).")
        endif()
    endforeach()
    if(SUNDIALS_VERSION AND SUNDIALS_VERSION VERSION_LESS 6)
        message(FATAL_ERROR "cardan needs SUNDIALS 6 or newer (SUNContext); found ${SUNDIALS_VERSION}.")
    endif()
    unset(_cardan_part)
endmacro()

# FindHDF5 compiles a C program to look for the C library.
macro(cardan_find_hdf5)
    if(NOT TARGET hdf5::hdf5_hl)
        enable_language(C)
        find_package(HDF5 1.10 REQUIRED COMPONENTS C HL)
    endif()
endmacro()

# libmatio has no package config of its own.
macro(cardan_find_matio)
    if(NOT TARGET matio::matio)
        find_path(MATIO_INCLUDE_DIR matio.h)
        find_library(MATIO_LIBRARY matio)
        if(NOT MATIO_INCLUDE_DIR OR NOT MATIO_LIBRARY)
            message(FATAL_ERROR "cardan needs libmatio (Debian: libmatio-dev; elsewhere set MATIO_INCLUDE_DIR and "
                                "MATIO_LIBRARY).")
        endif()
        mark_as_advanced(MATIO_INCLUDE_DIR MATIO_LIBRARY)
        add_library(matio::matio UNKNOWN IMPORTED)
        set_target_properties(matio::matio PROPERTIES IMPORTED_LOCATION "${MATIO_LIBRARY}"
                                                      INTERFACE_INCLUDE_DIRECTORIES "${MATIO_INCLUDE_DIR}")
    endif()
endmacro()

macro(cardan_find_tbb)
    if(NOT TARGET TBB::tbb)
        find_package(TBB 2021 REQUIRED CONFIG COMPONENTS tbb)
    endif()
endmacro()

macro(cardan_find_urdfdom)
    if(NOT TARGET urdfdom::urdfdom_model)
        find_package(urdfdom REQUIRED CONFIG)
    endif()
endmacro()

# The package calls its target yaml-cpp up to version 0.7 and yaml-cpp::yaml-cpp from 0.8 on.
macro(cardan_find_yaml_cpp)
    if(NOT TARGET yaml_cpp::yaml_cpp)
        find_package(yaml-cpp 0.6 REQUIRED CONFIG)
        add_library(yaml_cpp::yaml_cpp INTERFACE IMPORTED)
        if(TARGET yaml-cpp::yaml-cpp)
            set_target_properties(yaml_cpp::yaml_cpp PROPERTIES INTERFACE_LINK_LIBRARIES yaml-cpp::yaml-cpp)
        else()
            set_target_properties(yaml_cpp::yaml_cpp PROPERTIES INTERFACE_LINK_LIBRARIES yaml-cpp)
        endif()
    endif()
endmacro()
