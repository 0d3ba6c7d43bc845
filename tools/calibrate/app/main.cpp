// tern-calibrate: measures the coverage of predictions in recorded flights, and makes the prior of the calibration.

#include "runtime/command_line.h"
#include "runtime/tool.h"
#include "tools/calibrate/calibrate.h"

int main(int argc, char** argv) {
  tern::CommandLine app{
      "Predicts the obstacles of recorded flights anew from their detections. Prints the coverage and the width of the "
      "prediction intervals. Exit code: 0, or 2 for bad arguments or logs."};
  tern::calibrate::CalibrationRequest request;
  app.add_option("LOG", request.logs, "Logs: files, or folders that hold flight.lcm");
  app.add_option("--made-up", request.synthetic, "Add this many synthetic recordings of each kind of motion")
      ->range(0, 100);
  app.add_option("--csv", request.csv, "Also write the table to FILE")->type_name("FILE");
  app.add_option("--prior", request.prior, "Write the prior of the calibration, made from all recordings, to FILE")
      ->type_name("FILE");
  return tern::run_tool(app, "tern-calibrate", argc, argv, [&] {
    tern::calibrate::calibrate(request);
    return 0;
  });
}
