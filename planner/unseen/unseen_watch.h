// The field of unseen movers over a flight, as OBSTACLE_SIGHTINGS make it.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "core/wire/header.h"
#include "core/world/sighting.h"
#include "planner/unseen/unseen_field.h"
#include "planner/unseen/unseen_movers.h"

namespace tern {

/// The knowledge about unseen movers at one time.
struct UnseenKnowledge {
  std::optional<UnseenField> field;  ///< nullopt before the first picture: nothing is known
  UTime at;                          ///< time of the field, vehicle's clock
  MessageName first, last;           ///< the first and the last frame that was used
  std::int64_t pictures = 0;         ///< number of frames that were used
  double clear_radius = 0.0;         ///< of the ball about the first sensor that was clear at take-off, m; 0: none
};

/// The time of contact of a passively safe trajectory, s.
inline constexpr double kNoContact = std::numeric_limits<double>::infinity();

/// Returns the time to contact: when an unseen mover may touch the moving vehicle first on this trajectory, s after
/// t_s. It is kNoContact if none can before the vehicle rests (clear_until). Before the first picture it is 0.
/// @param radius  of the body about its vertical axis, m
double first_contact(const UnseenKnowledge& known, const TimedSpline& trajectory, UTime t_s, double radius);

/// Returns the radius of the cylinder about the vertical through the vehicle's position that contains the body, m.
double upright_radius(const Body& body);

/// Keeps an UnseenField in a window about the newest sensor. Its state depends on the frames alone, in their order.
///
/// | frame                                                          | effect                                        |
/// |----------------------------------------------------------------|-----------------------------------------------|
/// | its rows are not level (level_fan)                             | not used                                      |
/// | of one more sensor than kMostSensors                           | not used                                      |
/// | sooner than kPicturePeriod after the sensor's last used one    | not used: it would cost more than it shows    |
/// | the first used one, within the clear radius of the start       | a field with the clear ball of take-off begins |
/// | the first used one, elsewhere                                  | a field begins that knows nothing             |
/// | later than the field                                           | the field moves on to its time                |
/// | earlier than the field                                         | used with its age                             |
class UnseenWatch {
 public:
  static constexpr Duration kPicturePeriod{90'000};
  /// Frames of so many sensors are used. One whose last used frame is older than this does not count.
  static constexpr std::size_t kMostSensors = 64;
  static constexpr Duration kSensorForgotten{10'000'000};
  /// The window follows the sensor in steps of this many cells.
  static constexpr int kWindowStep = 8;

  /// @param start  of the vehicle, W: it takes off there
  UnseenWatch(const UnseenMovers& movers, const Vec3& start);

  /// @return whether the frame was used
  bool add(const SightingSet& frame);
  [[nodiscard]] const UnseenKnowledge& knowledge() const { return known_; }

 private:
  void begin(const SightingSet& frame);
  void follow(const Eigen::Vector2d& eye);

  UnseenMovers movers_;
  Eigen::Vector2d start_;
  UnseenKnowledge known_;
  std::map<std::pair<std::int64_t, std::int32_t>, UTime> used_;  ///< by sender epoch and sensor: its last used frame
};

}  // namespace tern
