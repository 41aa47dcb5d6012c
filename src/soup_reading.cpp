// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's readers parse; this file makes them dependable. They believe what a header promises,
// some stop without a word at the end of a truncated file, and some refuse harmless dialects. So
// a file is read into memory, brought into the form that the reader understands, its promises are
// compared with its size, and the result with its promises.
#include "soup_reading.h"

#include "attribute_reading.h"
#include "failure.h"
#include "medit.h"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>

#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/stream.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include <sys/resource.h>
#include <unistd.h>

namespace surety::tool {
namespace {

namespace fs = std::filesystem;
using Memory_stream = boost::iostreams::stream<boost::iostreams::array_source>;

/// While it lives, memory may grow only in proportion to the file that is read: a count in a file
/// that promises more than the file can hold then fails as std::bad_alloc, instead of bringing the
/// machine down. Where the memory in use cannot be told, there is no limit.
class Memory_limit
{
public:
  explicit Memory_limit(std::size_t file_size)
  {
    constexpr rlim_t per_byte = 100, base = rlim_t{2} << 30;
    const rlim_t in_use = memory_in_use();
    if (in_use == 0 || getrlimit(RLIMIT_AS, &old_) != 0) return;
    rlimit limit = old_;
    limit.rlim_cur = std::min(old_.rlim_cur, in_use + base + per_byte * rlim_t{file_size});
    is_active_ = setrlimit(RLIMIT_AS, &limit) == 0;
  }
  Memory_limit(const Memory_limit&) = delete;
  Memory_limit& operator=(const Memory_limit&) = delete;
  ~Memory_limit()
  {
    if (is_active_) setrlimit(RLIMIT_AS, &old_);
  }

private:
  static rlim_t memory_in_use()
  {
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
  }

  rlimit old_{};
  bool is_active_ = false;
};

std::string read_bytes(const std::string& file)
{
  std::error_code error;
  const auto status = fs::status(file, error);
  if (!fs::exists(status)) throw Bad_file(file, "there is no such file", "");
  if (fs::is_directory(status)) throw Bad_file(file, "this is a folder", "give a mesh file");
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  if (!stream || !(bytes << stream.rdbuf() || stream.peek() == EOF)) {
    throw Bad_file(file, "the file cannot be read", "check its permissions");
  }
  std::string text = std::move(bytes).str();
  if (text.empty()) throw Bad_file(file, "the file is empty", "export it again");
  return text;
}

/// Numbers of vertices and faces that a file promises.
struct Promise {
  std::uint64_t vertices, faces;
};

/// The word that starts at or after a position, behind blanks, and comments that '#' introduces.
std::string_view next_word(std::string_view text, std::size_t& position)
{
  while (position < text.size()) {
    if (text[position] == '#') {
      position = std::min(text.find('\n', position), text.size());
    } else if (std::isspace(static_cast<unsigned char>(text[position]))) {
      ++position;
    } else {
      break;
    }
  }
  const std::size_t begin = position;
  while (position < text.size() && !std::isspace(static_cast<unsigned char>(text[position]))) {
    ++position;
  }
  return text.substr(begin, position - begin);
}

std::optional<std::uint64_t> to_count(std::string_view word)
{
  if (word.empty() || word.size() > 18) return {};
  std::uint64_t count = 0;
  for (const char digit : word) {
    if (!std::isdigit(static_cast<unsigned char>(digit))) return {};
    count = 10 * count + static_cast<std::uint64_t>(digit - '0');
  }
  return count;
}

std::optional<Promise> off_promise(std::string_view text)
{
  std::size_t position = 0;
  auto word = next_word(text, position);
  if (word.size() >= 3 && word.substr(word.size() - 3) == "OFF") word = next_word(text, position);
  const auto vertices = to_count(word), faces = to_count(next_word(text, position));
  if (!vertices || !faces) return {};
  return Promise{*vertices, *faces};
}

std::optional<Promise> ply_promise(std::string_view text)
{
  std::optional<std::uint64_t> vertices, faces;
  std::size_t position = 0;
  while (position < text.size()) {
    const auto word = next_word(text, position);
    if (word == "end_header") break;
    if (word == "comment" || word == "obj_info") position = text.find('\n', position);
    if (word != "element") continue;
    const auto name = next_word(text, position);
    const auto count = to_count(next_word(text, position));
    if (name == "vertex") vertices = count;
    if (name == "face") faces = count;
  }
  if (!vertices || !faces) return {};
  return Promise{*vertices, *faces};
}

/// A vertex takes at least three numbers and as many blanks in text, and as many bytes in binary;
/// a face takes more.
void require_plausible(
    const Promise& promise, const std::string& file, std::size_t size, const char* format)
{
  constexpr std::uint64_t bytes_per_element = 6;
  if (promise.vertices <= size / bytes_per_element && promise.faces <= size / bytes_per_element) {
    return;
  }
  throw Bad_file(
      file,
      std::string("this is not a complete ") + format + " file: the header promises "
          + std::to_string(promise.vertices) + " vertices and " + std::to_string(promise.faces)
          + " faces, more than the " + std::to_string(size) + " bytes of the file can hold",
      "export the file again");
}

/// The first word of a text that is a number, but not a finite one, with its line.
std::optional<std::string> find_infinite_number(const std::string& text)
{
  std::size_t position = 0;
  while (position < text.size()) {
    const std::string word(next_word(text, position));
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (end == word.c_str() || *end != '\0' || std::isfinite(value)) continue;
    const auto line = 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(position), '\n');
    return "line " + std::to_string(line) + ": '" + word + "' is not a finite number";
  }
  return {};
}

[[noreturn]] void fail_to_parse(
    const std::string& file, const std::string& text, const char* format)
{
  if (const auto problem = find_infinite_number(text)) {
    throw Bad_file(file, *problem, "correct or remove the vertex");
  }
  throw Bad_file(
      file, std::string("this is not a complete ") + format + " file",
      "it may be truncated or of another format: export it again");
}

Soup read_off(const std::string& file, const std::string& text)
{
  const auto promise = off_promise(text);
  if (promise) require_plausible(*promise, file, text.size(), "OFF");
  Soup soup;
  Memory_stream stream(text.data(), text.size());
  if (!CGAL::IO::read_OFF(stream, soup.points, soup.polygons, CGAL::parameters::verbose(false))) {
    fail_to_parse(file, text, "OFF");
  }
  return soup;
}

Soup read_ply(const std::string& file, const std::string& text, bool wants_attributes)
{
  const auto promise = ply_promise(text);
  if (promise) require_plausible(*promise, file, text.size(), "PLY");
  Soup soup;
  Memory_stream stream(text.data(), text.size());
  const bool complete
      = CGAL::IO::read_PLY(stream, soup.points, soup.polygons, CGAL::parameters::verbose(false));
  if (!complete || !promise || promise->vertices != soup.points.size()
      || promise->faces != soup.polygons.size()) {
    fail_to_parse(file, text, "PLY");
  }
  if (wants_attributes) soup.attributes = read_ply_attributes(file, text, soup);
  return soup;
}

/// With blanks between words and one statement a line.
std::string unfolded_obj(std::string text)
{
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\t' || text[i] == '\r') text[i] = ' ';
    const bool continued = text[i] == '\\' && i + 1 < text.size()
        && text.find_first_not_of(" \t\r", i + 1) == text.find('\n', i + 1);
    if (!continued) continue;
    const std::size_t end = std::min(text.find('\n', i), text.size() - 1);
    std::fill(text.begin() + std::ptrdiff_t(i), text.begin() + std::ptrdiff_t(end) + 1, ' ');
  }
  return text;
}

/// Only what makes a mesh, in the dialect that CGAL's reader understands: vertices and faces.
/// Lines, curves, groups and materials are dropped.
std::string plain_obj(const std::string& text)
{
  std::string plain;
  plain.reserve(text.size());
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t start = line.find_first_not_of(' ');
    if (start == std::string::npos || start + 1 >= line.size() || line[start + 1] != ' ') continue;
    if (line[start] == 'v' || line[start] == 'f') plain.append(line, start).push_back('\n');
  }
  return plain;
}

Soup read_obj(const std::string& file, const std::string& text, bool wants_attributes)
{
  const std::string unfolded = unfolded_obj(text), plain = plain_obj(unfolded);
  Soup soup;
  Memory_stream stream(plain.data(), plain.size());
  if (plain.empty() || !CGAL::IO::read_OBJ(stream, soup.points, soup.polygons)) {
    fail_to_parse(file, text, "OBJ");
  }
  if (wants_attributes) soup.attributes = read_obj_attributes(file, unfolded, soup);
  return soup;
}

/// A binary STL file has a header of 80 bytes, a count, and 50 bytes a face. Some writers add bytes
/// at the end; zero bytes then still tell it from text.
bool is_binary_stl(const std::string& text)
{
  if (text.size() < 84) return false;
  std::uint32_t faces = 0;
  std::memcpy(&faces, text.data() + 80, sizeof faces);
  const std::uint64_t size = 84 + std::uint64_t{50} * faces;
  return text.size() == size || (text.size() > size && text.find('\0') != std::string::npos);
}

/// CGAL's reader merges equal points as it reads, in an order that a NaN would break.
void require_finite_stl(const std::string& file, const std::string& text)
{
  for (std::size_t offset = 84; offset + 50 <= text.size(); offset += 50) {
    std::array<float, 9> corners{};
    std::memcpy(corners.data(), text.data() + offset + 12, sizeof corners);
    if (std::all_of(corners.begin(), corners.end(), [](float x) { return std::isfinite(x); })) {
      continue;
    }
    throw Bad_file(
        file, "the coordinates of face " + std::to_string((offset - 84) / 50) + " are not finite",
        "correct or remove it");
  }
}

Soup read_stl(const std::string& file, std::string text)
{
  if (is_binary_stl(text)) {
    require_finite_stl(file, text);
    // The header is free text; one that begins like a text file would mislead the reader.
    std::fill_n(text.begin(), 5, '-');
  } else {
    const auto lower = [](unsigned char c) { return static_cast<char>(std::tolower(c)); };
    std::transform(text.begin(), text.end(), text.begin(), lower);
    std::size_t position = 0;
    if (next_word(text, position) != "solid") fail_to_parse(file, text, "STL");
  }
  Soup soup;
  Memory_stream stream(text.data(), text.size());
  const bool complete = CGAL::IO::read_STL(stream, soup.points, soup.polygons);
  if (!complete) fail_to_parse(file, text, "STL");
  return soup;
}

Soup parse(const std::string& file, bool wants_attributes)
{
  const std::string extension = extension_of(file);
  constexpr std::array<const char*, 6> known = {"off", "obj", "ply", "stl", "mesh", "meshb"};
  if (std::find(known.begin(), known.end(), extension) == known.end()) {
    throw Bad_file(
        file, "the format '" + extension + "' cannot be read",
        "give an off, obj, ply, stl, mesh or meshb file");
  }
  std::string text = read_bytes(file);
  const Memory_limit limit(text.size());
  if (extension == "off") return read_off(file, text);
  if (extension == "obj") return read_obj(file, text, wants_attributes);
  if (extension == "ply") return read_ply(file, text, wants_attributes);
  if (extension == "mesh") return read_medit_text(file, text);
  if (extension == "meshb") return read_medit_binary(file, text);
  return read_stl(file, std::move(text));
}

} // namespace

std::string extension_of(const std::string& file)
{
  std::string extension = fs::path(file).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

Soup read_soup(const std::string& file, bool wants_attributes)
{
  try {
    return parse(file, wants_attributes);
  } catch (const std::bad_alloc&) {
    throw Bad_file(
        file, "a count in the file is larger than the file can hold", "export the file again");
  } catch (const std::length_error&) {
    throw Bad_file(
        file, "a count in the file is larger than the file can hold", "export the file again");
  }
}

} // namespace surety::tool
