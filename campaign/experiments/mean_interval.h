// The mean of a sample with its 95 % interval.
#pragma once

#include <vector>

namespace tern {

/// Mean and half width of its 95 % interval by Student's t with n − 1 degrees of freedom. It assumes that the mean is
/// approximately normal.
struct MeanInterval {
  int n = 0;
  double mean = 0.0;
  double half = 0.0;  ///< 0 for n < 2
};

MeanInterval mean_interval(const std::vector<double>& numbers);

}  // namespace tern
