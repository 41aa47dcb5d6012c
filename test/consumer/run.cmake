# SPDX-License-Identifier: GPL-3.0-or-later
#
# Builds and runs the consumer against the library installed into an empty folder, with the CGAL that
# CMake finds by itself and with each of CGAL_DIRS, and against the source tree as a part of its
# build:
#   cmake -D BUILD=<build folder> -D SOURCE=<source folder> -D WORK=<folder> -D GENERATOR=<name>
#     [-D CGAL_DIRS=<folder with CGALConfig.cmake>[;...]] [-D LAUNCHER=<program>] -P run.cmake
file(REMOVE_RECURSE "${WORK}")

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Further arguments go to CMake.
function(run_consumer folder)
  run("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}" -B "${WORK}/${folder}" -G "${GENERATOR}"
    -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}" ${ARGN})
  run("${CMAKE_COMMAND}" --build "${WORK}/${folder}")
  run("${WORK}/${folder}/consumer")
endfunction()

set(installed "-DCMAKE_PREFIX_PATH=${WORK}/installed")
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/installed")
run_consumer(with_system_cgal ${installed})
set(number 0)
foreach(dir IN LISTS CGAL_DIRS)
  math(EXPR number "${number} + 1")
  run_consumer(with_cgal_${number} ${installed} "-DCGAL_DIR=${dir}")
endforeach()
run_consumer(in_one_build "-DSURETY_SOURCE_DIR=${SOURCE}")

if(EXISTS "${WORK}/installed/bin/surety")
  run("${WORK}/installed/bin/surety" --version)
endif()
