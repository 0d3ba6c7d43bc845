#include <nlohmann/json.hpp>
#include <string>

#include "tools/report/page.h"
#include "tools/report/report_data.h"

namespace tern::report {
namespace {

/// Escapes JSON for a script element: no text in it may end the element or begin a comment.
std::string escaped(const nlohmann::json& data) {
  const std::string text = data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace

std::string report_page(const audit::FlightRecord& record, const audit::Audit& audit, const FlightLaunch& launch) {
  // The policy forbids every request.
  return std::string("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n") +
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n" +
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
         "script-src 'unsafe-inline'; img-src data:\">\n<title>Tern flight report</title>\n<style>" +
         kPageStyle + "</style>\n</head>\n<body>\n<main></main>\n<script type=\"application/json\" id=\"data\">" +
         escaped(report_data(record, audit, launch)) + "</script>\n<!-- uPlot\n" + kPageChartsLicence +
         "-->\n<script>" + kPageCharts + "</script>\n<script>" + kPageScript + "</script>\n</body>\n</html>\n";
}

}  // namespace tern::report
