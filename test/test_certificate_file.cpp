// SPDX-License-Identifier: GPL-3.0-or-later
//
// Certificate files: what was written is read back bit by bit, and whatever else a file may hold is
// refused with the number of the line.
#include <surety/certificate.h>

#include "overlay.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <sstream>

namespace {

using namespace surety::test;
using surety::Certificate;
using surety::Correspondence;

std::string written(const Certificate& certificate)
{
  std::ostringstream out;
  write_certificate(out, certificate);
  return out.str();
}

Certificate read_back(const std::string& text)
{
  std::istringstream in(text);
  return surety::read_certificate(in);
}

Certificate example(unsigned seed = 1)
{
  Mapped_pair pair = square_on_square(6, 0.1, seed);
  pair.record.inner = {{seed, 3, 0.1, 0.2}, {seed + 7, 2, 1.0 / 3, 1.0 / 7}};
  pair.record.ridges = {{1, 9}, {2, 3}};
  surety::Operations operations;
  operations.collapses = 123;
  operations.flips = 45;
  operations.relocations = 67;
  operations.refuse(surety::Verdict::deviation);
  operations.refuse(surety::Verdict::shape);
  return Certificate(0.1, std::nextafter(0.05, 1), pair.record, operations, true);
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void expect_equal(const Certificate& a, const Certificate& b)
{
  EXPECT_TRUE(same_bits(a.tolerance(), b.tolerance()));
  EXPECT_TRUE(same_bits(a.bound(), b.bound()));
  EXPECT_EQ(a.is_cancelled(), b.is_cancelled());
  EXPECT_EQ(a.operations().collapses, b.operations().collapses);
  EXPECT_EQ(a.operations().flips, b.operations().flips);
  EXPECT_EQ(a.operations().relocations, b.operations().relocations);
  EXPECT_EQ(a.operations().refused, b.operations().refused);
  const Correspondence &r = *a.correspondence(), &s = *b.correspondence();
  ASSERT_EQ(r.images.size(), s.images.size());
  for (std::size_t i = 0; i < r.images.size(); ++i) {
    EXPECT_EQ(r.images[i].kind, s.images[i].kind);
    EXPECT_EQ(r.images[i].a, s.images[i].a);
    EXPECT_EQ(r.images[i].b, s.images[i].b);
  }
  EXPECT_EQ(r.edges, s.edges);
  EXPECT_EQ(r.offsets, s.offsets);
  EXPECT_EQ(r.ridges, s.ridges);
  ASSERT_EQ(r.crossings.size(), s.crossings.size());
  for (std::size_t i = 0; i < r.crossings.size(); ++i) {
    EXPECT_EQ(r.crossings[i].a, s.crossings[i].a);
    EXPECT_EQ(r.crossings[i].b, s.crossings[i].b);
    EXPECT_TRUE(same_bits(r.crossings[i].lambda, s.crossings[i].lambda));
  }
  ASSERT_EQ(r.inner.size(), s.inner.size());
  for (std::size_t i = 0; i < r.inner.size(); ++i) {
    EXPECT_EQ(r.inner[i].face, s.inner[i].face);
    EXPECT_EQ(r.inner[i].vertex, s.inner[i].vertex);
    EXPECT_TRUE(same_bits(r.inner[i].lambda, s.inner[i].lambda));
    EXPECT_TRUE(same_bits(r.inner[i].mu, s.inner[i].mu));
  }
}

TEST(Certificate_file, returns_what_was_written)
{
  for (unsigned seed = 0; seed < 5; ++seed) {
    expect_equal(example(seed), read_back(written(example(seed))));
  }
}

TEST(Certificate_file, keeps_every_double)
{
  Correspondence record;
  record.images.resize(2);
  record.edges = {{0, 1}};
  Random random(1);
  std::vector<double> values
      = {-0.0,
         0.0,
         std::numeric_limits<double>::denorm_min(),
         std::numeric_limits<double>::min(),
         0x1.fffffffffffffp-1,
         1.0,
         0.1,
         1.0 / 3};
  for (int i = 0; i < 1000; ++i)
    values.push_back(std::ldexp(random.unit(), -int(random.below(1070))));
  std::sort(values.begin(), values.end());
  for (const double lambda : values) record.crossings.push_back({0, 1, lambda});
  record.offsets = {0, std::uint32_t(values.size())};
  for (const double length :
       {0.0, std::numeric_limits<double>::denorm_min(), 0.1, 1e300,
        std::numeric_limits<double>::max()}) {
    const Certificate certificate(length, length, record);
    expect_equal(certificate, read_back(written(certificate)));
  }
}

TEST(Certificate_file, is_the_documented_text)
{
  Correspondence record;
  record.images = {at_vertex(7), on_edge(2, 5), at_face(3)};
  record.edges = {{0, 2}};
  record.offsets = {0, 2};
  record.crossings = {{1, 4, 0.25}, {2, 4, 0.8125}};
  record.inner = {{3, 6, 0.25, 0.5}, {5, 1, 0, 1}};
  record.ridges = {{0, 1}};
  const std::string text = written(Certificate(0.5, 0.375, record));
  EXPECT_EQ(
      text,
      "surety-certificate 2\n"
      "tolerance 0x1p-1\n"
      "bound 0x1.8p-2\n"
      "cancelled 0\n"
      "collapses 0\n"
      "flips 0\n"
      "relocations 0\n"
      "refused 7\n"
      "feature 0\n"
      "topology 0\n"
      "shape 0\n"
      "roughness 0\n"
      "deviation 0\n"
      "correspondence 0\n"
      "self_intersection 0\n"
      "images 3\n"
      "v 7\n"
      "e 2 5\n"
      "f 3\n"
      "edges 1\n"
      "x 0 2 2\n"
      "1 4 0x1p-2\n"
      "2 4 0x1.ap-1\n"
      "inner 2\n"
      "3 6 0x1p-2 0x1p-1\n"
      "5 1 0x0p+0 0x1p+0\n"
      "ridges 1\n"
      "0 1\n"
      "end\n");
}

TEST(Certificate_file, may_be_followed_by_other_text)
{
  std::istringstream in(written(example(1)) + written(example(2)) + "more");
  expect_equal(example(1), surety::read_certificate(in));
  expect_equal(example(2), surety::read_certificate(in));
  std::string rest;
  in >> rest;
  EXPECT_EQ(rest, "more");
}

TEST(Certificate_file, may_have_the_line_ends_of_other_systems_and_none_at_the_end)
{
  std::string text = written(example()), other;
  for (const char c : text) other += c == '\n' ? "\r\n" : std::string(1, c);
  expect_equal(example(), read_back(other));
  text.pop_back();
  expect_equal(example(), read_back(text));
}

TEST(Certificate_file, is_refused_wherever_it_ends_early)
{
  const std::string text = written(example());
  // Without the very last character it is complete.
  for (std::size_t length = 0; length + 1 < text.size(); length += length < 400 ? 1 : 37) {
    EXPECT_THROW(read_back(text.substr(0, length)), surety::Invalid_input) << length;
  }
  EXPECT_THROW(read_back(text.substr(0, text.size() - 2)), surety::Invalid_input);
}

void expect_refused_at_line(std::size_t line, const std::string& text)
{
  try {
    read_back(text);
    ADD_FAILURE() << "read: " << text;
  } catch (const surety::Invalid_input& problem) {
    EXPECT_EQ(problem.argument(), "line " + std::to_string(line)) << problem.what();
    EXPECT_EQ(problem.function(), "read_certificate");
  }
}

TEST(Certificate_file, bad_lines_are_named)
{
  Correspondence record;
  record.images = {at_vertex(7), on_edge(2, 5), at_face(3), at_face(3)};
  record.edges = {{0, 2}, {1, 2}};
  record.offsets = {0, 2, 2};
  record.crossings = {{1, 4, 0.25}, {2, 4, 0.8125}};
  record.inner = {{1, 3, 0.25, 0.5}, {2, 4, 0, 0.5}};
  record.ridges = {{0, 1}};
  const std::string sound = written(Certificate(0.5, 0.375, record));
  std::vector<std::string> lines;
  std::istringstream in(sound);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  const std::vector<std::pair<std::size_t, std::string>> bad
      = {{1, "surety-certificate 1"},
         {1, "surety-certificate 3"},
         {1, "surety-certificate"},
         {1, "OFF"},
         {1, ""},
         {2, "tolerance 0.5"},
         {2, "tolerance 0x"},
         {2, "tolerance 0x-1p-1"},
         {2, "tolerance 0x1p-1 "},
         {2, "tolerance nan"},
         {2, "tolerance inf"},
         {2, "tolerance 0xinf"},
         {2, "tolerance 0xnan"},
         {2, "tolerance -0x1p-1"},
         {2, "tolerance 0x1p99999"},
         {2, "tolerance 0x0x1p-1"},
         {2, "tolerance  0x1p-1"},
         {2, "bound 0x1p-1"},
         {3, "bound -0x0p+0"},
         {3, "bound -"},
         {4, "cancelled 2"},
         {4, "cancelled yes"},
         {5, "collapses -1"},
         {5, "collapses 1.5"},
         {5, "collapses 99999999999999999999999"},
         {5, "collapses +1"},
         {5, "collapses 0x1"},
         {9, "weather 3"},
         {9, "accept 3"},
         {9, "feature"},
         {17, "w 7"},
         {17, "v"},
         {17, "v 4294967296"},
         {17, "v -1"},
         {17, "v 7 8"},
         {17, "v\t7"},
         {18, "e 5 2"},
         {18, "e 5 5"},
         {18, "e 5"},
         {19, "f 3 1"},
         {22, "x 2 0 2"},
         {22, "x 0 4 2"},
         {22, "x 0 2"},
         {22, "y 0 2 2"},
         {22, "x 0 2 4294967295"},
         {23, "4 1 0x1p-2"},
         {23, "1 4 0x1.8p+0"},
         {23, "1 4 -0x1p-2"},
         {23, "1 4"},
         {23, "1 4 0x1p-2 1"},
         {24, "2 4 0x1p-3"},
         {25, "x 0 2 0"},
         {25, "x 0 1 0"},
         {7, "relocations -1"},
         {7, "refused 7"},
         {26, "inner x"},
         {26, "ridges 1"},
         {26, "inner 4294967296"},
         {27, "1 3 0x1p-2"},
         {27, "1 3 0x1p-2 0x1p-2 0"},
         {27, "-1 3 0x1p-2 0x1p-2"},
         {27, "1 -3 0x1p-2 0x1p-2"},
         {27, "1 3 -0x1p-2 0x1p-2"},
         {27, "1 3 0x1p-2 -0x1p-2"},
         {27, "1 3 0x1p-1 0x1.0000000000002p-1"},
         {27, "1 3 0x1.0000000000001p+0 0x0p+0"},
         {27, "1 3 0.25 0x1p-2"},
         {27, "1 3 nan 0x1p-2"},
         {28, "1 4 0x0p+0 0x1p-1"},
         {28, "0 4 0x0p+0 0x1p-1"},
         {29, "ridges -1"},
         {30, "1 0"},
         {30, "0 4"},
         {31, "END"},
         {31, "end 1"}};
  for (const auto& [line, replacement] : bad) {
    std::string text;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      text += (i + 1 == line ? replacement : lines[i]) + '\n';
    }
    // A wrong count of crossings shows on the line that is not one.
    const bool shows_later = replacement == "x 0 2 4294967295";
    if (!shows_later)
      expect_refused_at_line(line, text);
    else
      EXPECT_THROW(read_back(text), surety::Invalid_input);
  }
}

TEST(Certificate_file, huge_counts_do_not_allocate)
{
  const std::string start = "surety-certificate 2\ntolerance 0x1p-1\nbound 0x1p-2\ncancelled 0\n"
                            "collapses 0\nflips 0\nrelocations 0\nrefused 0\n";
  expect_refused_at_line(10, start + "images 4294967295\n");
  expect_refused_at_line(12, start + "images 1\nv 0\nedges 4294967295\n");
  expect_refused_at_line(13, start + "images 1\nv 0\nedges 0\ninner 4294967295\n");
  expect_refused_at_line(9, start + std::string(100'000, 'x'));
  expect_refused_at_line(1, std::string(100'000, '\0'));
}

TEST(Certificate_file, random_damage_is_refused_or_read_as_something)
{
  const std::string sound = written(example());
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    Random random(seed);
    std::string text = sound;
    for (std::size_t k = 1 + random.below(4); k > 0; --k) {
      const std::size_t place = random.below(text.size());
      const std::string alphabet = "0123456789abcdefvxp+-. \n\r\t\xff";
      switch (random.below(3)) {
      case 0:
        text[place] = alphabet[random.below(alphabet.size())];
        break;
      case 1:
        text.erase(place, 1 + random.below(20));
        break;
      default:
        text.insert(place, text.substr(random.below(text.size()), random.below(30)));
      }
    }
    try {
      const Certificate certificate = read_back(text);
      EXPECT_EQ(surety::internal::checker::record_defect(*certificate.correspondence()), "");
      expect_equal(certificate, read_back(written(certificate)));
    } catch (const surety::Invalid_input&) {}
  }
}

TEST(Certificate_file, certificates_without_a_map_cannot_be_written)
{
  std::ostringstream out;
  try {
    write_certificate(out, Certificate(1, 0.5, std::nullopt));
    ADD_FAILURE();
  } catch (const surety::Invalid_input& problem) {
    EXPECT_NE(problem.remedy().find("certify_distance"), std::string::npos);
  }
  EXPECT_TRUE(out.str().empty());
}

TEST(Certificate_file, records_that_cannot_be_read_back_are_not_written)
{
  Correspondence record = *example().correspondence();
  EXPECT_NO_THROW(written(Certificate(1, 0.5, record)));
  EXPECT_NO_THROW(written(Certificate(1, 0.5, Correspondence())));
  for (const double length : {-1.0, -0.0, double(NAN), double(INFINITY)}) {
    EXPECT_THROW(written(Certificate(length, 0.5, record)), surety::Invalid_input);
    EXPECT_THROW(written(Certificate(1, length, record)), surety::Invalid_input);
  }
  for (const surety::Correspondence::Inner& inner : std::initializer_list<Correspondence::Inner>{
           {9, 0, NAN, 0}, {9, 0, 0, NAN}, {9, 0, 0, -1}, {9, 0, 0.75, 0.5}, {0, 0, 0, 0}}) {
    Correspondence other = record;
    other.inner.push_back(inner);
    EXPECT_THROW(written(Certificate(1, 0.5, other)), surety::Invalid_input);
  }
  record.crossings[0].lambda = NAN;
  EXPECT_THROW(written(Certificate(1, 0.5, record)), surety::Invalid_input);
}

TEST(Certificate_file, a_full_stream_is_reported_by_the_stream)
{
  std::ostringstream out;
  out.setstate(std::ios::badbit);
  write_certificate(out, example());
  EXPECT_TRUE(out.fail());
  std::istringstream in(written(example()));
  in.setstate(std::ios::badbit);
  EXPECT_THROW(surety::read_certificate(in), surety::Invalid_input);
}

} // namespace
