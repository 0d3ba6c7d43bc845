// The bridge's place in a domain of DDS. Cyclone DDS stands behind it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace tern::ros2 {

/// The quality of service of a topic's end, as ROS's middlewares choose it.
struct Qos {
  bool reliable = true;
  bool latched = false;  ///< TRANSIENT_LOCAL: later readers get the newest messages
  int depth = 10;        ///< KEEP_LAST
};

/// A topic as DDS knows it.
struct DdsTopic {
  std::string name;       ///< "rt/odom"
  std::string type;       ///< "nav_msgs::msg::dds_::Odometry_"
  std::string user_data;  ///< "typehash=RIHS01_…;"
  Qos qos;
};

/// Counts of a reader or a writer since the start.
struct EndCounters {
  std::int64_t lost = 0;       ///< messages that a reader missed, or that a writer could not send
  std::int64_t unfitting = 0;  ///< ends of others whose quality of service does not fit
};

/// A participant with its readers and writers. No call waits for another participant, whether that is slow, floods the
/// network or sends malformed data. All calls come from one thread; Cyclone has threads of its own.
class Participant {
 public:
  /// @param domain  0 … 232
  /// @param network  "" for this host alone; the name or address of an interface; "any" for Cyclone's own choice and
  ///   configuration (CYCLONEDDS_URI)
  /// @throws std::runtime_error if DDS cannot be started
  Participant(int domain, const std::string& network);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  /// Returns the number of the new writer, or reader. @throws std::runtime_error if DDS refuses it
  int add_writer(const DdsTopic& topic);
  int add_reader(const DdsTopic& topic);

  [[nodiscard]] bool has_readers(int writer) const;
  /// True if an end of another participant has ever matched one of these.
  [[nodiscard]] bool has_met_others() const;
  /// Sends a message. @param cdr  with its header of four bytes
  void write(int writer, const std::string& cdr);
  /// Returns the oldest message that waits. A reader keeps the newest ones, as many as its depth.
  std::optional<std::string> take(int reader);
  /// Returns the newest line that Cyclone wanted to log since the last call, and how many there were; empty: none. So a
  /// peer that sends malformed packets cannot fill the log.
  static std::string take_log();
  [[nodiscard]] EndCounters writer_counters(int writer) const;
  [[nodiscard]] EndCounters reader_counters(int reader) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tern::ros2
