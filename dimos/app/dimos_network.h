// DimOS's LCM network, whose channels and types Tern's bus does not know.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "core/base/result.h"

namespace lcm {
class LCM;
}

namespace tern::dimos {

/// DimOS's own default; the same group and port as Tern's.
inline constexpr char kDefaultDimosUrl[] = "udpm://239.255.76.67:7667?ttl=0";

/// Bytes by channel. Nothing is received except in poll().
class DimosNetwork {
 public:
  using Handler = std::function<void(std::span<const std::uint8_t> bytes)>;

  /// @return an Error with a remedy if LCM cannot be used
  static Result<std::unique_ptr<DimosNetwork>> open(const std::string& url);
  ~DimosNetwork();
  DimosNetwork(const DimosNetwork&) = delete;
  DimosNetwork& operator=(const DimosNetwork&) = delete;

  /// Calls `handler` for each message of a channel. @param waiting  LCM keeps this many messages, and drops newer ones
  void subscribe(const std::string& channel, int waiting, Handler handler);
  void publish(const std::string& channel, const std::string& bytes);
  /// Hands the messages that have arrived to their handlers.
  void poll();

 private:
  explicit DimosNetwork(std::shared_ptr<lcm::LCM> lcm);
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tern::dimos
