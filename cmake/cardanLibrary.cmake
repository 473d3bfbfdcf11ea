# cardan_precompile(<target>): headers that most sources include are compiled once, with cardan_mbs, and taken from there.
# Sources do not rely on it: the presets thread and debug are made without.
function(cardan_precompile target)
    if(NOT CARDAN_PRECOMPILE_HEADERS)
        return()
    endif()
    if(NOT target STREQUAL "cardan_mbs")
        target_precompile_headers(${target} REUSE_FROM cardan_mbs)
        return()
    endif()
    target_precompile_headers(
        cardan_mbs
        PRIVATE
        <algorithm>
        <array>
        <cmath>
        <filesystem>
        <functional>
        <iostream>
        <limits>
        <optional>
        <span>
        <string>
        <vector>
        ${PROJECT_SOURCE_DIR}/mbs/base/decompositions.hpp
        ${PROJECT_SOURCE_DIR}/mbs/base/error.hpp
        ${PROJECT_SOURCE_DIR}/mbs/system/channel.hpp
        ${PROJECT_SOURCE_DIR}/mbs/system/system.hpp)
endfunction()

# cardan_link_headers(<from> <to> <folders>...): what is in <from>/<folder> is also <to>/cardan/<folder>, as installed.
function(cardan_link_headers from to)
    file(MAKE_DIRECTORY ${to}/cardan)
    foreach(folder IN LISTS ARGN)
        file(CREATE_LINK ${from}/${folder} ${to}/cardan/${folder} SYMBOLIC)
    endforeach()
endfunction()

# cardan_rooms(<out> <room>...): the sources of rooms, which are folders below the current one; detail/ is what is inside.
function(cardan_rooms out)
    set(sources "")
    foreach(room IN LISTS ARGN)
        file(GLOB found CONFIGURE_DEPENDS ${room}/*.cpp ${room}/detail/*.cpp)
        list(APPEND sources ${found})
    endforeach()
    set(${out} ${sources} PARENT_SCOPE)
endfunction()

# cardan_add_library(<name> [ROOMS <folders>] [WITHOUT <files>] [SOURCES <files>] [PUBLIC <targets>]
#                    [PRIVATE <targets>])
#
# Makes the target cardan_<name>, alias and export name cardan::<name>, of all sources of its rooms, those of WITHOUT left
# out, and of SOURCES. Without any it is a name for several libraries. Users include headers as
# <cardan/<folder>/<room>/<file>.hpp>, from include/ installed or from links in generated/include; sources and tests of our
# own as "<folder>/<room>/<file>.hpp".
function(cardan_add_library name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "ROOMS;WITHOUT;SOURCES;PUBLIC;PRIVATE")
    set(target cardan_${name})
    cardan_rooms(sources ${arg_ROOMS})
    list(REMOVE_ITEM sources ${arg_WITHOUT})
    list(APPEND sources ${arg_SOURCES})
    if(sources)
        add_library(${target} ${sources})
        set(public PUBLIC)
        target_link_libraries(${target} PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:cardan_warnings>)
        cardan_precompile(${target})
    else()
        add_library(${target} INTERFACE)
        set(public INTERFACE)
    endif()
    add_library(cardan::${name} ALIAS ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} CXX_EXTENSIONS OFF)
    target_compile_features(${target} ${public} cxx_std_20)
    target_include_directories(
        ${target} ${public} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>
        $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated/include>
        $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/cardan> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_link_libraries(${target} ${public} ${arg_PUBLIC})
    set_property(GLOBAL APPEND PROPERTY CARDAN_LIBRARIES ${target})
endfunction()

# cardan_packages(<out> <target>): what a library and those that it links stand on, as Eigen3 and SUNDIALS, the names
# before :: of their targets. Not what only the build needs.
function(cardan_packages out target)
    set(packages "")
    get_target_property(links ${target} INTERFACE_LINK_LIBRARIES)
    foreach(link IN LISTS links)
        string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" link "${link}")
        if(link MATCHES "^cardan_[a-z0-9_]+$")
            cardan_packages(further ${link})
            list(APPEND packages ${further})
        elseif(link MATCHES "^([A-Za-z0-9]+)::")
            list(APPEND packages ${CMAKE_MATCH_1})
        endif()
    endforeach()
    list(REMOVE_DUPLICATES packages)
    list(SORT packages CASE INSENSITIVE)
    set(${out} ${packages} PARENT_SCOPE)
endfunction()

# cardan_add_program(<target> SOURCES <files> LINK <targets>): an executable of ours, with our warnings.
function(cardan_add_program target)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LINK")
    add_executable(${target} ${arg_SOURCES})
    set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
    target_link_libraries(${target} PRIVATE ${arg_LINK} cardan_warnings)
endfunction()
