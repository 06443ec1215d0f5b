#include "server/store/compression.h"

#include <zstd.h>

#include <memory>
#include <new>

#include "server/store/errors.h"

namespace kcs::store {

std::string compress(std::string_view bytes) {
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), &ZSTD_freeCCtx);
  if (!context) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  std::string compressed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress2(context.get(), compressed.data(), compressed.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(size)) throw std::bad_alloc();  // nothing else can go wrong with a buffer of that size
  compressed.resize(size);
  return compressed;
}

std::string decompress(std::string_view compressed, std::size_t most) {
  const auto fail = [] {
    throw StoreError("a request in the store is damaged; restore its database from a backup, or delete the plan");
  };
  const unsigned long long size = ZSTD_getFrameContentSize(compressed.data(), compressed.size());
  if (size > most) fail();  // the two error codes are larger than any size, too
  std::string bytes(size, '\0');
  if (ZSTD_decompress(bytes.data(), bytes.size(), compressed.data(), compressed.size()) != size) fail();
  return bytes;
}

}  // namespace kcs::store
