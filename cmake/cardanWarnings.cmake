# cardan_warnings: linked PRIVATE by our own targets, never exported.
add_library(cardan_warnings INTERFACE)

if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    target_compile_options(cardan_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
    # clang counts sign conversions among -Wconversion, GCC does not; Eigen indices are signed, sizes of std are not.
    target_compile_options(cardan_warnings INTERFACE $<$<CXX_COMPILER_ID:Clang,AppleClang>:-Wno-sign-conversion>)
    if(CARDAN_WARNINGS_AS_ERRORS)
        target_compile_options(cardan_warnings INTERFACE -Werror)
    endif()
endif()
# GCC takes a joined source for a header, where a class with members of types from an anonymous namespace is a mistake.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(cardan_warnings INTERFACE -Wno-subobject-linkage)
endif()
