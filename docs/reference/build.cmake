# Makes the reference, a static site that opens from file://.
#
# cmake -D version=<of the library> -D generated=<folder of generated headers> -D site=<made anew> -P build.cmake
cmake_minimum_required(VERSION 3.25)

set(here ${CMAKE_CURRENT_LIST_DIR})
cmake_path(GET here PARENT_PATH source)
cmake_path(GET source PARENT_PATH source)

find_program(doxygen doxygen)
find_program(dot dot)
find_program(python3 python3)
find_path(mathjax MathJax.js HINTS /usr/share/javascript/mathjax)
foreach(tool IN ITEMS doxygen dot python3 mathjax)
    if(NOT ${tool})
        message(FATAL_ERROR "The reference needs ${tool} (Debian: doxygen graphviz libjs-mathjax python3)")
    endif()
endforeach()

# What is read is put together in a tree of its own: documents, headers, and a word on every room.
set(tree ${site}.work/tree)
file(REMOVE_RECURSE ${site} ${tree})
file(MAKE_DIRECTORY ${site} ${tree})

# The documents, in the order in which README lists them.
set(documents README.md)
file(STRINGS ${source}/README.md rows REGEX "^\\| \\[[A-Za-z0-9_/]+\\.md\\]\\(")
foreach(row IN LISTS rows)
    string(REGEX MATCH "[A-Za-z0-9_/]+\\.md" document "${row}")
    list(APPEND documents ${document})
endforeach()
set(input "")
foreach(document IN LISTS documents)
    cmake_path(GET document FILENAME name)
    execute_process(COMMAND ${python3} ${here}/markdown.py ${source}/${document} OUTPUT_FILE ${tree}/${name}
                    COMMAND_ERROR_IS_FATAL ANY)
    string(APPEND input "${tree}/${name} ")
endforeach()
string(APPEND input ${tree})
file(GLOB all RELATIVE ${source} ${source}/docs/*.md)
list(REMOVE_ITEM all ${documents})
if(all)
    message(FATAL_ERROR "README.md does not list ${all}")
endif()

foreach(folder IN ITEMS ${generated}/mbs ${source}/mbs ${source}/elements ${source}/solvers ${source}/turbines)
    file(COPY ${folder} DESTINATION ${tree} FILES_MATCHING PATTERN *.hpp PATTERN detail EXCLUDE PATTERN registers EXCLUDE)
endforeach()

file(STRINGS ${source}/cmake/rooms.cmake rows REGEX "^room\\((mbs|elements|solvers|turbines)/")
foreach(row IN LISTS rows)
    string(REGEX MATCH "^room\\(([a-z0-9_/]+).*\\) # (.*)$" row "${row}")
    set(room ${CMAKE_MATCH_1})
    string(REPLACE "/" "-" label ${room})
    file(APPEND ${tree}/rooms.dox "/** @dir ${tree}/${room}\n @brief ${CMAKE_MATCH_2}\n\n @anchor room-${label} */\n")
endforeach()

configure_file(${here}/Doxyfile.in ${site}.work/Doxyfile @ONLY)
execute_process(COMMAND ${doxygen} ${site}.work/Doxyfile RESULT_VARIABLE failed ERROR_VARIABLE warnings)
string(REPLACE "${tree}/" "" warnings "${warnings}")
if(failed)
    message(FATAL_ERROR "doxygen warns:\n${warnings}")
endif()

# The parts of MathJax that turn TeX into drawings.
foreach(part IN ITEMS MathJax.js extensions jax/element jax/input/TeX jax/output/SVG/jax.js jax/output/SVG/config.js
                      jax/output/SVG/autoload jax/output/SVG/fonts/TeX localization/en)
    cmake_path(GET part PARENT_PATH folder)
    file(COPY ${mathjax}/${part} DESTINATION ${site}/mathjax/${folder} FOLLOW_SYMLINK_CHAIN)
endforeach()
message(STATUS "${site}/index.html")
