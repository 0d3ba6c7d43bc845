// A ROS user for tests: Fast DDS with types that its own generator made of ros.idl.
#pragma once

#include <algorithm>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "rosPubSubTypes.h"

namespace tern::ros2 {

namespace fast = eprosima::fastdds::dds;

/// The quality of service that a ROS user asks for.
struct Wish {
  bool reliable = true, latched = false;
  int depth = 10;
};

/// A writer as discovery shows it.
struct SeenWriter {
  std::string type, user_data;
  bool reliable = false, latched = false;
};

/// A type of this name whose samples are any bytes (std::string), sent as they are.
class HostileType final : public fast::TopicDataType {
 public:
  explicit HostileType(fast::TopicDataType& named) {
    setName(named.getName());
    m_typeSize = named.m_typeSize;
  }
  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override {
    const auto& bytes = *static_cast<std::string*>(data);
    payload->length = static_cast<std::uint32_t>(bytes.size());
    std::copy(bytes.begin(), bytes.end(), payload->data);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<std::string*>(data)->size()); };
  }
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t*, void*) override { return false; }
  void* createData() override { return new std::string; }
  void deleteData(void* data) override { delete static_cast<std::string*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

/// Returns the bytes of a message, as Fast DDS sends them.
inline std::string cdr_of(fast::TopicDataType& type, void* message) {
  eprosima::fastrtps::rtps::SerializedPayload_t payload(type.getSerializedSizeProvider(message)());
  type.serialize(message, &payload);
  return {reinterpret_cast<const char*>(payload.data), payload.length};
}

/// A participant. @tparam Type of its ends: a generated type support
class FastPeer final : public fast::DomainParticipantListener {
 public:
  explicit FastPeer(int domain) {
    participant_ = fast::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<std::uint32_t>(domain), fast::PARTICIPANT_QOS_DEFAULT, this, fast::StatusMask::none());
    if (participant_ == nullptr) throw std::runtime_error("Fast DDS makes no participant");
    publisher_ = participant_->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
  }
  ~FastPeer() override {
    participant_->set_listener(nullptr);
    participant_->delete_contained_entities();
    fast::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  FastPeer(const FastPeer&) = delete;
  FastPeer& operator=(const FastPeer&) = delete;

  template <class Type>
  fast::DataReader* reader(const std::string& topic, Wish wish = {}) {
    fast::DataReaderQos qos = fast::DATAREADER_QOS_DEFAULT;
    apply(wish, qos);
    return subscriber_->create_datareader(topic_of(fast::TypeSupport(new Type), topic), qos);
  }
  template <class Type>
  fast::DataWriter* writer(const std::string& topic, Wish wish = {}) {
    return writer(fast::TypeSupport(new Type), topic, wish);
  }
  fast::DataWriter* writer(const fast::TypeSupport& type, const std::string& topic, Wish wish = {}) {
    fast::DataWriterQos qos = fast::DATAWRITER_QOS_DEFAULT;
    apply(wish, qos);
    return publisher_->create_datawriter(topic_of(type, topic), qos);
  }

  /// Returns the message that a reader has waited with longest.
  template <class Message>
  static std::optional<Message> take(fast::DataReader* reader) {
    Message message;
    fast::SampleInfo info;
    while (reader->take_next_sample(&message, &info) == ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) return message;
    }
    return std::nullopt;
  }
  static bool is_matched(fast::DataWriter* writer) {
    fast::PublicationMatchedStatus status;
    writer->get_publication_matched_status(status);
    return status.current_count > 0;
  }

  /// Returns the writer of a topic, if it was discovered.
  std::optional<SeenWriter> seen(const std::string& topic) {
    const std::lock_guard lock(mutex_);
    const auto found = seen_.find(topic);
    return found == seen_.end() ? std::nullopt : std::optional(found->second);
  }
  std::size_t writers_seen() {
    const std::lock_guard lock(mutex_);
    return seen_.size();
  }

 private:
  using ReturnCode_t = eprosima::fastrtps::types::ReturnCode_t;

  void on_publisher_discovery(fast::DomainParticipant*, eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) override {
    const auto& qos = info.info.m_qos;
    const std::lock_guard lock(mutex_);
    seen_[info.info.topicName().to_string()] = {info.info.typeName().to_string(),
                                                {qos.m_userData.begin(), qos.m_userData.end()},
                                                qos.m_reliability.kind == fast::RELIABLE_RELIABILITY_QOS,
                                                qos.m_durability.kind == fast::TRANSIENT_LOCAL_DURABILITY_QOS};
  }
  template <class Qos>
  static void apply(const Wish& wish, Qos& qos) {
    qos.reliability().kind = wish.reliable ? fast::RELIABLE_RELIABILITY_QOS : fast::BEST_EFFORT_RELIABILITY_QOS;
    qos.durability().kind = wish.latched ? fast::TRANSIENT_LOCAL_DURABILITY_QOS : fast::VOLATILE_DURABILITY_QOS;
    qos.history().kind = fast::KEEP_LAST_HISTORY_QOS;
    qos.history().depth = wish.depth;
    qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  }
  fast::Topic* topic_of(const fast::TypeSupport& type, const std::string& name) {
    if (fast::Topic* known = topics_[name]) return known;
    type.register_type(participant_);
    return topics_[name] = participant_->create_topic(name, type.get_type_name(), fast::TOPIC_QOS_DEFAULT);
  }

  fast::DomainParticipant* participant_ = nullptr;
  fast::Publisher* publisher_ = nullptr;
  fast::Subscriber* subscriber_ = nullptr;
  std::map<std::string, fast::Topic*> topics_;
  std::mutex mutex_;
  std::map<std::string, SeenWriter> seen_;
};

}  // namespace tern::ros2
