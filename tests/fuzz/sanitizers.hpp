// Differences of a build with sanitizers.
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/lsan_interface.h>
#endif

namespace strut::fuzz {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true;
// Memory that nothing points to any more, since the last time it was asked for.
inline bool has_leaked() { return __lsan_do_recoverable_leak_check() != 0; }
// Memory that is taken meanwhile may be lost: Open MPI's, when it starts.
inline void ask_for_leaks(bool asked) { asked ? __lsan_enable() : __lsan_disable(); }
#else
constexpr bool sanitized = false;
inline bool has_leaked() { return false; }
inline void ask_for_leaks(bool) {}
#endif

}  // namespace strut::fuzz
