#include "campaign/page/campaign_page.h"

#include <nlohmann/json.hpp>

#include "campaign/page/parts.h"
#include "campaign/records/campaign_summary.h"
#include "core/world/names.h"

namespace tern {
namespace {

using Json = nlohmann::ordered_json;

/// Returns the values of every measure, a row per flight; null for unknown values.
Json measures_of(const Flights& flights) {
  const std::vector<ColumnNote> notes = column_notes();
  Json measures = Json::array();
  for (const ColumnNote& note : notes) {
    measures.push_back({{"name", note.name}, {"meaning", note.meaning}, {"values", Json::array()}});
  }
  for (const auto& [seed, record] : flights.records) {
    const CsvRecord cells = to_cells(record);
    for (std::size_t k = 0; k < notes.size(); ++k) {
      const bool has = notes[k].compared == Compared::All ||
                       (notes[k].compared == Compared::Reached && record.result.outcome == FlightOutcome::Reached);
      measures[k]["values"].push_back(has && !cells[k].empty() ? Json(std::stod(cells[k])) : Json(nullptr));
    }
  }
  return measures;
}

Json failures_of(const Flights& flights) {
  Json failures = Json::array();
  for (const auto& [seed, record] : flights.records) {
    if (is_success(record)) continue;
    failures.push_back({{"seed", seed},
                        {"outcome", to_string(record.result.outcome)},
                        {"detail", record.result.detail},
                        {"audit", record.audit},
                        {"log", record.log}});
  }
  return failures;
}

/// Escapes JSON for a script element: no text in it may end the element or begin a comment.
std::string inside_a_script(const Json& data) {
  std::string safe;
  for (const char c : data.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    c == '<' ? safe += "\\u003c" : safe += c;
  }
  return safe;
}

}  // namespace

std::string campaign_page(const Flights& flights, const std::string& failures) {
  const Json data = {{"summary", Json::parse(to_json(summarize(flights), ""))},
                     {"measures", measures_of(flights)},
                     {"failures", failures_of(flights)},
                     {"folder", failures}};
  return std::string("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n") +
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n" +
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
         "script-src 'unsafe-inline'\">\n<title>Tern campaign</title>\n<style>" +
         kCampaignStyle + "</style>\n</head>\n<body>\n<main></main>\n<script type=\"application/json\" id=\"data\">" +
         inside_a_script(data) + "</script>\n<script>" + kCampaignScript + "</script>\n</body>\n</html>\n";
}

}  // namespace tern
