#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/phase.hpp>

#include <cmath>

using namespace dmp;

TEST_CASE("the phase variable decays exactly, in one step or many") {
  Phase one(2.0, 4.0);
  one.advance(1.0);
  CHECK(one.x() == doctest::Approx(0.13533528323661269).epsilon(1e-15));
  Phase many(2.0, 4.0);
  for (int i = 0; i < 1000; ++i) many.advance(1e-3);
  CHECK(many.x() == doctest::Approx(one.x()).epsilon(1e-13));
  Phase unit(1.0, 1.0);
  unit.advance(1.0);
  CHECK(unit.x() == doctest::Approx(0.36787944117144232).epsilon(1e-15));
}

TEST_CASE("twice the duration at twice the step is the same phase, bit for bit") {
  Phase slow(2.0, 4.6);
  Phase fast(1.0, 4.6);
  for (int i = 0; i < 777; ++i) {
    slow.advance(0.002);
    fast.advance(0.001);
    REQUIRE(slow.s() == fast.s());
  }
}

TEST_CASE("a new duration is approached without a jump and its phase does not depend on the step") {
  Phase coarse(1.0, 4.6);
  Phase fine(1.0, 4.6);
  REQUIRE(coarse.set_duration(3.0, 0.2));
  REQUIRE(fine.set_duration(3.0, 0.2));
  CHECK(coarse.duration() == 1.0);
  for (int i = 0; i < 10; ++i) coarse.advance(0.1);
  for (int i = 0; i < 1000; ++i) fine.advance(0.001);
  CHECK(coarse.s() == doctest::Approx(fine.s()).epsilon(1e-12));
  CHECK(coarse.duration() == doctest::Approx(3.0 - 2.0 * std::exp(-5.0)).epsilon(1e-12));
  for (int i = 0; i < 100; ++i) coarse.advance(0.1);
  CHECK(coarse.duration() == 3.0);
}

TEST_CASE("durations that are no durations are refused and change nothing") {
  CHECK_THROWS_AS(Phase(0.0, 1.0), InvalidArgument);
  CHECK_THROWS_AS(Phase(1.0, -1.0), InvalidArgument);
  CHECK_THROWS_AS(Phase(NAN, 1.0), InvalidArgument);
  Phase phase(1.0, 4.6);
  CHECK_FALSE(phase.set_duration(-1.0, 0.1));
  CHECK_FALSE(phase.set_duration(NAN, 0.1));
  CHECK_FALSE(phase.set_duration(1.0, -0.1));
  CHECK(phase.duration() == 1.0);
}
