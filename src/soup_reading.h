// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reading of polygon soups from files of all formats.
#ifndef SURETY_TOOL_SOUP_READING_H
#define SURETY_TOOL_SOUP_READING_H

#include "soup.h"

#include <string>

namespace surety::tool {

/// The soup that an OFF, OBJ, PLY, STL or Medit file holds, complete, but not checked in any other
/// way. \throws Bad_file if the file cannot be read to its end.
/// \param wants_attributes whether to read, and check, colours, normals and texture coordinates,
/// too.
Soup read_soup(const std::string& file, bool wants_attributes = false);

/// The extension of a file's name in lower case, without the dot.
std::string extension_of(const std::string& file);

} // namespace surety::tool

#endif // SURETY_TOOL_SOUP_READING_H
