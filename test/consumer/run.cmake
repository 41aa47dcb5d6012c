# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs the library into an empty folder, and builds and runs the consumer against it:
#   cmake -D BUILD=<build folder> -D WORK=<folder> -D GENERATOR=<name> -P run.cmake
file(REMOVE_RECURSE "${WORK}")

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/installed")
run("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}" -B "${WORK}/build" -G "${GENERATOR}"
  "-DCMAKE_PREFIX_PATH=${WORK}/installed" -DCMAKE_BUILD_TYPE=Debug
  "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}")
run("${CMAKE_COMMAND}" --build "${WORK}/build")
run("${WORK}/build/consumer")
if(EXISTS "${WORK}/installed/bin/surety")
  run("${WORK}/installed/bin/surety" --version)
endif()
