// The node: a recording becomes IMU and FEATURE_TRACKS in its own time; bad files are named and change nothing else.
#include "features/app/features_node.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <thread>

#include "messages/codec.h"
#include "runtime/virtual_runner.h"
#include "tests/features/recording_files.h"
#include "tests/support/rendered_flight.h"
#include "tests/support/temp_folder.h"

namespace tern {
namespace {

constexpr int kFrames = 12;
constexpr std::int64_t kStartNs = 1'403'715'273'262'142'976;

/// Writes 12 pairs at 20 Hz and 200 Hz of IMU samples.
class FeaturesNodeTest : public ::testing::Test {
 protected:
  FeaturesNodeTest() {
    support::write_text(path("cam0/sensor.yaml"), support::euroc_sensor_yaml(-0.055, 376, 240));
    support::write_text(path("cam1/sensor.yaml"), support::euroc_sensor_yaml(0.055, 376, 240));
    const StereoCalibration calibration = read_euroc_calibration(folder_.file("mav0"), body_from_imu("z -y x"));
    const support::SceneRig rig(calibration.rig, support::hall_with_box());
    std::string images = "#timestamp [ns],filename\n", samples = "#timestamp [ns],w_x,w_y,w_z,a_x,a_y,a_z\r\n";
    for (int k = 0; k < kFrames; ++k) {
      const std::string name = std::to_string(stamp(k)) + ".png";
      images += std::to_string(stamp(k)) + "," + name + "\r\n";
      NavState state;
      state.p = Vec3(3.0, 0.02 * k, 1.5);
      state.R = Eigen::AngleAxisd(1.5, Vec3::UnitZ()).toRotationMatrix();
      const support::ImagePair pair = rig.see(0.05 * k, state);
      support::write_image(path("cam0/data/" + name), pair.left);
      support::write_image(path("cam1/data/" + name), pair.right);
      for (int i = 0; i < 10; ++i) {
        samples += std::to_string(stamp(k) + i * 5'000'000) + ",0.1," + std::to_string(i) + ",0.3,9.8,0.5,0.25\n";
      }
    }
    support::write_text(path("cam0/data.csv"), images);
    support::write_text(path("cam1/data.csv"), images);
    support::write_text(path("imu0/data.csv"), samples);
    config_.recording = folder_.file("");
    config_.body_axes = "z -y x";
  }

  static std::int64_t stamp(int k) { return kStartNs + k * 50'000'000LL; }
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.file("mav0/" + name); }
  [[nodiscard]] std::string image(int camera, int k) const {
    return path("cam" + std::to_string(camera) + "/data/" + std::to_string(stamp(k)) + ".png");
  }

  /// Plays until the node has finished. @param each  called for each published frame
  RunResult play(const std::function<void()>& each = [] {}) {
    runner_.observer().subscribe(channels::kImu, [this](const ImuBatch& batch) {
      samples_.insert(samples_.end(), batch.samples.begin(), batch.samples.end());
    });
    runner_.observer().subscribe(channels::kFeatureTracks, [this, each](const FeatureFrame& frame) {
      frames_.push_back(frame);
      samples_before_.push_back(samples_.size());
      each();
    });
    node_ = &runner_.start("tern-features", [this](Bus& bus) { return std::make_unique<FeaturesNode>(bus, config_); });
    began_ = runner_.now();
    return runner_.run(runner_.now() + Duration{5'000'000});
  }

  TempFolder folder_;
  FeaturesConfig config_;
  VirtualRunner runner_;
  Node* node_ = nullptr;
  UTime began_;
  std::vector<FeatureFrame> frames_;
  std::vector<ImuSample> samples_;
  std::vector<std::size_t> samples_before_;
};

TEST_F(FeaturesNodeTest, PlaysImagesAndImuInTheirOwnTime) {
  config_.sensor = 3;
  const RunResult result = play();
  EXPECT_EQ(result.end, RunEnd::Finished);
  EXPECT_EQ(result.exit_code, 0);
  ASSERT_EQ(frames_.size(), idx(kFrames));
  for (int k = 0; k < kFrames; ++k) {
    EXPECT_EQ(frames_[idx(k)].at, began_ + Duration{50'000} * k);
    EXPECT_EQ(frames_[idx(k)].header.utime, frames_[idx(k)].at) << "sent at the time of its images";
    EXPECT_EQ(frames_[idx(k)].sensor_id, 3);
    EXPECT_GT(frames_[idx(k)].features.size(), 20u);
  }
  EXPECT_GT(frames_.front().features.front().id, 0);
  EXPECT_EQ(frames_.back().features.front().id, frames_.front().features.front().id) << "it is followed all along";
  // Ten samples between two frames, the last one of the frame's own time; means of two, in the body's axes.
  EXPECT_EQ(samples_before_[1], 10u);
  EXPECT_EQ(samples_[9].at, frames_[1].at);
  EXPECT_EQ(samples_[0].angular_velocity, Vec3(0.3, -0.5, 0.1));
  EXPECT_EQ(samples_[0].specific_force, Vec3(0.25, -0.5, 9.8));
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
}

TEST_F(FeaturesNodeTest, NamesBadFilesAndGoesOn) {
  std::filesystem::remove(image(1, 4));
  support::write_image(image(0, 5), GrayImage{64, 64, std::vector<std::uint8_t>(64 * 64, 90)});
  std::filesystem::copy_file(image(0, 6), image(0, 7), std::filesystem::copy_options::overwrite_existing);
  std::filesystem::copy_file(image(1, 6), image(1, 7), std::filesystem::copy_options::overwrite_existing);
  support::write_image(image(0, 9), GrayImage{376, 240, std::vector<std::uint8_t>(376 * 240, 1)});
  std::vector<std::string> said;
  play([&] { said.push_back(node_->health().waiting_for); });
  ASSERT_EQ(frames_.size(), 9u) << "4, 5 and 7 are not used";
  EXPECT_EQ(said[3], "");
  EXPECT_NE(said[4].find("another size"), std::string::npos) << said[4] << " (the newest trouble)";
  EXPECT_NE(said[5].find("equal to those before"), std::string::npos);
  EXPECT_NE(said[6].find("black"), std::string::npos);
  EXPECT_TRUE(frames_[6].features.empty());
  EXPECT_GT(frames_[7].features.front().id, frames_[5].features.back().id) << "tracks begin anew after the dark";
  EXPECT_EQ(samples_.size(), 119u - 9u) << "the IMU is not interrupted; it ends with the last image";
}

TEST_F(FeaturesNodeTest, BeginsWhereAsked) {
  config_.from_s = 0.2;
  config_.imu = false;
  config_.time_shift_s = 0.003;
  play();
  EXPECT_EQ(frames_.size(), 8u);
  EXPECT_EQ(frames_.front().at, began_ + Duration{3'000});
  EXPECT_TRUE(samples_.empty());
}

TEST_F(FeaturesNodeTest, ImagesThatStepBackAreNamed) {
  const std::string row = std::to_string(stamp(2)) + "," + std::to_string(stamp(2)) + ".png\n";
  const std::string later = std::to_string(stamp(5)) + "," + std::to_string(stamp(5)) + ".png\n";
  support::write_text(path("cam0/data.csv"), later + row);
  play();
  EXPECT_EQ(frames_.size(), 1u);
  EXPECT_NE(node_->health().waiting_for.find("stepped back"), std::string::npos);
}

TEST_F(FeaturesNodeTest, RefusesARecordingThatItCannotRead) {
  const auto refusal = [&]() -> std::string {
    try {
      Bus& bus = runner_.observer();
      FeaturesNode node(bus, config_);
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(), "");
  support::write_text(path("imu0/data.csv"), "#\n1403715273262142976,0,0,0,9.8,0\n");
  EXPECT_NE(refusal().find("imu0/data.csv:2"), std::string::npos);
  config_.imu = false;
  support::write_text(path("cam0/data.csv"), "1403715273262142976;a.png\n");
  EXPECT_NE(refusal().find("cam0/data.csv:1"), std::string::npos);
  support::write_text(path("cam0/data.csv"), "5,a.png\n");
  EXPECT_NE(refusal().find("no left image has a right one"), std::string::npos);
  config_.left = "0";
  EXPECT_NE(refusal().find("either `recording` or `left`"), std::string::npos);
  config_.recording.clear();
  EXPECT_NE(refusal().find("camera chain of Kalibr"), std::string::npos);
}

/// A numbered sequence of images is a video file for OpenCV. Both images are side by side.
TEST_F(FeaturesNodeTest, LiveCamerasReadAStreamWithBothImagesSideBySide) {
  GrayImage wide{200, 50, std::vector<std::uint8_t>(200 * 50)};
  for (int k = 0; k < 200 * 50; ++k) wide.pixels[idx(k)] = static_cast<std::uint8_t>(k % 200);
  for (int k = 0; k < 3; ++k) support::write_image(folder_.file("wide/0" + std::to_string(k) + ".png"), wide);
  const WallClock clock;
  LiveCameras cameras(clock, folder_.file("wide/%02d.png"), "");
  std::optional<LivePair> pair;
  while (!(pair = cameras.take())) std::this_thread::yield();
  EXPECT_EQ(pair->left.width, 100);
  EXPECT_EQ(pair->right.width, 100);
  EXPECT_EQ(pair->left.pixels[5], 5);
  EXPECT_EQ(pair->right.pixels[5], 105);
}

TEST_F(FeaturesNodeTest, SaysThatACameraCannotBeOpened) {
  const WallClock clock;
  LiveCameras cameras(clock, folder_.file("no_such_file.avi"), "");
  while (cameras.status().trouble.empty()) std::this_thread::yield();
  EXPECT_NE(cameras.status().trouble.find("no_such_file.avi: cannot be opened"), std::string::npos);
  EXPECT_FALSE(cameras.take());
}

}  // namespace
}  // namespace tern
