#pragma once
// What holds of a run of any kind as a value.

#include <doctest/doctest.h>

#include <utility>

namespace run_values {

/// Copied, assigned (to itself too) and moved, a run goes on as the original would; output(run) is what it
/// gives.
template <class Run, class Dmp, class Output>
void check(const Dmp& dmp, const Dmp& of_another, const Output& output) {
  Run run(dmp), other(of_another);
  for (int i = 0; i < 300; ++i) run.step(1e-3);
  const auto next_of = [&](Run one) {
    one.step(1e-2);
    return output(one);
  };
  const auto next = next_of(run);
  other = run;
  CHECK(next_of(other) == next);
  const Run& same = other;
  other = same;
  CHECK(next_of(other) == next);
  Run moved(std::move(other));
  CHECK(next_of(moved) == next);
  run.reset();
  run = std::move(moved);
  CHECK(next_of(run) == next);
}

}  // namespace run_values
