// The node of tern-features: images in, feature tracks out.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "features/app/calibration.h"
#include "features/app/features_config.h"
#include "features/app/image_recording.h"
#include "features/app/live_cameras.h"
#include "features/image_check.h"
#include "features/stereo_tracker.h"
#include "runtime/bus.h"
#include "runtime/node.h"

namespace tern {

/// Publishes FEATURE_TRACKS for each pair of images of a recording or of live cameras. With a recording it publishes
/// IMU as well, and finishes with code 0 after the last image.
///
/// A recording is played in its own time. Its first image is at the time when the node began, and all other times are
/// shifted by the same span. Messages are sent in the order of the recorded times, so a machine that is too slow plays
/// late, and still sends the same features.
///
/// | input                                                    | effect                                              |
/// |----------------------------------------------------------|-----------------------------------------------------|
/// | a pair of images                                         | FEATURE_TRACKS                                      |
/// | a black or white image                                   | FEATURE_TRACKS without features; all tracks end     |
/// | a file that is missing or no image, or another ImageTrouble | not used; HEARTBEAT names it for kTroubleShown   |
/// | a left image without a right one                         | not used; counted in the log                        |
/// | no pair from live cameras for kSilence                   | HEARTBEAT is WAITING                                |
class FeaturesNode final : public Node {
 public:
  static constexpr Duration kTroubleShown{5'000'000}, kSilence{500'000};
  /// How often live cameras are asked for a pair.
  static constexpr Duration kPoll{2'000};
  /// HEARTBEAT says that a recording is played late from here on.
  static constexpr Duration kLate{200'000};

  /// @throws ConfigError if the calibration or the recording cannot be read.
  FeaturesNode(Bus& bus, const FeaturesConfig& config);

  [[nodiscard]] UTime next_wakeup() const override;
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;
  [[nodiscard]] std::optional<int> finished() const override;

 private:
  [[nodiscard]] std::optional<UTime> next_recorded() const;
  void play(UTime now);
  void play_pair(const RecordedPair& pair);
  void send_samples(UTime until);
  void use(UTime at, const GrayImage& left, const GrayImage& right);
  void note(std::string trouble);
  void log_summary() const;

  Bus& bus_;
  FeaturesConfig config_;
  Eigen::Matrix3d R_BI_;
  StereoCalibration calibration_;
  StereoTracker tracker_;
  ImageCheck check_;
  Duration image_shift_;
  ImageRecording recording_;
  std::size_t next_pair_ = 0, next_sample_ = 0;
  Duration play_shift_, late_;
  std::unique_ptr<LiveCameras> live_;
  UTime next_poll_;
  std::optional<UTime> last_pair_, trouble_at_;
  std::string trouble_;
  std::int64_t frames_ = 0, features_ = 0, begun_ = 0;
  double cpu_ms_ = 0.0;
};

}  // namespace tern
