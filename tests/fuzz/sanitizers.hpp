// Differences of a build with sanitizers.
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/lsan_interface.h>
#endif

namespace strut::fuzz {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true;
// True if memory has leaked since the last call.
inline bool has_leaked() { return __lsan_do_recoverable_leak_check() != 0; }
// False: memory that is allocated from now on may leak, as that of Open MPI at its start.
inline void ask_for_leaks(bool asked) { asked ? __lsan_enable() : __lsan_disable(); }
#else
constexpr bool sanitized = false;
inline bool has_leaked() { return false; }
inline void ask_for_leaks(bool) {}
#endif

}  // namespace strut::fuzz
