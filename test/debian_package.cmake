# SPDX-License-Identifier: GPL-3.0-or-later
#
# Makes the Debian package, unpacks it, and uses what is in it:
#   cmake -D BUILD=<build folder> -D WORK=<folder> -P debian_package.cmake
file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

get_filename_component(bin "${CMAKE_COMMAND}" DIRECTORY)
run("${bin}/cpack" -G DEB --config "${BUILD}/CPackConfig.cmake" -B "${WORK}")
file(GLOB package "${WORK}/surety_*.deb")
run(dpkg-deb --info ${package})
run(dpkg-deb -x ${package} "${WORK}/root")

run("${WORK}/root/usr/bin/surety" --help)
foreach(file IN ITEMS
    usr/include/surety/surety.h usr/share/doc/surety/LICENSE
    usr/share/doc/surety/doc/manual/guarantees.md usr/share/man/man1/surety.1
    usr/share/bash-completion/completions/surety)
  if(NOT EXISTS "${WORK}/root/${file}")
    message(FATAL_ERROR "The package has no ${file}")
  endif()
endforeach()
file(GLOB_RECURSE config "${WORK}/root/usr/lib/*/surety-config.cmake")
if(NOT config)
  message(FATAL_ERROR "The package has no surety-config.cmake")
endif()
