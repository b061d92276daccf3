#pragma once

/// Marks what the shared libraries offer; everything else has hidden visibility.
#define DMP_EXPORT __attribute__((visibility("default")))
