// Feature tracks as a camera's front end would deliver them: found, followed, lost, and sometimes wrong.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/knobs.h"
#include "core/base/random.h"
#include "simulator/inertial/landmarks.h"

namespace tern {

/// The section `simulator.vio.tracks`.
struct TrackSpec {
  int at_most = 150;
  double apart_px = 40.0;
  double noise_px = 1.0;
  double lost = 0.02;
  double wrong = 0.002;
  template <typename V>
  void visit(V& v) {
    v("at_most", at_most, Range{0, 1000}, "largest number of tracks");
    v("apart_px", apart_px, Range{1.0, 1000.0}, "a new track begins in a cell of this size that has none, pixels");
    v("noise_px", noise_px, Range{0.0, 20.0}, "standard deviation of a measured coordinate, pixels");
    v("lost", lost, Range{0.0, 1.0}, "probability per frame that a track is lost");
    v("wrong", wrong, Range{0.0, 1.0},
      "probability per frame that a track slips to another point, up to 20 pixels away");
  }
};

/// One track in one frame.
struct SimulatedTrack {
  std::int64_t id = 0;  ///< > 0, ascending
  std::uint64_t landmark = 0;
  SurfaceClass surface = SurfaceClass::Ground;
  Eigen::Vector2d left = Eigen::Vector2d::Zero();   ///< measured, pixels
  Eigen::Vector2d right = Eigen::Vector2d::Zero();  ///< the same in the right image, with in_right
  bool in_right = false;
  bool slipped = false;  ///< it no longer follows its landmark
};

/// Follows landmarks from frame to frame.
///
/// 1. A track ends if its landmark is not seen (CameraFrame). Each other track ends with probability `lost`.
/// 2. A track slips with probability `wrong`: from then on it is a constant number of pixels off.
/// 3. New tracks begin in image cells without a track, on the landmarks with the least hash, up to `at_most` tracks.
/// 4. Each of the four coordinates is measured with normal noise.
///
/// A landmark that is seen again gets a new id. Deterministic from the seed and the frames.
class TrackSimulator {
 public:
  static constexpr double kSlip = 20.0;  ///< largest slip per axis, pixels

  TrackSimulator(const TrackSpec& spec, std::uint64_t seed) : spec_(spec), rng_(seed) {}
  /// @param landmarks  by id ascending, all that the frame may see
  /// @return the tracks by id ascending
  std::vector<SimulatedTrack> observe(const CameraFrame& frame, const std::vector<Landmark>& landmarks);

 private:
  struct Followed {
    std::int64_t id = 0;
    std::uint64_t landmark = 0;
    Eigen::Vector2d slip = Eigen::Vector2d::Zero();
  };
  SimulatedTrack measure(const Followed& track, const Landmark& landmark, const StereoPixel& pixel);
  void follow(const CameraFrame& frame, const std::vector<Landmark>& landmarks, std::vector<SimulatedTrack>& to);
  void begin(const CameraFrame& frame, const std::vector<Landmark>& landmarks, std::vector<SimulatedTrack>& to);

  TrackSpec spec_;
  Rng rng_;
  std::int64_t last_id_ = 0;
  std::vector<Followed> followed_;  ///< by id ascending
};

}  // namespace tern
