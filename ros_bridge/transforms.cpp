#include "ros_bridge/transforms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/wire/message_limits.h"
#include "ros_bridge/stamps.h"

namespace tern::ros {
namespace {

constexpr double kUnitTolerance = 0.01;

/// Frames of ROS 1 began with "/".
std::string plain(const std::string& frame) { return frame.starts_with('/') ? frame.substr(1) : frame; }

}  // namespace

Result<RigidTransform> read_pose(const ros::Vector3& position, const ros::Quaternion& orientation) {
  const Vec3 p(position.x, position.y, position.z);
  if (!p.allFinite() || p.cwiseAbs().maxCoeff() > kMaxCoordinate) {
    return fail(fmt::format("the position [{}, {}, {}] is no place", p.x(), p.y(), p.z()));
  }
  const Eigen::Quaterniond q(orientation.w, orientation.x, orientation.y, orientation.z);
  const double norm = q.norm();
  if (!(std::abs(norm - 1.0) <= kUnitTolerance)) {
    return fail(fmt::format("the orientation's quaternion has the length {:.3g}, not 1", norm));
  }
  return RigidTransform{q.normalized(), p};
}

Result<RigidTransform> read_pose(const ros::Pose& pose) {
  return read_pose({pose.position.x, pose.position.y, pose.position.z}, pose.orientation);
}

Result<void> TransformBuffer::add(const ros::TransformStamped& transform, bool is_static, UTime now) {
  const std::string child = plain(transform.child_frame_id), parent = plain(transform.header.frame_id);
  if (child.empty() || parent.empty() || child == parent || std::max(child.size(), parent.size()) > kMaxNameBytes) {
    return fail(fmt::format("a transform from \"{:.40}\" to \"{:.40}\" has no two frames", parent, child));
  }
  const auto pose = read_pose(transform.transform.translation, transform.transform.rotation);
  if (!pose) return fail(fmt::format("the transform of {}: {}", child, pose.error().message));
  const UTime at = time_of(transform.header.stamp);
  if (!is_static) {
    if (auto timely = check_stamp(at, now, kKept, kAhead); !timely) {
      return fail(fmt::format("the transform of {}: {}", child, timely.error().message));
    }
  }
  if (!frames_.contains(child) && frames_.size() >= kMaxFrames) {
    return fail(fmt::format("the transform of {}: there are {} frames already", child, kMaxFrames));
  }
  Frame& frame = frames_[child];
  if (frame.parent != parent || frame.is_static || is_static) frame = {parent, is_static, {}};
  auto& samples = frame.samples;
  const auto later =
      std::upper_bound(samples.begin(), samples.end(), at, [](UTime t, const Sample& sample) { return t < sample.at; });
  if (later != samples.begin() && std::prev(later)->at == at) {
    std::prev(later)->pose = *pose;
  } else {
    samples.insert(later, {at, *pose});
  }
  const auto is_old = [&](const Sample& sample) { return samples.size() > 1 && now - sample.at > kKept; };
  while (samples.size() > kMaxSamples || is_old(samples.front())) samples.pop_front();
  return {};
}

/// Returns the pose of `frame` in its farthest ancestor, or in `stop` if that is one.
Result<RigidTransform> TransformBuffer::to_root(std::string frame, const std::string& stop, std::optional<UTime> at,
                                                std::string& root) const {
  RigidTransform pose;
  for (int depth = 0; depth < kMaxDepth; ++depth) {
    const auto found = frames_.find(frame);
    if (frame == stop || found == frames_.end()) {
      root = frame;
      return pose;
    }
    const auto& [parent, is_static, samples] = found->second;
    const auto after = std::partition_point(samples.begin(), samples.end(),
                                            [&](const Sample& sample) { return at && sample.at < *at; });
    if (is_static || !at) {
      pose = samples.back().pose.after(pose);
    } else if (after == samples.end()) {
      return fail(fmt::format("the newest pose of {} in {} is {:.3f} s too old", frame, parent,
                              (*at - samples.back().at).seconds()));
    } else if (after->at == *at) {
      pose = after->pose.after(pose);
    } else if (after == samples.begin()) {
      return fail(
          fmt::format("the oldest pose of {} in {} is {:.3f} s too new", frame, parent, (after->at - *at).seconds()));
    } else {
      const Sample &a = *std::prev(after), &b = *after;
      const double share = (*at - a.at).seconds() / (b.at - a.at).seconds();
      pose = RigidTransform{a.pose.q.slerp(share, b.pose.q), a.pose.p + share * (b.pose.p - a.pose.p)}.after(pose);
    }
    frame = parent;
  }
  return fail(fmt::format("the frames above {} form a circle", frame));
}

Result<RigidTransform> TransformBuffer::find(const std::string& base, const std::string& frame,
                                             std::optional<UTime> at) const {
  std::string root, base_root;
  const std::string from = plain(frame);
  auto pose = to_root(from, base, at, root);
  if (!pose || root == base) return pose;
  auto base_pose = to_root(base, "", at, base_root);
  if (!base_pose) return base_pose;
  if (root != base_root) return fail(fmt::format("no transform leads from {} to {}", from, base));
  return base_pose->inverse().after(*pose);
}

}  // namespace tern::ros
