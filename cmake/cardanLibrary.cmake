# A static library for each room of cmake/rooms.cmake, linked as that table says, and the components that users name: groups
# of rooms.

# A library's sources need nothing that those before it make: all are compiled side by side.
set(CMAKE_OPTIMIZE_DEPENDENCIES ON)

# What the names behind USES stand for. Without a line: headers only.
set(links_dl ${CMAKE_DL_LIBS})
list(TRANSFORM CARDAN_SUNDIALS_COMPONENTS PREPEND SUNDIALS:: OUTPUT_VARIABLE links_sundials)
set(links_hdf5 hdf5::hdf5_hl hdf5::hdf5)
set(links_matio matio::matio)
set(links_libyaml libyaml::libyaml)
set(links_tbb TBB::tbb)
set(links_urdfdom urdfdom::urdfdom_model)
set(links_boost $<BUILD_INTERFACE:Boost::headers>)

# cardan_precompile(<target>): headers that most sources include are compiled once, with mbs/base, and taken from there.
# Sources do not rely on it: the preset debug is made without.
function(cardan_precompile target)
    if(NOT CARDAN_PRECOMPILE_HEADERS)
        return()
    endif()
    if(NOT target STREQUAL "cardan_mbs_base")
        target_precompile_headers(${target} REUSE_FROM cardan_mbs_base)
        return()
    endif()
    target_precompile_headers(
        ${target}
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

# cardan_export(<target> <PUBLIC|INTERFACE>): it has a name for users, cardan::<name>, and finds its headers: as
# <cardan/<folder>/<room>/<file>.hpp>, from include/ installed or from links in generated/include; sources and tests of our
# own write "<folder>/<room>/<file>.hpp".
function(cardan_export target scope)
    string(REGEX REPLACE "^cardan_" "" name ${target})
    add_library(cardan::${name} ALIAS ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} CXX_EXTENSIONS OFF)
    target_compile_features(${target} ${scope} cxx_std_20)
    target_include_directories(
        ${target} ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>
        $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated/include>
        $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/cardan> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    set_property(GLOBAL APPEND PROPERTY CARDAN_LIBRARIES ${target})
endfunction()

# room(<folder> [SEES <rooms>] [USES <libraries>]), as in cmake/rooms.cmake: the library cardan_<folder>, with _ for /, of
# the room's sources. Those of programs/ and examples/ are no libraries.
function(room folder)
    if(folder MATCHES "^(programs|examples)")
        return()
    endif()
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SEES;USES")
    string(REPLACE "/" "_" target cardan_${folder})
    list(TRANSFORM arg_SEES REPLACE "/" "_")
    list(TRANSFORM arg_SEES PREPEND cardan_)
    set(folder ${PROJECT_SOURCE_DIR}/${folder})
    file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp ${folder}/detail/*.cpp)
    add_library(${target} STATIC ${sources})
    file(RELATIVE_PATH room ${PROJECT_SOURCE_DIR} ${folder})
    set_target_properties(${target} PROPERTIES CARDAN_ROOM ${room})
    target_link_libraries(${target} PUBLIC ${arg_SEES} PRIVATE $<BUILD_INTERFACE:cardan_warnings>)
    foreach(library IN LISTS arg_USES)
        target_link_libraries(${target} PRIVATE ${links_${library}})
    endforeach()
    cardan_export(${target} PUBLIC)
    cardan_precompile(${target})
endfunction()

# library(...), as in cmake/rooms.cmake: for the test `layering` only.
function(library)
endfunction()

# cardan_rooms(<out> <target>): the folders of the rooms that a target stands for, those that others see first.
function(cardan_rooms out target)
    set(rooms "")
    get_target_property(links ${target} INTERFACE_LINK_LIBRARIES)
    foreach(link IN LISTS links)
        if(link MATCHES "^cardan_[a-z0-9_]+$")
            cardan_rooms(further ${link})
            list(APPEND rooms ${further})
        endif()
    endforeach()
    get_target_property(own ${target} CARDAN_ROOM)
    if(own)
        list(APPEND rooms ${own})
    endif()
    list(REMOVE_DUPLICATES rooms)
    set(${out} ${rooms} PARENT_SCOPE)
endfunction()

# cardan_component_header(<name>): <cardan/<name>.hpp>, all public headers of a component's rooms but of those that
# components before it have.
function(cardan_component_header name)
    set(CARDAN_HEADERS "")
    cardan_rooms(rooms cardan_${name})
    get_property(before GLOBAL PROPERTY CARDAN_ROOMS_WITH_HEADER)
    foreach(room IN LISTS rooms)
        if(room IN_LIST before)
            continue()
        endif()
        set_property(GLOBAL APPEND PROPERTY CARDAN_ROOMS_WITH_HEADER ${room})
        foreach(root IN ITEMS ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/generated)
            file(GLOB headers CONFIGURE_DEPENDS RELATIVE ${root} ${root}/${room}/*.hpp)
            foreach(header IN LISTS headers)
                string(APPEND CARDAN_HEADERS "#include \"${header}\"\n")
            endforeach()
        endforeach()
    endforeach()
    configure_file(${PROJECT_SOURCE_DIR}/cmake/component.hpp.in ${PROJECT_BINARY_DIR}/generated/include/cardan/${name}.hpp @ONLY)
endfunction()

# cardan_component(<name> <rooms>...): what users name; cardan::<name> stands for the rooms and those they see, and
# <cardan/<name>.hpp> for its headers.
function(cardan_component name)
    set(target cardan_${name})
    list(TRANSFORM ARGN REPLACE "/" "_")
    list(TRANSFORM ARGN PREPEND cardan_)
    add_library(${target} INTERFACE)
    target_link_libraries(${target} INTERFACE ${ARGN})
    cardan_export(${target} INTERFACE)
    set_property(GLOBAL APPEND PROPERTY CARDAN_COMPONENTS ${name})
    cardan_component_header(${name})
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
