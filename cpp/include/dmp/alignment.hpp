#pragma once
// The old name of dmp/eigen_abi.hpp, kept for one release.
#pragma message("<dmp/alignment.hpp> is now <dmp/eigen_abi.hpp>")

#include <dmp/eigen_abi.hpp>
