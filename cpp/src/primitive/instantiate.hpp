#pragma once

#include "primitive/average.hpp"
#include "primitive/batch.hpp"
#include "primitive/fit_report.hpp"
#include "primitive/primitive_bodies.hpp"
#include "primitive/spread.hpp"

/// Compiles everything that a primitive of a space offers, once, into the library.
#define DMP_INSTANTIATE(SPACE)                                                                 \
  template class Primitive<SPACE>;                                                             \
  template class Stepper<SPACE>;                                                               \
  template Primitive<SPACE> average(const std::vector<Primitive<SPACE>>&);                     \
  template FitReport assess(const Primitive<SPACE>&, const std::vector<SPACE::Demonstration>&, \
                            const Tolerance&);                                                 \
  template SpreadOf<SPACE> detail::spread_of<SPACE>(const std::vector<SPACE::Demonstration>&, Eigen::Index)
