// tern-calibrate: holds predictions against what came, in logs of flights, and makes the table that calibration begins
// with.
#include <CLI/CLI.hpp>

#include "runtime/tool.h"
#include "tools/calibrate/calibrate.h"

int main(int argc, char** argv) {
  CLI::App app{
      "Predicts the obstacles of recorded flights anew from their detections, and says how often and how widely "
      "promises were kept. Exit code: 0, or 2 for bad arguments or logs."};
  tern::calibrate::CalibrationRequest request;
  app.add_option("LOG", request.logs, "Logs: files, or folders of flight.lcm");
  app.add_option("--made-up", request.made_up, "So many recordings of made-up movers of each kind, too")
      ->check(CLI::Range(0, 100));
  app.add_option("--csv", request.csv, "Write the table there, too")->type_name("FILE");
  app.add_option("--prior", request.prior, "Write the table that calibration begins with, of these logs")
      ->type_name("FILE");
  return tern::run_tool(app, "tern-calibrate", argc, argv, [&] {
    tern::calibrate::calibrate(request);
    return 0;
  });
}
