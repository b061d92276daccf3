#pragma once

#include <dmp/arm.hpp>
#include <dmp/export.hpp>

namespace dmp {

/// How fast the arm's tip can move and turn at most.
struct TipSpeed {
  double linear = 0.0;   ///< m/s; infinity if a joint that moves the tip has no velocity limit
  double angular = 0.0;  ///< rad/s; likewise
};

/// The largest speeds of the tip in any posture within the joint limits, every joint within its velocity
/// limit:
///
///     W = max over q, s of | sum_j z_j(q) v_j s_j |,    V = max over q, s of | sum_j z_j x (p - o_j) v_j s_j
///     |
///
/// with s in {-1, 1}^n: a norm is convex, so its maximum over the box of joint velocities lies at a corner.
/// Over the corners that is exact (up to 10 joints; beyond, by ascent from many of them); over postures it is
/// what a search of 20 000 random ones found, the best improved. No motion that is followed exactly can be
/// faster. The same arm gives the same numbers.
DMP_EXPORT TipSpeed fastest_tip(const Arm& arm);

}  // namespace dmp
