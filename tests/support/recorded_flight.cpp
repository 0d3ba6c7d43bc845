#include "tests/support/recorded_flight.h"

#include <stdexcept>

#include "campaign/virtual_system.h"
#include "logger/records/log_writer.h"
#include "simulator/app/simulator_node.h"
#include "tools/log_reader/log_reader.h"

namespace tern::testing {
namespace {

constexpr Duration kLongestFlight{600LL * 1'000'000};

LogWriter writer_of(const std::string& path) {
  auto writer = LogWriter::open(path, 0);
  if (!writer) throw std::runtime_error(writer.error().message);
  return std::move(*writer);
}

}  // namespace

void record_flight(const std::string& scenario_file, const std::vector<std::string>& overrides,
                   const std::string& log) {
  LogWriter writer = writer_of(log);
  VirtualSystem system(scenario_file, overrides);
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
  auto reader = LogReader::open(from);
  if (!reader) throw std::runtime_error(reader.error().message);
  LogWriter writer = writer_of(to);
  while (auto event = reader->next()) {
    change(event->channel, event->data);
    if (!event->data.empty()) writer.append(event->channel, event->received_us, event->data);
  }
  if (const auto flushed = writer.flush(); !flushed) throw std::runtime_error(flushed.error().message);
}

}  // namespace tern::testing
