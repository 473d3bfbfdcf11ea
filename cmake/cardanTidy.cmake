# What clang-tidy reads. Most of its time goes into walking through the declarations of Eigen and the standard library, once
# for every source it is given: it is given few and large ones, across targets. Preset tidy; nothing here is compiled.

# cardan_tidy(<target> <targets>...): an object library that stands in the list of compile commands in their place. Packages
# were found in the folders that use them, so that their headers are looked for by folder here.
function(cardan_tidy tidy)
    add_library(${tidy} OBJECT EXCLUDE_FROM_ALL)
    set_target_properties(${tidy} PROPERTIES CXX_EXTENSIONS OFF)
    target_link_libraries(${tidy} PRIVATE cardan::mbs cardan_warnings)
    foreach(target IN LISTS ARGN)
        target_compile_definitions(${tidy} PRIVATE $<TARGET_PROPERTY:${target},COMPILE_DEFINITIONS>)
        target_include_directories(${tidy} PRIVATE $<TARGET_PROPERTY:${target},INCLUDE_DIRECTORIES>)
        set_target_properties(${target} PROPERTIES EXPORT_COMPILE_COMMANDS OFF)
    endforeach()
endfunction()

# cardan_absolute_sources(<out> <target>)
function(cardan_absolute_sources out target)
    get_target_property(sources ${target} SOURCES)
    get_target_property(folder ${target} SOURCE_DIR)
    list(FILTER sources INCLUDE REGEX "\\.cpp$")
    list(TRANSFORM sources REPLACE "^([^/])" "${folder}/\\1")
    set(${out} ${sources} PARENT_SCOPE)
endfunction()

# cardan_in_namespaces(<file> <programs>...): a source of all of theirs, each in a namespace of the program's name, since
# each has a main(). What they include comes before, so that the same lines within find nothing left to include.
function(cardan_in_namespaces file)
    set(includes "")
    set(bodies "")
    foreach(program IN LISTS ARGN)
        cardan_absolute_sources(source ${program})
        file(STRINGS ${source} lines REGEX "^#include ")
        list(APPEND includes ${lines})
        string(APPEND bodies "namespace ${program}_program {\n#include \"${source}\"\n}\n")
    endforeach()
    list(REMOVE_DUPLICATES includes)
    list(JOIN includes "\n" includes)
    file(CONFIGURE OUTPUT ${file} CONTENT "${includes}\n${bodies}" @ONLY)
endfunction()

# cardan_targets(<out> <folder> <type>): the targets of this type that a folder makes.
function(cardan_targets out folder type)
    get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
    set(found "")
    foreach(target IN LISTS targets)
        get_target_property(its_type ${target} TYPE)
        if(its_type STREQUAL type)
            list(APPEND found ${target})
        endif()
    endforeach()
    set(${out} ${found} PARENT_SCOPE)
endfunction()

# cardan_tidy_programs(<tidy> <folder>): of the programs of a folder. Those of several sources stay as they are, and those
# that open namespace cardan, which would be another one in there.
function(cardan_tidy_programs tidy folder)
    cardan_targets(targets ${folder} EXECUTABLE)
    set(programs "")
    foreach(target IN LISTS targets)
        cardan_absolute_sources(sources ${target})
        list(LENGTH sources count)
        list(GET sources 0 main)
        file(STRINGS ${main} opens REGEX "^namespace cardan")
        if(count EQUAL 1 AND NOT opens)
            list(APPEND programs ${target})
        endif()
    endforeach()
    cardan_tidy(${tidy} ${programs})
    set_target_properties(${tidy} PROPERTIES UNITY_BUILD OFF)
    target_compile_options(${tidy} PRIVATE -Wno-return-type)  # here main() is a function like others
    while(programs)
        list(SUBLIST programs 0 15 some)
        list(REMOVE_ITEM programs ${some})
        list(GET some 0 first)
        set(file ${PROJECT_BINARY_DIR}/tidy/${folder}_from_${first}.cpp)
        cardan_in_namespaces(${file} ${some})
        target_sources(${tidy} PRIVATE ${file})
    endwhile()
endfunction()

# cardan_tidy_libraries(<tidy> <folder> [<targets>...]): of the libraries of a folder without these.
function(cardan_tidy_libraries tidy folder)
    cardan_targets(libraries ${folder} STATIC_LIBRARY)
    list(REMOVE_ITEM libraries ${ARGN})
    cardan_tidy(${tidy} ${libraries})
    foreach(library IN LISTS libraries)
        cardan_absolute_sources(sources ${library})
        target_sources(${tidy} PRIVATE ${sources})
    endforeach()
    target_compile_options(${tidy} PRIVATE -Wno-shadow)  # of names in other sources
    set_target_properties(${tidy} PROPERTIES UNITY_BUILD_BATCH_SIZE 60)
endfunction()

cardan_tidy_libraries(tidy_mbs mbs)
cardan_tidy_libraries(tidy_elements elements)
cardan_tidy_libraries(tidy_turbines turbines)
# What writes files and pictures has helpers of the same names in every room.
cardan_tidy_libraries(tidy_solvers solvers cardan_hdf5 cardan_hdf5_models cardan_matlab cardan_pictures)
cardan_tidy_programs(tidy_programs examples)
if(TARGET bench_kernels)
    cardan_tidy_programs(tidy_benchmarks bench)
endif()
