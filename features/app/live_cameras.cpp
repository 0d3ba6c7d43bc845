#include "features/app/live_cameras.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <utility>

namespace tern {
namespace {

constexpr Duration kRetry{1'000'000};

cv::VideoCapture opened(const std::string& source) {
  int device = 0;
  const auto [end, error] = std::from_chars(source.data(), source.data() + source.size(), device);
  if (error == std::errc{} && end == source.data() + source.size()) return cv::VideoCapture(device);
  return cv::VideoCapture(source);
}

GrayImage gray(const cv::Mat& image) {
  cv::Mat grey = image;
  if (image.channels() == 3) cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  if (image.channels() == 4) cv::cvtColor(image, grey, cv::COLOR_BGRA2GRAY);
  if (grey.depth() == CV_16U) grey.convertTo(grey, CV_8U, 1.0 / 256.0);
  if (grey.type() != CV_8UC1) return {};
  return {grey.cols, grey.rows, {grey.begin<std::uint8_t>(), grey.end<std::uint8_t>()}};
}

}  // namespace

/// Both captures while they are open.
class OpenCameras {
 public:
  OpenCameras(const std::string& left, const std::string& right)
      : left_(opened(left)), right_(right.empty() ? cv::VideoCapture() : opened(right)), has_right_(!right.empty()) {}
  [[nodiscard]] bool are_open() const { return left_.isOpened() && (!has_right_ || right_.isOpened()); }
  /// A file has a number of frames; a camera has none.
  [[nodiscard]] bool is_file() const { return left_.get(cv::CAP_PROP_FRAME_COUNT) > 0.0; }
  [[nodiscard]] Duration position() const { return Duration::from_seconds(left_.get(cv::CAP_PROP_POS_MSEC) * 1e-3); }
  bool grab() { return left_.grab() && (!has_right_ || right_.grab()); }
  std::pair<GrayImage, GrayImage> retrieve() {
    cv::Mat left, right;
    left_.retrieve(left);
    if (has_right_) {
      right_.retrieve(right);
      return {gray(left), gray(right)};
    }
    const int half = left.cols / 2;
    return {gray(left.colRange(0, half)), gray(left.colRange(half, 2 * half))};
  }
  UTime began;  ///< a file's time 0

 private:
  cv::VideoCapture left_, right_;
  bool has_right_;
};

LiveCameras::LiveCameras(const Clock& clock, std::string left, std::string right)
    : clock_(clock), left_(std::move(left)), right_(std::move(right)), thread_([this] { run(); }) {}

LiveCameras::~LiveCameras() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  stopped_.notify_all();
  thread_.join();
}

std::optional<LivePair> LiveCameras::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(newest_, std::nullopt);
}

LiveStatus LiveCameras::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

bool LiveCameras::wait(Duration time) {
  std::unique_lock lock(mutex_);
  const std::chrono::microseconds span(clock_.in_system_time(time).us);
  return !stopped_.wait_for(lock, span, [this] { return stop_; });
}

void LiveCameras::report(const std::string& trouble) {
  const std::lock_guard lock(mutex_);
  status_.trouble = trouble;
}

bool LiveCameras::read(OpenCameras& cameras) {
  if (!cameras.grab()) return false;
  LivePair pair;
  pair.at = clock_.now();
  if (cameras.is_file()) {
    pair.at = cameras.began + cameras.position();
    if (!wait(std::max(pair.at - clock_.now(), Duration{}))) return false;
  }
  std::tie(pair.left, pair.right) = cameras.retrieve();
  const std::lock_guard lock(mutex_);
  status_.trouble.clear();
  if (newest_) ++status_.skipped;
  newest_ = std::move(pair);
  return true;
}

void LiveCameras::run() {
  do {
    std::string trouble = fmt::format("camera {}{}{}: ", left_, right_.empty() ? "" : " or ", right_);
    try {
      OpenCameras cameras(left_, right_);
      cameras.began = clock_.now();
      while (cameras.are_open() && read(cameras) && wait({})) {
      }
      trouble += cameras.are_open() ? "no more images" : "cannot be opened";
    } catch (const cv::Exception& e) {
      trouble += e.err;
    }
    report(trouble);
  } while (wait(kRetry));
}

}  // namespace tern
