// The densities of landmarks that labels promise to a camera.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/base/knobs.h"

namespace tern {

/// Expected densities of landmarks, per class of region: the meaning of a label before anything was seen.
struct LandmarkPriors {
  static constexpr double kMaxDensity = 50.0;  ///< 1/m²
  double ground = 1.0;
  double obstacles = 4.0;
  double ground_z_m = 0.0;
  /// Density per class of region; a class that is not listed has the ground's.
  std::vector<std::pair<std::string, double>> regions = {{"texture", 8.0}, {"water", 0.03}};
  template <typename V>
  void visit(V& v) {
    v("ground", ground, Range{0.0, kMaxDensity},
      "expected landmarks per m² of ground: 1 is lawn or asphalt, 0.03 a dark floor");
    v("obstacles", obstacles, Range{0.0, kMaxDensity}, "expected landmarks per m² of obstacles at rest");
    v("ground_z_m", ground_z_m, Range{-1e4, 1e4}, "height of the ground, m");
  }
};

}  // namespace tern
