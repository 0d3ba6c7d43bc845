#include "viewer/bridge/app/flight_note.h"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace tern {

FlightNote read_flight_note(const std::string& log) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::is_directory(log) ? fs::path(log) : fs::path(log).parent_path();
  std::ifstream file(folder / "summary.json");
  const auto summary = nlohmann::json::parse(file, nullptr, false);
  FlightNote note;
  if (!summary.is_object()) return note;
  const auto pace = summary.find("pace"), why = summary.find("why");
  if (pace != summary.end() && pace->is_number()) {
    if (const double x = pace->get<double>(); x > 0.0 && x <= 1.0) note.pace = x;
  }
  if (why != summary.end() && why->is_string()) note.why = why->get<std::string>();
  return note;
}

}  // namespace tern
