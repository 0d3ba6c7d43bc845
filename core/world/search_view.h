// SEARCH_VIEW: what a search looked at, for people.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.h"
#include "core/world/header.h"

namespace tern {

inline constexpr int kMaxSearchNodes = 2000;  ///< in a SearchView

/// A node that the search found clear.
struct SearchViewNode {
  Vec3 position = Vec3::Zero();  ///< control point, W, m
  std::int32_t parent = -1;      ///< index of a node before it; −1: the root
};

struct SearchView {
  Header header;
  std::int64_t request_id = 0;  ///< > 0
  std::int32_t left_out = 0;    ///< nodes that did not fit
  std::vector<SearchViewNode> nodes;
};

}  // namespace tern
