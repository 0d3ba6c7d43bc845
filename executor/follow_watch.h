// Judges whether the vehicle is where the committed trajectory says.
#pragma once

#include <cstdint>

#include "core/base/time.h"
#include "core/world/vehicle.h"
#include "executor/tube.h"

namespace tern {

/// A vehicle that is outside its tube by more than this must rejoin, m. Below it, its controller brings it back. While
/// the vehicle does not follow, it is the largest distance from the setpoint.
inline constexpr double kRejoinBeyond = 0.1;

/// A measured state, and the committed state of the same time.
struct TrackedState {
  MotionSample measured, committed;  ///< W
  Vec3 tube;                         ///< width per axis, m; zero: the vehicle flies the trajectory exactly
  bool after_silence = false;        ///< the first state since no setpoints were published
  bool follows = false;              ///< as the executor has decided
  bool reports_following = false;    ///< as the newest VEHICLE_STATUS says
};

/// The first row of FollowWatch's table that applies.
enum class Following : std::uint8_t { Unsure, Departed, OldMessages, Carried, Held, Lost, Outside, Inside };

/// Judges UAV_STATEs. The *persistent error* is PersistentError's; the *excess* is the error minus the tube.
///
/// | answer      | the state                                                            | effect                   |
/// |-------------|----------------------------------------------------------------------|--------------------------|
/// | Unsure      | off by more than kRejoinBeyond, but the persistent error is smaller  | none: noise, or forged   |
/// | Departed    | after a silence: outside the tube                                    | rejoin                   |
/// | Departed    | after a silence: in another motion, with an empty tube               | rejoin                   |
/// | OldMessages | does not follow, but VEHICLE_STATUS reports that it does             | none: flies to the end   |
/// | Carried     | does not follow, persistent error above kRejoinBeyond                | rejoin, without a count  |
/// | Held        | does not follow                                                      | none                     |
/// | Lost        | persistent error more than kRejoinBeyond outside the tube            | rejoin                   |
/// | Outside     | this state and the one before are outside the tube                   | the tube is widened      |
/// | Inside      | any other                                                            | the tube is measured     |
class FollowWatch {
 public:
  struct Judgement {
    Following answer = Following::Unsure;
    Vec3 error = Vec3::Zero();  ///< persistent, per axis, m
    bool outside = false;       ///< the row Outside applies; also if the answer is Lost
    bool leaves = false;        ///< the first such state
  };
  /// @param received  receive time, ascending
  Judgement judge(const TrackedState& state, UTime received);
  /// Number of times that the vehicle has left its tube.
  [[nodiscard]] std::int64_t exits() const { return exits_; }

 private:
  PersistentError persistent_;
  Vec3 excess_ = Vec3::Zero();  ///< of the newest state, m
  bool outside_ = false;
  std::int64_t exits_ = 0;
};

}  // namespace tern
