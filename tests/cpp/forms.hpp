#pragma once

// Options that differ in the form of orientations alone.

#include <dmp/options.hpp>

#include <Eigen/Core>

namespace motions {

using Vector6 = Eigen::Matrix<double, 6, 1>;

inline dmp::DmpOptions of_form(dmp::OrientationForm form) {
  dmp::DmpOptions options;
  options.orientation_form = form;
  return options;
}

}  // namespace motions
