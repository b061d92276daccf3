#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/options.hpp>
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

TEST_CASE("a new duration is approached without a jump, alike whatever the step") {
  Phase coarse(1.0, 4.6, 0.2);
  Phase fine(1.0, 4.6, 0.2);
  REQUIRE(coarse.set_duration(3.0));
  REQUIRE(fine.set_duration(3.0));
  CHECK(coarse.speed() == 1.0);
  for (int i = 0; i < 10; ++i) coarse.advance(0.1);
  for (int i = 0; i < 1000; ++i) fine.advance(0.001);
  CHECK(coarse.s() == doctest::Approx(fine.s()).epsilon(1e-12));
  CHECK(coarse.speed() == doctest::Approx(1.0 / 3 + 2.0 / 3 * 6.0 * std::exp(-5.0)).epsilon(1e-12));
  CHECK(coarse.s() == doctest::Approx(1.0 / 3 + 2.0 / 3 * 0.2 * (2 - 7.0 * std::exp(-5.0))).epsilon(1e-12));
  for (int i = 0; i < 100; ++i) coarse.advance(0.1);
  CHECK(coarse.speed() == 1.0 / 3);
}

TEST_CASE("a pause comes to rest where it says and goes on at full speed") {
  Phase phase(2.0, 4.6, 0.1);
  phase.advance(0.5);
  phase.pause();
  phase.advance(5.0);
  CHECK(phase.s() == doctest::Approx(0.25 + 0.5 * 2 * 0.1).epsilon(1e-9));
  CHECK(phase.speed() == 0.0);
  CHECK(phase.time() == 5.5);
  phase.reset();
  CHECK(phase.paused());
  CHECK(phase.speed() == 0.0);
  phase.resume();
  phase.advance(5.0);
  CHECK(phase.speed() == 0.5);
}

TEST_CASE("speed and acceleration of the phase are continuous and derivatives of each other") {
  Phase phase(1.0, 4.6, 0.1);
  phase.set_duration(2.0);
  const double h = 1e-6;
  for (int i = 0; i < 40; ++i) {
    if (i == 10) phase.pause();
    if (i == 15) phase.resume();
    Phase next = phase;
    next.advance(h);
    CHECK(std::abs((next.s() - phase.s()) / h - phase.speed()) < 1e-4);
    CHECK(std::abs((next.speed() - phase.speed()) / h - phase.speed_rate()) < 1e-3);
    CHECK(next.speed() >= 0.0);
    phase.advance(0.02);
  }
}

TEST_CASE("a tracking error slows the phase to 1 / (tau (1 + k e))") {
  Phase phase(2.0, 4.6, 0.0, 50.0);
  CHECK(phase.set_tracking_error(0.02));
  CHECK(phase.speed() == doctest::Approx(0.25));
  CHECK(phase.set_tracking_error(0.0));
  CHECK(phase.speed() == 0.5);
}

TEST_CASE("what is no duration, error or gain is refused and changes nothing") {
  CHECK_THROWS_AS(Phase(0.0, 1.0), InvalidArgument);
  CHECK_THROWS_AS(Phase(1.0, -1.0), InvalidArgument);
  CHECK_THROWS_AS(Phase(NAN, 1.0), InvalidArgument);
  CHECK_THROWS_AS(Phase(1e-320, 1.0), InvalidArgument);
  CHECK_THROWS_AS(Phase(1.0, 1.0, -0.1), InvalidArgument);
  CHECK_THROWS_AS(Phase(1.0, 1.0, 0.1, NAN), InvalidArgument);
  Phase phase(1.0, 4.6, 0.1);
  CHECK_FALSE(phase.set_duration(-1.0));
  CHECK_FALSE(phase.set_duration(NAN));
  CHECK_FALSE(phase.set_tracking_error(-0.1));
  CHECK_FALSE(phase.set_tracking_error(INFINITY));
  CHECK(phase.duration() == 1.0);
  CHECK(phase.speed() == 1.0);
}

TEST_CASE("the end is met within rounding, and a way across it comes apart there") {
  Phase phase(2.0, 4.6);
  CHECK_FALSE(phase.ended());
  CHECK(phase.before_end(0.4) == 0.4);
  CHECK(phase.before_end(1.0) == 1.0);
  CHECK(phase.before_end(1.5) == 1.0);
  phase.advance(1.5);
  CHECK(phase.before_end(0.5) == 0.25);
  phase.advance(0.5 - 1e-10);
  CHECK(phase.ended());
  CHECK_FALSE(phase.past_end());
  CHECK(phase.before_end(0.5) == 0.5);
  phase.advance(1e-3);
  CHECK(phase.past_end());
}

TEST_CASE("a clock of options has their decay, filter and gain") {
  DmpOptions options;
  options.alpha_x = 3.0;
  options.tempo_filter = 0.0;
  options.phase_stop = 4.0;
  Phase phase(2.0, options);
  phase.advance(1.0);
  CHECK(phase.x() == doctest::Approx(std::exp(-1.5)));
  phase.set_tracking_error(0.25);
  CHECK(phase.speed() == 0.25);
}
