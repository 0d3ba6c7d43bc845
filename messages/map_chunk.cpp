#include "messages/codec.h"
#include "messages/fields.h"
#include "messages/wire.h"
#include "tern_msgs/map_chunk_t.hpp"

namespace tern {
namespace {

using Message = tern_msgs::map_chunk_t;
static_assert(Message::MAX_RUNS == kMaxRunsPerChunk);
static_assert(Message::MAX_CLASSES == kMaxMapClasses);
static_assert(Message::MAX_CLASS_TEXT == kMaxMapClassText);
static_assert(Message::MAX_CHUNKS == kMaxMapChunks);
static_assert(Message::MAX_VOXELS == kMaxVoxels);

const wire::Layout kLayout{
    wire::Array{&Message::run_count, &Message::runs, 0, kMaxRunsPerChunk},
    wire::Array{&Message::class_count, &Message::class_lengths, 0, kMaxMapClasses},
    wire::Array{&Message::class_text_count, &Message::class_text, 0, kMaxMapClassText},
};
constexpr double kMaxResolution = 1000.0;  // m

Message to_lcm(const MapChunk& chunk) {
  Message m{};
  m.header = wire::to_lcm(chunk.header);
  m.version = static_cast<std::int64_t>(chunk.version);
  m.origin = wire::to_lcm(chunk.grid.origin);
  m.resolution = chunk.grid.resolution;
  m.size_x = chunk.grid.size.x();
  m.size_y = chunk.grid.size.y();
  m.size_z = chunk.grid.size.z();
  m.index = chunk.index;
  m.count = chunk.count;
  m.first_voxel = chunk.first_voxel;
  m.runs.reserve(chunk.runs.size());
  for (const VoxelRun& run : chunk.runs) {
    tern_msgs::map_run_t r{};
    r.length = run.length;
    r.label = wire::to_int8(run.label);
    r.class_index = run.class_index;
    m.runs.push_back(r);
  }
  for (const std::string& name : chunk.class_names) {
    m.class_lengths.push_back(static_cast<std::int32_t>(name.size()));
    wire::append(m.class_text, name);
  }
  return m;
}

VoxelGrid read_grid(wire::FieldReader& read, const Message& m) {
  constexpr auto kMaxSide = static_cast<std::int32_t>(kMaxVoxels);
  VoxelGrid grid;
  grid.origin = read.position(m.origin);
  grid.resolution = read.number(m.resolution, wire::kAboveZero, kMaxResolution);
  grid.size = {read.integer(m.size_x, 0, kMaxSide), read.integer(m.size_y, 0, kMaxSide),
               read.integer(m.size_z, 0, kMaxSide)};
  for (const double corner : Vec3(grid.bounds().max())) read.number(corner, -kMaxCoordinate, kMaxCoordinate);
  // The product as a double first: three sides of kMaxSide overflow 64 bits.
  const double voxels = grid.size.cast<double>().prod();
  if (read.number(voxels, 0.0, static_cast<double>(kMaxVoxels)) != voxels) grid.size.setZero();
  return grid;
}

std::vector<std::string> read_class_names(wire::FieldReader& read, const Message& m) {
  wire::Slices text(m.class_text);
  std::vector<std::string> names;
  for (const std::int32_t length : m.class_lengths) {
    const auto n = static_cast<std::size_t>(read.integer(length, 0, kMaxMapClassText));
    names.push_back(read.text(text.take(n)));
  }
  read.consistent(text.complete());
  read.consistent(names.empty() || names.front().empty());
  return names;
}

tl::expected<MapChunk, Rejection> from_lcm(const Message& m) {
  wire::FieldReader read;
  MapChunk chunk;
  chunk.header = read.header(m.header);
  chunk.version = read.integer<std::uint64_t>(static_cast<std::uint64_t>(m.version), 1, ~std::uint64_t{0});
  chunk.grid = read_grid(read, m);
  chunk.class_names = read_class_names(read, m);
  chunk.index = read.integer(m.index, 0, kMaxMapChunks - 1);
  chunk.count = read.integer(m.count, 1, kMaxMapChunks);
  read.consistent(chunk.index < chunk.count);
  chunk.first_voxel = read.integer<std::int64_t>(m.first_voxel, 0, kMaxVoxels);
  std::int64_t end = chunk.first_voxel;
  const std::size_t classes = std::max<std::size_t>(1, chunk.class_names.size());
  chunk.runs.reserve(m.runs.size());
  for (const tern_msgs::map_run_t& run : m.runs) {
    const auto length = read.integer(run.length, 1, static_cast<std::int32_t>(kMaxVoxels));
    chunk.runs.push_back({read.enumeration(run.label, VoxelLabel::Repulsive), run.class_index, length});
    read.consistent(run.class_index < classes);
    end += length;
  }
  read.consistent(end <= chunk.grid.voxels());
  return read.accept(std::move(chunk));
}

}  // namespace

template <>
Bytes encode(const MapChunk& value) {
  return wire::encode(to_lcm(value), kLayout);
}

template <>
tl::expected<MapChunk, Rejection> decode(std::span<const std::uint8_t> bytes) {
  return wire::decode(bytes, kLayout, from_lcm);
}

}  // namespace tern
