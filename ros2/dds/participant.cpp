#include "ros2/dds/participant.h"

#include <dds/dds.h>
#include <dds/ddsrt/log.h>
#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ros2/dds/cdr_type.h"

namespace tern::ros2 {
namespace {

/// Participants of one host find each other by trying this many ports, as ROS's middlewares do. They are tried each
/// second: participants that start later with ROS's default settings look for others by multicast only, not on `lo`.
constexpr int kMostOnOneHost = 32;
/// The largest message that is put together. A larger one is dropped. OctoMaps have at most 59 MB (octomap_intake.cpp).
constexpr int kMaxMessageMiB = 64;
/// How long a write may wait for slow readers.
constexpr dds_duration_t kNoWait = 0;

/// @throws std::runtime_error if `code` is an error
dds_entity_t checked(dds_entity_t code, std::string_view what) {
  if (code < 0) throw std::runtime_error(fmt::format("DDS: {}: {}", what, dds_strretcode(code)));
  return code;
}

std::string configuration(const std::string& network) {
  const std::string limit = fmt::format("<Internal><MaxSampleSize>{} MiB</MaxSampleSize></Internal>", kMaxMessageMiB);
  if (!network.empty()) {
    const bool is_address = network.find_first_not_of("0123456789.") == std::string::npos;
    return fmt::format("<Domain><General><Interfaces><NetworkInterface {}=\"{}\"/></Interfaces></General>{}</Domain>",
                       is_address ? "address" : "name", network, limit);
  }
  return fmt::format(
      "<Domain><General><Interfaces><NetworkInterface address=\"127.0.0.1\"/></Interfaces>"
      "<AllowMulticast>false</AllowMulticast></General>"
      "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>{}</MaxAutoParticipantIndex>"
      "<Peers><Peer address=\"127.0.0.1\"/></Peers><SPDPInterval>1 s</SPDPInterval></Discovery>{}</Domain>",
      kMostOnOneHost, limit);
}

/// The lines of Cyclone's log, whose threads write them.
struct Log {
  std::mutex mutex;
  std::int64_t lines = 0;
  std::string newest;
};
Log& dds_log() {
  static Log log;
  return log;
}

void keep_line(void*, const dds_log_data_t* line) {
  constexpr std::size_t kMostBytes = 160;
  Log& log = dds_log();
  const std::lock_guard lock(log.mutex);
  ++log.lines;
  log.newest.assign(line->message, std::min(line->size, kMostBytes));
  while (!log.newest.empty() && log.newest.back() == '\n') log.newest.pop_back();
}

using QosPointer = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

QosPointer qos_of(const DdsTopic& topic) {
  QosPointer qos(dds_create_qos(), dds_delete_qos);
  const Qos& wanted = topic.qos;
  dds_qset_reliability(qos.get(), wanted.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, kNoWait);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, wanted.depth);
  dds_qset_durability(qos.get(), wanted.latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, wanted.depth, DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  dds_qset_writer_data_lifecycle(qos.get(), false);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  dds_qset_userdata(qos.get(), topic.user_data.data(), topic.user_data.size());
  return qos;
}

}  // namespace

struct Participant::Impl {
  dds_entity_t domain = 0;  ///< 0: made by Cyclone itself
  dds_entity_t participant = 0;
  std::vector<dds_entity_t> writers, readers;
  std::vector<std::int64_t> unsent;  ///< by writer

  ~Impl() {
    dds_delete(participant);
    if (domain > 0) dds_delete(domain);
  }
  [[nodiscard]] dds_entity_t make_topic(const DdsTopic& topic) const {
    ddsi_sertype* type = make_cdr_type(topic.type);
    return checked(dds_create_topic_sertype(participant, topic.name.c_str(), &type, nullptr, nullptr, nullptr),
                   topic.name);
  }
};

Participant::Participant(int domain, const std::string& network) : impl_(std::make_unique<Impl>()) {
  dds_set_log_sink(keep_line, nullptr);
  const auto id = static_cast<dds_domainid_t>(domain);
  if (network != "any") {
    impl_->domain = checked(dds_create_domain(id, configuration(network).c_str()),
                            fmt::format("domain {} on {}", domain, network.empty() ? "this host" : network));
  }
  const QosPointer qos(dds_create_qos(), dds_delete_qos);
  constexpr std::string_view kEnclave = "enclave=/;";
  dds_qset_userdata(qos.get(), kEnclave.data(), kEnclave.size());
  impl_->participant = checked(dds_create_participant(id, qos.get(), nullptr), fmt::format("domain {}", domain));
}

Participant::~Participant() = default;

int Participant::add_writer(const DdsTopic& topic) {
  const QosPointer qos = qos_of(topic);
  impl_->writers.push_back(
      checked(dds_create_writer(impl_->participant, impl_->make_topic(topic), qos.get(), nullptr), topic.name));
  impl_->unsent.push_back(0);
  return static_cast<int>(impl_->writers.size()) - 1;
}

int Participant::add_reader(const DdsTopic& topic) {
  const QosPointer qos = qos_of(topic);
  impl_->readers.push_back(
      checked(dds_create_reader(impl_->participant, impl_->make_topic(topic), qos.get(), nullptr), topic.name));
  return static_cast<int>(impl_->readers.size()) - 1;
}

bool Participant::has_readers(int writer) const {
  dds_publication_matched_status_t status{};
  dds_get_publication_matched_status(impl_->writers[static_cast<std::size_t>(writer)], &status);
  return status.current_count > 0;
}

bool Participant::has_met_others() const {
  const auto has_met_writer = [](dds_entity_t reader) {
    dds_subscription_matched_status_t status{};
    dds_get_subscription_matched_status(reader, &status);
    return status.total_count > 0;
  };
  const auto has_met_reader = [](dds_entity_t writer) {
    dds_publication_matched_status_t status{};
    dds_get_publication_matched_status(writer, &status);
    return status.total_count > 0;
  };
  return std::ranges::any_of(impl_->readers, has_met_writer) || std::ranges::any_of(impl_->writers, has_met_reader);
}

void Participant::write(int writer, const std::string& cdr) {
  const auto k = static_cast<std::size_t>(writer);
  if (dds_write(impl_->writers[k], &cdr) != DDS_RETCODE_OK) ++impl_->unsent[k];
}

std::optional<std::string> Participant::take(int reader) {
  std::string cdr;
  void* sample = &cdr;
  dds_sample_info_t info{};
  while (dds_take(impl_->readers[static_cast<std::size_t>(reader)], &sample, &info, 1, 1) > 0) {
    if (info.valid_data) return cdr;  // the others say that a writer has gone
  }
  return std::nullopt;
}

std::string Participant::take_log() {
  Log& log = dds_log();
  const std::lock_guard lock(log.mutex);
  if (log.lines == 0) return "";
  return fmt::format("DDS: {} warnings, the last one: {}", std::exchange(log.lines, 0), log.newest);
}

EndCounters Participant::writer_counters(int writer) const {
  const auto k = static_cast<std::size_t>(writer);
  dds_offered_incompatible_qos_status_t qos{};
  dds_get_offered_incompatible_qos_status(impl_->writers[k], &qos);
  return {impl_->unsent[k], qos.total_count};
}

EndCounters Participant::reader_counters(int reader) const {
  const dds_entity_t end = impl_->readers[static_cast<std::size_t>(reader)];
  dds_requested_incompatible_qos_status_t qos{};
  dds_get_requested_incompatible_qos_status(end, &qos);
  dds_sample_lost_status_t lost{};
  dds_get_sample_lost_status(end, &lost);
  return {lost.total_count, qos.total_count};
}

}  // namespace tern::ros2
