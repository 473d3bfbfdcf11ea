# What some rooms have beside their sources and what cmake/rooms.cmake says of them.

# The alignment of Eigen's fixed-size types and who frees its arrays are part of the binary interface: the same whatever
# -m flags a consumer has, and with the address sanitizer, which makes Eigen change to an allocator of its own.
target_link_libraries(cardan_mbs_base PUBLIC Eigen3::Eigen)
target_compile_definitions(cardan_mbs_base PUBLIC EIGEN_MAX_ALIGN_BYTES=16)
if(CMAKE_SYSTEM_NAME STREQUAL "Linux" AND CMAKE_SIZEOF_VOID_P EQUAL 8)
    target_compile_definitions(cardan_mbs_base PUBLIC EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()
if(CARDAN_EIGEN_MALLOC_CHECKS)
    target_compile_definitions(cardan_mbs_base PUBLIC $<BUILD_INTERFACE:EIGEN_RUNTIME_NO_MALLOC>)
endif()

# Loops of these call the C library's vector functions, which set no errno; of the inductions both sides of a condition may
# be computed. Precompiled headers are made without these flags.
set(vectors -fno-math-errno -fno-trapping-math)
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_SYSTEM_NAME STREQUAL "Linux" AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
    list(APPEND vectors -fveclib=libmvec)
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    set_source_files_properties(
        ${PROJECT_SOURCE_DIR}/mbs/base/elementary.cpp ${PROJECT_SOURCE_DIR}/elements/aerodynamics/inductions.cpp
        PROPERTIES COMPILE_OPTIONS "${vectors}" SKIP_PRECOMPILE_HEADERS ON)
endif()

# The tables of turbines/data become part of the library, so that a program needs no path to find them.
file(GLOB tables CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/turbines/data/*.csv)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${tables})
set(CARDAN_EMBEDDED_TABLES "")
foreach(table IN LISTS tables)
    get_filename_component(table_name ${table} NAME)
    file(READ ${table} table_text)
    string(APPEND CARDAN_EMBEDDED_TABLES "    Table{\"${table_name}\", R\"cardan_csv(${table_text})cardan_csv\"},\n")
endforeach()
list(LENGTH tables CARDAN_EMBEDDED_COUNT)
set(embedded ${PROJECT_BINARY_DIR}/generated/turbines/tables/detail/embedded_data.cpp)
configure_file(${PROJECT_SOURCE_DIR}/cmake/embedded_data.cpp.in ${embedded} @ONLY)
target_sources(cardan_turbines_tables PRIVATE ${embedded})
