#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cstring>
#include <utility>

#include "core/world/names.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/planning.h"

namespace tern::python {
namespace {

using Bytes3 = py::array_t<std::uint8_t, py::array::f_style | py::array::forcecast>;

/// Checks a track by the rules of PREDICTIONS.
Track checked(Track track) {
  (void)track_set_of({track}, UTime{1'000'000}, track.kind == TrackKind::Estimated ? 0.99 : 1.0);
  return track;
}

/// Returns rows of an array (n, 3), or n times the same three numbers, or n times one number.
std::vector<Vec3> rows_of(const py::object& value, const char* name, std::size_t n) {
  const py::array array = py::array::ensure(value);
  if (!array) PyErr_Clear();
  if (!array || array.ndim() < 2) return std::vector<Vec3>(n, vec3_or_number(value, name));
  const Points points = points_of(value, name);
  if (points.cols() != static_cast<Eigen::Index>(n)) {
    throw py::value_error(fmt::format("{}: {} rows for {} pieces", name, points.cols(), n));
  }
  std::vector<Vec3> rows;
  for (Eigen::Index k = 0; k < points.cols(); ++k) rows.emplace_back(points.col(k));
  return rows;
}

// Shares of n pieces: (n, levels) for all axes, or (n, levels, 3).
std::vector<AlphaShares> shares_of(const py::object& shares, std::size_t n) {
  const auto rows = static_cast<py::ssize_t>(n);
  const bool has_axes = py::array(shares).ndim() == 3;
  const Doubles all = has_axes ? doubles_of(shares, "shares", {rows, kLevels - 1, 3})
                               : doubles_of(shares, "shares", {rows, kLevels - 1});
  std::vector<AlphaShares> of_pieces(n);
  for (py::ssize_t k = 0; k < rows; ++k) {
    for (py::ssize_t level = 0; level < kLevels - 1; ++level) {
      for (py::ssize_t axis = 0; axis < 3; ++axis) {
        of_pieces[idx(k)][idx(level)][idx(axis)] =
            static_cast<float>(has_axes ? all.at(k, level, axis) : all.at(k, level));
      }
    }
  }
  return of_pieces;
}

Track track_of(std::int64_t id, const std::string& kind, const py::object& half_extents, std::int64_t start_us,
               const py::object& durations_us, const py::object& coefficients, const py::object& alpha,
               const py::object& shares, double top_speed) {
  Track track;
  track.id = id;
  const auto named_kind = named<TrackKind>(kind);
  if (!named_kind) throw py::value_error(fmt::format("kind: {}, not static, declared or estimated", kind));
  track.kind = *named_kind;
  track.half_extents = vec3_or_number(half_extents, "half_extents");
  track.top_speed = top_speed;
  track.motion.start = UTime{start_us};
  const std::vector<std::int64_t> durations = integers_of(durations_us, "durations_us");
  const Doubles cubics = doubles_of(coefficients, "coefficients", {-1, 3, 4});
  const std::size_t n = durations.size();
  if (cubics.shape(0) != static_cast<py::ssize_t>(n)) {
    throw py::value_error(fmt::format("coefficients: {} pieces for {} durations", cubics.shape(0), n));
  }
  for (std::size_t k = 0; k < n; ++k) {
    CubicPiece piece{Duration{durations[k]}, PowerCubic::Zero()};
    for (int axis = 0; axis < 3; ++axis) {
      for (int power = 0; power < 4; ++power) {
        piece.coefficients(axis, power) = cubics.at(static_cast<py::ssize_t>(k), axis, power);
      }
    }
    track.motion.pieces.push_back(piece);
  }
  track.alpha = rows_of(alpha, "alpha", n);
  if (!shares.is_none()) {
    track.shares = shares_of(shares, n);
  } else if (track.kind == TrackKind::Estimated) {
    track.shares.assign(n, on_all_axes({1.0F, 1.0F, 1.0F, 1.0F}));
  }
  return checked(std::move(track));
}

Track still(std::int64_t id, const py::object& centre, const py::object& half_extents, std::int64_t start_us) {
  Track track;
  track.id = id;
  track.kind = TrackKind::Static;
  track.half_extents = vec3_or_number(half_extents, "half_extents");
  CubicPiece piece{Duration{1'000'000}, PowerCubic::Zero()};
  piece.coefficients.col(3) = vec3_of(centre, "centre");
  track.motion = {UTime{start_us}, {piece}};
  track.alpha = {Vec3::Zero()};
  return checked(std::move(track));
}

Track through(std::int64_t id, const py::object& half_extents, const py::object& times_us, const py::object& positions,
              const py::object& velocities, const py::object& alpha, double top_speed) {
  const std::vector<std::int64_t> times = integers_of(times_us, "times_us");
  const Points p = points_of(positions, "positions"), v = points_of(velocities, "velocities");
  const auto n = static_cast<Eigen::Index>(times.size());
  if (n < 2 || p.cols() != n || v.cols() != n) {
    throw py::value_error(fmt::format(
        "times_us, positions, velocities: {}, {} and {} rows, not the same number from 2 on", n, p.cols(), v.cols()));
  }
  Track track;
  track.id = id;
  track.half_extents = vec3_or_number(half_extents, "half_extents");
  track.top_speed = top_speed;
  track.motion.start = UTime{times.front()};
  for (Eigen::Index k = 0; k + 1 < n; ++k) {
    const Duration duration{times[idx(k + 1)] - times[idx(k)]};
    if (duration <= Duration{0}) throw py::value_error(fmt::format("times_us: element {} does not ascend", k + 1));
    MotionSample from, to;
    from.p = p.col(k), from.v = v.col(k), to.p = p.col(k + 1), to.v = v.col(k + 1);
    track.motion.pieces.push_back(hermite_piece(from, to, duration));
  }
  track.alpha = rows_of(alpha, "alpha", track.motion.pieces.size());
  return checked(std::move(track));
}

/// Returns the bytes of an array of the given shape in the order of voxels: x runs fastest.
template <class T>
std::vector<T> voxels_of(const py::object& value, const char* name, const std::vector<py::ssize_t>* shape) {
  const py::array array = py::array::ensure(value);
  if (!array || array.ndim() != 3 || (array.dtype().kind() != 'u' && array.dtype().kind() != 'i')) {
    PyErr_Clear();
    throw py::value_error(fmt::format("{}: is not an integer array of the shape (x, y, z)", name));
  }
  if (shape != nullptr && !std::equal(shape->begin(), shape->end(), array.shape())) {
    throw py::value_error(fmt::format("{}: has another shape than labels", name));
  }
  const py::array_t<std::int64_t, py::array::f_style | py::array::forcecast> wide(array);
  std::vector<T> voxels(static_cast<std::size_t>(wide.size()));
  for (std::size_t k = 0; k < voxels.size(); ++k) {
    const std::int64_t x = wide.data()[k];
    if (x < 0 || x > 255) throw py::value_error(fmt::format("{}: {} is not 0 to 255", name, x));
    voxels[k] = static_cast<T>(x);
  }
  return voxels;
}

VoxelMap map_of(const py::object& labels, const py::object& origin, double resolution, const py::object& classes,
                std::vector<std::string> class_names) {
  VoxelMap map;
  map.labels = voxels_of<VoxelLabel>(labels, "labels", nullptr);
  const py::array array = py::array::ensure(labels);
  const std::vector<py::ssize_t> shape(array.shape(), array.shape() + 3);
  map.grid.origin = vec3_of(origin, "origin");
  map.grid.resolution = resolution;
  for (int axis = 0; axis < 3; ++axis) map.grid.size[axis] = static_cast<int>(shape[idx(axis)]);
  map.classes = classes.is_none() ? std::vector<std::uint8_t>(map.labels.size())
                                  : voxels_of<std::uint8_t>(classes, "classes", &shape);
  class_names.insert(class_names.begin(), "");
  map.class_names = std::move(class_names);
  return checked_map(std::move(map));
}

Bytes3 labels_of(const VoxelMap& map) {
  Bytes3 labels({map.grid.size.x(), map.grid.size.y(), map.grid.size.z()});
  std::memcpy(labels.mutable_data(), map.labels.data(), map.labels.size());
  return labels;
}

/// One free voxel: a world without a map.
VoxelMap free_voxel() {
  VoxelMap map;
  map.grid.size = Eigen::Vector3i::Ones();
  map.labels = {VoxelLabel::Free};
  map.classes = {0};
  map.class_names = {""};
  return checked_map(std::move(map));
}

PreparedWorld world_of(const Vehicle& vehicle, const py::object& goal, const std::vector<Track>& tracks,
                       const VoxelMap* map, const PlannerConfig* config, const py::object& start,
                       std::int64_t made_at_us, double confidence) {
  const Vec3 goal_at = vec3_of(goal, "goal");
  const Vec3 start_at = start.is_none() ? goal_at : vec3_of(start, "start");
  TrackSet set = track_set_of(tracks, UTime{made_at_us}, confidence);
  const VoxelMap known = map != nullptr ? *map : free_voxel();
  const PlannerConfig chosen = config != nullptr ? *config : planner_config_of({});
  const py::gil_scoped_release release;
  return {vehicle, goal_at, start_at, std::move(set), known, chosen};
}

/// Returns (ids, centres, velocities, half extents with α) of the tracks at a time.
py::tuple tracks_at(const PreparedWorld& world, std::int64_t t_us) {
  const auto& predictions = world.world().predictions;
  const std::vector<Track> none;
  const std::vector<Track>& tracks = predictions ? predictions->set.tracks : none;
  const auto n = static_cast<Eigen::Index>(tracks.size());
  std::vector<std::int64_t> ids;
  Points centres(3, n), velocities(3, n), extents(3, n);
  const UTime t{t_us};
  for (Eigen::Index k = 0; k < n; ++k) {
    const Track& track = tracks[idx(k)];
    const MotionSample s = track.motion.sample(std::clamp(t, track.motion.start, track.motion.end()));
    const Box bounds = track.bounds(t, t);
    ids.push_back(track.id);
    centres.col(k) = s.p;
    velocities.col(k) = s.v;
    extents.col(k) = 0.5 * bounds.sizes();
  }
  return py::make_tuple(array_of(std::move(ids)), array_of(centres), array_of(velocities), array_of(extents));
}

void bind_track(py::module_& m) {
  using namespace py::literals;
  py::class_<Track>(m, "Track",
                    "One obstacle over time: an axis-aligned box that moves along cubic pieces. At each time of piece "
                    "k the true box lies within the box around p(t) with half_extents + alpha[k].")
      .def(py::init(&track_of), "id"_a, "kind"_a, "half_extents"_a, "start_us"_a, "durations_us"_a, "coefficients"_a,
           "alpha"_a = 0.0, "shares"_a = py::none(), "top_speed"_a = 0.0,
           "kind: static, declared or estimated. half_extents: m. durations_us (n,): of the pieces. coefficients "
           "(n, 3, 4): of tau^3, tau^2, tau and 1 per axis of W, tau in s since the piece's start; m/s^3 … m. alpha "
           "(n, 3): half-extents of the error box, m. shares (n, 4), or (n, 4, 3) per axis: of alpha at the lower "
           "levels of "
           "confidence, only estimated. top_speed: m/s per axis, at which the box grows before and after its pieces.")
      .def_static("static", &still, "id"_a, "centre"_a, "half_extents"_a, "start_us"_a = 1'000'000,
                  "A box that never moves (W, m).")
      .def_static("through", &through, "id"_a, "half_extents"_a, "times_us"_a, "positions"_a, "velocities"_a,
                  "alpha"_a = 0.0, "top_speed"_a = 0.0,
                  "A declared motion through positions and velocities (n, 3) (W; m, m/s) at n times: cubic Hermite "
                  "pieces.")
      .def_property_readonly("id", [](const Track& t) { return t.id; })
      .def_property_readonly("kind", [](const Track& t) { return to_string(t.kind); })
      .def_property_readonly(
          "half_extents", [](const Track& t) { return array_of(t.half_extents); }, "m")
      .def_property_readonly("start_us", [](const Track& t) { return t.motion.start.us; })
      .def_property_readonly("end_us", [](const Track& t) { return t.motion.end().us; });
}

void bind_map_and_config(py::module_& m) {
  using namespace py::literals;
  py::class_<VoxelMap>(m, "VoxelMap", "A grid of labelled voxels.")
      .def(py::init(&map_of), "labels"_a, "origin"_a, "resolution"_a, "classes"_a = py::none(),
           "class_names"_a = std::vector<std::string>(),
           "labels (x, y, z): 0 unknown, 1 free, 2 occupied, 3 attractive, 4 repulsive. origin: the grid's lower "
           "corner, W, m. resolution: side of a voxel, m. classes (x, y, z): 0 for none, k for class_names[k - 1].")
      .def_property_readonly("labels", &labels_of, "(x, y, z), uint8")
      .def_property_readonly(
          "origin", [](const VoxelMap& map) { return array_of(map.grid.origin); }, "W, m")
      .def_property_readonly(
          "resolution", [](const VoxelMap& map) { return map.grid.resolution; }, "m")
      .def_property_readonly(
          "version", [](const VoxelMap& map) { return map.version; }, "Digest of grid, labels and classes.");
  py::class_<PlannerConfig>(m, "Config", "The settings of the planner.")
      .def(py::init([](const py::object& settings) { return planner_config_of(settings_of(settings)); }),
           "settings"_a = py::dict(),
           "settings: values by key, such as {'planner.search.samples_xy': 5}, of the sections planner and semantics "
           "(docs/reference/keys.md).")
      .def_readonly("lambda_attractive", &PlannerConfig::lambda_attractive)
      .def_readonly("lambda_repulsive", &PlannerConfig::lambda_repulsive);
}

}  // namespace

void bind_world(py::module_& m) {
  using namespace py::literals;
  bind_track(m);
  bind_map_and_config(m);
  py::class_<PreparedWorld>(m, "World",
                            "The inputs of a plan besides its request: tracks, map, goal and settings. A World never "
                            "changes.")
      .def(
          py::init(&world_of), "vehicle"_a, "goal"_a, "tracks"_a = std::vector<Track>(), "map"_a = py::none(),
          "config"_a = py::none(), py::kw_only(), "start"_a = py::none(), "made_at_us"_a = 1'000'000,
          "confidence"_a = 1.0,
          "Takes about 100 ms, with regions 300 ms: distances to the goal are computed. goal: W, m. start: about where "
          "the flight starts, W, m; paths are sought around goal, start and obstacles. made_at_us: time of the newest "
          "information about tracks; 0.3 s later they are stale. confidence: the probability that an estimated track "
          "stays within its alpha.")
      .def(
          "with_tracks",
          [](const PreparedWorld& world, const std::vector<Track>& tracks, std::int64_t made_at_us, double confidence) {
            TrackSet set = track_set_of(tracks, UTime{made_at_us}, confidence);
            const py::gil_scoped_release release;
            return world.with_tracks(std::move(set));
          },
          "tracks"_a, "made_at_us"_a, "confidence"_a = 1.0,
          "The same world with other tracks. It is cheap unless the static tracks differ.")
      .def("tracks_at", &tracks_at, "t_us"_a,
           "Where tracks are predicted: ids (n,), centres (n, 3) m, velocities (n, 3) m/s, and half-extents with alpha "
           "(n, 3) m, in W.")
      .def_property_readonly("config", [](const PreparedWorld& world) { return world.config(); })
      .def_property_readonly(
          "goal",
          [](const PreparedWorld& world) -> py::object {
            if (!world.world().goal) return py::none();
            return array_of(world.world().goal->goal.position);
          },
          "W, m; None if there is no goal.");
}

}  // namespace tern::python
