# SPDX-License-Identifier: GPL-3.0-or-later
#
# What all targets of this project share and no user of the library should inherit: warnings,
# sanitizers and a precompiled header, since CGAL's kernel alone takes seconds to parse. Also the
# meshes of Debian's libcgal-demo, which the tests, the examples and the benchmarks read.

add_library(surety_options INTERFACE)
target_compile_options(surety_options INTERFACE
  "$<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall;-Wextra;-Wpedantic>")
if(SURETY_SANITIZE)
  target_compile_options(surety_options INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(surety_options INTERFACE -fsanitize=address,undefined)
endif()

# One precompiled header, built once and reused by every program that asks for it. It is never
# part of the library: each header must compile on its own.
add_library(surety_precompiled STATIC EXCLUDE_FROM_ALL "${CMAKE_CURRENT_LIST_DIR}/precompiled.cpp")
target_link_libraries(surety_precompiled PUBLIC surety::surety PRIVATE surety_options)
target_precompile_headers(surety_precompiled PRIVATE
  <CGAL/Exact_predicates_inexact_constructions_kernel.h>
  <CGAL/Surface_mesh.h>
  <array>
  <string>
  <vector>)

# Links a program or library of this project with the library, its options and the precompiled
# header.
function(surety_target target)
  target_link_libraries(${target} PRIVATE surety::surety surety_options)
  target_precompile_headers(${target} REUSE_FROM surety_precompiled)
endfunction()

# The meshes of libcgal-demo: unpacked once into the build folder. SURETY_DATA_DIR may name a
# folder of meshes instead.
set(SURETY_DATA_DIR "" CACHE PATH "Folder of the meshes of libcgal-demo (unpacked when empty)")
set(SURETY_DATA_ARCHIVE /usr/share/doc/libcgal-dev/data.tar.gz CACHE FILEPATH
  "The archive of meshes of libcgal-demo")
set(surety_data_dir "${SURETY_DATA_DIR}")
if(NOT surety_data_dir AND EXISTS "${SURETY_DATA_ARCHIVE}")
  set(surety_data_dir "${PROJECT_BINARY_DIR}/data/meshes")
  if(NOT EXISTS "${surety_data_dir}/bunny00.off")
    message(STATUS "Unpacking ${SURETY_DATA_ARCHIVE}")
    file(ARCHIVE_EXTRACT INPUT "${SURETY_DATA_ARCHIVE}" DESTINATION "${PROJECT_BINARY_DIR}"
      PATTERNS "data/meshes/*")
  endif()
endif()
if(NOT surety_data_dir)
  message(STATUS "No meshes of libcgal-demo: tests that need them are skipped")
endif()
