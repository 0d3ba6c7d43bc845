#include "messages/codec.h"
#include "messages/fields.h"
#include "messages/wire.h"
#include "tern_msgs/search_view_t.hpp"

namespace tern {
namespace {

using Message = tern_msgs::search_view_t;
static_assert(Message::MAX_NODES == kMaxSearchNodes);

const wire::Layout kLayout{
    wire::Array{&Message::node_count, &Message::nodes, 0, kMaxSearchNodes},
};

Message to_lcm(const SearchView& view) {
  Message m{};
  m.header = wire::to_lcm(view.header);
  m.request_id = view.request_id;
  m.left_out = view.left_out;
  for (const SearchViewNode& node : view.nodes) {
    tern_msgs::search_node_t n{};
    n.position = wire::to_lcm(node.position);
    n.parent = node.parent;
    m.nodes.push_back(n);
  }
  return m;
}

tl::expected<SearchView, Rejection> from_lcm(const Message& m) {
  wire::FieldReader read;
  SearchView view;
  view.header = read.header(m.header);
  view.request_id = read.integer<std::int64_t>(m.request_id, 1, wire::kMaxCounter);
  view.left_out = read.integer(m.left_out, 0, std::numeric_limits<std::int32_t>::max());
  for (const tern_msgs::search_node_t& n : m.nodes) {
    const auto index = static_cast<std::int32_t>(view.nodes.size());
    view.nodes.push_back({read.position(n.position), read.integer(n.parent, -1, kMaxSearchNodes)});
    read.consistent(n.parent < index);
  }
  return read.accept(std::move(view));
}

}  // namespace

template <>
Bytes encode(const SearchView& value) {
  return wire::encode(to_lcm(value), kLayout);
}

template <>
tl::expected<SearchView, Rejection> decode(std::span<const std::uint8_t> bytes) {
  return wire::decode(bytes, kLayout, from_lcm);
}

}  // namespace tern
