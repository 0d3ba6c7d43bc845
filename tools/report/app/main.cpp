// tern-report: draws a recorded flight as one HTML file.
#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "core/base/files.h"
#include "runtime/command_line.h"
#include "runtime/config.h"
#include "runtime/tool.h"
#include "runtime/version.h"
#include "tools/audit/app/load_flight.h"
#include "tools/report/report_data.h"

namespace {

int run(const std::string& log, const std::string& page) {
  const tern::audit::FlightRecord record = tern::value_or_throw(tern::audit::load_flight(log));
  const std::string html = tern::report::report_page(record, tern::audit::audit_flight(record),
                                                     {tern::audit::typed_command(log), tern::audit::flown_pace(log)});
  if (!tern::write_text(page, html)) throw std::runtime_error(page + " cannot be written");
  fmt::print("{}\n", page);
  return 0;
}

std::string beside(const std::string& log) {
  namespace fs = std::filesystem;
  return (fs::is_directory(log) ? fs::path(log) / "report.html" : fs::path(log).replace_extension(".html")).string();
}

}  // namespace

int main(int argc, char** argv) {
  tern::CommandLine app{
      "Draws a recorded flight as one self-contained HTML file. Exit code: 0 written, 2 bad arguments or log."};
  app.set_version_flag("--version", fmt::format("tern-report {}", tern::build_id()));
  std::string log, page;
  app.add_option("LOG", log, "The log: a file (further parts are found), or a flight's folder")->required();
  app.add_option("-o,--out,--output", page, "The file to write (default: beside the log)")->type_name("FILE.html");
  return tern::run_tool(app, "tern-report", argc, argv, [&] { return run(log, page.empty() ? beside(log) : page); });
}
