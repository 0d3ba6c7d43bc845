#include "ros2/app/outlet.h"

#include <fmt/format.h>

#include <span>
#include <type_traits>

#include "ros2/topics.h"
#include "ros_messages/type_hash.h"
#include "runtime/mac.h"

namespace tern::ros2 {

DdsTopic dds_topic(const ros::FeedTopic& topic, const TopicNames& names, const Qos& qos) {
  const std::string text = ros::hashed_description(*topic.type);
  std::string digits;
  for (const std::uint8_t byte : sha256(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()))) {
    digits += fmt::format("{:02x}", byte);
  }
  return {dds_topic_name(names.of(topic.name)), dds_type_name(topic.type->name()), user_data(digits), qos};
}

Outlet::Outlet(Bus& bus, Participant& participant, const TopicNames& names, const std::set<std::string>& sent)
    : participant_(participant),
      feed_([this](const ros::FeedTopic& topic, const std::string& cdr) { write(topic.name, cdr); },
            [this](std::string_view topic) { return is_wanted(topic); }, {}, ros::Drawings::Markers),
      bus_feed_(bus, feed_) {
  for (const ros::FeedTopic& topic : sent_topics()) {
    if (!sent.contains(topic.name)) continue;
    const int number = participant_.add_writer(dds_topic(topic, names, writer_qos(topic)));
    writers_[topic.name] = {number, topic.latched, {}};
  }
}

bool Outlet::is_wanted(std::string_view topic) const {
  const auto found = writers_.find(topic);
  return found != writers_.end() && (found->second.latched || participant_.has_readers(found->second.number));
}

void Outlet::write(std::string_view topic, const std::string& cdr) {
  participant_.write(writers_.find(topic)->second.number, cdr);
}

void Outlet::write_clock(UTime now) {
  if (is_wanted(topics::kClock)) write(topics::kClock, ros::encode_cdr(ros::Clock{ros::to_ros(now)}));
}

std::string Outlet::take_trouble() {
  std::string text;
  for (auto& [topic, writer] : writers_) {
    const EndCounters counters = participant_.writer_counters(writer.number);
    if (counters.lost > writer.reported.lost) {
      text += fmt::format("{}{}: {} messages were not sent, as readers are too slow", text.empty() ? "" : "; ", topic,
                          counters.lost - writer.reported.lost);
    }
    if (counters.unfitting > writer.reported.unfitting) {
      text += fmt::format("{}{}: the QoS of a reader does not fit a {} writer", text.empty() ? "" : "; ", topic,
                          writer.latched ? "reliable, transient local" : "reliable, volatile");
    }
    writer.reported = counters;
  }
  return text;
}

}  // namespace tern::ros2
