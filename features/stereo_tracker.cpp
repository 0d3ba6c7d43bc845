#include "features/stereo_tracker.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <utility>
#include <vector>

#include "features/motion_check.h"

namespace tern {
namespace {

using Eigen::Vector2d;
using Pyramid = std::vector<cv::Mat>;

const cv::Size kWindow(15, 15);
constexpr int kPyramidLevels = 3;  ///< above the image itself; with this window, motions up to some 50 pixels are found
const cv::Size kMeanWindow(31, 31);
constexpr int kCornerBlock = 5;  ///< pixels
/// Nearer to an image's edge than this, the window would lack most of its pixels.
constexpr float kMargin = 8.0F;

cv::Mat as_mat(const GrayImage& image) {
  // OpenCV has no view of constant pixels; none of the functions here writes to its input.
  return {image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data())};
}

/// The image without its local mean: the two cameras differ in exposure, and Lucas-Kanade compares grey values.
Pyramid pyramid_of(const GrayImage& image) {
  cv::Mat mean, detail;
  cv::blur(as_mat(image), mean, kMeanWindow);
  cv::addWeighted(as_mat(image), 1.0, mean, -1.0, 128.0, detail);
  Pyramid pyramid;
  cv::buildOpticalFlowPyramid(detail, pyramid, kWindow, kPyramidLevels, true);
  return pyramid;
}

bool is_inside(const cv::Point2f& p, const cv::Size& size) {
  return p.x >= kMargin && p.y >= kMargin && p.x <= static_cast<float>(size.width - 1) - kMargin &&
         p.y <= static_cast<float>(size.height - 1) - kMargin;
}

/// Follows points from one image to another, beginning at `to`, and back.
/// @return for each point whether it was found, inside the image, and came back
std::vector<bool> follow(const Pyramid& from_image, const Pyramid& to_image, const std::vector<cv::Point2f>& from,
                         std::vector<cv::Point2f>& to) {
  if (from.empty()) return {};
  const cv::TermCriteria criteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 30, 0.01);
  const auto flow = [&](const Pyramid& a, const Pyramid& b, const std::vector<cv::Point2f>& start,
                        std::vector<cv::Point2f>& end) {
    std::vector<std::uint8_t> found;
    cv::calcOpticalFlowPyrLK(a, b, start, end, found, cv::noArray(), kWindow, kPyramidLevels, criteria,
                             cv::OPTFLOW_USE_INITIAL_FLOW);
    return found;
  };
  const std::vector<std::uint8_t> there = flow(from_image, to_image, from, to);
  std::vector<cv::Point2f> back = from;
  const std::vector<std::uint8_t> returned = flow(to_image, from_image, to, back);
  std::vector<bool> good(from.size());
  for (std::size_t k = 0; k < from.size(); ++k) {
    good[k] = there[k] != 0 && returned[k] != 0 && is_inside(to[k], to_image[0].size()) &&
              cv::norm(back[k] - from[k]) <= StereoTracker::kBackPx;
  }
  return good;
}

Vector2d as_vector(const cv::Point2f& p) { return {p.x, p.y}; }
cv::Point2f as_point(const Vector2d& p) { return {static_cast<float>(p.x()), static_cast<float>(p.y())}; }

/// A track has a vote per frame that it has been followed, up to this. A mover's tracks are ended while they are young,
/// so it is not taken for the surroundings when it fills half of the image.
constexpr int kMostVotes = 10;
constexpr std::int64_t kEnded = -1;  ///< id of a track that is to be erased

struct KltTrack {
  cv::Point2f left, right;  ///< pixels; right with feature.has_right
  Vector2d now;             ///< coordinates of `left`
  int age = 0;              ///< frames
  StereoFeature feature;    ///< as published; while a frame is handled, that of the frame before
};

}  // namespace

struct StereoTracker::State {
  StereoRig rig;
  KltConfig config;
  std::int64_t next_id;
  double pixel;  ///< in normalized coordinates
  Pyramid left_before;
  std::vector<KltTrack> tracks;  ///< by id ascending
  double usual_disparity = 0.0;  ///< the median of the newest frame that has one
  KltReport report;

  void follow_left(const Pyramid& left);
  void end_contradicted();
  int erase_ended();  ///< @return how many
  void begin(const GrayImage& left);
  void match_right(const Pyramid& left, const Pyramid& right);
  [[nodiscard]] cv::Point2f guess_right(const KltTrack& track) const;
  void look_right(KltTrack& track, const cv::Point2f& right) const;
  [[nodiscard]] FeatureFrame frame(UTime at) const;
};

void StereoTracker::State::follow_left(const Pyramid& left) {
  std::vector<cv::Point2f> from;
  for (const KltTrack& track : tracks) from.push_back(track.left);
  std::vector<cv::Point2f> to = from;
  const std::vector<bool> found = follow(left_before, left, from, to);
  for (std::size_t k = 0; k < tracks.size(); ++k) {
    const auto now = rig.left_coordinates(as_vector(to[k]));
    if (!found[k] || !now) {
      tracks[k].feature.id = kEnded;
      continue;
    }
    tracks[k].right += to[k] - from[k];
    tracks[k].left = to[k];
    tracks[k].now = *now;
    ++tracks[k].age;
  }
  report.lost = erase_ended();
}

int StereoTracker::State::erase_ended() {
  return static_cast<int>(std::erase_if(tracks, [](const KltTrack& track) { return track.feature.id == kEnded; }));
}

void StereoTracker::State::end_contradicted() {
  std::vector<MovedPoint> points;
  for (const KltTrack& track : tracks) {
    const StereoFeature& before = track.feature;
    const double disparity = before.left.x() - before.right.x();
    // A smaller disparity is no measured depth.
    const bool has_depth = before.has_right && disparity >= 2.0 * config.sigma_px * pixel;
    const double depth = has_depth ? rig.baseline() / disparity : 1.0;
    points.push_back({Vec3(before.left.x() * depth, before.left.y() * depth, depth), track.now, has_depth,
                      static_cast<double>(std::min(track.age, kMostVotes))});
  }
  const auto agrees = agree_with_motion(points, config.sigma_px * pixel, rig.baseline());
  if (!agrees) return;
  for (std::size_t k = 0; k < tracks.size(); ++k) {
    if (!(*agrees)[k]) tracks[k].feature.id = kEnded;
  }
  report.contradicted = erase_ended();
}

void StereoTracker::State::begin(const GrayImage& left) {
  if (std::ssize(tracks) >= config.at_most) return;
  cv::Mat strength;
  cv::cornerMinEigenVal(as_mat(left), strength, kCornerBlock);
  cv::Mat free(strength.size(), CV_8UC1, cv::Scalar(255));
  const int apart = static_cast<int>(std::lround(config.apart_px));
  const auto occupy = [&](const cv::Point2f& at) { cv::circle(free, at, apart, cv::Scalar(0), cv::FILLED); };
  for (const KltTrack& track : tracks) occupy(track.left);
  // cornerMinEigenVal() scales by 255, and its derivatives span two pixels.
  const double least = std::pow(2.0 * kLeastGradient / 255.0, 2);
  struct Corner {
    double strength;
    cv::Point at;
  };
  std::vector<Corner> corners;
  for (int y = 0; y < left.height; y += apart) {
    for (int x = 0; x < left.width; x += apart) {
      const cv::Rect cell = cv::Rect(x, y, apart, apart) & cv::Rect({}, strength.size());
      Corner corner{};
      cv::minMaxLoc(strength(cell), nullptr, &corner.strength, nullptr, &corner.at, free(cell));
      corner.at += cell.tl();
      if (corner.strength >= least && is_inside(corner.at, strength.size())) corners.push_back(corner);
    }
  }
  std::ranges::stable_sort(corners, [](const Corner& a, const Corner& b) { return a.strength > b.strength; });
  for (const Corner& corner : corners) {
    if (std::ssize(tracks) >= config.at_most) break;
    const auto now = rig.left_coordinates(as_vector(corner.at));
    if (free.at<std::uint8_t>(corner.at) == 0 || !now) continue;
    KltTrack track;
    track.left = corner.at;
    track.now = *now;
    track.feature.id = next_id++;
    track.feature.has_right = false;
    tracks.push_back(track);
    occupy(track.left);
    ++report.begun;
  }
}

cv::Point2f StereoTracker::State::guess_right(const KltTrack& track) const {
  if (track.feature.has_right) return track.right;  // moved along with the left view
  const auto usual = rig.right_pixel(track.now - Vector2d(usual_disparity, 0.0));
  return usual ? as_point(*usual) : track.left;
}

/// Takes the right view of a track if it is on the feature's line.
void StereoTracker::State::look_right(KltTrack& track, const cv::Point2f& right) const {
  const auto at = rig.right_coordinates(as_vector(right));
  if (!at) return;
  const Vector2d offset = track.now - *at;
  if (std::abs(offset.y()) > kEpipolarPx * pixel || offset.x() < -kEpipolarPx * pixel) return;
  track.right = right;
  track.feature.right = *at;
  track.feature.has_right = true;
}

void StereoTracker::State::match_right(const Pyramid& left, const Pyramid& right) {
  std::vector<double> disparities;
  for (const KltTrack& track : tracks) {
    if (track.feature.has_right) disparities.push_back(track.feature.left.x() - track.feature.right.x());
  }
  if (!disparities.empty()) {
    const auto middle = disparities.begin() + std::ssize(disparities) / 2;
    std::ranges::nth_element(disparities, middle);
    usual_disparity = *middle;
  }
  std::vector<cv::Point2f> from, to;
  for (KltTrack& track : tracks) {
    track.feature.left = track.now;
    from.push_back(track.left);
    to.push_back(guess_right(track));
  }
  const std::vector<bool> found = follow(left, right, from, to);
  for (std::size_t k = 0; k < tracks.size(); ++k) {
    tracks[k].feature.has_right = false;
    if (found[k]) look_right(tracks[k], to[k]);
    if (tracks[k].feature.has_right) ++report.with_right;
  }
}

FeatureFrame StereoTracker::State::frame(UTime at) const {
  FeatureFrame frame;
  frame.at = at;
  frame.p_BC = rig.left().p_BC;
  const Eigen::Quaterniond q(rig.R_BC());
  frame.q_BC = {q.w(), q.x(), q.y(), q.z()};
  frame.baseline_m = rig.baseline();
  frame.sigma = config.sigma_px * pixel;
  for (const KltTrack& track : tracks) frame.features.push_back(track.feature);
  return frame;
}

StereoTracker::StereoTracker(const StereoRig& rig, const KltConfig& config, std::int64_t first_id)
    : state_(new State{rig, config, first_id, 1.0 / rig.focal(), {}, {}, 0.0, {}}) {}
StereoTracker::~StereoTracker() = default;
StereoTracker::StereoTracker(StereoTracker&&) noexcept = default;

FeatureFrame StereoTracker::track(UTime at, const GrayImage& left, const GrayImage& right) {
  state_->report = {};
  Pyramid left_pyramid = pyramid_of(left);
  if (!state_->tracks.empty()) {
    state_->follow_left(left_pyramid);
    state_->end_contradicted();
  }
  state_->report.followed = static_cast<int>(state_->tracks.size());
  state_->begin(left);
  state_->match_right(left_pyramid, pyramid_of(right));
  // The level of the image itself has a border, so it is a copy: the caller's pixels may change.
  state_->left_before = std::move(left_pyramid);
  return state_->frame(at);
}

FeatureFrame StereoTracker::forget(UTime at) {
  state_->report = {.lost = static_cast<int>(state_->tracks.size())};
  state_->tracks.clear();
  return state_->frame(at);
}

const KltReport& StereoTracker::report() const { return state_->report; }

}  // namespace tern
