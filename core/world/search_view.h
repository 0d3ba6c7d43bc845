// The message SEARCH_VIEW: the nodes of a search, for display.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.h"
#include "core/wire/header.h"

namespace tern {

inline constexpr int kMaxSearchNodes = 2000;  ///< in a SearchView

/// A node whose part of the spline was found clear.
struct SearchViewNode {
  Vec3 position = Vec3::Zero();  ///< control point, W, m
  std::int32_t parent = -1;      ///< index of an earlier node; −1: the root
};

/// SEARCH_VIEW: the nodes of the last search of an answer.
struct SearchView {
  Header header;
  std::int64_t request_id = 0;  ///< > 0
  std::int32_t left_out = 0;    ///< nodes that did not fit into the message
  std::vector<SearchViewNode> nodes;
};

}  // namespace tern
