#pragma once

/// Stands behind every method that a control loop may call: it never allocates, locks, throws or enters the
/// kernel, and its cost does not depend on the values. Clang 20 and newer check it (RealtimeSanitizer).
#if defined(__clang__) && __clang_major__ >= 20
#define DMP_REALTIME [[clang::nonblocking]]
#else
#define DMP_REALTIME
#endif
