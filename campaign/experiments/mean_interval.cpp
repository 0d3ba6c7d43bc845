#include "campaign/experiments/mean_interval.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace tern {

MeanInterval mean_interval(const std::vector<double>& numbers) {
  MeanInterval m;
  m.n = static_cast<int>(numbers.size());
  if (m.n == 0) return m;
  for (const double x : numbers) m.mean += x / m.n;
  if (m.n < 2) return m;
  double squares = 0.0;
  for (const double x : numbers) squares += (x - m.mean) * (x - m.mean);
  const boost::math::students_t t(m.n - 1);
  m.half = boost::math::quantile(t, 0.975) * std::sqrt(squares / (m.n - 1) / m.n);
  return m;
}

}  // namespace tern
