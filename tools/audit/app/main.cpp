// tern-audit: recomputes a recorded flight and says what was broken.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "core/base/files.h"
#include "runtime/command_line.h"
#include "runtime/config.h"
#include "runtime/tool.h"
#include "runtime/version.h"
#include "tools/audit/app/load_flight.h"
#include "tools/audit/audit.h"

namespace {

constexpr int kExitPartOnly = 3;   ///< nothing is broken in the part of the flight that the log holds
constexpr int kExitNotJudged = 4;  ///< the log holds no flight

int exit_code(tern::audit::Verdict verdict) {
  switch (verdict) {
    case tern::audit::Verdict::Held: return 0;
    case tern::audit::Verdict::Broken: return 1;
    case tern::audit::Verdict::Incomplete: return kExitPartOnly;
    default: return kExitNotJudged;
  }
}

int run(const std::string& log, const std::string& json_file) {
  const tern::audit::FlightRecord record = tern::value_or_throw(tern::audit::load_flight(log));
  const tern::audit::Audit audit = tern::audit::audit_flight(record);
  fmt::print("{}", tern::audit::to_text(audit, record));
  if (json_file.empty()) return exit_code(audit.verdict());
  // The log's path need not be UTF-8.
  const std::string json =
      tern::audit::to_json(audit, record).dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (!tern::write_text(json_file, json + "\n")) throw std::runtime_error(json_file + " cannot be written");
  return exit_code(audit.verdict());
}

}  // namespace

int main(int argc, char** argv) {
  tern::CommandLine app{
      "Recomputes a recorded flight and lists violations. Exit code: 0 held, 1 broken, 2 bad arguments or log, 3 "
      "incomplete, "
      "4 not judged."};
  app.set_version_flag("--version", fmt::format("tern-audit {}", tern::build_id()));
  std::string log, json;
  app.add_option("LOG", log, "The log: a file (further parts are found), or a flight's folder")->required();
  app.add_option("--json", json, "Also write the audit as JSON to this file")->type_name("FILE");
  return tern::run_tool(app, "tern-audit", argc, argv, [&] { return run(log, json); });
}
