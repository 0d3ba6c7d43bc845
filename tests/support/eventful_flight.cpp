#include "tests/support/eventful_flight.h"

#include <span>
#include <stdexcept>
#include <string_view>

#include "flight_log/log_writer.h"

namespace tern::testing {

void record_virtually(const EventfulFlight& flight, const std::string& log) {
  VirtualSystem system(flight.scenario_file, flight.overrides);
  VirtualRunner& runner = system.runner();
  auto writer = LogWriter::open(log, 0);
  if (!writer) throw std::runtime_error(writer.error().message);
  runner.observer().listen([&](std::string_view channel, std::int64_t, std::span<const std::uint8_t> bytes) {
    writer->append(channel, runner.now().us, bytes);
  });
  const UTime start = runner.now();
  for (const auto& [second, happen] : flight.events) {
    runner.run(start + Duration::from_seconds(second));
    happen(system);
  }
  runner.run(start + Duration::from_seconds(flight.seconds));
  if (const auto flushed = writer->flush(); !flushed) throw std::runtime_error(flushed.error().message);
}

}  // namespace tern::testing
