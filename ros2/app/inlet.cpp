#include "ros2/app/inlet.h"

#include <fmt/format.h>

#include <span>

#include "ros2/app/outlet.h"
#include "ros2/topics.h"
#include "ros_messages/cdr.h"

namespace tern::ros2 {
namespace {

constexpr Duration kCloudPeriod{50'000}, kOctomapPeriod{500'000};

ros::Input input_of(const std::string& topic) {
  using ros::Input;
  static const std::map<std::string, Input> kInputs = {
      {topics::kGoalPose, Input::Goal},       {topics::kOdom, Input::Odometry},
      {topics::kFollowing, Input::Following}, {topics::kDetections, Input::Detections},
      {topics::kCloud, Input::Cloud},         {topics::kOctomap, Input::Octomap},
      {topics::kTf, Input::Transforms},       {topics::kTfStatic, Input::StaticTransforms}};
  return kInputs.at(topic);
}

std::set<ros::Input> inputs_of(const std::set<std::string>& topics) {
  std::set<ros::Input> inputs;
  for (const std::string& topic : topics) inputs.insert(input_of(topic));
  return inputs;
}

}  // namespace

Inlet::Inlet(Bus& bus, Participant& participant, const TopicNames& names, const std::set<std::string>& received,
             const ros::InletOptions& options, const UavSpec& uav)
    : participant_(participant), inlet_(bus, inputs_of(received), options, uav) {
  const auto add = [&](const ros::FeedTopic& topic) {
    const int number = participant_.add_reader(dds_topic(topic, names, reader_qos(topic)));
    readers_.push_back({topic.name, input_of(topic.name), number, {}, {}});
  };
  for (const ros::FeedTopic& topic : transform_topics()) {
    if (!received.empty()) add(topic);
  }
  for (const ros::FeedTopic& topic : received_topics()) {
    if (received.contains(topic.name)) add(topic);
  }
}

/// Takes no more than the reader holds, however fast others send.
void Inlet::receive(Reader& reader, UTime now) {
  if (now < reader.next) return;
  const auto decode = []<class Message>(std::span<const std::uint8_t> bytes) {
    return ros::decode_cdr<Message>(bytes);
  };
  const Duration period = reader.input == ros::Input::Cloud     ? kCloudPeriod
                          : reader.input == ros::Input::Octomap ? kOctomapPeriod
                                                                : Duration{};
  const int most = period > Duration{} ? 1 : 100;
  for (int k = 0; k < most; ++k) {
    const auto cdr = participant_.take(reader.number);
    if (!cdr) return;
    inlet_.receive(reader.input, reader.topic, {reinterpret_cast<const std::uint8_t*>(cdr->data()), cdr->size()}, now,
                   decode);
    reader.next = now + period;
  }
}

void Inlet::step(UTime now) {
  for (Reader& reader : readers_) receive(reader, now);
  inlet_.step(now);
}

std::string Inlet::take_trouble() {
  std::string text = inlet_.take_trouble();
  for (Reader& reader : readers_) {
    const EndCounters counters = participant_.reader_counters(reader.number);
    if (counters.unfitting > reader.reported.unfitting) {
      text += fmt::format("{}{}: the QoS of a writer does not fit the reader", text.empty() ? "" : "; ", reader.topic);
    }
    reader.reported = counters;
  }
  return text;
}

}  // namespace tern::ros2
