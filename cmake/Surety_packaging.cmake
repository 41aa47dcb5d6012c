# SPDX-License-Identifier: GPL-3.0-or-later
#
# `cpack` in the build folder makes a Debian package of what is installed: the command line, its
# manual page and completion, the headers, the CMake package and the manual.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME surety)
set(CPACK_PACKAGE_VENDOR "The Surety developers")
set(CPACK_PACKAGE_CONTACT "The Surety developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGE_DESCRIPTION
  "Simplifies and remeshes triangle meshes, and proves that every point of the result
lies within a tolerance of the input and every point of the input within it of the
result. With a command line and a header-only C++17 library for CGAL.")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES TRUE)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${CPACK_PACKAGE_CONTACT}")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# Who uses the command line only can do without what the headers need.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libcgal-dev (>= 5.5), libeigen3-dev (>= 3.3)")
find_program(SURETY_SHLIBDEPS dpkg-shlibdeps)
mark_as_advanced(SURETY_SHLIBDEPS)
if(SURETY_SHLIBDEPS)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS TRUE)
endif()
include(CPack)
