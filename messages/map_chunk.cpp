#include "messages/form.h"
#include "tern_msgs/map_chunk_t.hpp"

namespace tern {

template <>
struct wire::Form<MapChunk> {
  using Message = tern_msgs::map_chunk_t;
  static_assert(Message::MAX_RUNS == kMaxRunsPerChunk);
  static_assert(Message::MAX_CLASSES == kMaxMapClasses);
  static_assert(Message::MAX_CLASS_TEXT == kMaxMapClassText);
  static_assert(Message::MAX_CHUNKS == kMaxMapChunks);
  static_assert(Message::MAX_VOXELS == kMaxVoxels);
  static constexpr Layout kLayout{
      Array{&Message::run_count, &Message::runs, 0, kMaxRunsPerChunk},
      Array{&Message::class_count, &Message::class_lengths, 0, kMaxMapClasses},
      Array{&Message::class_text_count, &Message::class_text, 0, kMaxMapClassText},
  };
  static constexpr double kMaxResolution = 1000.0;  // m
  static constexpr auto kMaxSide = static_cast<std::int32_t>(kMaxVoxels);

  static void fields(auto& io, auto& m, auto& chunk) {
    io.header("header", m.header, chunk.header);
    io.integer("version", m.version, chunk.version, 1, ~std::uint64_t{0});
    io.position("origin", m.origin, chunk.grid.origin);
    io.number("resolution", m.resolution, chunk.grid.resolution, kAboveZero, kMaxResolution);
    io.integer("size_x", m.size_x, chunk.grid.size.x(), 0, kMaxSide);
    io.integer("size_y", m.size_y, chunk.grid.size.y(), 0, kMaxSide);
    io.integer("size_z", m.size_z, chunk.grid.size.z(), 0, kMaxSide);
    io.integer("index", m.index, chunk.index, 0, kMaxMapChunks - 1);
    io.integer("count", m.count, chunk.count, 1, kMaxMapChunks);
    io.integer("first_voxel", m.first_voxel, chunk.first_voxel, 0, kMaxVoxels);
    io.list("runs", m.runs, chunk.runs, [&io](auto& r, auto& run) {
      io.integer("length", r.length, run.length, 1, kMaxSide);
      io.enumeration("label", r.label, run.label, VoxelLabel::Repulsive);
      io.any("class_index", r.class_index, run.class_index);
    });
  }

  static void write_rest(Message& m, const MapChunk& chunk) {
    for (const std::string& name : chunk.class_names) {
      m.class_lengths.push_back(static_cast<std::int32_t>(name.size()));
      append(m.class_text, name);
    }
  }

  static void read_rest(FieldReader& read, const Message& m, MapChunk& chunk) {
    check_grid(read, chunk.grid);
    Slices text(m.class_text);
    for (const std::int32_t length : m.class_lengths) {
      const auto n = static_cast<std::size_t>(read.integer(length, 0, kMaxMapClassText));
      chunk.class_names.push_back(read.text(text.take(n)));
    }
    read.consistent(text.complete());
    read.consistent(chunk.class_names.empty() || chunk.class_names.front().empty());
    read.consistent(chunk.index < chunk.count);
    std::int64_t end = chunk.first_voxel;
    const std::size_t classes = std::max<std::size_t>(1, chunk.class_names.size());
    for (const VoxelRun& run : chunk.runs) {
      read.consistent(run.class_index < classes);
      end += run.length;
    }
    read.consistent(end <= chunk.grid.voxels());
  }

  static void check_grid(FieldReader& read, VoxelGrid& grid) {
    for (const double corner : Vec3(grid.bounds().max())) read.number(corner, -kMaxCoordinate, kMaxCoordinate);
    // The product as a double first: three sides of kMaxSide overflow 64 bits.
    const double voxels = grid.size.cast<double>().prod();
    if (read.number(voxels, 0.0, static_cast<double>(kMaxVoxels)) != voxels) grid.size.setZero();
  }
};

template Bytes encode(const MapChunk& value);
template tl::expected<MapChunk, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<MapChunk>(std::span<const std::uint8_t> bytes);

}  // namespace tern
