#pragma once
// Calls a function with every bad value in the place of every argument: what is refused is refused with
// InvalidArgument, what is answered is answered without NaN.

#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/trajectory.hpp>

#include <climits>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace refusals {

/// What may come where a good value should, and whether it must be refused.
template <class T>
struct Bad {
  std::string name;
  T value;
  bool never = true;
};

/// One argument of a call: a good value, and which of the bad ones may have a meaning.
template <class T>
struct Argument {
  std::string name;
  T good;
  bool any_size = false;  ///< other sizes may be answered
  bool infinite = false;  ///< infinity means none
};

template <class T>
Argument<T> argument(const char* name, T good) {
  return {name, std::move(good)};
}
template <class T>
Argument<T> any_size(const char* name, T good) {
  return {name, std::move(good), true};
}
template <class T>
Argument<T> or_infinite(const char* name, T good) {
  return {name, std::move(good), false, true};
}

inline std::vector<Bad<double>> bad_numbers(bool infinite) {
  const double inf = std::numeric_limits<double>::infinity();
  return {{"NaN", std::nan("")},   {"infinity", inf, !infinite}, {"-infinity", -inf, !infinite},
          {"0", 0.0, false},       {"-1", -1.0, false},          {"denormal", 5e-324, false},
          {"1e308", 1e308, false}, {"-1e308", -1e308, false}};
}

inline std::vector<Bad<double>> bad(const Argument<double>& argument) {
  return bad_numbers(argument.infinite);
}

inline std::vector<Bad<int>> bad(const Argument<int>&) {
  return {{"0", 0, false}, {"-1", -1, false}, {"INT_MIN", INT_MIN}, {"INT_MAX", INT_MAX, false}};
}

/// One number of it, in the middle, and all of them replaced.
template <class Matrix>
void spoil_numbers(const Matrix& good, bool infinite, std::vector<Bad<Matrix>>& all) {
  for (const Bad<double>& number : bad_numbers(infinite)) {
    Bad<Matrix> one{"one " + number.name, good, number.never};
    one.value(good.rows() / 2, good.cols() / 2) = number.value;
    all.push_back(one);
    all.push_back(
        {"all " + number.name, Matrix::Constant(good.rows(), good.cols(), number.value), number.never});
  }
}

/// Vectors, tables and matrices, of fixed size or not.
template <class Scalar, int Rows, int Cols, int Options>
auto bad(const Argument<Eigen::Matrix<Scalar, Rows, Cols, Options>>& argument) {
  using Matrix = Eigen::Matrix<Scalar, Rows, Cols, Options>;
  const Matrix& good = argument.good;
  std::vector<Bad<Matrix>> all;
  spoil_numbers(good, argument.infinite, all);
  if constexpr (Rows == Eigen::Dynamic) {
    const bool never = !argument.any_size;
    all.push_back({"empty", Matrix(0, good.cols()), never});
    all.push_back({"shorter", good.topRows(good.rows() - 1), never});
    Matrix longer(good.rows() + 1, good.cols());
    longer << good, good.bottomRows(1);
    all.push_back({"longer", longer, never});
  }
  return all;
}

/// One rotation or pose among many.
template <class Matrix>
std::vector<Bad<std::vector<Matrix>>> bad(const Argument<std::vector<Matrix>>& argument) {
  const std::vector<Matrix>& good = argument.good;
  const bool never = !argument.any_size;
  std::vector<Bad<std::vector<Matrix>>> all{{"empty", {}, never},
                                            {"shorter", {good.begin(), good.end() - 1}, never}};
  std::vector<Bad<Matrix>> ones;
  spoil_numbers(good[good.size() / 2], argument.infinite, ones);
  for (const Bad<Matrix>& one : ones) {
    all.push_back({one.name, good, one.never});
    all.back().value[good.size() / 2] = one.value;
  }
  return all;
}

inline bool no_nan(double value) { return !std::isnan(value); }
template <class Derived>
bool no_nan(const Eigen::MatrixBase<Derived>& matrix) {
  return !matrix.hasNaN();
}
template <class T>
bool no_nan(const std::vector<T>& values) {
  for (const T& value : values)
    if (!no_nan(value)) return false;
  return true;
}
inline bool no_nan(const dmp::Trajectory& motion) {
  return motion.time.allFinite() && motion.position.allFinite() && motion.velocity.allFinite() &&
         motion.acceleration.allFinite();
}
inline bool no_nan(const dmp::OrientationTrajectory& motion) {
  return motion.time.allFinite() && no_nan(motion.rotation) && motion.angular_velocity.allFinite() &&
         motion.angular_acceleration.allFinite();
}
inline bool no_nan(const dmp::PoseTrajectory& motion) {
  return motion.time.allFinite() && no_nan(motion.pose) && motion.twist.allFinite() &&
         motion.acceleration.allFinite();
}

/// The call with `value` in the place of argument I.
template <std::size_t I, class Call, class... T, class Value>
auto call_with(const Call& call, const std::tuple<Argument<T>...>& arguments, const Value& value) {
  auto values =
      std::apply([](const auto&... argument) { return std::make_tuple(argument.good...); }, arguments);
  std::get<I>(values) = value;
  return std::apply(call, values);
}

template <std::size_t I, class Call, class... T>
void check_argument(const std::string& entry, const Call& call, const std::tuple<Argument<T>...>& arguments) {
  for (const auto& bad_value : bad(std::get<I>(arguments))) {
    CAPTURE(entry);
    CAPTURE(std::get<I>(arguments).name);
    CAPTURE(bad_value.name);
    try {
      const auto answer = call_with<I>(call, arguments, bad_value.value);
      CHECK_FALSE(bad_value.never);
      CHECK(no_nan(answer));
    } catch (const dmp::InvalidArgument& refused) {
      CHECK(std::string(refused.what()).size() > 10);
    }
  }
}

template <class Call, class Arguments, std::size_t... I>
void check_each(const std::string& entry, const Call& call, const Arguments& arguments,
                std::index_sequence<I...>) {
  (check_argument<I>(entry, call, arguments), ...);
}

/// The good call is answered; each bad value of each argument is refused or answered without NaN.
template <class Call, class... T>
void check(const std::string& entry, const Call& call, const Argument<T>&... arguments) {
  CAPTURE(entry);
  CHECK(no_nan(call(arguments.good...)));
  check_each(entry, call, std::make_tuple(arguments...), std::index_sequence_for<T...>{});
}

}  // namespace refusals
