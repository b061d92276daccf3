#pragma once

/// Stands behind every method that a control loop may call: it never allocates, locks, throws or enters the
/// kernel, and its work is bounded: a step(dt) takes as many internal steps as dt asks for (one for up to
/// 0.005 of the duration, or up to half a duration over the largest gain). Clang 20 and newer check it
/// (RealtimeSanitizer).
#if defined(__clang__) && __clang_major__ >= 20
#define DMP_REALTIME [[clang::nonblocking]]
#else
#define DMP_REALTIME
#endif
