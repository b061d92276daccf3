#include <dmp/error.hpp>
#include <dmp/so3.hpp>

#include <Eigen/SVD>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>

namespace dmp::so3 {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;

/// A quaternion proportional to that of r; the largest pivot keeps every component exact. Shepperd 1978.
Quaterniond shepperd(const Matrix3d& r) noexcept {
  const double trace = r.trace();
  int pivot = 0;
  const double largest = r.diagonal().maxCoeff(&pivot);
  if (trace >= largest) return {1.0 + trace, r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)};
  const int j = (pivot + 1) % 3;
  const int k = (pivot + 2) % 3;
  Vector3d v;
  v[pivot] = 1.0 + r(pivot, pivot) - r(j, j) - r(k, k);
  v[j] = r(j, pivot) + r(pivot, j);
  v[k] = r(k, pivot) + r(pivot, k);
  return {r(k, j) - r(j, k), v[0], v[1], v[2]};
}

/// True if q and -q are told apart by making w positive, or, at an angle of pi, the first component of the
/// axis.
bool points_down(const Quaterniond& q) noexcept {
  if (q.w() != 0.0) return q.w() < 0.0;
  for (int i = 0; i < 3; ++i)
    if (q.vec()[i] != 0.0) return q.vec()[i] < 0.0;
  return false;
}

/// The axes of a convention as 0, 1, 2, and whether they move with the body.
struct Convention {
  std::array<int, 3> axes;
  bool intrinsic;
};

[[noreturn]] void refuse_convention(const std::string& convention) {
  throw InvalidArgument(
      "convention: '" + convention +
      "' is unknown, expected three axes such as \"ZYX\" (moving axes) or \"xyz\" (fixed axes), "
      "no two neighbours equal, or \"source\".");
}

Convention parse(const std::string& convention) {
  if (convention == "source") return {{2, 1, 0}, true};
  if (convention.size() != 3) refuse_convention(convention);
  Convention parsed{};
  parsed.intrinsic = std::isupper(static_cast<unsigned char>(convention[0])) != 0;
  const char first = parsed.intrinsic ? 'X' : 'x';
  for (std::size_t i = 0; i < 3; ++i) {
    parsed.axes[i] = convention[i] - first;
    if (parsed.axes[i] < 0 || parsed.axes[i] > 2 || (i > 0 && parsed.axes[i] == parsed.axes[i - 1]))
      refuse_convention(convention);
  }
  return parsed;
}

Matrix3d about(int axis, double angle) {
  return Eigen::AngleAxisd(angle, Vector3d::Unit(axis)).toRotationMatrix();
}

double wrapped(double angle) {
  if (angle > kPi) return angle - 2.0 * kPi;
  return angle <= -kPi ? angle + 2.0 * kPi : angle;
}

/// The angles in the order of the convention. Rotations about moving axes are those about the fixed axes in
/// reverse order, so the formula, which is for fixed axes, then finds the last angle first.
Vector3d angles_of(const Matrix3d& r, const Convention& convention) {
  const std::array<int, 3>& axes = convention.axes;
  const int first = convention.intrinsic ? 2 : 0;
  const int third = 2 - first;
  const bool proper = axes[0] == axes[2];
  const int i = axes[static_cast<std::size_t>(first)];
  const int j = axes[1];
  const int k = 3 - i - j;
  const double parity = (i - j) * (j - k) * (k - i) / 2;  // +1 for an even permutation
  const Quaterniond q = shepperd(r).normalized();
  const Vector3d v = q.vec();
  Eigen::Vector4d n(q.w(), v[i], v[j], v[k] * parity);
  if (!proper) n = Eigen::Vector4d(n[0] - n[2], n[1] + n[3], n[2] + n[0], n[3] - n[1]);
  const double middle = 2.0 * std::atan2(std::hypot(n[2], n[3]), std::hypot(n[0], n[1]));
  const double half_sum = std::atan2(n[1], n[0]);
  const double half_difference = std::atan2(n[3], n[2]);
  Vector3d angles(0.0, proper ? middle : middle - kPi / 2.0, 0.0);
  constexpr double kLock = 1e-12;
  if (middle < kLock) {
    angles[0] = 2.0 * half_sum;
  } else if (middle > kPi - kLock) {
    angles[0] = (convention.intrinsic ? 2.0 : -2.0) * half_difference;
  } else {
    angles[first] = half_sum - half_difference;
    angles[third] = half_sum + half_difference;
  }
  if (!proper) angles[third] *= parity;
  return {wrapped(angles[0]), angles[1], wrapped(angles[2])};
}

}  // namespace

Matrix3d hat(const Vector3d& a) noexcept {
  Matrix3d m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

Vector3d vee(const Matrix3d& m) noexcept {
  return 0.5 * Vector3d(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1));
}

Quaterniond exp_quaternion(const Vector3d& v) noexcept {
  const double t = v.squaredNorm();
  double w = 0.0;
  double scale = 0.0;  // sin(theta/2) / theta
  if (t < 0.0625) {    // Taylor, exact to rounding up to theta = 1/4; what an integration step takes
    w = 1.0 + t * (-1.0 / 8 + t * (1.0 / 384 + t * (-1.0 / 46080 + t * (1.0 / 10321920 - t / 3715891200.0))));
    scale = 0.5 + t * (-1.0 / 48 + t * (1.0 / 3840 + t * (-1.0 / 645120 + t * (1.0 / 185794560))));
  } else {
    const double theta = std::isfinite(t) ? std::sqrt(t) : v.stableNorm();
    w = std::cos(0.5 * theta);
    scale = std::sin(0.5 * theta) / theta;
  }
  return {w, scale * v.x(), scale * v.y(), scale * v.z()};
}

Matrix3d exp(const Vector3d& v) noexcept { return exp_quaternion(v).toRotationMatrix(); }

Vector3d log(const Quaterniond& q) noexcept {
  const double sign = points_down(q) ? -1.0 : 1.0;
  const Vector3d v = sign * q.vec();
  const double w = sign * q.w();
  const double squared = v.squaredNorm();
  const double n = squared > 1e-200 && squared < 1e200 ? std::sqrt(squared) : v.stableNorm();
  if (n < 1e-8 * w) return v * (2.0 / w) * (1.0 - n * n / (3.0 * w * w));
  if (n == 0.0) return Vector3d::Zero();
  return v * (2.0 * std::atan2(n, w) / n);
}

Vector3d log(const Matrix3d& r) noexcept { return log(shepperd(r)); }

Vector3d lifted_log(const Quaterniond& q, const Vector3d& previous) noexcept {
  const Vector3d principal = log(q);
  // The branches lie 2 pi apart: one less than pi away is the nearest.
  if ((principal - previous).squaredNorm() < kPi * kPi) return principal;
  const double theta = principal.norm();
  if (theta < 1e-3) {  // near a whole turn the axis is lost in rounding: keep the previous one
    const double length = previous.norm();
    const double turns = std::round(length / (2.0 * kPi));
    if (turns == 0.0) return principal;
    return previous / length * (2.0 * kPi * turns + principal.dot(previous) / length);
  }
  const Vector3d axis = principal / theta;
  const double turns = std::round((previous.dot(axis) - theta) / (2.0 * kPi));
  return turns == 0.0 ? principal : Vector3d(axis * (theta + 2.0 * kPi * turns));
}

Matrix3d left_jacobian(const Vector3d& v) noexcept {
  const double t = v.squaredNorm();
  if (t > 1e40) {  // the terms in 1 / theta are below rounding: what is left is n n^T, and t may overflow
    const Vector3d n = v.stableNormalized();
    return n * n.transpose();
  }
  double a = 0.0;  // (1 - cos theta) / theta^2
  double b = 0.0;  // (theta - sin theta) / theta^3
  if (t < 0.0025) {
    a = 0.5 + t * (-1.0 / 24 + t * (1.0 / 720 - t / 40320));
    b = 1.0 / 6 + t * (-1.0 / 120 + t * (1.0 / 5040 - t / 362880));
  } else {
    const double theta = std::sqrt(t);
    const double s = std::sin(0.5 * theta);
    a = 2.0 * s * s / t;
    b = (theta - std::sin(theta)) / (t * theta);
  }
  const Matrix3d k = hat(v);
  return Matrix3d::Identity() + a * k + b * k * k;
}

Matrix3d left_jacobian_inverse(const Vector3d& v) noexcept {
  const double t = v.squaredNorm();
  double c = 0.0;  // (1 - (theta/2) cot(theta/2)) / theta^2
  if (t < 0.0025) {
    c = 1.0 / 12 + t * (1.0 / 720 + t * (1.0 / 30240 + t / 1209600));
  } else {
    const double half = 0.5 * std::sqrt(t);
    c = (1.0 - half / std::tan(half)) / t;
  }
  const Matrix3d k = hat(v);
  return Matrix3d::Identity() - 0.5 * k + c * k * k;
}

double distance(const Matrix3d& a, const Matrix3d& b) noexcept {
  return log(Matrix3d(a * b.transpose())).norm();
}

Matrix3d from_euler(const Vector3d& angles, const std::string& convention) {
  const Convention parsed = parse(convention);
  if (!angles.allFinite()) throw InvalidArgument("angles: not finite, expected three angles in rad.");
  const Vector3d a = convention == "source" ? Vector3d(-angles) : angles;
  const Matrix3d first = about(parsed.axes[0], a[0]);
  const Matrix3d middle = about(parsed.axes[1], a[1]);
  const Matrix3d last = about(parsed.axes[2], a[2]);
  return parsed.intrinsic ? Matrix3d(first * middle * last) : Matrix3d(last * middle * first);
}

Vector3d to_euler(const Matrix3d& r, const std::string& convention) {
  const Convention parsed = parse(convention);
  require_rotation(r, "rotation");
  const Vector3d angles = angles_of(r, parsed);
  return convention == "source" ? Vector3d(-angles) : angles;
}

namespace {

double defect(const Matrix3d& r) noexcept {
  return (r.transpose() * r - Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

}  // namespace

bool is_rotation(const Matrix3d& r) noexcept {
  const Matrix3d excess = r.transpose() * r - Matrix3d::Identity();
  return (excess.array().abs() <= 1e-3).all() && r.determinant() > 0.0;  // false for what is not a number
}

void require_rotation(const Matrix3d& r, const std::string& name) {
  if (is_rotation(r)) return;
  if (!r.allFinite())
    throw InvalidArgument(name + ": not finite, expected a rotation matrix. Remove or fill the gap.");
  char number[32];
  const double determinant = r.determinant();
  if (determinant < 0.0) {
    std::snprintf(number, sizeof number, "%.3f", determinant);
    throw InvalidArgument(name + ": det(R) = " + number +
                          ", expected +1 (a reflection). Check the axis order.");
  }
  std::snprintf(number, sizeof number, "%.3g", defect(r));
  throw InvalidArgument(
      name + ": |R^T R - I| = " + number +
      ", expected at most 1e-3 (a rotation matrix). Orthonormalise it, or check its layout.");
}

Matrix3d nearest_rotation(const Matrix3d& r) {
  const Eigen::JacobiSVD<Matrix3d> svd(r, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Matrix3d q = svd.matrixU() * svd.matrixV().transpose();
  // Newton's step takes the rounding of the SVD out.
  return 0.5 * q * (3.0 * Matrix3d::Identity() - q.transpose() * q);
}

Matrix3d mean_rotation(const Rotations& rotations) {
  if (rotations.empty()) throw InvalidArgument("rotations: none, expected at least one.");
  if (rotations.size() == 1) return rotations[0];
  Matrix3d sum = Matrix3d::Zero();
  for (const Matrix3d& rotation : rotations) sum += rotation;
  const Eigen::JacobiSVD<Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixU() * Vector3d(1.0, 1.0, sign).asDiagonal() * svd.matrixV().transpose();
}

}  // namespace dmp::so3
