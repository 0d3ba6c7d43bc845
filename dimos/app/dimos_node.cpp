#include "dimos/app/dimos_node.h"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <utility>

#include "dimos/channel.h"
#include "dimos/wire.h"
#include "messages/channels.h"
#include "runtime/config.h"
#include "runtime/log.h"

namespace tern::dimos {
namespace {

constexpr Duration kPollPeriod{2'000}, kCloudPeriod{50'000}, kReportPeriod{5'000'000};
/// SETPOINT has 100 Hz. Without one for this long nobody flies the vehicle.
constexpr Duration kSetpointSilence{200'000};
constexpr std::size_t kMostTrouble = 900;  // bytes; HEARTBEAT takes kMaxWaitingText

constexpr char kOdom[] = "odom", kCmdVel[] = "cmd_vel";

struct InPort {
  Port port;
  ros::Input input;
  int waiting;  ///< messages that LCM keeps
};

const std::vector<InPort>& in_ports() {
  using ros::Input;
  static const std::vector<InPort> kPorts = {
      {{"goal_request", {type_name(ros::PoseStamped::kName)}}, Input::Goal, 10},
      {{kOdom, {type_name(ros::PoseStamped::kName), type_name(ros::Odometry::kName)}}, Input::Odometry, 100},
      {{"following", {type_name(ros::Bool::kName)}}, Input::Following, 10},
      {{"detections", {type_name(ros::Detection3DArray::kName)}}, Input::Detections, 10},
      {{"lidar", {type_name(ros::PointCloud2::kName)}}, Input::Cloud, 2},
      {{"tf", {type_name(ros::TFMessage::kName)}}, Input::Transforms, 100}};
  return kPorts;
}

const std::string* channel_of(const DimosOptions& options, const std::string& port) {
  const auto found = options.channels.find(port);
  return found == options.channels.end() ? nullptr : &found->second;
}

/// Returns the input that a port is, by the type of its channel.
std::optional<ros::Input> input_of(const InPort& in, const DimosOptions& options) {
  const std::string* channel = channel_of(options, in.port.name);
  if (channel == nullptr) return std::nullopt;
  const bool is_pose = channel->ends_with("#" + type_name(ros::PoseStamped::kName));
  return in.port.name == kOdom && is_pose ? ros::Input::PoseOdometry : in.input;
}

/// Checks all channels. @throws ConfigError
DimosOptions checked(const DimosOptions& options) {
  for (const Port& port : ports()) {
    if (const std::string* channel = channel_of(options, port.name)) {
      value_or_throw(type_of_channel(*channel, port.types), "--" + port.name + ": ");
    }
  }
  for (const char* needing : {kCmdVel, "following"}) {
    if (channel_of(options, needing) != nullptr && channel_of(options, kOdom) == nullptr) {
      throw ConfigError(fmt::format("--{}: it is a part of the vehicle, which odom reports; add --odom", needing));
    }
  }
  return options;
}

std::set<ros::Input> inputs_of(const DimosOptions& options) {
  std::set<ros::Input> inputs;
  for (const InPort& in : in_ports()) {
    if (const auto input = input_of(in, options)) inputs.insert(*input);
  }
  return inputs;
}

Placement placement_of(const DimosConfig& config, const DimosOptions& options) {
  const WorldConfig& world = config.world;
  return {options.world_frame, Vec3(world.x, world.y, world.z), world.yaw_deg * M_PI / 180.0};
}

ros::InletOptions inlet_options(const DimosConfig& config, const DimosOptions& options) {
  ros::InletOptions in;
  in.detection_sigma_m = config.detection_sigma_m;
  in.detection_range_m = config.detection_range_m;
  in.cloud_range_m = config.cloud_range_m;
  in.cloud_sensor = options.cloud_sensor;
  in.keep_height = config.keep_height;
  in.world_frame = kTernFrame;
  in.placed = placement_of(config, options).transform();
  in.mode = "DimOS";
  return in;
}

}  // namespace

const std::vector<Port>& ports() {
  static const std::vector<Port> kPorts = [] {
    std::vector<Port> all;
    for (const InPort& in : in_ports()) all.push_back(in.port);
    all.push_back({kCmdVel, {type_name(ros::Twist::kName)}});
    for (const OutPort& out : out_ports()) all.push_back(out.port);
    return all;
  }();
  return kPorts;
}

DimosNode::DimosNode(Bus& bus, const UavSpec& uav, const DimosConfig& config, const DimosOptions& options)
    : bus_(bus),
      config_(config),
      network_(value_or_throw(DimosNetwork::open(checked(options).url), "--dimos_url: ")),
      outlet_(bus, *network_, placement_of(config, options), options.channels),
      inlet_(bus, inputs_of(options), inlet_options(config, options), uav),
      next_(bus.clock().now()),
      next_command_(next_),
      next_report_(next_ + kReportPeriod),
      next_cloud_(next_) {
  if (const std::string* channel = channel_of(options, kCmdVel)) cmd_vel_ = *channel;
  subscribe(options);
  bus.subscribe(channels::kSetpoint, [this](const UavState& setpoint) { setpoint_ = setpoint; });
  bus.subscribe(channels::kUavState, [this](const UavState& state) { state_ = state; });
  log::info("DimOS: {}", options.url);
}

void DimosNode::subscribe(const DimosOptions& options) {
  for (const InPort& in : in_ports()) {
    const auto input = input_of(in, options);
    if (!input) continue;
    network_->subscribe(*channel_of(options, in.port.name), in.waiting,
                        [this, input = *input, name = in.port.name](std::span<const std::uint8_t> bytes) {
                          receive(input, name, bytes);
                        });
  }
}

void DimosNode::receive(ros::Input input, const std::string& port, std::span<const std::uint8_t> bytes) {
  const UTime now = bus_.clock().now();
  if (input == ros::Input::Cloud) {
    if (now < next_cloud_) return;
    next_cloud_ = now + kCloudPeriod;
  }
  inlet_.receive(input, port, bytes, now,
                 []<class M>(std::span<const std::uint8_t> message) { return decode<M>(message); });
}

void DimosNode::step(UTime now) {
  if (now < next_) return;
  next_ = now + kPollPeriod;
  network_->poll();
  inlet_.step(now);
  outlet_.step(now);
  if (now >= next_command_ && !cmd_vel_.empty()) {
    next_command_ = now + Duration::from_seconds(1.0 / config_.rate_hz);
    command(now);
  }
  if (now >= next_report_) report(now);
}

std::optional<ros::Twist> DimosNode::velocity(UTime now) {
  why_still_.clear();
  if (is_ending_) return std::nullopt;
  if (!setpoint_ || !state_ || now - setpoint_->at > kSetpointSilence || now - state_->at > ros::kOldestOdometry) {
    return std::nullopt;
  }
  if (!inlet_.is_alone(now)) return std::nullopt;
  auto twist = velocity_command(*setpoint_, *state_, config_.following);
  if (!twist) {
    why_still_ =
        fmt::format("the setpoint is {:.2f} m from the vehicle, more than dimos.far_m = {} m: no velocity is sent",
                    (setpoint_->motion.p - state_->motion.p).norm(), config_.following.far_m);
  }
  return twist;
}

void DimosNode::command(UTime now) {
  const auto twist = velocity(now);
  if (twist) {
    commanded_ = now;
    network_->publish(cmd_vel_, encode(*twist));
  } else if (commanded_) {
    network_->publish(cmd_vel_, encode(ros::Twist()));
    if (now - *commanded_ > kStopping) commanded_.reset();
  }
}

bool DimosNode::end(UTime now) {
  if (is_ending_ || !commanded_) return true;
  is_ending_ = true;
  next_command_ = now;
  return false;
}

void DimosNode::report(UTime now) {
  next_report_ = now + kReportPeriod;
  trouble_ = inlet_.take_trouble();
  if (trouble_.size() > kMostTrouble) trouble_ = trouble_.substr(0, kMostTrouble) + " …";
  if (!trouble_.empty()) log::warn("{}", trouble_);
}

NodeHealth DimosNode::health() const {
  const std::string lacks = inlet_.waiting_for(bus_.clock().now());
  if (!lacks.empty()) return {ProcessState::Waiting, lacks};
  return {ProcessState::Ready, why_still_.empty() ? trouble_ : why_still_};
}

}  // namespace tern::dimos
