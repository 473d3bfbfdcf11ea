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

cardan_manual_page(cardan "" "wind turbines as multibody systems")
cardan_manual_page(cardan-campbell campbell "Campbell diagram of any machine")
cardan_manual_page(cardan-modes modes "modes of any machine at one rotor speed")
cardan_manual_page(cardan-steady steady "steady state of any machine")
cardan_manual_page(cardan-simulate simulate "motion of any machine in time")
cardan_manual_page(cardan-linearise linearise "linear model of any machine")
cardan_manual_page(cardan-convert convert "machines and time histories in other formats")
cardan_manual_page(cardan-plot plot "pictures of results")
cardan_manual_page(cardan-info info "what is in a machine or a result")
cardan_manual_page(cardan-repair repair "time histories whose writer was killed")
cardan_manual_page(cardan-repeat repeat "a result once more from its file")

get_property(manual GLOBAL PROPERTY CARDAN_MANUAL)
add_custom_target(manual ALL DEPENDS ${manual})
