// The front end of an estimator: follows corners through the images of a stereo pair.
#pragma once

#include <cstdint>
#include <memory>

#include "core/base/knobs.h"
#include "core/base/time.h"
#include "core/world/inertial.h"
#include "features/gray_image.h"
#include "features/stereo_rig.h"

namespace tern {

struct KltConfig {
  int at_most = 150;
  double apart_px = 30.0;
  double sigma_px = 1.0;

  template <typename V>
  void visit(V& v) {
    v("at_most", at_most, Range{10, kMaxFeatures}, "largest number of tracks");
    v("apart_px", apart_px, Range{8.0, 500.0},
      "a new track begins in a cell of this size that has none, and this far from all others, pixels");
    v("sigma_px", sigma_px, Range{0.1, 10.0},
      "stated standard deviation of a coordinate, pixels; FEATURE_TRACKS.sigma is this over the focal length");
  }
};

/// Counts of tracks in one frame.
struct KltReport {
  int followed = 0;      ///< tracks that go on
  int lost = 0;          ///< not found again, or found elsewhere by the backward check
  int contradicted = 0;  ///< ended, as they move unlike the surroundings
  int begun = 0;
  int with_right = 0;  ///< features that the right camera sees
};

/// Kanade-Lucas-Tomasi tracks in the left images, each matched in the right image of the same time.
///
/// 1. Flow: each track is followed from the last left image to this one by pyramidal Lucas-Kanade, and back. It ends if
///    it does not come back within kBackPx.
/// 2. Motion: tracks that move unlike the surroundings end (motion_check.h). If no motion explains most of them, all
///    go on.
/// 3. Corners: in each cell of apart_px without a track, the strongest corner by Shi and Tomasi begins one.
/// 4. Stereo: each feature is followed to the right image and back. It has a right view if both are on the same line of
///    the rectified pair, within kEpipolarPx, and the disparity is not below −kEpipolarPx.
///
/// J.-Y. Bouguet, "Pyramidal implementation of the Lucas Kanade feature tracker", 2000; J. Shi and C. Tomasi, "Good
/// features to track", 1994. Deterministic: the same images give the same features, by one build of OpenCV on one type
/// of processor.
class StereoTracker {
 public:
  static constexpr double kBackPx = 0.7;
  static constexpr double kEpipolarPx = 2.0;
  /// Least eigenvalue of a corner, as the root mean square of its gradient, grey values per pixel. The noise of a dark
  /// image (2 grey values) has half of it.
  static constexpr double kLeastGradient = 2.0;

  /// @param first_id  ids count up from here. Trackers of one camera that succeed each other must not share ids.
  StereoTracker(const StereoRig& rig, const KltConfig& config, std::int64_t first_id = 1);
  ~StereoTracker();
  StereoTracker(StereoTracker&&) noexcept;
  StereoTracker& operator=(StereoTracker&&) = delete;
  StereoTracker(const StereoTracker&) = delete;
  StereoTracker& operator=(const StereoTracker&) = delete;

  /// Returns the features of the next pair of images, by id ascending. The header is empty.
  /// @param at  the middle of the exposure
  /// @pre both images have the sizes of the rig's cameras (ImageCheck)
  FeatureFrame track(UTime at, const GrayImage& left, const GrayImage& right);
  /// Ends all tracks, as after a dark image. @return a frame without features
  FeatureFrame forget(UTime at);
  /// About the newest frame.
  [[nodiscard]] const KltReport& report() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tern
