// Writes room.ot, room.bt and colour.ot with OctoMap's own library, and prints the numbers that octomap_test.cpp
// expects:
//     g++ make_octomaps.cpp -loctomap -loctomath -o make_octomaps && ./make_octomaps     (Debian: liboctomap-dev)
#include <octomap/ColorOcTree.h>
#include <octomap/octomap.h>

#include <cstdio>

template <class Tree>
void print_leaves(const char* name, const Tree& tree) {
  long leaves[2] = {0, 0};
  long voxels[2] = {0, 0};
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const long side = 1L << (16 - leaf.getDepth());
    const int is_occupied = tree.isNodeOccupied(*leaf) ? 1 : 0;
    ++leaves[is_occupied];
    voxels[is_occupied] += side * side * side;
  }
  std::printf("%s: leaves %ld occupied, %ld free; voxels %ld occupied, %ld free\n", name, leaves[1], leaves[0],
              voxels[1], voxels[0]);
}

int main() {
  // A sensor in a room of 4 × 3 × 2 m sees its walls five times.
  octomap::OcTree room(0.2);
  octomap::Pointcloud walls;
  for (double z = 0; z < 2; z += 0.1) {
    for (double x = -2; x < 2; x += 0.1) {
      walls.push_back(x, -1.45, z);
      walls.push_back(x, 1.45, z);
    }
    for (double y = -1.5; y < 1.5; y += 0.1) {
      walls.push_back(-1.95, y, z);
      walls.push_back(1.95, y, z);
    }
  }
  for (int i = 0; i < 5; ++i) room.insertPointCloud(walls, octomap::point3d(0.05, 0.05, 1.05));
  room.updateInnerOccupancy();
  room.prune();
  room.write("room.ot");
  room.writeBinary("room.bt");
  print_leaves("room", room);

  // A cube of 4 m with a wall of one voxel: pruned leaves, and a colour per node.
  octomap::ColorOcTree colour(0.5);
  for (int i = 0; i < 8 * 8 * 8; ++i) {
    const int x = i % 8 - 4, y = i / 8 % 8 - 4, z = i / 64;
    colour.updateNode(octomap::point3d(x * 0.5 + 0.25, y * 0.5 + 0.25, z * 0.5 + 0.25), x == 2 && y < 2);
  }
  colour.updateInnerOccupancy();
  colour.prune();
  colour.write("colour.ot");
  print_leaves("colour", colour);
}
