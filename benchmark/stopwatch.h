// SPDX-License-Identifier: GPL-3.0-or-later
//
// CPU time of this process, which the load of the machine hardly changes.
#ifndef SURETY_BENCHMARK_STOPWATCH_H
#define SURETY_BENCHMARK_STOPWATCH_H

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <vector>

namespace surety::benchmark {

class Stopwatch
{
public:
  /// CPU seconds since the construction.
  double seconds() const { return now() - start_; }

private:
  static double now()
  {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  double start_ = now();
};

/// CPU seconds that a function takes.
template <class Function>
double seconds_of(const Function& function)
{
  const Stopwatch stopwatch;
  function();
  return stopwatch.seconds();
}

/// The median; of an even number of values, the mean of the middle two.
inline double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

} // namespace surety::benchmark

#endif // SURETY_BENCHMARK_STOPWATCH_H
