#include "dimos/app/dimos_network.h"

#include <deque>
#include <lcm/lcm-cpp.hpp>
#include <stdexcept>
#include <utility>

#include "dimos/channel.h"
#include "runtime/lcm_network.h"

namespace tern::dimos {

struct DimosNetwork::State {
  static void on_message(const lcm::ReceiveBuffer* buffer, const std::string&, const Handler* handler) {
    (*handler)({static_cast<const std::uint8_t*>(buffer->data), buffer->data_size});
  }

  std::shared_ptr<lcm::LCM> lcm;
  std::deque<Handler> handlers;  ///< LCM keeps pointers to them
};

DimosNetwork::DimosNetwork(std::shared_ptr<lcm::LCM> lcm) : state_(std::make_unique<State>()) {
  state_->lcm = std::move(lcm);
}

DimosNetwork::~DimosNetwork() = default;

Result<std::unique_ptr<DimosNetwork>> DimosNetwork::open(const std::string& url) {
  auto lcm = open_lcm(choose_lcm_url(url, nullptr));
  if (!lcm) return tl::unexpected(lcm.error());
  return std::unique_ptr<DimosNetwork>(new DimosNetwork(std::move(*lcm)));
}

void DimosNetwork::subscribe(const std::string& channel, int waiting, Handler handler) {
  const Handler& kept = state_->handlers.emplace_back(std::move(handler));
  lcm::Subscription* subscription = state_->lcm->subscribeFunction(pattern_of(channel), &State::on_message, &kept);
  if (subscription == nullptr) throw std::runtime_error("LCM cannot subscribe to " + channel);
  subscription->setQueueCapacity(waiting);
}

void DimosNetwork::publish(const std::string& channel, const std::string& bytes) {
  state_->lcm->publish(channel, bytes.data(), static_cast<unsigned int>(bytes.size()));
}

void DimosNetwork::poll() {
  constexpr int kMostAtOnce = 1'000;
  drain(*state_->lcm, kMostAtOnce);
}

}  // namespace tern::dimos
