#include "tools/replay/recorded_inputs.h"

#include <algorithm>
#include <utility>

#include "flight_log/track_sets.h"
#include "messages/codec.h"

namespace tern {
namespace {

/// Number of incomplete maps that are kept; the oldest is dropped first.
constexpr std::size_t kMaxUnfinished = 32;

/// Collects a map per version, since a restarted planner may use an older one than later planners do.
class Maps {
 public:
  explicit Maps(std::map<std::uint64_t, VoxelMap>& complete) : complete_(complete) {}
  void add(const MapChunk& chunk) {
    if (complete_.contains(chunk.version)) return;
    MapAssembler& assembler = unfinished_[chunk.version];
    const auto done = assembler.add(chunk);
    if (done && *done) complete_.emplace(chunk.version, assembler.take());
    if ((done && *done) || !done) unfinished_.erase(chunk.version);
    if (unfinished_.size() > kMaxUnfinished) unfinished_.erase(unfinished_.begin());
  }

 private:
  std::map<std::uint64_t, VoxelMap>& complete_;
  std::map<std::uint64_t, MapAssembler> unfinished_;
};

/// The messages of planners beside their plans. A restarted executor counts its requests from 1 again, so the id alone
/// does not name a request.
struct BesidePlans {
  std::map<MessageName, PlanTiming> timings;  ///< a planner sends one per plan, so with the name of the plan
  std::map<std::pair<std::int64_t, MessageName>, PlanHeading> headings;  ///< by planner and request

  void attach(std::vector<RecordedPlan>& plans) const {
    for (RecordedPlan& recorded : plans) {
      const MessageName& name = recorded.plan.header.name;
      const auto timing = timings.find(name);
      const bool is_its = timing != timings.end() && timing->second.request_id == recorded.plan.request_id;
      if (is_its) recorded.timing = timing->second;
      const auto heading = headings.find({name.sender_epoch_us, recorded.plan.inputs.request});
      if (heading != headings.end()) recorded.heading = heading->second;
    }
  }
};

/// Returns whether any planner kept a field of unseen movers.
bool watches_unseen(const RecordedInputs& inputs) {
  return std::ranges::any_of(inputs.configurations, [](const auto& known) {
    return known.second.yaml.find("unseen: passive") != std::string::npos;
  });
}

/// Reads the views of all frames of OBSTACLE_SIGHTINGS.
Result<void> read_frames(const std::string& path, const std::string& suffix, RecordedInputs& inputs) {
  FlightLog log(suffix);
  log.on(channels::kObstacleSightings, [&](const SightingSet& frame, std::int64_t) {
    inputs.frames.push_back(frame);
    inputs.frames.back().sightings.clear();
  });
  log.on(channels::kHorizonRequest, [&](const HorizonRequest& request, std::int64_t) {
    inputs.frames_before.emplace(request.header.name, inputs.frames.size());
  });
  auto contents = log.read(path);
  if (!contents) return tl::make_unexpected(contents.error());
  return {};
}

}  // namespace

Result<RecordedInputs> read_recorded_inputs(const std::string& path, const std::string& suffix) {
  RecordedInputs inputs;
  Maps maps(inputs.maps);
  BesidePlans beside;
  FlightLog log(suffix);
  log.on(channels::kHorizonRequest,
         [&](const HorizonRequest& request, std::int64_t) { inputs.requests.emplace(request.header.name, request); });
  log.on(channels::kGoal, [&](const Goal& goal, std::int64_t) { inputs.goals.emplace(goal.header.name, goal); });
  log.on(channels::kSemanticMap, [&](const MapChunk& chunk, std::int64_t) { maps.add(chunk); });
  log.on(channels::kLandmarkDensities, [&](const LandmarkDensities& densities, std::int64_t) {
    inputs.densities.emplace(densities.statics, densities);
  });
  log.on(channels::kConfiguration, [&](const ConfigurationReport& report, std::int64_t) {
    inputs.configurations.emplace(report.hash, report);
    inputs.platforms.emplace(report.header.name.sender_epoch_us, report.platform);
  });
  log.on(channels::kPlan, [&](const Plan& plan, std::int64_t received_us) {
    inputs.plans.push_back({plan, received_us, std::nullopt, std::nullopt});
  });
  log.on(channels::kPlanTiming,
         [&](const PlanTiming& timing, std::int64_t) { beside.timings[timing.header.name] = timing; });
  log.on(channels::kPlanHeading, [&](const PlanHeading& heading, std::int64_t) {
    beside.headings[{heading.header.name.sender_epoch_us, heading.request}] = heading;
  });
  auto contents = log.read(path);
  if (!contents) return tl::make_unexpected(contents.error());
  if (watches_unseen(inputs)) {
    if (auto read = read_frames(path, suffix, inputs); !read) return tl::make_unexpected(read.error());
  }
  beside.attach(inputs.plans);
  inputs.log = std::move(*contents);
  return inputs;
}

Result<LogContents> read_prediction_sets(const std::string& path, const std::string& suffix,
                                         const std::function<void(TrackSet)>& use) {
  RecordedSets sets;
  FlightLog log(suffix);
  log.on(channels::kPoseError, [&](const PoseError& error, std::int64_t) { sets.add(error); });
  log.on(channels::kPredictions, [&](const TrackSet& batch, std::int64_t) {
    if (auto whole = sets.add(batch)) use(std::move(*whole));
  });
  return log.read(path);
}

}  // namespace tern
