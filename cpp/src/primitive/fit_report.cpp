#include "primitive/fit_report.hpp"

#include <dmp/error.hpp>

#include <cmath>
#include <string>
#include <utility>

#include "base/text.hpp"

namespace dmp::detail {

using Eigen::Index;
using Eigen::VectorXd;

void warn_of_scaling(FitReport& report, const VectorXd& displacement, const VectorXd& amplitude) {
  for (Index d = 0; d < amplitude.size(); ++d)
    if (std::abs(displacement[d]) < 1e-3 * amplitude[d])
      report.warnings.push_back("scaling: axis " + std::to_string(d) + " ends " + number(displacement[d]) +
                                " from its start and covers " + number(amplitude[d]) +
                                ": a new goal multiplies it by the ratio. Use Scaling::advance.");
}

void warn(FitReport& report, const std::vector<Index>& sizes, const DmpOptions& options, double excess) {
  if (excess > 1.0)
    report.warnings.push_back("rmse: " + number(excess) + " times the tolerance. " +
                              (report.suggested_basis_count > 0
                                   ? std::to_string(report.suggested_basis_count) + " kernels reach it."
                                   : "More kernels do not help; smoothing may."));
  for (std::size_t j = 0; j < sizes.size(); ++j)
    if (sizes[j] < 3)
      report.warnings.push_back(
          indexed("demonstrations", static_cast<long>(j)) +
          ": two samples tell a start and a goal only; the spring and damper alone move there.");
  if (report.largest_log > 1.9 * M_PI && options.orientation_form != OrientationForm::turning)
    report.warnings.push_back(
        "largest_log: " + number(report.largest_log) +
        " rad comes near 2 pi, where the logarithm is singular across the axis. Split the demonstration.");
  if (report.condition > 5e13)
    report.warnings.push_back("condition: " + number(report.condition) +
                              " leaves few digits. Use fewer kernels, a larger overlap or a larger ridge.");
  if (options.derivatives != Derivatives::smooth && report.noise.maxCoeff() > 0.0)
    report.warnings.push_back("noise: " + number(report.noise.maxCoeff()) +
                              " was found and learned with the motion. Derivatives::smooth takes it out.");
}

void require_tolerance(const Tolerance& tolerance) {
  for (const auto& [name, value] :
       {std::pair("position", tolerance.position), std::pair("angle", tolerance.angle)})
    if (!(value > 0.0))
      throw InvalidArgument(std::string("tolerance.") + name + ": " + number(value) + ", expected > 0.");
}

}  // namespace dmp::detail
