// A controller that links dmp::core: learns, writes and reads a model, and runs it to its goal.
#include <dmp/error.hpp>
#include <dmp/file.hpp>

#include <cmath>

int main() {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(50, 0.0, 1.0);
  dmp::RowMatrix positions(50, 2);
  positions << times, times.array().square().matrix();
  const dmp::Dmp learned = dmp::Dmp::fit(dmp::Demonstration(times, positions));
  const dmp::Dmp reach = std::get<dmp::Dmp>(dmp::from_json(dmp::to_json(learned)));
  dmp::Run run(reach);
  while (run.step(1e-3) == dmp::Status::running) {
  }
  try {
    reach.rollout({}, -1.0);  // an exception of the library is caught across its boundary
    return 1;
  } catch (const dmp::InvalidArgument&) {
  }
  return std::abs(run.position()[1] - 1.0) < 1e-2 ? 0 : 1;
}
