// Landmarks: points on the world's surfaces that a camera can recognize, more of them where there is texture.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/base/knobs.h"
#include "core/base/random.h"
#include "core/scenario/region.h"
#include "simulator/inertial/camera_frame.h"
#include "simulator/worlds/world.h"

namespace tern {

/// The class of texture of a surface.
enum class SurfaceClass : std::uint8_t { Ground = 0, Region = 1, Obstacle = 2, Mover = 3, Horizon = 4 };

/// The section `simulator.vio.landmarks`.
struct LandmarkSpec {
  static constexpr double kMaxDensity = 50.0;  ///< 1/m²
  double ground = 1.0;
  double obstacles = 4.0;
  double movers = 8.0;
  double horizon = 0.0;
  double ground_z_m = 0.0;
  /// Density per class of region; a class that is not listed has the ground's.
  std::vector<std::pair<std::string, double>> regions = {{"texture", 8.0}, {"water", 0.03}};
  template <typename V>
  void visit(V& v) {
    v("ground", ground, Range{0.0, kMaxDensity}, "landmarks per m² of ground: 1 is lawn or asphalt, 0.03 a dark floor");
    v("obstacles", obstacles, Range{0.0, kMaxDensity}, "landmarks per m² of obstacles at rest");
    v("movers", movers, Range{0.0, kMaxDensity}, "landmarks per m² of obstacles that move; they move along");
    v("horizon", horizon, Range{0.0, 1000.0}, "far landmarks per radian of horizon; 0: fog, or a hall");
    v("ground_z_m", ground_z_m, Range{-1e4, 1e4}, "height of the ground, m");
  }
};

/// One landmark at one time.
struct Landmark {
  std::uint64_t id = 0;  ///< unique in a world, the same at all times
  SurfaceClass surface = SurfaceClass::Ground;
  SurfacePoint point;
};

/// The landmarks of a world: a Poisson process on its surfaces, a pure function of world, regions, spec and seed.
///
/// | surface                                | landmarks per m²; on the horizon per rad                   |
/// |----------------------------------------|------------------------------------------------------------|
/// | the plane z = ground_z_m               | `ground`; below a region, the density of the region's class |
/// | upright sides of a box or prism region | the density of its class                                   |
/// | the six faces of an obstacle           | `obstacles`, or `movers` if it ever moves                  |
/// | the horizon                            | `horizon`, within 0.05 rad of the eye's height             |
///
/// The sides of a region have landmarks only if its class is denser than the ground. They are seen from both sides, and
/// hide nothing. Where several regions lie over one point of the ground, the first one decides its density.
///
/// The ground consists of square cells. Each is drawn from a seed of its own at the largest density, then thinned to
/// the density of each place. A cell has therefore the same landmarks from every viewpoint, and only cells in view are
/// drawn.
class LandmarkField {
 public:
  static constexpr double kCell = 4.0;         ///< side of a cell of ground, m
  static constexpr double kHorizonM = 5000.0;  ///< distance of the horizon

  /// The world must outlive the field.
  LandmarkField(const World& world, const std::vector<Region>& regions, const LandmarkSpec& spec, std::uint64_t seed);

  /// Returns the landmarks within range_m of the eye and those of the horizon, by id ascending. Absent obstacles have
  /// none. Ground that is seen at a smaller angle than grazing_rad is left out.
  [[nodiscard]] std::vector<Landmark> around(const Vec3& eye, double range_m, double grazing_rad, double t_s);
  /// Landmarks per m² of the ground at (x, y).
  [[nodiscard]] double ground_density(double x, double y) const;

 private:
  struct OnObstacle {
    std::size_t obstacle = 0;
    std::uint64_t id = 0;
    Vec3 offset, normal;  ///< from the obstacle's centre
  };
  void add_ground(const Vec3& eye, double reach_m, std::vector<Landmark>& to);
  const std::vector<Landmark>& cell(int i, int j);
  void draw_sides(const Region& region, double density, std::uint64_t seed);
  void draw_side(const Vec3& from, const Vec3& to, double height, double density, Rng& rng);
  void draw_obstacle(std::size_t k, double density, std::uint64_t seed);
  void draw_horizon(std::uint64_t seed);
  std::uint64_t next_id() { return next_id_++; }

  const World* world_;
  std::vector<std::pair<Region, double>> regions_;
  LandmarkSpec spec_;
  std::uint64_t seed_;
  double largest_;  ///< density of ground
  std::uint64_t next_id_ = 0;
  std::vector<Landmark> fixed_;    ///< sides of regions
  std::vector<Landmark> horizon_;  ///< directions as points, relative to the eye
  std::vector<OnObstacle> on_obstacles_;
  std::unordered_map<std::uint64_t, std::vector<Landmark>> cells_;
};

/// Returns a number of the Poisson distribution with this mean, by counting exponential gaps. O(mean).
int poisson(Rng& rng, double mean);

}  // namespace tern
