# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installation of the headers, of the command line and of the package that find_package(surety)
# finds.
include(CMakePackageConfigHelpers)

set(surety_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/surety")

install(TARGETS surety EXPORT surety)
install(EXPORT surety NAMESPACE surety:: FILE surety-targets.cmake
  DESTINATION "${surety_package_dir}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/surety" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
  FILES_MATCHING PATTERN "*.h")
install(FILES
  "${PROJECT_SOURCE_DIR}/LICENSE"
  "${PROJECT_SOURCE_DIR}/README.md"
  "${PROJECT_SOURCE_DIR}/CHANGELOG.md"
  "${PROJECT_SOURCE_DIR}/CITATION.cff"
  DESTINATION "${CMAKE_INSTALL_DOCDIR}")
# As the README's links have it.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/doc/manual" "${PROJECT_SOURCE_DIR}/doc/examples"
  DESTINATION "${CMAKE_INSTALL_DOCDIR}/doc" PATTERN "CMakeLists.txt" EXCLUDE)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/doc/figures" DESTINATION "${CMAKE_INSTALL_DOCDIR}/doc"
  FILES_MATCHING PATTERN "*.png")
# Where the target doc has been built.
install(DIRECTORY "${PROJECT_BINARY_DIR}/doc/html" DESTINATION "${CMAKE_INSTALL_DOCDIR}" OPTIONAL)
if(SURETY_BUILD_TOOLS)
  install(TARGETS surety_tool RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  if(NOT CMAKE_CROSSCOMPILING)
    install(FILES "${PROJECT_BINARY_DIR}/surety.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
    install(FILES "${PROJECT_BINARY_DIR}/surety.bash"
      DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" RENAME surety)
  endif()
endif()

configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/surety-config.cmake.in"
  "${PROJECT_BINARY_DIR}/surety-config.cmake"
  INSTALL_DESTINATION "${surety_package_dir}")
write_basic_package_version_file(
  "${PROJECT_BINARY_DIR}/surety-config-version.cmake"
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES
  "${PROJECT_BINARY_DIR}/surety-config.cmake"
  "${PROJECT_BINARY_DIR}/surety-config-version.cmake"
  DESTINATION "${surety_package_dir}")
