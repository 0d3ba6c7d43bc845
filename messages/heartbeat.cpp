#include "messages/codec.h"
#include "messages/fields.h"
#include "messages/wire.h"
#include "tern_msgs/heartbeat_t.hpp"

namespace tern {
namespace {

using Message = tern_msgs::heartbeat_t;
static_assert(Message::MAX_PROCESS_TEXT == kMaxProcessText);
static_assert(Message::MAX_BUILD_ID_TEXT == kMaxBuildIdText);
static_assert(Message::MAX_WAITING_TEXT == kMaxWaitingText);
static_assert(Message::MAX_CHANNELS == kMaxHeartbeatChannels);
static_assert(Message::MAX_CHANNEL_TEXT == kMaxHeartbeatChannels * kMaxChannelName);
static_assert(Message::MAX_ECHOES == kMaxClockEchoes);
static_assert(Message::FAILED == static_cast<int>(ProcessState::Failed));

static_assert(sizeof(tern_msgs::channel_counters_t::rejected) == sizeof(ChannelCounters::rejected));

const wire::Layout kLayout{
    wire::Array{&Message::process_count, &Message::process, 1, kMaxProcessText},
    wire::Array{&Message::build_id_count, &Message::build_id, 0, kMaxBuildIdText},
    wire::Array{&Message::waiting_count, &Message::waiting_for, 0, kMaxWaitingText},
    wire::Array{&Message::channel_count, &Message::channels, 0, kMaxHeartbeatChannels},
    wire::Array{&Message::channel_text_count, &Message::channel_text, 0, kMaxHeartbeatChannels* kMaxChannelName},
    wire::Array{&Message::echo_count, &Message::echoes, 0, kMaxClockEchoes},
};

tern_msgs::channel_counters_t to_lcm(const std::string& name, const ChannelCounters& counters) {
  tern_msgs::channel_counters_t m{};
  m.name_length = static_cast<std::int32_t>(name.size());
  m.sent = counters.sent;
  m.received = counters.received;
  std::copy(std::begin(counters.rejected), std::end(counters.rejected), m.rejected);
  m.lost = counters.lost;
  m.late = counters.late;
  return m;
}

Message to_lcm(const Heartbeat& heartbeat) {
  Message m{};
  m.header = wire::to_lcm(heartbeat.header);
  m.state = wire::to_int8(heartbeat.state);
  m.process = wire::to_lcm(heartbeat.process);
  m.build_id = wire::to_lcm(heartbeat.build_id);
  m.waiting_for = wire::to_lcm(heartbeat.waiting_for);
  for (const auto& [name, counters] : heartbeat.channels) {
    m.channels.push_back(to_lcm(name, counters));
    wire::append(m.channel_text, name);
  }
  for (const ClockEcho& echo : heartbeat.echoes) {
    tern_msgs::clock_echo_t& e = m.echoes.emplace_back();
    e.sender_epoch_us = echo.sender_epoch_us;
    e.sent_us = echo.sent.us;
    e.received_us = echo.received.us;
  }
  return m;
}

ChannelCounters read_counters(wire::FieldReader& read, const tern_msgs::channel_counters_t& m) {
  ChannelCounters counters;
  counters.sent = read.counter(m.sent);
  counters.received = read.counter(m.received);
  for (int i = 0; i < kRejections; ++i) counters.rejected[i] = read.counter(m.rejected[i]);
  counters.lost = read.counter(m.lost);
  counters.late = read.counter(m.late);
  return counters;
}

tl::expected<Heartbeat, Rejection> from_lcm(const Message& m) {
  wire::FieldReader read;
  Heartbeat heartbeat;
  heartbeat.header = read.header(m.header);
  heartbeat.state = read.enumeration(m.state, ProcessState::Failed);
  heartbeat.process = read.text(m.process);
  heartbeat.build_id = read.text(m.build_id);
  heartbeat.waiting_for = read.text(m.waiting_for);
  wire::Slices names(m.channel_text);
  for (const tern_msgs::channel_counters_t& channel : m.channels) {
    const int length = read.integer(channel.name_length, 1, kMaxChannelName);
    std::string name = read.text(names.take(static_cast<std::size_t>(length)));
    read.consistent(heartbeat.channels.empty() || heartbeat.channels.rbegin()->first < name);
    heartbeat.channels.emplace(std::move(name), read_counters(read, channel));
  }
  read.consistent(names.complete());
  for (const tern_msgs::clock_echo_t& echo : m.echoes) {
    const auto epoch_us = read.integer<std::int64_t>(echo.sender_epoch_us, 1, kMaxTimeUs);
    read.consistent(heartbeat.echoes.empty() || heartbeat.echoes.back().sender_epoch_us < epoch_us);
    heartbeat.echoes.push_back({epoch_us, read.time(echo.sent_us), read.time(echo.received_us)});
  }
  return read.accept(std::move(heartbeat));
}

}  // namespace

template <>
Bytes encode(const Heartbeat& value) {
  return wire::encode(to_lcm(value), kLayout);
}

template <>
tl::expected<Heartbeat, Rejection> decode(std::span<const std::uint8_t> bytes) {
  return wire::decode(bytes, kLayout, from_lcm);
}

}  // namespace tern
