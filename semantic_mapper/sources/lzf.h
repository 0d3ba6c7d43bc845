// Decompression of LZF (Marc Lehmann's LibLZF), which binary_compressed PCD files use.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace tern {

/// Returns the `size` bytes that the stream holds; nullopt if the stream is broken or holds another number of bytes.
/// A size beyond the stream's capacity allocates no memory. O(size).
std::optional<std::vector<std::uint8_t>> lzf_decompress(std::span<const std::uint8_t> stream, std::size_t size);

}  // namespace tern
