#include "tests/support/recorded_flight.h"

#include <filesystem>
#include <stdexcept>

#include "campaign/virtual_system.h"
#include "flight_log/log_reader.h"
#include "flight_log/log_writer.h"
#include "simulator/app/simulator_node.h"

namespace tern::testing {
namespace {

constexpr Duration kLongestFlight{600LL * 1'000'000};

LogWriter writer_of(const std::string& path) {
  auto writer = LogWriter::open(path, 0);
  if (!writer) throw std::runtime_error(writer.error().message);
  return std::move(*writer);
}

/// Copies each event as often as `times` says of it.
template <class Times>
void copy_events(const std::vector<std::string>& from, const std::string& to, const Times& times) {
  LogWriter writer = writer_of(to);
  for (const std::string& log : from) {
    auto reader = LogReader::open(log);
    if (!reader) throw std::runtime_error(reader.error().message);
    while (auto event = reader->next()) {
      for (int left = times(*event); left > 0; --left) writer.append(event->channel, event->received_us, event->data);
    }
  }
  if (const auto flushed = writer.flush(); !flushed) throw std::runtime_error(flushed.error().message);
}

}  // namespace

std::string recorded_log(const std::string& name) {
  const std::string log = std::string(TERN_RECORDED_FLIGHTS "/") + name + ".lcm";
  if (!std::filesystem::exists(log))
    throw std::runtime_error(log + " is not there: ctest -R RecordedFlights records it");
  return log;
}

void record_flight(const std::string& scenario_file, const std::vector<std::string>& overrides, const std::string& log,
                   UTime start) {
  LogWriter writer = writer_of(log);
  VirtualSystem system(scenario_file, overrides, Charge::Counts, start);
  VirtualRunner& runner = system.runner();
  runner.observer().listen([&](std::string_view channel, std::int64_t, std::span<const std::uint8_t> data) {
    writer.append(channel, runner.now().us, data);
  });
  const SimulatorNode& simulator = system.simulator();
  runner.run(runner.now() + kLongestFlight, [&] { return simulator.result().has_value(); });
  if (!simulator.result()) throw std::runtime_error("no end within ten minutes");
  runner.run(runner.now() + Duration{1'000'000});
  if (const auto flushed = writer.flush(); !flushed) throw std::runtime_error(flushed.error().message);
}

void copy_log(const std::string& from, const std::string& to, const ChangeBytes& change) {
  copy_events({from}, to, [&](LogEvent& event) {
    change(event.channel, event.data);
    return event.data.empty() ? 0 : 1;
  });
}

void copy_part_of_log(const std::string& from, const std::string& to, std::int64_t from_us, std::int64_t to_us) {
  copy_events({from}, to, [&](const LogEvent& e) { return e.received_us >= from_us && e.received_us < to_us ? 1 : 0; });
}

void copy_log_without(const std::string& from, const std::string& to, std::int64_t from_us, std::int64_t to_us) {
  copy_events({from}, to, [&](const LogEvent& e) { return e.received_us >= from_us && e.received_us < to_us ? 0 : 1; });
}

void copy_log_repeated(const std::string& from, const std::string& to, int times) {
  copy_events({from}, to, [&](const LogEvent&) { return times; });
}

void join_logs(const std::vector<std::string>& from, const std::string& to) {
  copy_events(from, to, [](const LogEvent&) { return 1; });
}

}  // namespace tern::testing
