#pragma once

#include <dmp/export.hpp>
#include <dmp/realtime.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

/// Rotations: SO(3), its exponential and logarithm, Euler angles. Rotation matrices map body to world, so
/// that Rd = [omega]x R makes omega the angular velocity in the world frame. All angles are in rad.
namespace dmp::so3 {

/// [a]x, the matrix with [a]x b = a x b.
DMP_EXPORT Eigen::Matrix3d hat(const Eigen::Vector3d& a) noexcept DMP_REALTIME;
/// The inverse of hat, from the skew-symmetric part of m.
DMP_EXPORT Eigen::Vector3d vee(const Eigen::Matrix3d& m) noexcept DMP_REALTIME;

/// The rotation by |v| about v. Exact to rounding for every |v|, 1e-300 and beyond 2 pi included.
DMP_EXPORT Eigen::Matrix3d exp(const Eigen::Vector3d& v) noexcept DMP_REALTIME;
DMP_EXPORT Eigen::Quaterniond exp_quaternion(const Eigen::Vector3d& v) noexcept DMP_REALTIME;

/// The rotation vector v with exp(v) = r and |v| <= pi, by the un-normalised Shepperd quaternion and atan2:
/// exact to rounding everywhere, at pi too. There both signs are logarithms; the one whose first component
/// that is not zero is positive is returned.
DMP_EXPORT Eigen::Vector3d log(const Eigen::Matrix3d& r) noexcept DMP_REALTIME;
/// The same for a quaternion, which need not have length 1; q and -q give the same answer.
DMP_EXPORT Eigen::Vector3d log(const Eigen::Quaterniond& q) noexcept DMP_REALTIME;
/// The logarithm nearest to `previous` among all branches (theta + 2 pi m) n: continuous through pi and 2 pi.
DMP_EXPORT Eigen::Vector3d lifted_log(const Eigen::Quaterniond& q,
                                      const Eigen::Vector3d& previous) noexcept DMP_REALTIME;

/// J_l(v): omega = J_l(v) vd for R = exp(v) (world frame).
DMP_EXPORT Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& v) noexcept DMP_REALTIME;
/// J_l(v)^-1; singular where |v| is a multiple of 2 pi other than 0.
DMP_EXPORT Eigen::Matrix3d left_jacobian_inverse(const Eigen::Vector3d& v) noexcept DMP_REALTIME;

/// The angle of the rotation between a and b, 0 to pi.
DMP_EXPORT double distance(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) noexcept DMP_REALTIME;

/// The rotation of three Euler angles. `convention` names the axes in the order of the angles: upper case for
/// rotations about the moving axes ("ZYX": R = Rz(a) Ry(b) Rx(c)), lower case about the fixed ones ("xyz":
/// R = Rz(c) Ry(b) Rx(a)); "source" is the passive product Rz(a)^T Ry(b)^T Rx(c)^T of the thesis proposal of
/// 2019. Throws InvalidArgument for an unknown convention or angles that are not finite.
DMP_EXPORT Eigen::Matrix3d from_euler(const Eigen::Vector3d& angles, const std::string& convention);
/// The inverse: first and third angle in (-pi, pi], the middle one in [-pi/2, pi/2] (three different axes) or
/// [0, pi] (first axis repeated). At gimbal lock the third angle is 0.
/// Bernardes and Viollet 2022, "Quaternion to Euler angles conversion", PLOS ONE.
DMP_EXPORT Eigen::Vector3d to_euler(const Eigen::Matrix3d& r, const std::string& convention);

/// Whether r is a rotation to 1e-3: |R^T R - I| elementwise, det(R) > 0; false if not finite.
DMP_EXPORT bool is_rotation(const Eigen::Matrix3d& r) noexcept;
/// Throws InvalidArgument, naming `name`, unless r is a rotation: finite, orthogonal to 1e-3, det +1.
DMP_EXPORT void require_rotation(const Eigen::Matrix3d& r, const std::string& name);
/// The rotation nearest to r (polar decomposition), for one that require_rotation lets pass.
DMP_EXPORT Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& r);

/// The rotation nearest to all of them, in the sense of least squares of their matrices (chordal mean:
/// Hartley et al. 2013, "Rotation averaging", section 5.3). One alone is its own mean, to the last bit.
/// Throws InvalidArgument for none.
DMP_EXPORT Eigen::Matrix3d mean_rotation(const Rotations& rotations);

}  // namespace dmp::so3
