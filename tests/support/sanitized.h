// Sanitizers make the code some ten times slower: tests of long work take smaller sizes there.
#pragma once

namespace farcell {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif
}  // namespace farcell
