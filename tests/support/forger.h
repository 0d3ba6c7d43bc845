// A stranger on the network of a virtual flight: it receives everything and sends forged bytes.
#pragma once

#include <lcm/lcm-cpp.hpp>
#include <map>
#include <string>

#include "messages/codec.h"
#include "runtime/virtual_runner.h"

namespace tern::testing {

class Forger {
 public:
  /// Starts to listen. It knows the last message of the true sender of each channel.
  explicit Forger(VirtualRunner& runner) : runner_(runner) {
    learn(channels::kPredictions);
    learn(channels::kDeclaredMotions);
    learn(channels::kHorizonRequest);
    learn(channels::kPlan);
    learn(channels::kGoal);
    learn(channels::kUavState);
    runner.observer().subscribe(channels::kHorizonRequest, [this](const HorizonRequest& heard) { request_ = heard; });
  }

  /// Returns a header with the true sender's epoch, its next number and the current time. Receivers cannot tell it
  /// from the true one.
  [[nodiscard]] Header next(const std::string& channel) const {
    const MessageName last = last_.at(channel);
    return {{last.sender_epoch_us, last.sequence + 1}, runner_.now()};
  }
  /// Returns the header of another sender that started a second ago.
  [[nodiscard]] Header foreign(std::int64_t sequence = 1) const {
    return {{runner_.now().us - 1'000'000, sequence}, runner_.now()};
  }
  [[nodiscard]] const HorizonRequest& newest_request() const { return request_; }

  template <class T>
  void send(const std::string& channel, T message, const Header& header) {
    message.header = header;
    const Bytes bytes = encode(message);
    runner_.network().publish(channel, bytes.data(), static_cast<unsigned>(bytes.size()));
  }

 private:
  template <class T>
  void learn(const Channel<T>& channel) {
    runner_.observer().subscribe(channel, [this, name = channel.name](const T& m) { last_[name] = m.header.name; });
  }

  VirtualRunner& runner_;
  std::map<std::string, MessageName> last_;
  HorizonRequest request_;
};

}  // namespace tern::testing
