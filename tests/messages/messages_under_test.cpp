#include "tests/messages/messages_under_test.h"

#include <array>
#include <bit>
#include <concepts>
#include <string>
#include <type_traits>

namespace tern {
namespace {

std::int32_t size_of(const auto& list) { return static_cast<std::int32_t>(list.size()); }

std::int32_t text_bytes(const auto& list, const auto& text_of) {
  std::size_t n = 0;
  for (const auto& item : list) n += text_of(item).size();
  return static_cast<std::int32_t>(n);
}

/// Collects words; a list brings its size first.
struct Words {
  std::vector<std::uint64_t> words;

  void operator()(const auto&... fields) { (add(fields), ...); }

  void add(double x) { words.push_back(std::bit_cast<std::uint64_t>(x)); }
  void add(std::integral auto x) { words.push_back(static_cast<std::uint64_t>(x)); }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void add(Enum x) { words.push_back(static_cast<std::uint64_t>(x)); }
  template <class Derived>
  void add(const Eigen::DenseBase<Derived>& m) {
    add(m.cols());
    for (Eigen::Index c = 0; c < m.cols(); ++c) {
      for (Eigen::Index r = 0; r < m.rows(); ++r) add(m(r, c));
    }
  }
  void add(const std::string& text) {
    add(text.size());
    for (const char c : text) add(c);
  }
  template <class E>
  void add(const std::vector<E>& list) {
    add(list.size());
    for (const E& item : list) add(item);
  }
  template <class E, std::size_t n>
  void add(const std::array<E, n>& list) {
    for (const E& item : list) add(item);
  }
  template <class E, std::size_t n>
  void add(const E (&list)[n]) {
    for (const E& item : list) add(item);
  }
  void add(const Box& box) { (*this)(box.min(), box.max()); }
  void add(UTime t) { add(t.us); }
  void add(Duration d) { add(d.us); }
  void add(const MessageName& n) { (*this)(n.sender_epoch_us, n.sequence); }
  void add(const Header& h) { (*this)(h.name, h.utime); }
  void add(const BatchHeader& b) { (*this)(b.set, b.index, b.count); }
  void add(const MotionSample& m) { (*this)(m.p, m.v, m.a, m.j); }
  void add(const TimedSpline& s) { (*this)(s.start, s.interval, s.control_points); }
  void add(const Detection& d) { (*this)(d.position, d.half_extents, d.variance, d.track_id); }
  void add(const CubicPiece& p) { (*this)(p.duration, p.coefficients); }
  void add(const Track& t) {
    (*this)(t.id, t.kind, t.half_extents, t.motion.start, t.motion.pieces, t.alpha, t.top_speed, t.shares);
  }
  void add(const VoxelRun& r) { (*this)(r.label, r.class_index, r.length); }
  void add(const CertificatePlane& p) { (*this)(p.track, p.interval, p.part, p.parts, p.plane.n, p.plane.d); }
  void add(const BudgetCut& c) { (*this)(c.phase, c.attempt, c.stage, c.count); }
  void add(const PlanCost& c) { (*this)(c.distance_to_goal, c.jerk, c.attraction, c.repulsion, c.total); }
  void add(const PlanInputs& i) {
    const GoalFieldInputs& f = i.goal_field;
    (*this)(i.request, i.goal, i.predictions, i.prediction_set, i.left_out, i.map_version, i.configuration_hash,
            i.planner_build, f.map_version, f.statics_epoch_us, f.statics_first_set, f.statics, f.vehicle);
  }
  void add(const ChannelCounters& c) { (*this)(c.sent, c.received, c.rejected, c.lost, c.late); }
  void add(const TrueObstacle& o) { (*this)(o.id, o.position, o.velocity, o.half_extents, o.moves); }
  void add(const Exposure& e) { (*this)(e.region, e.seconds, e.metres, e.near_seconds, e.near_metres); }

  void add(const UavState& s) { (*this)(s.header, s.at, s.motion, s.yaw); }
  void add(const VehicleStatus& s) {
    (*this)(s.header, s.at, s.armed, s.following, s.landed, s.mode, s.why_not, s.battery.value_or(-1.0), s.estimator,
            s.position_sigma, s.resets);
  }
  void add(const Goal& g) { (*this)(g.header, g.id, g.mode, g.position); }
  void add(const SpeedLimit& s) { (*this)(s.header, s.goal_id, s.v_max); }
  void add(const Fence& f) {
    const auto* circle = std::get_if<FenceCircle>(&f.shape);
    (*this)(f.is_inclusion, circle != nullptr);
    if (circle != nullptr) return (*this)(circle->centre, circle->radius);
    add(std::get<FencePolygon>(f.shape).corners);
  }
  void add(const FenceSet& s) { (*this)(s.header, s.fences); }
  void add(const ObservationSet& s) {
    (*this)(s.header, s.at, s.sensor_id, s.range_m, s.sensor_position, s.detections);
  }
  void add(const Sighting& s) { (*this)(s.lower, s.upper, s.lower_sigma, s.upper_sigma, s.bounds, s.points); }
  void add(const SensorView& v) {
    (*this)(v.kind, v.sensor_position, v.q_WC, v.left, v.right, v.up, v.down, v.near_m, v.range_m, v.depth_sigma,
            v.depth_sigma_per_square_m, v.unit_m, v.rows, v.columns, v.depths);
  }
  void add(const SightingSet& s) { (*this)(s.header, s.at, s.sensor_id, s.left_out, s.view, s.sightings); }
  void add(const ImuSample& s) { (*this)(s.at, s.angular_velocity, s.specific_force); }
  void add(const ImuBatch& b) { (*this)(b.header, b.sensor_id, b.saturation_rate, b.saturation_force, b.samples); }
  void add(const StereoFeature& f) { (*this)(f.id, f.left, f.right, f.has_right); }
  void add(const FeatureFrame& f) {
    (*this)(f.header, f.at, f.sensor_id, f.p_BC, f.q_BC, f.baseline_m, f.sigma, f.features);
  }
  void add(const PositionFix& f) {
    (*this)(f.header, f.at, f.sensor_id, f.position, f.variance, f.has_yaw, f.yaw, f.yaw_variance);
  }
  void add(const Odometry& o) {
    (*this)(o.header, o.at, o.state, o.epoch, o.p_OB, o.q_OB, o.v_OB, o.angular_velocity, o.p_WO, o.yaw_WO,
            o.gyroscope_bias, o.accelerometer_bias, o.pose_covariance, o.velocity_covariance, o.drift_covariance,
            o.tracks, o.rejected);
  }
  void add(const PlanHeading& h) {
    (*this)(h.header, h.request_id, h.request, h.start, h.interval, h.control_points, h.rate_max, h.acceleration_max,
            h.path_term, h.track_term, h.unseen_term, h.texture_term);
  }
  void add(const PlanUnseen& u) {
    (*this)(u.header, u.request_id, u.request, u.start, u.committed_clear, u.plan_clear);
  }
  void add(const PoseError& e) { (*this)(e.header, e.set, e.position, e.pose_covariance, e.apart); }
  void add(const LandmarkDensities& d) {
    (*this)(d.header, d.statics, d.tracks, d.map_version, d.densities.obstacles, d.densities.by_class);
  }
  void add(const CloudPoint& p) { (*this)(p.position, p.class_number); }
  void add(const CloudScan& s) {
    (*this)(s.header, s.at, s.sensor_id, s.range_m, s.sensor_position, s.has_classes, s.points);
  }
  void add(const DepthImage& i) {
    (*this)(i.header, i.at, i.sensor_id, i.range_m, i.sensor_position, i.q_WC, i.fx, i.fy, i.cx, i.cy, i.unit_m,
            i.width, i.first_row, i.depths);
  }
  void add(const MapFile& f) { (*this)(f.header, f.at, f.format, f.origin, f.part, f.parts, f.bytes); }
  void add(const TrackSet& s) { (*this)(s.header, s.batch, s.made_at, s.confidence, s.left_out, s.tracks); }
  void add(const MapChunk& c) {
    (*this)(c.header, c.version, c.grid.origin, c.grid.resolution, c.grid.size, c.class_names, c.index, c.count,
            c.first_voxel, c.runs);
  }
  void add(const HorizonRequest& r) {
    (*this)(r.header, r.id, r.t_s, r.deadline, r.committed, r.start, r.limits.v_max, r.limits.a_max, r.limits.j_max,
            r.body.vertices, r.body.radius, r.flight_box, r.tube);
    const Dynamics d = r.limits.dynamics.value_or(Dynamics{0.0, 0.0, 0.0, 0.0});
    (*this)(d.thrust_min, d.thrust_max, d.tilt_max_deg, d.body_rate_max_deg_s);
  }
  void add(const Plan& p) {
    (*this)(p.header, p.request_id, p.outcome, p.reason, p.trajectory, p.hold, p.confidence, p.level, p.alpha_scale,
            p.sure_for, p.relaxed, p.local_goal, p.sphere_radius, p.cost, p.inputs, p.certificate, p.cuts,
            p.standing.value_or(-1));
  }
  void add(const SearchViewNode& n) { (*this)(n.position, n.parent); }
  void add(const SearchView& v) { (*this)(v.header, v.request_id, v.left_out, v.nodes); }
  void add(const TrackBound& b) {
    (*this)(b.id, b.kind, b.ruled_by, b.ahead_s, b.model, b.measured, b.promised, b.evidence);
  }
  void add(const TrackBounds& b) { (*this)(b.header, b.at, b.confidence, b.left_out, b.bounds); }
  void add(const PlanTiming& t) {
    (*this)(t.header, t.request_id, t.total_ms, t.first_answer_ms, t.cpu_ms, t.stage_ms, t.expansions, t.hulls,
            t.pairs_by_index, t.pairs_by_box, t.pairs_by_instant, t.pairs_by_cache, t.pairs_by_plane, t.pairs_by_lp,
            t.solver_calls, t.solver_iterations, t.peak_rss_kb, t.from_watchdog);
  }
  void add(const Heartbeat& h) {
    (*this)(h.header, h.process, h.build_id, h.state, h.waiting_for, h.channels.size());
    for (const auto& [name, counters] : h.channels) (*this)(name, counters);
    for (const ClockEcho& echo : h.echoes) (*this)(echo.sender_epoch_us, echo.sent, echo.received);
  }
  void add(const ConfigurationReport& r) { (*this)(r.header, r.process, r.build_id, r.platform, r.yaml, r.hash); }
  void add(const ObstacleTruth& t) { (*this)(t.header, t.batch, t.at, t.obstacles, t.left_out); }
  void add(const FlightResult& r) {
    (*this)(r.header, r.outcome, r.detail, r.flight_time_s, r.first_entry_s, r.path_length_m, r.mean_speed_mps,
            r.top_speed_mps, r.min_clearance_m, r.min_map_clearance_m, r.jerk_integral, r.stops, r.limit_violations,
            r.contacts_moving, r.contacts_at_rest, r.obstacles, r.obstacles_left_out, r.exposure);
  }
};

}  // namespace

template <class T>
std::vector<std::uint64_t> words_of(const T& value) {
  Words words;
  words.add(value);
  return words.words;
}
template std::vector<std::uint64_t> words_of(const UavState&);
template std::vector<std::uint64_t> words_of(const VehicleStatus&);
template std::vector<std::uint64_t> words_of(const ObservationSet&);
template std::vector<std::uint64_t> words_of(const CloudScan&);
template std::vector<std::uint64_t> words_of(const DepthImage&);
template std::vector<std::uint64_t> words_of(const TrackSet&);
template std::vector<std::uint64_t> words_of(const MapChunk&);
template std::vector<std::uint64_t> words_of(const Goal&);
template std::vector<std::uint64_t> words_of(const HorizonRequest&);
template std::vector<std::uint64_t> words_of(const Plan&);
template std::vector<std::uint64_t> words_of(const PlanTiming&);
template std::vector<std::uint64_t> words_of(const PlanUnseen&);
template std::vector<std::uint64_t> words_of(const PoseError&);
template std::vector<std::uint64_t> words_of(const LandmarkDensities&);
template std::vector<std::uint64_t> words_of(const SearchView&);
template std::vector<std::uint64_t> words_of(const TrackBounds&);
template std::vector<std::uint64_t> words_of(const Heartbeat&);
template std::vector<std::uint64_t> words_of(const ConfigurationReport&);
template std::vector<std::uint64_t> words_of(const ObstacleTruth&);
template std::vector<std::uint64_t> words_of(const SightingSet&);
template std::vector<std::uint64_t> words_of(const PlanHeading&);
template std::vector<std::uint64_t> words_of(const ImuBatch&);
template std::vector<std::uint64_t> words_of(const FeatureFrame&);
template std::vector<std::uint64_t> words_of(const PositionFix&);
template std::vector<std::uint64_t> words_of(const Odometry&);
template std::vector<std::uint64_t> words_of(const FlightResult&);
template std::vector<std::uint64_t> words_of(const MapFile&);
template std::vector<std::uint64_t> words_of(const SpeedLimit&);
template std::vector<std::uint64_t> words_of(const FenceSet&);

template <>
std::vector<std::int32_t> array_sizes(const UavState&) {
  return {};
}
template <>
std::vector<std::int32_t> array_sizes(const Goal&) {
  return {};
}
template <>
std::vector<std::int32_t> array_sizes(const SpeedLimit&) {
  return {};
}
template <>
std::vector<std::int32_t> array_sizes(const FenceSet& set) {
  std::int32_t corners = 0;
  for (const Fence& fence : set.fences) {
    if (const auto* polygon = std::get_if<FencePolygon>(&fence.shape)) corners += size_of(polygon->corners);
  }
  return {size_of(set.fences), corners};
}
template <>
std::vector<std::int32_t> array_sizes(const PlanTiming&) {
  return {};
}
template <>
std::vector<std::int32_t> array_sizes(const PlanUnseen&) {
  return {};
}
template <>
std::vector<std::int32_t> array_sizes(const PoseError&) {
  return {};
}
template <>
std::vector<std::int32_t> array_sizes(const LandmarkDensities& of) {
  return {size_of(of.densities.by_class)};
}
template <>
std::vector<std::int32_t> array_sizes(const SearchView& view) {
  return {size_of(view.nodes)};
}
template <>
std::vector<std::int32_t> array_sizes(const TrackBounds& of) {
  return {size_of(of.bounds)};
}
template <>
std::vector<std::int32_t> array_sizes(const ObservationSet& set) {
  return {size_of(set.detections)};
}
template <>
std::vector<std::int32_t> array_sizes(const CloudScan& scan) {
  return {size_of(scan.points)};
}
template <>
std::vector<std::int32_t> array_sizes(const DepthImage& image) {
  return {size_of(image.depths)};
}
template <>
std::vector<std::int32_t> array_sizes(const TrackSet& set) {
  std::int32_t pieces = 0;
  for (const Track& track : set.tracks) pieces += size_of(track.motion.pieces);
  return {size_of(set.tracks), pieces};
}
template <>
std::vector<std::int32_t> array_sizes(const MapChunk& chunk) {
  return {size_of(chunk.runs), size_of(chunk.class_names),
          text_bytes(chunk.class_names, [](const auto& n) { return n; })};
}
template <>
std::vector<std::int32_t> array_sizes(const HorizonRequest& request) {
  return {static_cast<std::int32_t>(request.committed.control_points.cols()),
          static_cast<std::int32_t>(request.body.vertices.cols())};
}
template <>
std::vector<std::int32_t> array_sizes(const Plan& plan) {
  return {static_cast<std::int32_t>(plan.trajectory.control_points.cols()), size_of(plan.certificate),
          size_of(plan.cuts)};
}
template <>
std::vector<std::int32_t> array_sizes(const Heartbeat& heartbeat) {
  return {size_of(heartbeat.process),
          size_of(heartbeat.build_id),
          size_of(heartbeat.waiting_for),
          size_of(heartbeat.channels),
          text_bytes(heartbeat.channels, [](const auto& channel) { return channel.first; }),
          size_of(heartbeat.echoes)};
}
template <>
std::vector<std::int32_t> array_sizes(const ConfigurationReport& report) {
  return {size_of(report.process), size_of(report.build_id), size_of(report.platform), size_of(report.yaml)};
}
template <>
std::vector<std::int32_t> array_sizes(const ObstacleTruth& truth) {
  return {size_of(truth.obstacles)};
}
template <>
std::vector<std::int32_t> array_sizes(const VehicleStatus& status) {
  return {size_of(status.mode), size_of(status.why_not)};
}
template <>
std::vector<std::int32_t> array_sizes(const SightingSet& value) {
  return {size_of(value.sightings), size_of(value.view.depths)};
}
template <>
std::vector<std::int32_t> array_sizes(const PlanHeading& value) {
  return {size_of(value.control_points)};
}
template <>
std::vector<std::int32_t> array_sizes(const ImuBatch& value) {
  return {size_of(value.samples)};
}
template <>
std::vector<std::int32_t> array_sizes(const FeatureFrame& value) {
  return {size_of(value.features)};
}
template <>
std::vector<std::int32_t> array_sizes(const PositionFix&) {
  return {};
}
template <>
std::vector<std::int32_t> array_sizes(const Odometry&) {
  return {};
}
template <>
std::vector<std::int32_t> array_sizes(const MapFile& file) {
  return {size_of(file.bytes)};
}
template <>
std::vector<std::int32_t> array_sizes(const FlightResult& result) {
  return {size_of(result.detail), size_of(result.exposure),
          text_bytes(result.exposure, [](const auto& e) { return e.region; })};
}

}  // namespace tern
