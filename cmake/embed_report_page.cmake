# SPDX-License-Identifier: GPL-3.0-or-later
#
# Writes a C++ source with the parts of the HTML report, byte by byte: of all compilers, not one
# takes literals of a megabyte.
#
#   cmake -D PAGE=folder -D VIEWER=three.min.js -D CONTROLS=OrbitControls.js -D OUTPUT=source.cpp
#         -P embed_report_page.cmake
#
# Without VIEWER and CONTROLS the source says that there is no page.
set(parts page "${PAGE}/page.html" style "${PAGE}/page.css" script "${PAGE}/page.js")
if(VIEWER AND CONTROLS)
  list(APPEND parts viewer "${VIEWER}" controls "${CONTROLS}")
endif()

set(text "// Made by embed_report_page.cmake.\n#include \"report_page.h\"\n\n")
string(APPEND text "namespace surety::tool {\nnamespace {\n\n")
set(members "")
while(parts)
  list(POP_FRONT parts name file)
  file(READ "${file}" bytes HEX)
  string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(APPEND text "constexpr unsigned char ${name}[] = {\n${bytes}};\n\n")
  list(APPEND members "{reinterpret_cast<const char*>(${name}), sizeof(${name})}")
endwhile()
string(APPEND text "} // namespace\n\nconst Report_page* report_page()\n{\n")
if(VIEWER AND CONTROLS)
  list(JOIN members ",\n      " members)
  string(APPEND text "  static const Report_page all{\n      ${members}};\n  return &all;\n}\n")
else()
  string(REPLACE "constexpr unsigned" "[[maybe_unused]] constexpr unsigned" text "${text}")
  string(APPEND text "  return nullptr;\n}\n")
endif()
string(APPEND text "\n} // namespace surety::tool\n")
file(WRITE "${OUTPUT}" "${text}")
