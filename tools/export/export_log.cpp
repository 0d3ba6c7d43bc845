#include "tools/export/export_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "flight_log/track_sets.h"
#include "messages/codec.h"
#include "tools/export/csv_files.h"
#include "tools/export/foxglove.h"
#include "tools/export/mcap_writer.h"
#include "tools/export/shortfalls.h"

namespace tern::exporting {
namespace {

/// MCAP has no time before the epoch.
std::int64_t mcap_time(std::int64_t received_us) { return std::max<std::int64_t>(received_us, 0); }

void add(McapWriter& mcap, const Drawing& drawing, std::int64_t received_us) {
  mcap.add(drawing.topic, drawing.schema, &foxglove_schema, mcap_time(received_us), drawing.message);
}

void add(McapWriter& mcap, const LoggedMessage& message) {
  mcap.add("/" + message.channel, message.type, &message_schema, mcap_time(message.received_us), message.fields);
  if (const auto drawing = drawing_of(message)) add(mcap, *drawing, message.received_us);
}

/// Draws each map once, when its last chunk arrives. A chunk that contradicts the others is ignored.
void add_maps(FlightLog& log, McapWriter& mcap) {
  log.on(channels::kSemanticMap,
         [&mcap, maps = std::make_shared<MapAssembler>()](const MapChunk& chunk, std::int64_t received_us) {
           if (maps->add(chunk).value_or(false)) add(mcap, drawing_of(maps->take(), received_us), received_us);
         });
}

/// Draws hulls and planes of each plan, from the request and the predictions that it names. Only the newest are stored.
class Proofs {
 public:
  explicit Proofs(McapWriter& mcap) : mcap_(mcap) {}
  void listen(FlightLog& log) {
    log.on(channels::kHorizonRequest,
           [this](const HorizonRequest& request, std::int64_t) { keep(requests_, request.header.name, request.t_s); });
    log.on(channels::kPredictions, [this](const TrackSet& batch, std::int64_t) {
      if (auto whole = sets_.add(batch)) {
        keep(tracks_, std::pair(whole->header.name.sender_epoch_us, whole->batch.set), std::move(*whole));
      }
    });
    log.on(channels::kPlan, [this](const Plan& plan, std::int64_t received_us) { draw(plan, received_us); });
  }

 private:
  static constexpr std::size_t kKept = 32;

  template <class Key, class Value>
  static void keep(std::map<Key, Value>& kept, const Key& key, Value value) {
    kept.insert_or_assign(key, std::move(value));
    if (kept.size() > kKept) kept.erase(kept.begin());
  }

  void draw(const Plan& plan, std::int64_t received_us) {
    const auto request = requests_.find(plan.inputs.request);
    const auto tracks = tracks_.find({plan.inputs.predictions.sender_epoch_us, plan.inputs.prediction_set});
    const bool blind = plan.inputs.predictions == MessageName{};
    if (request == requests_.end() || (tracks == tracks_.end() && !blind)) return;
    for (const Drawing& drawing :
         drawings_of(plan, request->second, blind ? TrackSet() : tracks->second, received_us)) {
      add(mcap_, drawing, received_us);
    }
  }

  McapWriter& mcap_;
  RecordedSets sets_;
  std::map<MessageName, UTime> requests_;  ///< t_s
  std::map<std::pair<std::int64_t, std::int64_t>, TrackSet> tracks_;
};

}  // namespace

Result<std::string> export_log(const ExportOptions& options) {
  const bool to_csv = !options.csv_folder.empty(), to_mcap = !options.mcap_file.empty();
  if (!to_csv && !to_mcap) return fail("nothing to write: name --csv DIR, --mcap FILE or both");
  std::error_code error;
  if (to_csv) std::filesystem::create_directories(options.csv_folder, error);
  if (error) return fail(options.csv_folder + ": " + error.message());

  CsvFiles csv(options.csv_folder);
  std::optional<McapWriter> mcap;
  if (to_mcap) mcap.emplace(options.mcap_file);
  std::int64_t messages = 0;
  FlightLog log(options.suffix);
  on_every_channel(log, options.suffix, [&](const LoggedMessage& message) {
    ++messages;
    if (to_csv) csv.add(message);
    if (mcap) add(*mcap, message);
  });
  std::optional<Proofs> proofs;
  if (mcap) {
    add_maps(log, *mcap);
    proofs.emplace(*mcap).listen(log);
  }
  const auto contents = log.read(options.log);
  if (!contents) return tl::make_unexpected(contents.error());
  if (messages == 0) return fail(options.log + ": holds no message of Tern");
  if (const auto written = csv.finish(); !written) return tl::make_unexpected(written.error());
  if (mcap) {
    if (const auto written = mcap->finish(); !written) return tl::make_unexpected(written.error());
  }
  return fmt::format("{} messages exported\n{}", messages, shortfalls(*contents));
}

}  // namespace tern::exporting
