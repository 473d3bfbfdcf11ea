# `cpack` in the build folder makes one Debian package of all that is installed; .ci/package tries it on a clean Debian.
set(CPACK_GENERATOR DEB)
# The form that Debian asks for; who distributes the package gives an address: cpack -D CPACK_PACKAGE_CONTACT="... <...>".
set(CPACK_PACKAGE_CONTACT "The Cardan authors <cardan@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT) # cardan_<version>_<architecture>.deb
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "Library, CMake package and programs for the dynamics of wind turbines and other
slender rotating machines: trees of rigid bodies on springs, cardanic joint beam
elements, Campbell diagrams, Floquet theory, linear models, motion in time.
Models of OpenFAST and windIO are read as they are.")

# Shared libraries that the programs need, and what find_package(cardan) looks for (cardanDependencies.cmake).
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS
    "libeigen3-dev (>= 3.4), libsundials-dev (>= 6), libhdf5-dev, libmatio-dev, libtbb-dev (>= 2021), libyaml-dev, liburdfdom-dev"
)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS gnuplot-nox) # pictures
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, cmake (>= 3.25)")

# The folders that the package makes are anybody's to read, whatever the umask.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)
include(CPack)
