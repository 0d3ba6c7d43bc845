#include "messages/form.h"
#include "tern_msgs/heartbeat_t.hpp"

namespace tern {

template <>
struct wire::Form<Heartbeat> {
  using Message = tern_msgs::heartbeat_t;
  static_assert(Message::MAX_PROCESS_TEXT == kMaxProcessText);
  static_assert(Message::MAX_BUILD_ID_TEXT == kMaxBuildIdText);
  static_assert(Message::MAX_WAITING_TEXT == kMaxWaitingText);
  static_assert(Message::MAX_CHANNELS == kMaxHeartbeatChannels);
  static_assert(Message::MAX_CHANNEL_TEXT == kMaxHeartbeatChannels * kMaxChannelName);
  static_assert(Message::MAX_ECHOES == kMaxClockEchoes);
  static_assert(Message::FAILED == static_cast<int>(ProcessState::Failed));
  static_assert(sizeof(tern_msgs::channel_counters_t::rejected) == sizeof(ChannelCounters::rejected));
  static constexpr Layout kLayout{
      Array{&Message::process_count, &Message::process, 1, kMaxProcessText},
      Array{&Message::build_id_count, &Message::build_id, 0, kMaxBuildIdText},
      Array{&Message::waiting_count, &Message::waiting_for, 0, kMaxWaitingText},
      Array{&Message::channel_count, &Message::channels, 0, kMaxHeartbeatChannels},
      Array{&Message::channel_text_count, &Message::channel_text, 0, kMaxHeartbeatChannels* kMaxChannelName},
      Array{&Message::echo_count, &Message::echoes, 0, kMaxClockEchoes},
  };

  static void fields(auto& io, auto& m, auto& heartbeat) {
    io.header("header", m.header, heartbeat.header);
    io.enumeration("state", m.state, heartbeat.state, ProcessState::Failed);
    io.text("process", m.process, heartbeat.process);
    io.text("build_id", m.build_id, heartbeat.build_id);
    io.text("waiting_for", m.waiting_for, heartbeat.waiting_for);
    io.list("echoes", m.echoes, heartbeat.echoes, [&io](auto& e, auto& echo) {
      io.integer("sender_epoch_us", e.sender_epoch_us, echo.sender_epoch_us, 1, kMaxTimeUs);
      io.time("sent_us", e.sent_us, echo.sent);
      io.time("received_us", e.received_us, echo.received);
    });
  }

  static void counter_fields(auto& io, auto& m, auto& counters) {
    io.counter("sent", m.sent, counters.sent);
    io.counter("received", m.received, counters.received);
    for (int i = 0; i < kRejections; ++i) io.counter("rejected", m.rejected[i], counters.rejected[i]);
    io.counter("lost", m.lost, counters.lost);
    io.counter("late", m.late, counters.late);
  }

  static void write_rest(Message& m, const Heartbeat& heartbeat) {
    FieldWriter write;
    for (const auto& [name, counters] : heartbeat.channels) {
      tern_msgs::channel_counters_t& channel = m.channels.emplace_back();
      channel.name_length = static_cast<std::int32_t>(name.size());
      counter_fields(write, channel, counters);
      append(m.channel_text, name);
    }
  }

  static void read_rest(FieldReader& read, const Message& m, Heartbeat& heartbeat) {
    Slices names(m.channel_text);
    for (const tern_msgs::channel_counters_t& channel : m.channels) {
      const int length = read.integer(channel.name_length, 1, kMaxChannelName);
      std::string name = read.text(names.take(static_cast<std::size_t>(length)));
      read.consistent(heartbeat.channels.empty() || heartbeat.channels.rbegin()->first < name);
      counter_fields(read, channel, heartbeat.channels[std::move(name)]);
    }
    read.consistent(names.complete());
    for (std::size_t k = 1; k < heartbeat.echoes.size(); ++k) {
      read.consistent(heartbeat.echoes[k - 1].sender_epoch_us < heartbeat.echoes[k].sender_epoch_us);
    }
  }
};

template Bytes encode(const Heartbeat& value);
template tl::expected<Heartbeat, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<Heartbeat>(std::span<const std::uint8_t> bytes);

}  // namespace tern
