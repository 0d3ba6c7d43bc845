// Samples a spline, asks for a hull and a separating plane: exit code 0 if all three are right.
#include "core/geometry/convex_hull.h"
#include "core/geometry/separation.h"
#include "core/splines/clamped_spline.h"

int main() {
  const tern::ClampedSpline spline = tern::at_rest(tern::Vec3(5.0, 0.0, 1.0), 6, 0.25);
  const bool sampled = spline.sample(0.8).p == tern::Vec3(5.0, 0.0, 1.0);

  tern::Points cube(3, 9);  // eight corners and the centre
  for (int i = 0; i < 8; ++i) cube.col(i) = tern::Vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  cube.col(8).setConstant(0.5);
  const tern::Points hull = tern::hull_vertices(cube);

  const bool separated = tern::separate(hull, spline.minvo(0), 0.5).has_value();
  return sampled && hull.cols() == 8 && separated ? 0 : 1;
}
