#include "tools/audit/configured.h"

#include <cstdlib>
#include <sstream>

namespace tern::audit {

std::optional<std::string> configured(const FlightRecord& record, std::string_view process, std::string_view key) {
  std::optional<std::string> value;
  for (const ConfigurationReport& report : record.configurations) {
    if (report.process != process) continue;
    std::istringstream lines(report.yaml);
    for (std::string line; std::getline(lines, line);) {
      const std::size_t begin = line.find_first_not_of(' ');
      if (begin == std::string::npos || line.compare(begin, key.size(), key) != 0) continue;
      const std::size_t colon = begin + key.size();
      if (line.compare(colon, 2, ": ") == 0) value = line.substr(colon + 2);
    }
  }
  return value;
}

std::optional<double> configured_number(const FlightRecord& record, std::string_view process, std::string_view key) {
  const auto text = configured(record, process, key);
  if (!text) return std::nullopt;
  char* end = nullptr;
  const double number = std::strtod(text->c_str(), &end);
  if (end == text->c_str()) return std::nullopt;
  return number;
}

}  // namespace tern::audit
