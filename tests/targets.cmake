cmake_minimum_required(VERSION 3.25)

# Fails when the table of docs/dependencies.md has other targets than the build, or they stand on something else, and when a
# document names a target that does not exist.
#
# targets: lines "<name>: <packages>", as the build has them
set(violations "")

# As the table calls what cardan_packages() finds.
set(packages Eigen3 hdf5 libyaml matio SUNDIALS TBB urdfdom)
set(words Eigen HDF5 libyaml libmatio SUNDIALS oneTBB urdfdom)

set(built "")
file(STRINGS ${targets} lines)
foreach(line IN LISTS lines)
    string(REGEX MATCH "^([a-z0-9_]+): (.*)$" found "${line}")
    set(name ${CMAKE_MATCH_1})
    string(REPLACE " " ";" needs "${CMAKE_MATCH_2}")
    foreach(package word IN ZIP_LISTS packages words)
        list(TRANSFORM needs REPLACE "^${package}$" ${word})
    endforeach()
    list(JOIN needs ", " needs_${name})
    list(APPEND built ${name})
endforeach()

set(table "")
file(STRINGS ${source_dir}/docs/dependencies.md rows REGEX "^\\| `cardan::[a-z0-9_]+` \\|")
foreach(row IN LISTS rows)
    string(REGEX MATCH "^\\| `cardan::([a-z0-9_]+)` \\| (.*) \\| (.*) \\|$" found "${row}")
    set(name ${CMAKE_MATCH_1})
    list(APPEND table ${name})
    if(name IN_LIST built)
        if(NOT CMAKE_MATCH_3 STREQUAL needs_${name})
            string(APPEND violations "\n  docs/dependencies.md: cardan::${name} needs '${CMAKE_MATCH_3}'; it is '${needs_${name}}'")
        endif()
    else()
        string(APPEND violations "\n  docs/dependencies.md: there is no target cardan::${name}")
    endif()
endforeach()
foreach(name IN LISTS built)
    if(NOT name IN_LIST table)
        string(APPEND violations "\n  docs/dependencies.md: no row of the target cardan::${name}")
    endif()
endforeach()

# Where documents mean a target rather than what is in the namespace: `cardan::name`, behind an #include, in CMake.
file(GLOB documents RELATIVE ${source_dir} ${source_dir}/*.md ${source_dir}/docs/*.md)
list(REMOVE_ITEM documents CHANGELOG.md) # what was
foreach(document IN LISTS documents)
    file(STRINGS ${source_dir}/${document} lines
         REGEX "`cardan::[a-z0-9_]+`|#include.*// *cardan::|target_link_libraries|find_package\\(cardan")
    foreach(line IN LISTS lines)
        string(REGEX MATCHALL "cardan::[a-z0-9_]+" names "${line}")
        if(line MATCHES "COMPONENTS ([a-z0-9_ ]+)\\)")
            string(REPLACE " " ";" components "${CMAKE_MATCH_1}")
            list(APPEND names ${components})
        endif()
        list(TRANSFORM names REPLACE "^cardan::" "")
        foreach(name IN LISTS names)
            if(NOT name IN_LIST table)
                string(APPEND violations "\n  ${document}: there is no target cardan::${name}")
            endif()
        endforeach()
    endforeach()
endforeach()

if(violations)
    message(FATAL_ERROR "targets and documents differ:${violations}")
endif()
list(LENGTH built count)
message(STATUS "targets: the documents have all ${count} that are built")
