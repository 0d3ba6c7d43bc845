#include <algorithm>
#include <memory>

#include "mavlink/app/mavlink_node.h"
#include "runtime/command_line.h"
#include "runtime/keys.h"
#include "runtime/process.h"

int main(int argc, char** argv) {
  using namespace tern::mavlink;
  std::string url, key_file, odometry_url;
  const tern::ProcessDescription description{
      .name = "tern-mavlink",
      .section = "mavlink",
      .summary = "Flies SETPOINT with an autopilot over MAVLink, and publishes UAV_STATE and VEHICLE_STATUS",
      .add_options =
          [&](tern::CommandLine& app) {
            app.add_option("--connect", url,
                           "udp://ADDRESS:PORT (listens), udp://ADDRESS:PORT@ADDRESS:PORT (listens and sends first), "
                           "udpout://ADDRESS:PORT, serial:///dev/NAME:BAUD");
            app.add_option("--odometry", odometry_url,
                           "With `mavlink.odometry: companion`, where the other estimator sends its ODOMETRY: a URL as "
                           "of --connect");
            app.add_option("--signing-key", key_file,
                           "Sign MAVLink frames with this secret (file of 32 bytes, mode 600)");
          },
      .read_section = [](tern::ConfigSection section) { section.read<BridgeConfig>(); }};
  return tern::run_process(argc, argv, description, [&](tern::ProcessContext& context) -> std::unique_ptr<tern::Node> {
    const auto config = context.section.read<BridgeConfig>();
    std::optional<SigningKey> key;
    if (!key_file.empty()) {
      const tern::Key secret = tern::value_or_throw(tern::read_master_key(key_file));
      key.emplace();
      std::copy(secret.bytes().begin(), secret.bytes().end(), key->secret.begin());
      key->sha256 = tern::sha256;
    }
    if (url.empty()) throw tern::ConfigError("--connect URL is required");
    constexpr tern::Duration kSecond{1'000'000};
    if (url.starts_with("serial://") && context.bus.clock().in_system_time(kSecond) != kSecond) {
      throw tern::ConfigError("--pace: a real autopilot's clock cannot be slowed; use --pace 1");
    }
    auto link = tern::value_or_throw(open_link(url), "--connect ");
    if ((config.odometry == OdometrySource::Companion) == odometry_url.empty())
      throw tern::ConfigError("mavlink.odometry: companion and --odometry URL belong together");
    auto estimator =
        odometry_url.empty() ? nullptr : tern::value_or_throw(open_link(odometry_url, Peer::Estimator), "--odometry ");
    return std::make_unique<MavlinkNode>(context.bus, std::move(link), context.scenario.uav, config, key,
                                         std::move(estimator));
  });
}
