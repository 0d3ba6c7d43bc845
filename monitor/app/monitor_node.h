// tern-monitor: shows a flight, judges its end and writes its summary.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/scenario/scenario.h"
#include "core/world/voxel_map.h"
#include "monitor/app/terminal.h"
#include "monitor/flight_watch.h"
#include "runtime/batches.h"
#include "runtime/bus.h"
#include "runtime/node.h"
#include "runtime/process.h"

namespace tern {

struct MonitorOptions {
  std::string summary_file;  ///< file for the summary's JSON; empty: none
  std::string log;           ///< path of the recording, named in the summary
  std::string command;       ///< command line of the user, named in the summary
  std::string failure_file;  ///< if this file appears, the flight has failed, and its text is the reason; empty: none
};

/// Receives the channels by which it judges, and those that no other process counts. Finishes with the outcome as exit
/// code (flight_summary.h).
class MonitorNode final : public Node {
 public:
  /// @throws ConfigError if the summary's file cannot be written
  MonitorNode(Bus& bus, const Scenario& scenario, MonitorOptions options);

  [[nodiscard]] UTime next_wakeup() const override { return next_look_; }
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override { return {ProcessState::Ready, ""}; }
  [[nodiscard]] std::optional<int> finished() const override { return exit_code_; }

 private:
  void check_summary_file() const;
  void subscribe();
  void look_for_failure();
  void finish(const Ending& ending);

  Bus& bus_;
  MonitorOptions options_;
  FlightWatch watch_;
  BatchCollector<ObstacleTruth> truth_;
  MapAssembler map_;
  LiveOutput output_;
  UTime next_look_, next_line_;
  std::optional<int> exit_code_;
};

/// Makes the node with the flight's time limit (timed()). @throws ConfigError as the constructor
std::unique_ptr<MonitorNode> make_monitor(ProcessContext& context, const MonitorOptions& options);

}  // namespace tern
