// SEARCH_VIEW on the wire: lcmtypes/search_view_t.lcm.
#pragma once

#include "core/world/search_view.h"
#include "messages/codec.h"

namespace tern {

template <>
Bytes encode(const SearchView& value);
/// Inconsistent: a node whose parent does not come before it.
template <>
tl::expected<SearchView, Rejection> decode(std::span<const std::uint8_t> bytes);

}  // namespace tern
