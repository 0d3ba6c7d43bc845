#include "predictor/faces/looked_for.h"

#include "perception/view.h"

namespace tern {

bool is_looked_through(const SensorView& view, const Box& box) {
  if (view.depths.empty()) return false;
  const Vec3 centre = box.center(), half = 0.5 * kLookedForShare * box.sizes();
  int looks = 0, through = 0;
  for (int k = 0; k < 27; ++k) {
    const Vec3 corner(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    const Looked look = looked_at(view, centre + corner.cwiseProduct(half));
    looks += look == Looked::OutOfView ? 0 : 1;
    through += look == Looked::Through ? 1 : 0;
  }
  return looks >= kFewestLooks && through >= kThroughShare * looks;
}

}  // namespace tern
