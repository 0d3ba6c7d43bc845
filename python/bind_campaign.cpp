#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <filesystem>
#include <utility>

#include "campaign/campaign.h"
#include "campaign/recorded_flight.h"
#include "python/bindings.h"

namespace py = pybind11;

namespace tern::python {
namespace {

Charge charge_of(const std::string& word) {
  if (word != "counts" && word != "cpu") throw py::value_error("charge: " + word + ", not counts or cpu");
  return word == "cpu" ? Charge::Cpu : Charge::Counts;
}

std::string fly_one(const std::string& scenario, const std::vector<std::string>& settings, const std::string& charge,
                    std::uint64_t seed, const std::string& folder) {
  const FlightInputs inputs{scenario, settings, charge_of(charge)};
  const py::gil_scoped_release release;
  try {
    const CampaignIdentity identity = check_inputs(inputs, seed);
    std::filesystem::create_directories(folder);
    const RecordedFlight flight = fly_recorded(inputs, seed, identity, folder, {});
    return encode_flight(flight.record, flight.times);
  } catch (const CannotRecord& error) {
    throw FileError(error.what());
  }
}

/// Calls `progress(done, total, successes)` after each flight. An exception of it, and Ctrl-C, end the campaign.
void run(const std::string& scenario, const std::vector<std::string>& settings, const std::string& charge,
         std::pair<std::uint64_t, std::uint64_t> seeds, int jobs, const std::string& out,
         const std::vector<std::string>& command,
         const std::function<void(std::int64_t, std::int64_t, std::int64_t)>& progress) {
  CampaignOptions options;
  options.inputs = {scenario, settings, charge_of(charge)};
  std::tie(options.first_seed, options.last_seed) = seeds;
  options.jobs = jobs;
  options.out = out;
  options.failures = default_failures(out);
  const py::gil_scoped_release release;
  const auto end = run_campaign(options, command, -1, [&progress](const CampaignProgress& p) {
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (progress) progress(p.done, p.total, p.successes);
  });
  if (!end) throw FileError(end.error().message);
  if (*end == CampaignEnd::Interrupted) throw std::runtime_error("a flight's process was ended from outside");
}

}  // namespace

void bind_campaign(py::module_& m) {
  using namespace py::literals;
  m.def(
      "fly_one", &fly_one, "scenario"_a, "settings"_a, "charge"_a, "seed"_a, "folder"_a,
      "Flies one seed on virtual time and writes scenario.yaml, flight.lcm and summary.json to the folder. Returns two "
      "lines of CSV, as tern-campaign fly-one prints them.");
  m.def("run_campaign", &run, "scenario"_a, "settings"_a, "charge"_a, "seeds"_a, "jobs"_a, "out"_a, "command"_a,
        "progress"_a, "Flies the seeds that are missing in the file `out`, by the command. See campaign().");
  m.def(
      "flight_columns", [] { return flight_columns(); }, "The columns of FLIGHTS.csv.");
}

}  // namespace tern::python
