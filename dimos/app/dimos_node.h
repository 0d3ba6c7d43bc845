// tern-dimos: a native module of DimOS as a process.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "dimos/app/dimos_network.h"
#include "dimos/app/outlet.h"
#include "dimos/dimos_config.h"
#include "ros_bridge/app/ros_inlet.h"
#include "runtime/bus.h"
#include "runtime/node.h"

namespace tern::dimos {

/// The options of tern-dimos.
struct DimosOptions {
  std::string url = kDefaultDimosUrl;
  std::string world_frame = "world";            ///< DimOS's name of its world
  std::string cloud_sensor;                     ///< see ros::IntakeContext
  std::map<std::string, std::string> channels;  ///< "/odom#geometry_msgs.PoseStamped" by the port's name
};

/// All ports, in the order of --help.
const std::vector<Port>& ports();

/// Passes messages between the bus and DimOS. It never waits for DimOS, and no message of DimOS ends it.
///
/// With the port `odom` it is the vehicle. With `cmd_vel` as well it flies the setpoints by velocities: while SETPOINT
/// and odometry are fresh and no other process is the vehicle. When that ends, and when this process ends, it sends
/// velocity 0 for kStopping, at least once, then nothing: the vehicle is free for others.
class DimosNode final : public Node {
 public:
  static constexpr Duration kStopping{500'000};

  /// @throws ConfigError for a channel of another type, or if LCM cannot be used
  DimosNode(Bus& bus, const UavSpec& uav, const DimosConfig& config, const DimosOptions& options);

  [[nodiscard]] UTime next_wakeup() const override { return next_; }
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;
  [[nodiscard]] bool end(UTime now) override;
  [[nodiscard]] std::optional<int> finished() const override {
    return is_ending_ && !commanded_ ? std::optional(0) : std::nullopt;
  }

 private:
  void subscribe(const DimosOptions& options);
  void receive(ros::Input input, const std::string& port, std::span<const std::uint8_t> bytes);
  void command(UTime now);
  void report(UTime now);
  /// Returns the velocity that flies the newest setpoint now; nullopt, with the reason, if there is none.
  [[nodiscard]] std::optional<ros::Twist> velocity(UTime now);

  Bus& bus_;
  DimosConfig config_;
  std::string cmd_vel_;  ///< channel; empty: velocities are not sent
  std::unique_ptr<DimosNetwork> network_;
  Outlet outlet_;
  ros::RosInlet inlet_;
  std::optional<UavState> setpoint_, state_;
  std::optional<UTime> commanded_;  ///< when a velocity was last sent; nullopt: the vehicle was told to stop since
  bool is_ending_ = false;          ///< it ends once the vehicle was told to stop
  UTime next_, next_command_, next_report_, next_cloud_;
  std::string why_still_;  ///< why no velocity is sent although a setpoint is there
  std::string trouble_;    ///< of the last report
};

}  // namespace tern::dimos
