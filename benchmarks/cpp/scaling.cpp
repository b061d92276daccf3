// How cost and memory grow: tables over samples, kernels, dimensions and demonstrations, each with the
// exponent of its growth (1: linear, 0: not at all), the slope of log(time) over log(size) by least squares.
#include <dmp/batch.hpp>
#include <dmp/so3.hpp>

#include <malloc.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "stopwatch.hpp"

namespace {

using namespace dmp;
using Eigen::Index;

RowMatrix motion(Index samples, Index dimensions) {
  RowMatrix y(samples, dimensions);
  for (Index k = 0; k < samples; ++k)
    for (Index d = 0; d < dimensions; ++d) {
      const double s = static_cast<double>(k) / static_cast<double>(samples - 1);
      y(k, d) = std::sin((2.0 + 0.1 * static_cast<double>(d)) * s) + s * s;
    }
  return y;
}

Eigen::VectorXd times(Index samples) { return Eigen::VectorXd::LinSpaced(samples, 0.0, 5.0); }

DmpOptions kernels(int count) {
  DmpOptions options;
  options.basis_count = count;
  return options;
}

double exponent(const std::vector<double>& size, const std::vector<double>& cost) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const double n = static_cast<double>(size.size());
  for (std::size_t i = 0; i < size.size(); ++i) {
    const double a = std::log(size[i]);
    const double b = std::log(cost[i]);
    x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

/// One row: the times at each size and the exponent over the larger half, where what is constant has faded.
void row(const char* name, const std::vector<int>& sizes,
         const std::function<std::function<void()>(int)>& work) {
  std::printf("%-48s", name);
  std::vector<double> size, cost;
  for (const int n : sizes) {
    const double seconds = median_seconds(work(n));
    std::printf(" %6d: %9.2f us", n, 1e6 * seconds);
    size.push_back(n);
    cost.push_back(seconds);
  }
  const std::ptrdiff_t half = static_cast<std::ptrdiff_t>(size.size() / 2);
  std::printf("   exponent %.2f\n",
              exponent({size.begin() + half, size.end()}, {cost.begin() + half, cost.end()}));
}

/// Bytes of the heap that one of many objects takes.
template <class Make>
double bytes_each(Make make) {
  std::vector<decltype(make())> kept;
  kept.reserve(100);
  const auto before = mallinfo2().uordblks;
  for (int i = 0; i < 100; ++i) kept.push_back(make());
  return static_cast<double>(mallinfo2().uordblks - before) / 100.0;
}

void memory() {
  for (const int n : {25, 100, 400}) {
    const Demonstration demo(times(1000), motion(1000, 3));
    const Dmp model = Dmp::fit(demo, kernels(n));
    Poses poses;
    for (Index k = 0; k < 1000; ++k)
      poses.push_back(pose_of(so3::exp({0.001 * static_cast<double>(k), 0, 0}), demo.position().row(k)));
    const PoseDemonstration both(times(1000), poses);
    const PoseDmp pose = PoseDmp::fit(both, kernels(n));
    std::printf("memory, N = %3d: Dmp %.1f KiB, Run %.1f KiB, PoseDmp %.1f KiB, PoseRun %.1f KiB\n", n,
                bytes_each([&] { return Dmp(model.parameters()); }) / 1024,
                bytes_each([&] { return Run(model); }) / 1024,
                bytes_each([&] { return PoseDmp(pose.parameters()); }) / 1024,
                bytes_each([&] { return PoseRun(pose); }) / 1024);
    if (n == 25)
      std::printf("memory, 1000 samples: Demonstration %.0f KiB, PoseDemonstration %.0f KiB\n",
                  bytes_each([&] { return Demonstration(times(1000), demo.position()); }) / 1024,
                  bytes_each([&] { return PoseDemonstration(times(1000), poses); }) / 1024);
  }
}

void fits_of_large_arrays(const char* memory) {
  row((std::string("fit over samples (N 100, 3 axes)") + memory).c_str(), {1000, 2000, 4000, 8000, 16000},
      [](int n) { return [t = times(n), y = motion(n, 3)] { Dmp::fit(Demonstration(t, y)); }; });
  row((std::string("fit over dimensions (1000 samples)") + memory).c_str(), {24, 48, 96, 192, 384},
      [](int n) { return [t = times(1000), y = motion(1000, n)] { Dmp::fit(Demonstration(t, y)); }; });
}

}  // namespace

int main() {
  fits_of_large_arrays("");
  row("fit over kernels (4000 samples)", {25, 50, 100, 200, 400}, [](int n) {
    return [t = times(4000), y = motion(4000, 3), o = kernels(n)] { Dmp::fit(Demonstration(t, y), o); };
  });
  row("joint fit over demonstrations", {10, 20, 40, 80, 160}, [](int n) {
    return [d = std::vector<Demonstration>(static_cast<std::size_t>(n),
                                           Demonstration(times(300), motion(300, 3)))] { Dmp::fit(d); };
  });
  row("fit_each over demonstrations", {10, 20, 40, 80, 160}, [](int n) {
    return [t = times(1000), y = std::vector<RowMatrix>(static_cast<std::size_t>(n), motion(1000, 3))] {
      fit_each(t, y);
    };
  });
  row("step over kernels (3 axes)", {25, 100, 400, 1600, 6400}, [](int n) {
    return [run = Run(Dmp::fit(Demonstration(times(4000), motion(4000, 3)), kernels(n)))]() mutable {
      if (run.step(1e-3) == Status::finished) run.reset();
    };
  });
  row("step over dimensions (N 100)", {3, 6, 12, 24, 48}, [](int n) {
    return [run = Run(Dmp::fit(Demonstration(times(1000), motion(1000, n))))]() mutable {
      if (run.step(1e-3) == Status::finished) run.reset();
    };
  });
  row("rollout over samples (N 100)", {500, 1000, 2000, 4000, 8000}, [](int n) {
    return [dmp = Dmp::fit(Demonstration(times(1000), motion(1000, 3))), n] { dmp.rollout({}, {}, 5.0 / n); };
  });
  memory();
  // The C library gives arrays of more than 128 KiB back at once and takes them anew, page by page. Kept,
  // they show what the arithmetic costs.
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  fits_of_large_arrays(", memory kept");
}
