#pragma once

#include <dmp/path_fit.hpp>

namespace dmp::detail {

/// InvalidArgument, naming argument, index, what came and what was expected, unless fit_path can use them.
void check_fit(const Arm& arm, const Eigen::VectorXd& times, const Poses& poses, const RowMatrix& start,
               const PathFitOptions& options);

}  // namespace dmp::detail
