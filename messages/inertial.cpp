#include "core/world/inertial.h"

#include <numbers>

#include "core/world/pose_error.h"
#include "messages/form.h"
#include "messages/quaternion_fields.h"
#include "tern_msgs/feature_tracks_t.hpp"
#include "tern_msgs/imu_t.hpp"
#include "tern_msgs/odometry_t.hpp"
#include "tern_msgs/pose_error_t.hpp"
#include "tern_msgs/position_fix_t.hpp"

namespace tern {
namespace {

constexpr double kMaxVariance = kMaxCoordinate * kMaxCoordinate;

void vector_fields(auto& io, const char* name, auto& m, auto& x) {
  io.vec3(name, m, x, -kMaxCoordinate, kMaxCoordinate);
}

template <std::size_t n>
void covariance_fields(auto& io, const char* name, auto& m, auto& x) {
  for (std::size_t k = 0; k < n; ++k) io.number(name, m[k], x[k], -kMaxVariance, kMaxVariance);
}

}  // namespace

template <>
struct wire::Form<ImuBatch> {
  using Message = tern_msgs::imu_t;
  static_assert(Message::MAX_SAMPLES == kMaxImuSamples);
  static constexpr Layout kLayout{Array{&Message::sample_count, &Message::samples, 1, kMaxImuSamples}};

  static void fields(auto& io, auto& m, auto& batch) {
    io.header("header", m.header, batch.header);
    io.integer("sensor_id", m.sensor_id, batch.sensor_id, 0, std::numeric_limits<std::int32_t>::max());
    io.number("saturation_rate", m.saturation_rate, batch.saturation_rate, 0.0, kMaxCoordinate);
    io.number("saturation_force", m.saturation_force, batch.saturation_force, 0.0, kMaxCoordinate);
    io.list("samples", m.samples, batch.samples, [&io](auto& s, auto& sample) {
      io.time("at_us", s.at_us, sample.at);
      vector_fields(io, "angular_velocity", s.angular_velocity, sample.angular_velocity);
      vector_fields(io, "specific_force", s.specific_force, sample.specific_force);
    });
  }

  static void read_rest(FieldReader& read, const Message&, ImuBatch& batch) {
    for (std::size_t k = 1; k < batch.samples.size(); ++k)
      read.in_order(batch.samples[k - 1].at < batch.samples[k].at, "the samples are not in ascending order of time");
  }
};

template <>
struct wire::Form<FeatureFrame> {
  using Message = tern_msgs::feature_tracks_t;
  static_assert(Message::MAX_FEATURES == kMaxFeatures);
  static constexpr Layout kLayout{Array{&Message::feature_count, &Message::features, 0, kMaxFeatures}};

  static void fields(auto& io, auto& m, auto& frame) {
    io.header("header", m.header, frame.header);
    io.time("at_us", m.at_us, frame.at);
    io.integer("sensor_id", m.sensor_id, frame.sensor_id, 0, std::numeric_limits<std::int32_t>::max());
    vector_fields(io, "p_bc", m.p_bc, frame.p_BC);
    quaternion_fields(io, m, frame.q_BC);
    io.number("baseline", m.baseline, frame.baseline_m, kAboveZero, kMaxCoordinate);
    io.number("sigma", m.sigma, frame.sigma, kAboveZero, kMaxCoordinate);
    io.list("features", m.features, frame.features, [&io](auto& f, auto& feature) {
      io.integer("id", f.id, feature.id, 0, kMaxCounter);
      io.number("left_x", f.left_x, feature.left.x(), -kMaxCoordinate, kMaxCoordinate);
      io.number("left_y", f.left_y, feature.left.y(), -kMaxCoordinate, kMaxCoordinate);
      io.number("right_x", f.right_x, feature.right.x(), -kMaxCoordinate, kMaxCoordinate);
      io.number("right_y", f.right_y, feature.right.y(), -kMaxCoordinate, kMaxCoordinate);
      io.flag("has_right", f.has_right, feature.has_right);
    });
  }

  static void read_rest(FieldReader& read, const Message&, FeatureFrame& frame) {
    read.consistent(is_unit(frame.q_BC), "the quaternion has not the length 1");
    std::vector<std::int64_t> ids;
    ids.reserve(frame.features.size());
    for (const StereoFeature& feature : frame.features) ids.push_back(feature.id);
    read.all_different(std::move(ids), "two features have the id");
  }
};

template <>
struct wire::Form<PositionFix> {
  using Message = tern_msgs::position_fix_t;
  static constexpr Layout<Message> kLayout{};

  static void fields(auto& io, auto& m, auto& fix) {
    io.header("header", m.header, fix.header);
    io.time("at_us", m.at_us, fix.at);
    io.integer("sensor_id", m.sensor_id, fix.sensor_id, 0, std::numeric_limits<std::int32_t>::max());
    io.position("position", m.position, fix.position);
    io.vec3("variance", m.variance, fix.variance, kAboveZero, kMaxVariance);
    io.flag("has_yaw", m.has_yaw, fix.has_yaw);
    io.number("yaw", m.yaw, fix.yaw, -std::numbers::pi, std::numbers::pi);
    io.number("yaw_variance", m.yaw_variance, fix.yaw_variance, kAboveZero, kMaxVariance);
  }
};

template <>
struct wire::Form<Odometry> {
  using Message = tern_msgs::odometry_t;
  static_assert(Message::LOST == static_cast<int>(EstimatorState::Lost));
  static constexpr Layout<Message> kLayout{};

  static void fields(auto& io, auto& m, auto& odometry) {
    io.header("header", m.header, odometry.header);
    io.time("at_us", m.at_us, odometry.at);
    io.enumeration("state", m.state, odometry.state, EstimatorState::Lost);
    io.counter("epoch", m.epoch, odometry.epoch);
    io.position("p_ob", m.p_ob, odometry.p_OB);
    quaternion_fields(io, m, odometry.q_OB);
    vector_fields(io, "v_ob", m.v_ob, odometry.v_OB);
    vector_fields(io, "angular_velocity", m.angular_velocity, odometry.angular_velocity);
    io.position("p_wo", m.p_wo, odometry.p_WO);
    io.number("yaw_wo", m.yaw_wo, odometry.yaw_WO, -std::numbers::pi, std::numbers::pi);
    vector_fields(io, "gyroscope_bias", m.gyroscope_bias, odometry.gyroscope_bias);
    vector_fields(io, "accelerometer_bias", m.accelerometer_bias, odometry.accelerometer_bias);
    covariance_fields<36>(io, "pose_covariance", m.pose_covariance, odometry.pose_covariance);
    covariance_fields<9>(io, "velocity_covariance", m.velocity_covariance, odometry.velocity_covariance);
    covariance_fields<9>(io, "drift_covariance", m.drift_covariance, odometry.drift_covariance);
    io.integer("tracks", m.tracks, odometry.tracks, 0, std::numeric_limits<std::int32_t>::max());
    io.integer("rejected", m.rejected, odometry.rejected, 0, std::numeric_limits<std::int32_t>::max());
  }

  static void read_rest(FieldReader& read, const Message&, Odometry& odometry) {
    read.consistent(is_unit(odometry.q_OB), "the quaternion has not the length 1");
  }
};

template <>
struct wire::Form<PoseError> {
  using Message = tern_msgs::pose_error_t;
  static constexpr Layout<Message> kLayout{};

  static void fields(auto& io, auto& m, auto& error) {
    io.header("header", m.header, error.header);
    io.integer("set", m.set, error.set, 1, kMaxCounter);
    io.position("position", m.position, error.position);
    covariance_fields<36>(io, "pose_covariance", m.pose_covariance, error.pose_covariance);
    io.number("apart", m.apart, error.apart, 0.0, kMaxCoordinate);
  }
};

template Bytes encode(const ImuBatch& value);
template tl::expected<ImuBatch, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<ImuBatch>(std::span<const std::uint8_t> bytes);
template Bytes encode(const FeatureFrame& value);
template tl::expected<FeatureFrame, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<FeatureFrame>(std::span<const std::uint8_t> bytes);
template Bytes encode(const PositionFix& value);
template tl::expected<PositionFix, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<PositionFix>(std::span<const std::uint8_t> bytes);
template Bytes encode(const Odometry& value);
template tl::expected<Odometry, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<Odometry>(std::span<const std::uint8_t> bytes);
template Bytes encode(const PoseError& value);
template tl::expected<PoseError, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<PoseError>(std::span<const std::uint8_t> bytes);

}  // namespace tern
