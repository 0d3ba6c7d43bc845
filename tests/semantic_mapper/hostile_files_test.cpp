// Damaged files: the readers return a value or an error for any bytes.
#include <gtest/gtest.h>

#include <string_view>

#include "core/base/plain_text.h"
#include "core/base/random.h"
#include "core/wire/message_limits.h"
#include "semantic_mapper/sources/las.h"
#include "semantic_mapper/sources/lzf.h"
#include "semantic_mapper/sources/octomap.h"
#include "semantic_mapper/sources/pcd.h"
#include "semantic_mapper/sources/ply.h"
#include "semantic_mapper/sources/text_cloud.h"
#include "tests/support/cloud_files.h"
#include "tests/support/effort.h"

namespace tern {
namespace {

using support::FileBytes;
using support::mutated;

const int kMutations = support::at_effort(10'000);
/// Compressed data may hold this many times its bytes.
constexpr std::size_t kMaxLzfRatio = 88;

PointCloud some_points(Rng& rng) {
  PointCloud points;
  for (int i = 0; i < 20; ++i) {
    const Vec3 p(rng.uniform(-50, 50), rng.uniform(-50, 50), rng.uniform(-5, 5));
    points.push_back({p, static_cast<std::uint8_t>(rng.uniform(0, 32))});
  }
  return points;
}

void expect_sane(const Result<CloudFile>& cloud, std::size_t most) {
  if (!cloud) {
    ASSERT_TRUE(cloud.error().message.starts_with("file, offset ")) << cloud.error().message;
    ASSERT_LT(cloud.error().message.size(), 300u);
    ASSERT_TRUE(is_plain_text(cloud.error().message)) << "an error that quotes the file can be sent";
    return;
  }
  ASSERT_LE(cloud->points.size(), most);
  for (const LabelledPoint& point : cloud->points) ASSERT_LE(point.position.cwiseAbs().maxCoeff(), kMaxCoordinate);
}

TEST(HostileFiles, MutatedLasGivesAValueOrAnError) {
  Rng rng(1);
  for (int i = 0; i < kMutations; ++i) {
    support::LasSpec spec;
    spec.minor = i % 5;
    spec.format = spec.minor == 4 ? i % 11 : i % 6;
    const FileBytes bytes = mutated(support::las_file(some_points(rng), spec), rng);
    expect_sane(parse_las(bytes, "file", {}), bytes.size());
    if (HasFatalFailure()) return;
  }
}

TEST(HostileFiles, MutatedPlyGivesAValueOrAnError) {
  Rng rng(2);
  for (int i = 0; i < kMutations; ++i) {
    const auto kind = static_cast<support::PlyKind>(i % 3);
    const FileBytes bytes = mutated(support::ply_file(some_points(rng), kind), rng);
    expect_sane(parse_ply(bytes, "file", {}), bytes.size());
    if (HasFatalFailure()) return;
  }
}

TEST(HostileFiles, MutatedPcdGivesAValueOrAnError) {
  Rng rng(3);
  for (int i = 0; i < kMutations; ++i) {
    const auto kind = static_cast<support::PcdKind>(i % 3);
    const FileBytes bytes = mutated(support::pcd_file(some_points(rng), kind), rng);
    expect_sane(parse_pcd(bytes, "file", {}), kMaxLzfRatio * bytes.size());
    if (HasFatalFailure()) return;
  }
}

TEST(HostileFiles, MutatedCompressedBytesGiveTheirSizeOrNothing) {
  Rng rng(4);
  for (int i = 0; i < kMutations; ++i) {
    FileBytes bytes;
    for (int n = 0; n < 30; ++n) {
      bytes.insert(bytes.end(), static_cast<std::size_t>(rng.uniform(1, 20)), static_cast<std::uint8_t>(n));
    }
    const FileBytes packed = mutated(support::lzf_compressed(bytes), rng);
    const auto back = lzf_decompress(packed, bytes.size());
    ASSERT_TRUE(!back || back->size() == bytes.size());
  }
}

TEST(HostileFiles, MutatedTextGivesAValueOrAnError) {
  Rng rng(5);
  for (int i = 0; i < kMutations; ++i) {
    const FileBytes bytes = mutated(support::text_file(some_points(rng), " ,;\t"[i % 4]), rng);
    expect_sane(parse_text_cloud(bytes, "file", {}), bytes.size());
    if (HasFatalFailure()) return;
  }
}

TEST(HostileFiles, MutatedOctoMapGivesAValueOrAnError) {
  Rng rng(6);
  for (int i = 0; i < kMutations; ++i) {
    std::vector<VoxelLabel> labels(64);
    for (VoxelLabel& label : labels) label = static_cast<VoxelLabel>(rng.uniform(0, 3));
    const FileBytes bytes = mutated(support::octomap_file(labels, 4, i % 2 == 0), rng);
    const auto octomap = parse_octomap(bytes, "file", {});
    if (!octomap) {
      ASSERT_TRUE(octomap.error().message.starts_with("file, offset ")) << octomap.error().message;
      ASSERT_LT(octomap.error().message.size(), 300u);
      ASSERT_TRUE(is_plain_text(octomap.error().message));
      continue;
    }
    ASSERT_LE(octomap->leaves.size(), 4 * bytes.size());
    for (const OctoLeaf& leaf : octomap->leaves) {
      const Box box = octomap->box(leaf);
      ASSERT_TRUE(Box(Vec3::Constant(-kMaxCoordinate), Vec3::Constant(kMaxCoordinate)).contains(box));
      ASSERT_FALSE(box.isEmpty());
    }
  }
}

}  // namespace
}  // namespace tern
