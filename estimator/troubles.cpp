#include "estimator/estimate.h"

namespace tern {

std::string to_text(Trouble trouble) {
  switch (trouble) {
    case Trouble::ImuNotFinite:
      return "an IMU sample is not finite or beyond the range of any IMU: not used; check the driver";
    case Trouble::ImuOrder: return "an IMU sample is not newer than the one before: not used; send samples in order";
    case Trouble::ImuGap: return "IMU samples are missing: bridged with more uncertainty; check rate and transport";
    case Trouble::ImuSaturated: return "the IMU is saturated: used with more uncertainty; choose a larger range";
    case Trouble::FrameNotFinite:
      return "features or the camera's pose are not finite or out of range: not used; check the tracker";
    case Trouble::FrameLate:
      return "a frame is older than the filter's state: not used; send frames in order, within 0.25 s";
    case Trouble::FrameAhead: return "frames are ahead of the IMU: not used; compare the clocks of camera and IMU";
    case Trouble::RepeatedIds:
      return "an id occurs twice in a frame: the second feature is not used; give each track its own id";
    case Trouble::CameraStuck: return "the camera sends the same image again: not used; restart the camera";
    case Trouble::CamerasSwapped: return "disparities are negative: not used; exchange the left and the right camera";
    case Trouble::TracksContradict:
      return "most features contradict the IMU: not used; check the camera's clock and calibration, mask movers";
    case Trouble::FixNotFinite:
      return "a position fix is not finite, or its variance is not positive: not used; check its driver";
    case Trouble::FixLate:
      return "a position fix is older than all poses in the filter: not used; send it within 0.5 s";
    case Trouble::FixAhead: return "position fixes are ahead of the IMU: not used; compare the clocks";
    case Trouble::FixContradicts:
      return "a position fix contradicts the estimate: not used; check its frame and its variance";
    case Trouble::NotAtRest: return "the vehicle moves: the estimate begins after a rest; let it stand";
  }
  return "unknown trouble";
}

}  // namespace tern
