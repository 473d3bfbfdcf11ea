# Libraries, headers, data, programs and the CMake package `cardan`.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/cardan)
get_property(libraries GLOBAL PROPERTY CARDAN_LIBRARIES)
list(TRANSFORM libraries REPLACE "^cardan_" "" OUTPUT_VARIABLE CARDAN_COMPONENTS)

install(TARGETS ${libraries} EXPORT cardanTargets)
get_property(programs GLOBAL PROPERTY CARDAN_PROGRAMS)
if(programs)
    install(TARGETS ${programs})
endif()
install(EXPORT cardanTargets NAMESPACE cardan:: DESTINATION ${package_dir})

foreach(folder IN ITEMS mbs elements turbines solvers)
    file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.hpp)
    # Inside of the libraries: most of these need headers of HDF5, urdfdom or yaml-cpp.
    list(FILTER headers EXCLUDE REGEX "(assembler|description_yaml_(fields|node|tree)|windio_beams|hdf5_(checks|driver|impl|storage|structure|text|journal|journal_driver|history_(impl|writer))|urdf_(impl|plan|vocabulary)|newton_matrix|plot_campbell_style|shifted_schur|state_space_impl|stepper(_sundials)?|sundials_memory)[.]hpp$")
    install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/cardan/${folder})
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/generated/mbs/version.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/cardan/mbs)

file(GLOB data CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/turbines/data/*.csv)
install(FILES ${data} DESTINATION ${CMAKE_INSTALL_DATADIR}/cardan/data)

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/cardanConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/cardanConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cardanConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/cardanConfig.cmake ${PROJECT_BINARY_DIR}/cardanConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/cardanDependencies.cmake DESTINATION ${package_dir})
