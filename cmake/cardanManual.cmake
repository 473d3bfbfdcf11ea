# Manual pages of `cardan` and its commands, made from what --help says, where help2man is found.
find_program(CARDAN_HELP2MAN help2man)
if(NOT CARDAN_HELP2MAN)
    message(STATUS "manual pages: none, help2man was not found")
    return()
endif()

# help2man takes the name of a page from that of the program: a script of that name calls the command.
function(cardan_manual_page name arguments about)
    set(script ${CMAKE_CURRENT_BINARY_DIR}/manual/${name})
    set(page ${script}.1)
    file(CONFIGURE OUTPUT ${script} CONTENT "#!/bin/sh\nexec ${CMAKE_CURRENT_BINARY_DIR}/cardan ${arguments} \"$@\"\n" @ONLY)
    file(CHMOD ${script} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
    add_custom_command(
        OUTPUT ${page}
        COMMAND ${CARDAN_HELP2MAN} --no-info --no-discard-stderr --section=1 "--name=${about}"
                "--version-string=${PROJECT_VERSION}" "--source=Cardan ${PROJECT_VERSION}" --manual=Cardan
                --output=${page} ${script}
        DEPENDS cardan
        COMMENT "Manual page ${name}.1"
        VERBATIM)
    set_property(GLOBAL APPEND PROPERTY CARDAN_MANUAL ${page})
endfunction()

# The commands and what they are for stand in the program's own table.
cardan_manual_page(cardan "" "wind turbines as multibody systems")
set(table ${CMAKE_CURRENT_SOURCE_DIR}/cardan.cpp)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${table})
file(STRINGS ${table} rows REGEX "^    Command{\"")
foreach(row IN LISTS rows)
    string(REGEX MATCH "^    Command{\"([a-z]+)\", \"([^\"]*)\"" command "${row}")
    cardan_manual_page(cardan-${CMAKE_MATCH_1} ${CMAKE_MATCH_1} "${CMAKE_MATCH_2}")
endforeach()

get_property(manual GLOBAL PROPERTY CARDAN_MANUAL)
add_custom_target(manual ALL DEPENDS ${manual})
