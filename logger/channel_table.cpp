#include "logger/channel_table.h"

#include "messages/codec.h"

namespace tern {
namespace {

template <class T>
tl::expected<Header, Rejection> head_of(std::span<const std::uint8_t> bytes) {
  return decode<T>(bytes).map([](const T& message) { return message.header; });
}

}  // namespace

HeadDecoder find_head_decoder(std::string_view channel) {
  HeadDecoder decoder = nullptr;
  visit_channel(channel, [&decoder]<class T>(const Channel<T>&) { decoder = &head_of<T>; });
  return decoder;
}

void ChannelTable::add(std::string_view name, UTime received, std::span<const std::uint8_t> data) {
  auto found = channels_.find(name);
  if (found == channels_.end()) {
    found = channels_.emplace(std::string(name), Entry{}).first;
    if (name.ends_with(suffix_)) found->second.decode = find_head_decoder(name.substr(0, name.size() - suffix_.size()));
  }
  Entry& channel = found->second;
  ++channel.count.received;
  channel.count.bytes += static_cast<std::int64_t>(data.size());
  if (channel.decode == nullptr) return;
  const auto head = channel.decode(data);
  if (!head) {
    ++channel.count.refused;
    return;
  }
  channel.losses.add(head->name, received);
  channel.count.lost = channel.losses.lost();
}

std::map<std::string, ChannelCount> ChannelTable::counts() const {
  std::map<std::string, ChannelCount> counts;
  for (const auto& [name, channel] : channels_) counts[name] = channel.count;
  return counts;
}

}  // namespace tern
