# SPDX-License-Identifier: GPL-3.0-or-later
#
# The target doc makes the manual and the reference as HTML in doc/html of the build folder, and
# fails if a public entity is not documented or a link leads nowhere.
find_package(Doxygen QUIET)
find_package(Python3 QUIET COMPONENTS Interpreter)
set(surety_doc_dir "${PROJECT_BINARY_DIR}/doc")
configure_file("${PROJECT_SOURCE_DIR}/doc/Doxyfile.in" "${PROJECT_BINARY_DIR}/Doxyfile" @ONLY)
if(NOT DOXYGEN_FOUND OR NOT Python3_FOUND)
  message(STATUS "Doxygen or Python is missing: the target doc is left out")
  return()
endif()
add_custom_target(doc
  COMMAND "${CMAKE_COMMAND}" -E make_directory "${surety_doc_dir}"
  COMMAND Doxygen::doxygen "${PROJECT_BINARY_DIR}/Doxyfile"
  COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/doc/check_links.py" "${surety_doc_dir}/html"
  COMMENT "Making the manual" VERBATIM)
