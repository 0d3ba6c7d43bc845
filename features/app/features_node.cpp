#include "features/app/features_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "features/app/image_file.h"
#include "messages/channels.h"
#include "messages/codec.h"
#include "runtime/config.h"
#include "runtime/log.h"
#include "runtime/stopwatch.h"

namespace tern {
namespace {

StereoCalibration calibration_of(const FeaturesConfig& config, const Eigen::Matrix3d& R_BI) {
  if (!config.calibration.empty()) return read_kalibr_calibration(config.calibration, R_BI);
  if (config.recording.empty()) throw ConfigError("features.calibration: live cameras need a camera chain of Kalibr");
  return read_euroc_calibration(mav0_of(config.recording), R_BI);
}

ImageCheck::Size size_of(const CameraModel& model) { return {model.width, model.height}; }

}  // namespace

FeaturesNode::FeaturesNode(Bus& bus, const FeaturesConfig& config)
    : bus_(bus),
      config_(config),
      R_BI_(body_from_imu(config.body_axes)),
      calibration_(calibration_of(config, R_BI_)),
      // Ids go on upwards when the process is started again.
      tracker_(calibration_.rig, config.tracks, bus.epoch_us()),
      check_(size_of(calibration_.rig.left().model), size_of(calibration_.rig.right().model)),
      image_shift_(Duration::from_seconds(config.time_shift_s + calibration_.time_shift_s)),
      next_poll_(bus.clock().now()) {
  if (config.recording.empty() == config.left.empty()) {
    throw ConfigError("features: either `recording` or `left` must be given");
  }
  if (config.recording.empty()) {
    live_ = std::make_unique<LiveCameras>(bus.clock(), config.left, config.right);
    return;
  }
  recording_ = read_image_recording(mav0_of(config.recording), config.imu);
  const UTime begin = recording_.pairs.front().at + Duration::from_seconds(config.from_s);
  const auto first = std::ranges::find_if(recording_.pairs, [begin](const auto& pair) { return pair.at >= begin; });
  if (first == recording_.pairs.end()) throw ConfigError("features.from_s: the recording is shorter");
  recording_.pairs.erase(recording_.pairs.begin(), first);
  std::erase_if(recording_.samples, [begin](const ImuSample& sample) { return sample.at < begin; });
  play_shift_ = bus.clock().now() - begin;
  log::info("plays {} pairs of images and {} IMU samples over {:.1f} s; {} left images have no right one",
            recording_.pairs.size(), recording_.samples.size(), (recording_.pairs.back().at - begin).seconds(),
            recording_.unpaired);
}

std::optional<UTime> FeaturesNode::next_recorded() const {
  if (next_pair_ == recording_.pairs.size()) return std::nullopt;
  const UTime pair = recording_.pairs[next_pair_].at;
  return next_sample_ == recording_.samples.size() ? pair : std::min(pair, recording_.samples[next_sample_].at);
}

UTime FeaturesNode::next_wakeup() const {
  if (live_) return next_poll_;
  const auto next = next_recorded();
  return next ? *next + play_shift_ : kNever;
}

void FeaturesNode::step(UTime now) {
  if (!live_) return play(now);
  if (now < next_poll_) return;
  next_poll_ = now + kPoll;
  if (const auto pair = live_->take()) use(pair->at + image_shift_, pair->left, pair->right);
}

/// Sends what is due up to the next pair of images; a later pair waits for the next step, so the node stays responsive.
void FeaturesNode::play(UTime now) {
  const UTime recorded = now - play_shift_;
  const auto next = next_recorded();
  if (!next || *next > recorded) return;
  const RecordedPair& pair = recording_.pairs[next_pair_];
  send_samples(std::min(recorded, pair.at));
  if (pair.at > recorded) return;
  late_ = recorded - pair.at;
  play_pair(pair);
  if (++next_pair_ == recording_.pairs.size()) log_summary();
}

void FeaturesNode::play_pair(const RecordedPair& pair) {
  const Result<GrayImage> left = read_gray_image(pair.left), right = read_gray_image(pair.right);
  if (!left) return note(left.error().message);
  if (!right) return note(right.error().message);
  use(pair.at + play_shift_ + image_shift_, *left, *right);
}

void FeaturesNode::send_samples(UTime until) {
  ImuBatch batch;
  batch.sensor_id = config_.sensor;
  const auto send = [&] {
    if (!batch.samples.empty()) bus_.publish(channels::kImu, batch);
    batch.samples.clear();
  };
  for (; next_sample_ < recording_.samples.size(); ++next_sample_) {
    const ImuSample& sample = recording_.samples[next_sample_];
    if (sample.at > until) break;
    batch.samples.push_back({sample.at + play_shift_, R_BI_ * sample.angular_velocity, R_BI_ * sample.specific_force});
    if (std::ssize(batch.samples) == kMaxImuSamples) send();
  }
  send();
}

void FeaturesNode::use(UTime at, const GrayImage& left, const GrayImage& right) {
  last_pair_ = bus_.clock().now();
  const double before = thread_cpu_ms();
  const auto trouble = check_.check(at, left, right);
  const bool is_blind = trouble == ImageTrouble::Dark || trouble == ImageTrouble::Saturated;
  if (trouble) note(to_text(*trouble));
  if (trouble && !is_blind) return;
  FeatureFrame frame = is_blind ? tracker_.forget(at) : tracker_.track(at, left, right);
  cpu_ms_ += thread_cpu_ms() - before;
  frame.sensor_id = config_.sensor;
  ++frames_;
  features_ += std::ssize(frame.features);
  begun_ += tracker_.report().begun;
  bus_.publish(channels::kFeatureTracks, std::move(frame));
}

void FeaturesNode::note(std::string trouble) {
  if (trouble != trouble_) log::warn("{}", trouble);
  trouble_ = std::move(trouble);
  trouble_at_ = bus_.clock().now();
}

void FeaturesNode::log_summary() const {
  log::info(
      "the recording has ended: {} frames, {:.0f} features each, tracks of {:.1f} frames, {:.1f} ms of CPU a frame",
      frames_, static_cast<double>(features_) / static_cast<double>(std::max<std::int64_t>(frames_, 1)),
      static_cast<double>(features_) / static_cast<double>(std::max<std::int64_t>(begun_, 1)),
      cpu_ms_ / static_cast<double>(std::max<std::int64_t>(frames_, 1)));
}

std::optional<int> FeaturesNode::finished() const {
  if (live_ || next_recorded()) return std::nullopt;
  return 0;
}

NodeHealth FeaturesNode::health() const {
  const UTime now = bus_.clock().now();
  const LiveStatus live = live_ ? live_->status() : LiveStatus{};
  if (!live.trouble.empty()) return {ProcessState::Waiting, live.trouble};
  if (live_ && (!last_pair_ || now - *last_pair_ > kSilence)) return {ProcessState::Waiting, "images of the cameras"};
  if (trouble_at_ && now - *trouble_at_ <= kTroubleShown) return {ProcessState::Waiting, trouble_};
  if (late_ > kLate) {
    return {ProcessState::Ready, fmt::format("the recording is played {:.1f} s late: use --pace", late_.seconds())};
  }
  if (live.skipped > 0) {
    return {ProcessState::Ready,
            fmt::format("{} pairs were skipped: they come faster than they are handled", live.skipped)};
  }
  return {ProcessState::Ready, ""};
}

}  // namespace tern
