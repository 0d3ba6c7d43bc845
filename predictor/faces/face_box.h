// The box of one track, learnt face by face. docs/prediction/faces.md.
#pragma once

#include <array>
#include <limits>
#include <optional>

#include "core/base/types.h"
#include "core/world/sighting.h"
#include "predictor/faces/size_record.h"

namespace tern {

/// A known size follows measured ones by at least this share of the difference, and by more if it is less certain. If a
/// measured size is larger and disagrees, it is taken at once. A size that was measured kSureSize times never jumps: a
/// neighbour may have merged.
inline constexpr double kSizeFollows = 0.05;
inline constexpr int kSureSize = 5;

/// True for a bound that is a measured end of the obstacle.
constexpr bool is_end(BoundSight sight) { return sight == BoundSight::Face || sight == BoundSight::Whole; }

/// A sliver is a sighting of fewer points than this that has a cut or hidden bound. So few points fit any face, so none
/// of its bounds is trusted as an end.
inline constexpr int kSliverPoints = 16;
/// Returns the sighting. The ends of a sliver are marked as hidden.
Sighting without_false_ends(Sighting sighting);

/// Both ends of all axes must have been measured this often before the sizes are recorded.
inline constexpr int kMeasuredToRecord = 3;
/// Where no similar obstacle was seen whole, a hidden end lies at most this far beyond what was seen, m.
inline constexpr double kUnseenRest = 4.0;

/// One face of a box: its distance outwards from the anchor.
struct FaceReach {
  double reach = 0.0;  ///< m; before the first measurement: as far as the obstacle was seen
  double sigma = 0.0;  ///< of a measured reach, m
  int measured = 0;    ///< measurements; 0: the obstacle ends somewhere beyond `reach`, a hidden end
  /// Where space was seen to be empty: a hidden end lies nearer, m.
  double limit = std::numeric_limits<double>::infinity();
};
inline constexpr std::size_t kLowerFace = 0, kUpperFace = 1;

/// A position per axis with its variance; none along an axis without a measured end.
struct AnchorMeasurement {
  std::array<bool, 3> has{};
  Vec3 position = Vec3::Zero();  ///< W, m
  Vec3 variance = Vec3::Zero();  ///< m²
};

/// An axis-aligned box that moves with its *anchor*, a point of the obstacle. A filter estimates the anchor; this class
/// keeps the distances of the six faces from it.
///
/// - A measured end of a face with a known reach measures the anchor: bound − reach for the upper face.
/// - A reach changes only by measured *sizes*, where both ends of an axis are seen. So the extent is free of errors of
///   the filter, and the velocity is free of changes of the visible part.
/// - A face that was never measured is a hidden end. It lies at least as far out as the obstacle was seen, and nearer
///   than space that was seen to be empty. completed() puts it at the least place that the other axes suggest, whole()
///   at the farthest one that is likely.
class FaceBox {
 public:
  FaceBox() = default;
  /// @param anchor  receives the middle of the visible part
  FaceBox(const Sighting& sighting, Vec3& anchor);

  /// Returns the misfit between the sighting and the known faces, m, ≥ 0. It is the largest distance of a measured end
  /// from its face, or of any other bound that lies outside its face. Three standard deviations of a measured end and
  /// its face are left out.
  /// @param unknown  the least result if no end can be compared, m
  [[nodiscard]] double mismatch(const Vec3& anchor, const Sighting& sighting, double unknown) const;
  /// Returns the anchor by the measured ends whose reach is known. Where the two ends of an axis disagree with the
  /// known size, the one nearer to its prediction counts.
  [[nodiscard]] AnchorMeasurement measure(const Vec3& anchor, const Sighting& sighting) const;
  /// True if measure() would measure the anchor along an axis.
  [[nodiscard]] bool is_located_by(const Sighting& sighting) const;
  /// Learns reaches. @param anchor  after its update; @param axes  those that may be learnt
  void learn(const Vec3& anchor, const Sighting& sighting, const std::array<bool, 3>& axes = {true, true, true});

  /// Learns the faces of one axis anew, so that the anchor stays.
  void relearn(int axis, const Vec3& anchor, const Sighting& sighting);

  /// True if a face of the axis was ever measured. Otherwise position and velocity along the axis are unknown.
  [[nodiscard]] bool has_position(int axis) const;
  /// The number of axes with a position.
  [[nodiscard]] int positions() const {
    return (has_position(0) ? 1 : 0) + (has_position(1) ? 1 : 0) + (has_position(2) ? 1 : 0);
  }
  /// Returns the box about an anchor with its unseen rest completed. An axis is at least as long as the shorter of the
  /// other two that is measured at both ends, or else that was seen.
  /// @param sigmas  known faces lie farther out by this many standard deviations of their reach
  [[nodiscard]] Box completed(const Vec3& anchor, double sigmas = 0.0) const;
  /// Returns the box about an anchor that contains the whole obstacle. A hidden end lies as far out as the longest
  /// similar obstacle allows, or kUnseenRest beyond what was seen, but nearer than empty space.
  [[nodiscard]] Box whole(const Vec3& anchor, double sigmas, const SizeRecord& record) const;
  /// Returns the sizes if all ends were measured kMeasuredToRecord times.
  [[nodiscard]] std::optional<Vec3> measured_sizes() const;
  /// Limits hidden ends by the space that a view saw to be empty (open_ends.h).
  /// @param error  standard deviation of the box's place in the view, m
  void limit_hidden_ends(const SensorView& view, const Vec3& anchor, double error);

 private:
  using Axis = std::array<FaceReach, 2>;
  void learn_axis(Axis& axis, double anchor, const std::array<double, 2>& bounds, const std::array<double, 2>& sigmas,
                  const std::array<BoundSight, 2>& sights) const;
  [[nodiscard]] double least_size(int axis) const;
  [[nodiscard]] KnownSizes known_sizes() const;

  std::array<Axis, 3> axes_;
  std::array<bool, 3> has_depth_{};  // an axis of which more than the near face was seen
};

}  // namespace tern
