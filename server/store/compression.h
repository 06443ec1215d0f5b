// Compresses pieces of a request.
#pragma once

#include <string>
#include <string_view>

namespace kcs::store {

// The bytes in Zstandard's format, with a checksum.
std::string compress(std::string_view bytes);

// Throws StoreError if these bytes do not come from compress(), or not more than `most` of them were given to it.
std::string decompress(std::string_view compressed, std::size_t most);

}  // namespace kcs::store
