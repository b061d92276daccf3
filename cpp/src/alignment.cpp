#include <dmp/alignment.hpp>

extern "C" const char DMP_ALIGNMENT_SYMBOL = 0;
