#pragma once
// The old name of dmp/dtw.hpp, kept for one release.
#pragma message("<dmp/align.hpp> is now <dmp/dtw.hpp>")

#include <dmp/dtw.hpp>
