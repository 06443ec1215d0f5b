// Whether the tests run under AddressSanitizer or ThreadSanitizer, which take time and memory of their own.
#pragma once

namespace kcs::planning {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitizer = true;
#else
constexpr bool kSanitizer = false;
#endif

}  // namespace kcs::planning
