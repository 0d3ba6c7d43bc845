#include "predictor/faces/looked_for.h"

#include <array>

#include "perception/view.h"

namespace tern {

bool is_looked_through(const SensorView& view, const Box& box) {
  if (view.depths.empty()) return false;
  const Vec3 centre = box.center(), half = 0.5 * kLookedForShare * box.sizes();
  int looks = 0, through = 0;
  constexpr std::array kOffsets{-1.0, 0.0, 1.0};
  for (const double x : kOffsets) {
    for (const double y : kOffsets) {
      for (const double z : kOffsets) {
        const Looked look = looked_at(view, centre + Vec3(x, y, z).cwiseProduct(half));
        looks += look == Looked::OutOfView ? 0 : 1;
        through += look == Looked::Through ? 1 : 0;
      }
    }
  }
  return looks >= kFewestLooks && through >= kThroughShare * looks;
}

}  // namespace tern
