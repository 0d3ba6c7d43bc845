// The mean of a few flights' numbers, and how sure it is.
#pragma once

#include <vector>

namespace tern {

/// Mean and half the width of its 95 % interval by Student's t (n − 1 degrees of freedom). This assumes only that means
/// of so many flights are about normal.
struct MeanInterval {
  int n = 0;
  double mean = 0.0;
  double half = 0.0;  ///< 0 for n < 2
};

MeanInterval mean_interval(const std::vector<double>& numbers);

}  // namespace tern
