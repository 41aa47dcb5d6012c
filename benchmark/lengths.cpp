// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far off is the length of an edge when the metric is known at its ends only? Each rule against
// a fine quadrature, on edges of about unit length in the plane.
#include "program.h"
#include "stopwatch.h"
#include "table.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <surety/metric.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace surety::benchmark;
using surety::Length_rule;
using Vector = Eigen::Vector3d;
using Tensor = Eigen::Matrix3d;

struct Field {
  std::string name;
  std::function<Tensor(const Vector&)> metric;
};

/// Distance from a circle.
double from_ring(const Vector& p) { return std::abs(std::hypot(p.x() - 0.5, p.y() - 0.5) - 0.35); }

std::vector<Field> fields()
{
  using surety::internal::metric::isotropic_tensor;
  using surety::internal::metric::tangential;
  return {
      {"isotropic ring",
       [](const Vector& p) { return isotropic_tensor(0.02 + 0.25 * from_ring(p)); }},
      {"anisotropic ring",
       [](const Vector& p) {
         const Vector radial = Vector(p.x() - 0.5, p.y() - 0.5, 0).normalized();
         return tangential(Vector::UnitZ(), radial, 0.02 + 0.25 * from_ring(p), 0.1);
       }},
      {"straight layer", [](const Vector& p) {
         return tangential(
             Vector::UnitZ(), Vector::UnitX(), 0.02 + 0.25 * std::abs(p.x() - 0.5), 0.1);
       }}};
}

const std::vector<std::pair<std::string, Length_rule>>& rules()
{
  static const std::vector<std::pair<std::string, Length_rule>> all
      = {{"end_only", Length_rule::end_only},
         {"trapezoid", Length_rule::trapezoid},
         {"logarithmic_mean", Length_rule::logarithmic_mean},
         {"linear_size", Length_rule::linear_size},
         {"simpson", Length_rule::simpson}};
  return all;
}

struct Edge {
  Vector from, way;
};

/// Edges of length 1 in the metric of their first end, inside the unit square.
std::vector<Edge> random_edges(const Field& field, std::size_t number)
{
  std::mt19937_64 engine(1);
  const auto unit = [&] { return double(engine() >> 11) * 0x1p-53; };
  std::vector<Edge> edges;
  while (edges.size() < number) {
    const Vector p(unit(), unit(), 0);
    const double turn = 6.283185307179586 * unit();
    const Vector d(std::cos(turn), std::sin(turn), 0),
        e = d / std::sqrt(d.dot(field.metric(p) * d));
    if ((p + e).minCoeff() >= 0 && (p + e).maxCoeff() <= 1) edges.push_back({p, e});
  }
  return edges;
}

double exact_length(const Field& field, const Edge& edge)
{
  constexpr int pieces = 2000;
  double sum = 0;
  for (int i = 0; i < pieces; ++i) {
    const Vector p = edge.from + (i + 0.5) / pieces * edge.way;
    sum += std::sqrt(edge.way.dot(field.metric(p) * edge.way));
  }
  return sum / pieces;
}

int run(int argc, char* argv[])
{
  CLI::App program(
      "Prints the mean and the 95th percentile of |ln(length / exact length)| for every rule, on "
      "random edges, and what an edge costs.");
  std::size_t number = 2000;
  program.add_option("--edges", number, "Of each field")->capture_default_str();
  parse_or_exit(program, argc, argv);

  const Table table({"field", "rule", "mean_error", "error_95", "microseconds"});
  for (const Field& field : fields()) {
    const auto edges = random_edges(field, number);
    std::vector<double> exact;
    std::vector<std::pair<Tensor, Tensor>> ends;
    for (const Edge& edge : edges) {
      exact.push_back(exact_length(field, edge));
      ends.emplace_back(field.metric(edge.from), field.metric(edge.from + edge.way));
    }
    for (const auto& [name, rule] : rules()) {
      std::vector<double> errors(number);
      const double seconds = seconds_of([&] {
        for (std::size_t i = 0; i < number; ++i) {
          errors[i] = surety::metric_length(edges[i].way, ends[i].first, ends[i].second, rule);
        }
      });
      double sum = 0;
      for (std::size_t i = 0; i < number; ++i) {
        errors[i] = std::abs(std::log(errors[i] / exact[i]));
        sum += errors[i];
      }
      std::sort(errors.begin(), errors.end());
      table.add(
          {{"field", field.name},
           {"rule", name},
           {"mean_error", std::to_string(sum / double(number))},
           {"error_95", std::to_string(errors[number * 95 / 100])},
           {"microseconds", std::to_string(1e6 * seconds / double(number))}});
    }
  }
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  return run_program([&] { return run(argc, argv); });
}
