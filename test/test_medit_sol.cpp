// SPDX-License-Identifier: GPL-3.0-or-later
//
// Metrics in Medit's .sol files: what is written is read back, and what is wrong is said with its
// line.
#include <surety/medit_sol.h>

#include "meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

namespace {

using namespace surety::test;
using surety::Invalid_input;
using surety::Medit_solution;
using surety::Metric_kind;
using surety::read_medit_sol;
using surety::write_medit_sol;
using Tensor = Eigen::Matrix3d;
namespace with = surety::parameters;

Medit_solution read(const std::string& text)
{
  std::istringstream in(text);
  return read_medit_sol(in);
}

Medit_solution written_and_read(const Medit_solution& solution)
{
  std::stringstream file;
  write_medit_sol(file, solution);
  return read_medit_sol(file);
}

TEST(Medit_sol, sizes_are_read_back_to_the_last_bit)
{
  Random random(1);
  Medit_solution solution;
  for (int i = 0; i < 1000; ++i) solution.sizes.push_back(std::exp(random.between(-50, 50)));
  solution.sizes.push_back(5e-324);
  solution.sizes.push_back(1.7976931348623157e308);
  const auto read_back = written_and_read(solution);
  EXPECT_EQ(read_back.sizes, solution.sizes);
  EXPECT_FALSE(read_back.is_anisotropic());
}

TEST(Medit_sol, tensors_are_read_back_to_the_last_bit)
{
  Random random(2);
  Medit_solution solution;
  for (int i = 0; i < 200; ++i) {
    Tensor a;
    for (int k = 0; k < 9; ++k) a(k / 3, k % 3) = random.between(-1, 1);
    const Tensor m = a * a.transpose() + Tensor::Identity();
    solution.tensors.push_back((m + m.transpose()) / 2);
  }
  const auto read_back = written_and_read(solution);
  EXPECT_EQ(read_back.tensors, solution.tensors);
  EXPECT_TRUE(read_back.is_anisotropic());
  EXPECT_EQ(read_back.number_of_vertices(), 200u);
}

TEST(Medit_sol, tensors_are_in_the_order_xx_xy_yy_xz_yz_zz)
{
  const auto solution
      = read("MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n1\n1 3\n10 1 20 2 3 30\nEnd\n");
  Tensor expected;
  expected << 10, 1, 2, 1, 20, 3, 2, 3, 30;
  ASSERT_EQ(solution.tensors.size(), 1u);
  EXPECT_EQ(solution.tensors[0], expected);
}

TEST(Medit_sol, other_layouts_and_fields_are_understood)
{
  const auto solution
      = read("# a comment\r\nMeshVersionFormatted\r\n1\r\n\r\nDimension 3 # as it must be\r\n"
             "SolAtTriangles 2 2 1 2\r\n1 2 3 4\r\n5 6 7 8\r\n"
             "SolAtVertices 3 1 1\r\n0.5 +1e-3\t2.\r\n");
  EXPECT_EQ(solution.sizes, (std::vector<double>{0.5, 1e-3, 2}));
}

TEST(Medit_sol, words_after_the_end_are_not_read)
{
  EXPECT_EQ(read("Dimension 3\nSolAtVertices 1 1 1\n2\nEnd\nrubbish").sizes.size(), 1u);
}

struct Mistake {
  const char* text;
  int line;
  const char* problem;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.problem; }

class Mistakes : public testing::TestWithParam<Mistake>
{};

TEST_P(Mistakes, are_reported_with_their_line)
{
  try {
    read(GetParam().text);
    FAIL() << "it was accepted";
  } catch (const Invalid_input& error) {
    EXPECT_EQ(error.function(), "read_medit_sol");
    EXPECT_EQ(error.argument(), "line " + std::to_string(GetParam().line));
    EXPECT_NE(error.problem().find(GetParam().problem), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Texts, Mistakes,
    testing::Values(
        Mistake{"", 1, "there is no SolAtVertices"},
        Mistake{"Dimension 3\n\nEnd\n", 3, "there is no SolAtVertices"},
        Mistake{"Dimension 2\n", 1, "the dimension is 2, not 3"},
        Mistake{"Dimension\nthree\n", 2, "\"three\" is not a whole number"},
        Mistake{"Dimension 3.5\n", 1, "is not a whole number"},
        Mistake{"Dimension", 1, "the file ends where a whole number should be"},
        Mistake{"SolAtVertices\n1 1 1 2\n", 1, "the dimension must come before"},
        Mistake{"Dimension 3\nVertices 4\n", 2, "the keyword \"Vertices\" is not known"},
        Mistake{"Dimension 3\n\x01\x80SolAt\n", 2, "is not known"},
        Mistake{"Dimension 3\nSolAtVertices\n0\n1 1\n", 3, "there are no vertices"},
        Mistake{"Dimension 3\nSolAtVertices\n-1\n1 1\n", 3, "\"-1\" is not a whole number"},
        Mistake{"Dimension 3\nSolAtVertices\n1\n2 1 1\n3 4\n", 4, "there are 2 fields, not 1"},
        Mistake{"Dimension 3\nSolAtVertices\n1\n1 2\n1 2 3\n", 4, "type of the field is 2"},
        Mistake{"Dimension 3\nSolAtVertices\n1\n1 4\n1 2 3\n", 4, "type of the field is 4"},
        Mistake{"Dimension 3\nSolAtEdges\n1\n1 7\n1\n", 4, "type of a field is not 1, 2 or 3"},
        Mistake{"Dimension 3\nSolAtVertices\n2\n1 1\n1\n0\n", 6, "the size 0 is not positive"},
        Mistake{"Dimension 3\nSolAtVertices\n2\n1 1\n1\n-2\n", 6, "the size -2 is not positive"},
        Mistake{"Dimension 3\nSolAtVertices\n2\n1 1\n1\nnan\n", 6, "\"nan\" is not finite"},
        Mistake{"Dimension 3\nSolAtVertices\n2\n1 1\n1\ninf\n", 6, "\"inf\" is not finite"},
        Mistake{"Dimension 3\nSolAtVertices\n2\n1 1\n1\n1e999\n", 6, "is not a number"},
        Mistake{"Dimension 3\nSolAtVertices\n2\n1 1\n1\n1,5\n", 6, "\"1,5\" is not a number"},
        Mistake{"Dimension 3\nSolAtVertices\n3\n1 1\n1\n2\n", 7, "the file ends"},
        Mistake{"Dimension 3\nSolAtVertices\n99999999999999\n1 1\n1\n", 6, "the file ends"},
        Mistake{"Dimension 3\nSolAtVertices\n1\n1 1\n1\n2\n", 6, "the keyword \"2\" is not known"},
        Mistake{"Dimension 3\nSolAtVertices\n1\n1 3\n1 2 1 0 0 1\n", 5, "not positive definite"},
        Mistake{
            "Dimension 3\nSolAtVertices\n1 1 1\n2\nSolAtVertices\n1 1 1 2\n", 5, "more than one"}));

TEST(Medit_sol, files_are_opened_by_their_path)
{
  EXPECT_THROW(read_medit_sol(std::string("/no/such/file.sol")), Invalid_input);
  const std::string path = testing::TempDir() + "surety_test_medit.sol";
  {
    std::ofstream out(path);
    write_medit_sol(out, {{0.25, 0.5}, {}});
  }
  EXPECT_EQ(read_medit_sol(path).sizes, (std::vector<double>{0.25, 0.5}));
  std::remove(path.c_str());
}

TEST(Medit_sol, the_writer_refuses_what_cannot_be_read_back)
{
  std::ostringstream out;
  EXPECT_THROW(write_medit_sol(out, {}), Invalid_input);
  EXPECT_THROW(write_medit_sol(out, {{1}, {Tensor::Identity()}}), Invalid_input);
  out.setstate(std::ios::badbit);
  EXPECT_THROW(write_medit_sol(out, {{1}, {}}), Invalid_input);
}

TEST(Medit_sol, fields_have_values_of_any_sign)
{
  const auto text = [](const std::string& type, const std::string& values) {
    return "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n3\n1 " + type + "\n" + values
        + "\nEnd\n";
  };
  std::istringstream good(text("1", "-1.5 0 2e3"));
  EXPECT_EQ(surety::read_medit_scalars(good), (std::vector<double>{-1.5, 0, 2e3}));
  std::istringstream tensors(text("3", "1 0 1 0 0 1 1 0 1 0 0 1 1 0 1 0 0 1"));
  EXPECT_THROW(surety::read_medit_scalars(tensors), Invalid_input);
  std::istringstream infinite(text("1", "1 inf 2"));
  EXPECT_THROW(surety::read_medit_scalars(infinite), Invalid_input);
  std::istringstream sizes(text("1", "-1.5 0 2e3"));
  EXPECT_THROW(surety::read_medit_sol(sizes), Invalid_input);
  EXPECT_THROW(surety::read_medit_scalars(std::string("/no/such/file.sol")), Invalid_input);
}

TEST(Medit_sol, of_a_metric_has_what_satisfies_all_sides_of_each_vertex)
{
  const Mesh mesh = cube(2);
  const auto sides = surety::find_sides(mesh, surety::find_features(mesh, with::feature_angle(40)));
  for (const auto kind : {Metric_kind::isotropic, Metric_kind::anisotropic}) {
    auto metric = surety::make_uniform_metric(mesh, sides, 0.5, with::metric_kind(kind));
    for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
      if (metric.normal(s).z() > 0.9) metric.set_size(s, 0.125);
    }
    const auto solution = surety::to_medit_sol(mesh, metric);
    ASSERT_EQ(solution.number_of_vertices(), mesh.num_vertices());
    EXPECT_EQ(solution.is_anisotropic(), kind == Metric_kind::anisotropic);
    for (const Vertex v : mesh.vertices()) {
      const double expected = mesh.point(v).z() == 1 ? 0.125 : 0.5;
      const double size = solution.is_anisotropic() ? 1 / std::sqrt(solution.tensors[v].trace() / 3)
                                                    : solution.sizes[v];
      EXPECT_NEAR(size, expected, 1e-12);
    }
  }
}

} // namespace
