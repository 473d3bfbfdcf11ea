# Libraries, headers, data, documents, programs and the CMake package `cardan`.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/cardan)
get_property(libraries GLOBAL PROPERTY CARDAN_LIBRARIES)
get_property(CARDAN_COMPONENTS GLOBAL PROPERTY CARDAN_COMPONENTS)
set(CARDAN_NEEDS "")
foreach(component IN LISTS CARDAN_COMPONENTS)
    cardan_packages(packages cardan_${component})
    list(TRANSFORM packages TOLOWER)
    list(JOIN packages " " packages)
    string(APPEND CARDAN_NEEDS "set(_cardan_needs_${component} ${packages})\n")
endforeach()

install(TARGETS ${libraries} EXPORT cardanTargets)
install(EXPORT cardanTargets NAMESPACE cardan:: DESTINATION ${package_dir})

if(CARDAN_BUILD_EXAMPLES)
    install(TARGETS cardan)
    get_property(manual GLOBAL PROPERTY CARDAN_MANUAL)
    install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
    install(FILES ${PROJECT_SOURCE_DIR}/programs/cardan/completion.bash
            DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME cardan)
endif()

# All headers but those in detail/ and registers/, which are the inside of the libraries.
install(DIRECTORY mbs elements turbines solvers DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/cardan
        FILES_MATCHING PATTERN "*.hpp" PATTERN "detail" EXCLUDE PATTERN "registers" EXCLUDE PATTERN "data" EXCLUDE)
foreach(component IN LISTS CARDAN_COMPONENTS)
    install(FILES ${PROJECT_BINARY_DIR}/generated/include/cardan/${component}.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/cardan)
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/generated/mbs/base/version.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/cardan/mbs/base)

file(GLOB data CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/turbines/data/*.csv)
install(FILES ${data} DESTINATION ${CMAKE_INSTALL_DATADIR}/cardan/data)

install(FILES README.md CONTRIBUTING.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright) # as Debian calls it
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN reference EXCLUDE)

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/cardanConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/cardanConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cardanConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/cardanConfig.cmake ${PROJECT_BINARY_DIR}/cardanConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/cardanDependencies.cmake DESTINATION ${package_dir})
