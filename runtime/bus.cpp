#include "runtime/bus.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <deque>
#include <exception>
#include <lcm/lcm-cpp.hpp>
#include <mutex>
#include <stdexcept>

#include "core/wire/message_limits.h"
#include "core/world/names.h"
#include "messages/refused_field.h"
#include "runtime/authentication.h"
#include "runtime/log.h"
#include "runtime/node.h"
#include "runtime/sender_watch.h"

namespace tern {
namespace {

constexpr Duration kLogInterval{1'000'000};

void check_name(std::string_view name) {
  if (Bus::is_channel_name(name)) return;
  throw std::invalid_argument(
      fmt::format("channel name \"{}\": only letters, digits, '_' and '-', at most {} of them", name, kMaxChannelName));
}

/// Admits a log line at most once per kLogInterval and counts the events between.
class LogLimiter {
 public:
  /// @return how many events this line stands for, or nullopt if it is too soon.
  std::optional<std::int64_t> admit(UTime now, std::int64_t events = 1) {
    pending_ += events;
    if (last_ && now - *last_ < kLogInterval && now >= *last_) return std::nullopt;
    last_ = now;
    return std::exchange(pending_, 0);
  }

 private:
  std::optional<UTime> last_;
  std::int64_t pending_ = 0;
};

/// Counts refusals in spans of a second, for HEARTBEAT.
class RefusalRate {
 public:
  /// @param why  in words
  void add(UTime now, std::string why, std::int64_t times) {
    if (now - begun_ > kSenderTroubleReported || count_ == 0) *this = {};
    if (count_ == 0) begun_ = now;
    count_ += times;
    last_ = now;
    why_ = std::move(why);
    if (now - begun_ < kLogInterval) return;
    per_second_ = static_cast<double>(count_ - times) / (now - begun_).seconds();
    count_ = times;
    begun_ = now;
  }
  /// @return "30/s refused: position.y is nan"; empty unless something was refused several times, and recently.
  [[nodiscard]] std::string text(UTime now) const {
    constexpr int kSeveral = 3;
    if (now - last_ > kSenderTroubleReported) return "";
    if (per_second_ > 0.0) return fmt::format("{:.0f}/s refused: {}", std::max(per_second_, 1.0), why_);
    return count_ < kSeveral ? "" : fmt::format("{} refused: {}", count_, why_);
  }

 private:
  std::int64_t count_ = 0;  // since begun_
  UTime begun_, last_;
  double per_second_ = 0.0;
  std::string why_;
};

/// Why a message of a channel is refused: the reason, and the field if it is known.
std::string describe(std::string_view channel, Rejection reason, std::span<const std::uint8_t> bytes) {
  std::string field;
  visit_channel(channel, [&]<class T>(const Channel<T>&) { field = refused_field<T>(bytes); });
  return field.empty() ? to_string(reason) : field;
}

/// How many elements of an accepted message were left out.
std::int32_t left_out(std::string_view channel, std::span<const std::uint8_t> bytes) {
  return channel == channels::kObstacleObservations.name ? left_out_elements<ObservationSet>(bytes) : 0;
}

}  // namespace

struct Bus::ChannelState {
  State* state = nullptr;
  std::string name, wire_name;
  ChannelCounters counters;
  SenderWatch senders;
  std::deque<RawHandler> handlers;
  lcm::Subscription* subscription = nullptr;
  bool counted = false;   ///< an earlier handler has judged the message being delivered
  bool admitted = false;  ///< that handler has accepted it
  ReplayGuard guard;      ///< with keys
  LogLimiter reject_log, send_log;
  RefusalRate refused;
  std::string why;                     ///< in words, of the newest refusal
  std::string description;             ///< in words, of the last message refused for its fields that was looked into
  std::optional<Rejection> described;  ///< the reason of that refusal
  UTime described_at;                  ///< its time
  std::deque<Encoder> unsent;
  UTime due = kNever;

  /// Sets `description`. Naming the field decodes the message again, so in a flood it is done once per interval and
  /// reason.
  void describe_delivered(Rejection reason, std::span<const std::uint8_t> delivered, UTime now) {
    if (described == reason && now - described_at < kLogInterval && now >= described_at) return;
    description = describe(name, reason, delivered);
    described = reason;
    described_at = now;
  }
  /// Counts the refusal of a message, or of elements of an accepted one.
  void count_refused(Rejection reason, UTime now, const char* what, std::int64_t times) {
    counters.rejected[static_cast<int>(reason)] += times;
    if (reason != Rejection::Sender && reason != Rejection::Future) refused.add(now, why, times);
    if (reason == Rejection::Repeated) return;  // a network may duplicate messages
    if (const auto refusals = reject_log.admit(now, times)) {
      log::warn("{}: refused {}: {} ({} refused since the last report)", wire_name, what, why, *refusals);
    }
  }
};

struct Bus::State {
  Bus* bus = nullptr;
  std::shared_ptr<lcm::LCM> lcm;
  std::string suffix;
  std::optional<KeyRing> keys;
  std::optional<Role> sender_role;  ///< with keys: role of the sender of the message being delivered
  std::int64_t epoch_us = 0;
  mutable std::mutex mutex;  ///< guards `channels` (the map) and counters; held while a message is numbered and sent
  std::map<std::string, ChannelState, std::less<>> channels;
  std::int64_t unsent = 0;
  std::int64_t deliveries = 0;
  std::int64_t received_us = 0;             ///< system time at which the message being delivered arrived
  std::span<const std::uint8_t> delivered;  ///< the message being delivered
  std::exception_ptr error;
  Listener listener;
  lcm::Subscription* all_channels = nullptr;

  /// @pre the mutex is held
  ChannelState& channel(std::string_view name) {
    const auto found = channels.find(name);
    if (found != channels.end()) return found->second;
    const std::string wire_name = std::string(name) + suffix;
    check_name(wire_name);
    ChannelState& made = channels[std::string(name)];
    made.state = this;
    made.name = name;
    made.wire_name = wire_name;
    made.senders = SenderWatch(sender_silence(name), epoch_us);
    return made;
  }

  static void on_message(const lcm::ReceiveBuffer* buffer, const std::string&, ChannelState* channel) {
    State& state = *channel->state;
    if (state.error) return;
    state.received_us = buffer->recv_utime;
    channel->counted = false;
    state.delivered = {};
    std::span bytes(static_cast<const std::uint8_t*>(buffer->data), buffer->data_size);
    try {
      if (state.keys) {
        const auto verified =
            verify(bytes, *state.keys, channel->guard, channel->name, channel->wire_name, state.bus->received());
        if (!verified) return state.bus->reject(channel->name, verified.error());
        bytes = verified->message;
        state.sender_role = verified->role;
      }
      ++state.deliveries;
      state.delivered = bytes;
      for (const RawHandler& handler : channel->handlers) handler(bytes);
    } catch (...) {
      state.error = std::current_exception();
    }
  }

  static void on_any(const lcm::ReceiveBuffer* buffer, const std::string& wire_name, State* state) {
    if (state->error) return;
    try {
      state->listener(wire_name, buffer->recv_utime,
                      {static_cast<const std::uint8_t*>(buffer->data), buffer->data_size});
    } catch (...) {
      state->error = std::current_exception();
    }
  }
};

Bus::Bus(std::shared_ptr<lcm::LCM> lcm, const Clock& clock, std::int64_t epoch_us, std::string suffix,
         std::optional<KeyRing> keys)
    : clock_(clock), epoch_us_(epoch_us), state_(std::make_unique<State>()) {
  check_name(suffix);
  state_->bus = this;
  state_->keys = std::move(keys);
  state_->lcm = std::move(lcm);
  state_->suffix = std::move(suffix);
  state_->epoch_us = epoch_us;
}

Bus::~Bus() {
  for (auto& [name, channel] : state_->channels) {
    if (channel.subscription != nullptr) state_->lcm->unsubscribe(channel.subscription);
  }
  if (state_->all_channels != nullptr) state_->lcm->unsubscribe(state_->all_channels);
}

bool Bus::is_channel_name(std::string_view name) {
  // LCM reads a subscription's channel as a regular expression: only literal characters are allowed.
  const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  return std::all_of(name.begin(), name.end(), plain) && name.size() <= static_cast<std::size_t>(kMaxChannelName);
}

MessageName Bus::send(std::string_view name, const Encoder& encoder) {
  const std::scoped_lock lock(state_->mutex);
  ChannelState& channel = state_->channel(name);
  const UTime now = clock_.now();
  const Header header{{epoch_us_, channel.counters.sent + 1}, now};
  Bytes bytes = encoder(header);
  if (state_->keys) sign(bytes, *state_->keys, name, channel.wire_name, header);
  ++channel.counters.sent;
  const int status = state_->lcm->publish(channel.wire_name, bytes.data(), static_cast<unsigned>(bytes.size()));
  if (status != 0) {
    if (const auto times = channel.send_log.admit(now)) {
      log::warn("{}: LCM could not send ({} times since the last report)", channel.wire_name, *times);
    }
  }
  return header.name;
}

void Bus::send_paced(std::string_view name, std::vector<Encoder> batches) {
  ChannelState* channel = nullptr;
  {
    const std::scoped_lock lock(state_->mutex);
    channel = &state_->channel(name);
  }
  state_->unsent += static_cast<std::int64_t>(channel->unsent.size());
  channel->unsent.assign(std::make_move_iterator(batches.begin()), std::make_move_iterator(batches.end()));
  channel->due = batches.empty() ? kNever : clock_.now();
  if (!batches.empty()) send_due(channel->due);
}

UTime Bus::next_due() const {
  const std::scoped_lock lock(state_->mutex);
  UTime due = kNever;
  for (const auto& [name, channel] : state_->channels) due = std::min(due, channel.due);
  return due;
}

void Bus::send_due(UTime now) {
  std::vector<std::pair<std::string, Encoder>> due;
  {
    const std::scoped_lock lock(state_->mutex);
    for (auto& [name, channel] : state_->channels) {
      if (channel.due > now || channel.unsent.empty()) continue;
      due.emplace_back(name, std::move(channel.unsent.front()));
      channel.unsent.pop_front();
      channel.due = channel.unsent.empty() ? kNever : now + kPacing;
    }
  }
  for (const auto& [name, encoder] : due) send(name, encoder);
}

void Bus::subscribe_raw(std::string_view name, RawHandler handler) {
  const std::scoped_lock lock(state_->mutex);
  ChannelState& channel = state_->channel(name);
  if (state_->keys && state_->keys->find(name, state_->keys->role_on(name)) == nullptr) {
    throw std::invalid_argument("no key for messages on " + channel.name);
  }
  channel.handlers.push_back(std::move(handler));
  if (channel.subscription != nullptr) return;
  channel.subscription = state_->lcm->subscribeFunction(channel.wire_name, &State::on_message, &channel);
  if (channel.subscription == nullptr) throw std::runtime_error("LCM cannot subscribe to " + channel.wire_name);
  channel.subscription->setQueueCapacity(kQueueCapacity);
}

void Bus::listen(Listener listener) {
  state_->listener = std::move(listener);
  if (state_->all_channels != nullptr) return;
  state_->all_channels = state_->lcm->subscribeFunction(".*", &State::on_any, state_.get());
  if (state_->all_channels == nullptr) throw std::runtime_error("LCM cannot subscribe to all channels");
  state_->all_channels->setQueueCapacity(kListenCapacity);
}

bool Bus::listens() const { return static_cast<bool>(state_->listener); }

void Bus::reject(const std::string& name, Rejection reason) {
  const std::scoped_lock lock(state_->mutex);
  ChannelState& channel = state_->channel(name);
  channel.admitted = false;
  if (std::exchange(channel.counted, true)) return;
  channel.describe_delivered(reason, state_->delivered, clock_.now());
  channel.why = channel.description;
  count_refused(channel, reason);
}

/// @pre the mutex is held
void Bus::count_refused(ChannelState& channel, Rejection reason) {
  channel.count_refused(reason, clock_.now(), "a message", 1);
}

bool Bus::admits(const std::string& name, const MessageName& message, UTime claimed) {
  const std::scoped_lock lock(state_->mutex);
  ChannelState& channel = state_->channel(name);
  if (std::exchange(channel.counted, true)) return channel.admitted;
  const auto refusal = channel.senders.judge(message, claimed, received(), channel.counters.sent);
  channel.counters.lost = channel.senders.lost();
  channel.admitted = !refusal;
  if (refusal) {
    const bool is_repeated = *refusal == Rejection::Repeated;
    channel.why = is_repeated ? fmt::format("repeats number {}", message.sequence) : to_string(*refusal);
    count_refused(channel, *refusal);
  } else {
    ++channel.counters.received;
    if (const std::int32_t elements = left_out(name, state_->delivered); elements > 0) {
      channel.describe_delivered(Rejection::Number, state_->delivered, clock_.now());
      channel.why = channel.description + " (the others are used)";
      channel.count_refused(Rejection::Number, clock_.now(), "a part of a message", elements);
    }
  }
  return channel.admitted;
}

std::string Bus::sender_troubles() const {
  const std::scoped_lock lock(state_->mutex);
  const UTime now = clock_.now();
  std::string text;
  for (const auto& [name, channel] : state_->channels) {
    const std::string separator = text.empty() ? "" : "; ", refused = channel.refused.text(now);
    if (channel.senders.has_second_sender(now)) {
      text += fmt::format("{}{}: two senders, only the first is accepted", separator, name);
    } else if (const auto ahead = channel.senders.ahead(now)) {
      text += fmt::format("{}{}: stamped {:.1f} s ahead of this clock, refused: synchronize the clocks", separator,
                          name, ahead->seconds());
    } else if (!refused.empty()) {
      text += fmt::format("{}{}: {}", separator, name, refused);
    }
  }
  return text;
}

bool Bus::may_report_as(std::string_view process) const {
  const auto role = role_of_process(process);
  return !state_->keys || !role || role == state_->sender_role;
}

std::map<std::string, ChannelCounters> Bus::counters() const {
  const std::scoped_lock lock(state_->mutex);
  std::map<std::string, ChannelCounters> counters;
  for (const auto& [name, channel] : state_->channels) counters[name] = channel.counters;
  return counters;
}

void Bus::count_late_on(std::string_view name) {
  const std::scoped_lock lock(state_->mutex);
  ++state_->channel(name).counters.late;
}

void Bus::refuse_on(std::string_view name, Rejection reason) {
  const std::scoped_lock lock(state_->mutex);
  ChannelState& channel = state_->channel(name);
  channel.why = to_string(reason);
  count_refused(channel, reason);
}

const std::string& Bus::suffix() const { return state_->suffix; }

std::int64_t Bus::unsent() const { return state_->unsent; }

std::int64_t Bus::deliveries() const { return state_->deliveries; }

UTime Bus::received() const { return clock_.at_system_time(state_->received_us); }

void Bus::rethrow() {
  if (state_->error) std::rethrow_exception(std::exchange(state_->error, nullptr));
}

}  // namespace tern
