#include <dmp/eigen_abi.hpp>

extern "C" const char DMP_ALIGNMENT_SYMBOL = 0;
