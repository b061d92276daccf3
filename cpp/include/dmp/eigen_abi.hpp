#pragma once
// Eigen aligns what it holds by the instructions that it may use: a program that is compiled with -mavx or
// -march=native lays out the values of this library in another way than a library that was not, and hands
// memory back that it never took. So every program refers to a symbol that is named after its alignment, and
// one that differs does not link. Compile the library with the same flags then, or take it by
// add_subdirectory.

#include <dmp/export.hpp>

#include <Eigen/Core>

#define DMP_JOIN_(a, b, c) a##b##_##c
#define DMP_JOIN(a, b, c) DMP_JOIN_(a, b, c)
#define DMP_ALIGNMENT_SYMBOL \
  DMP_JOIN(dmp_is_not_compiled_for_eigen_alignment_, EIGEN_MAX_STATIC_ALIGN_BYTES, EIGEN_MAX_ALIGN_BYTES)

extern "C" DMP_EXPORT const char DMP_ALIGNMENT_SYMBOL;

namespace {
[[gnu::used]] const char* const dmp_alignment = &DMP_ALIGNMENT_SYMBOL;
}
