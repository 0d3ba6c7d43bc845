#include "predictor/app/predictor_config.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/support/temp_folder.h"

namespace tern {
namespace {

// The section of a file with these lines under `predictor:`.
PredictorConfig read(const std::string& lines) {
  const TempFolder folder;
  const std::string file = folder.file("predictor.yaml");
  std::ofstream(file) << "predictor:\n" << lines;
  ConfigDocument document = ConfigDocument::load(file, {});
  return read_predictor_config(document.root().section("predictor"));
}

void expect_refused(const std::string& lines, const std::string& says) {
  try {
    read(lines);
    ADD_FAILURE() << lines << " was accepted";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
  }
}

TEST(PredictorConfig, HasDefaults) {
  const PredictorConfig config = read("  {}\n");
  EXPECT_EQ(config.model, PredictorModel::Both);
  EXPECT_EQ(config.period(), Duration{50'000});
  EXPECT_EQ(config.tracker.prediction.horizon, Duration{4'500'000});
  EXPECT_EQ(config.tracker.prediction.confidence, 0.99);
}

TEST(PredictorConfig, ReadsItsKeys) {
  const PredictorConfig config = read(
      "  model: detections\n  rate_hz: 10\n  horizon_s: 3\n  piece_s: 0.5\n"
      "  confidence: 0.9\n  max_speed: 2\n  confirm_hits: 2\n"
      "  confirm_window: 4\n  coast_s: 1\n  resting_after_s: 2\n"
      "  piece_growth: 0.1\n  remember_rest_s: 7\n");
  EXPECT_EQ(config.model, PredictorModel::Detections);
  EXPECT_EQ(config.period(), Duration{100'000});
  EXPECT_EQ(config.tracker.prediction.piece, Duration{500'000});
  EXPECT_EQ(config.tracker.prediction.max_speed, 2.0);
  EXPECT_EQ(config.tracker.prediction.piece_growth, 0.1);
  EXPECT_EQ(config.tracker.remember_rest, Duration{7'000'000});
  EXPECT_EQ(config.tracker.confirm_hits, 2);
  EXPECT_EQ(config.tracker.confirm_window, 4);
  EXPECT_EQ(config.tracker.coast, Duration{1'000'000});
  EXPECT_EQ(config.tracker.resting_after, Duration{2'000'000});
}

TEST(PredictorConfig, RefusesWhatIsWrong) {
  expect_refused("  modle: declared\n", "modle");
  expect_refused("  model: kalman\n", "kalman");
  expect_refused("  confidence: 1\n", "confidence");
  expect_refused("  max_speed: fast\n", "max_speed");
  expect_refused("  confirm_hits: 6\n", "confirm_window");
}

// A track with more pieces than a message holds would be left out of every set.
TEST(PredictorConfig, RefusesMorePiecesThanAMessageTakes) {
  const auto with_piece = [](double piece_s) {
    return "  horizon_s: 23\n  piece_growth: 0\n  piece_s: " + std::to_string(piece_s) + "\n";
  };
  EXPECT_EQ(piece_ends(read(with_piece(0.05)).tracker.prediction).size(), 461u);
  expect_refused("  horizon_s: 30\n  piece_growth: 0\n  piece_s: 0.05\n", "600 pieces");
  expect_refused("  horizon_s: 23.01\n  piece_growth: 0\n  piece_s: 0.05\n", "piece_s");
}

}  // namespace
}  // namespace tern
