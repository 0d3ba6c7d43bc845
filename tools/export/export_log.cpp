#include "tools/export/export_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "flight_log/track_sets.h"
#include "messages/codec.h"
#include "ros_messages/feed.h"
#include "ros_messages/own_messages.h"
#include "runtime/batches.h"
#include "tools/export/bag_folder.h"
#include "tools/export/csv_files.h"
#include "tools/export/mcap_writer.h"
#include "tools/export/output_files.h"
#include "tools/export/shortfalls.h"

namespace tern::exporting {
namespace {

/// Writes every message to an MCAP file: as it is, and as the ROS messages that follow from it. Setpoints are left as
/// they are, for size.
class McapExport {
 public:
  explicit McapExport(const std::string& file)
      : mcap_(file), feed_([this](const ros::FeedTopic& topic, const std::string& cdr) {
          mcap_.add(topic.name, *topic.type, now_us_, cdr);
        }) {}

  void add(const LoggedMessage& message) {
    receive_at(message.received_us);
    mcap_.add("/" + message.channel, ros::own_type(message.type), now_us_, ros::own_cdr(message.type, message.bytes));
  }

  /// Call it after on_every_channel(): a message comes before its drawings.
  void listen(FlightLog& log) {
    pass_on(log, channels::kUavState);
    pass_on(log, channels::kVehicleStatus);
    pass_on(log, channels::kObstacleObservations);
    pass_on(log, channels::kGoal);
    pass_on(log, channels::kHorizonRequest);
    pass_on(log, channels::kPlan);
    log.on(channels::kObstacleTruth, [this](const ObstacleTruth& batch, std::int64_t) {
      if (auto batches = truth_.add(batch)) feed_.receive(join_batches(std::move(*batches)));
    });
    log.on(channels::kPredictions, [this](const TrackSet& batch, std::int64_t) {
      if (const auto whole = tracks_.add(batch)) feed_.receive(*whole);
    });
    // A map is drawn once, when its last chunk arrives. A chunk that contradicts the others is ignored.
    log.on(channels::kSemanticMap, [this](const MapChunk& chunk, std::int64_t) {
      if (maps_.add(chunk).value_or(false)) feed_.receive(maps_.take(), chunk.header.utime);
    });
  }

  Result<void> finish() { return mcap_.finish(); }
  [[nodiscard]] const McapWriter& file() const { return mcap_; }

 private:
  template <class T>
  void pass_on(FlightLog& log, const Channel<T>& channel) {
    log.on(channel, [this](const T& message, std::int64_t) { feed_.receive(message); });
  }
  /// MCAP has no time before the epoch.
  void receive_at(std::int64_t received_us) { now_us_ = std::max<std::int64_t>(received_us, 0); }

  McapWriter mcap_;
  ros::Feed feed_;
  std::int64_t now_us_ = 0;
  BatchCollector<ObstacleTruth> truth_;
  RecordedSets tracks_;
  MapAssembler maps_;
};

}  // namespace

Result<std::string> export_log(const ExportOptions& options) {
  const bool to_csv = !options.csv_folder.empty(), to_bag = !options.bag_folder.empty();
  const std::string mcap_file =
      to_bag ? (std::filesystem::path(options.bag_folder) / bag_file_name(options.bag_folder)).string()
             : options.mcap_file;
  if (!to_csv && mcap_file.empty()) return fail("nothing to write: name --csv DIR, --mcap FILE or --bag DIR");
  for (const std::string& folder : {options.csv_folder, options.bag_folder}) {
    std::error_code error;
    if (!folder.empty()) std::filesystem::create_directories(folder, error);
    if (error) return fail(folder + ": " + error.message());
  }

  OutputFiles outputs(log_parts(options.log));
  CsvFiles csv(options.csv_folder, outputs);
  std::optional<McapExport> mcap;
  if (!mcap_file.empty()) mcap.emplace(outputs.part_of(mcap_file).string());
  const std::filesystem::path metadata =
      to_bag ? outputs.part_of(std::filesystem::path(options.bag_folder) / "metadata.yaml") : std::filesystem::path();
  if (!outputs.refusal().empty()) return fail(outputs.refusal());
  std::int64_t messages = 0;
  FlightLog log(options.suffix);
  on_every_channel(log, options.suffix, [&](const LoggedMessage& message) {
    ++messages;
    if (to_csv) csv.add(message);
    if (mcap) mcap->add(message);
  });
  if (mcap) mcap->listen(log);
  const auto contents = log.read(options.log);
  if (!contents) return tl::make_unexpected(contents.error());
  if (messages == 0) return fail(options.log + ": holds no message of Tern");
  if (!outputs.refusal().empty()) return fail(outputs.refusal());
  Result<void> written = csv.finish();
  if (written && mcap) written = mcap->finish();
  if (written && to_bag) written = write_bag_metadata(metadata, options.bag_folder, mcap->file());
  if (written) written = outputs.put_in_place();
  if (!written) return tl::make_unexpected(written.error());
  return fmt::format("{} messages exported\n{}", messages, shortfalls(*contents));
}

}  // namespace tern::exporting
