#include "messages/form.h"
#include "tern_msgs/search_view_t.hpp"

namespace tern {

template <>
struct wire::Form<SearchView> {
  using Message = tern_msgs::search_view_t;
  static_assert(Message::MAX_NODES == kMaxSearchNodes);
  static constexpr Layout kLayout{
      Array{&Message::node_count, &Message::nodes, 0, kMaxSearchNodes},
  };

  static void fields(auto& io, auto& m, auto& view) {
    io.header("header", m.header, view.header);
    io.integer("request_id", m.request_id, view.request_id, 1, kMaxCounter);
    io.integer("left_out", m.left_out, view.left_out, 0, std::numeric_limits<std::int32_t>::max());
    io.list("nodes", m.nodes, view.nodes, [&io](auto& n, auto& node) {
      io.position("position", n.position, node.position);
      io.integer("parent", n.parent, node.parent, -1, kMaxSearchNodes);
    });
  }

  static void read_rest(FieldReader& read, const Message& m, SearchView&) {
    for (int k = 0; k < m.node_count; ++k) read.consistent(m.nodes[idx(k)].parent < k);
  }
};

template Bytes encode(const SearchView& value);
template tl::expected<SearchView, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<SearchView>(std::span<const std::uint8_t> bytes);

}  // namespace tern
