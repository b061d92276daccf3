#pragma once

#include <dmp/error.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "primitive/option_fields.hpp"

namespace dmp::detail {

using Json = nlohmann::ordered_json;

/// The member `key`; throws InvalidArgument, naming `where`, unless there is one.
const Json& member(const Json& object, const std::string& key, const std::string& where);
// A value of JSON; each throws InvalidArgument, naming `where`, for what is something else.
double number_at(const Json& json, const std::string& where);
int integer_at(const Json& json, const std::string& where);
bool boolean_at(const Json& json, const std::string& where);
std::string text_at(const Json& json, const std::string& where);
Eigen::VectorXd vector_at(const Json& json, const std::string& where);
/// Rows of numbers, all of one length.
RowMatrix table_at(const Json& json, const std::string& where);

Json to_list(const Eigen::VectorXd& vector);
Json to_rows(const RowMatrix& table);

/// Fills fields from the members of an object, one call a field; a column of numbers is a list, a matrix a
/// list of rows.
class JsonReader {
 public:
  /// `object`, named `name` where a key is missing; a value is named `prefix` + key.
  JsonReader(const Json& object, std::string name, std::string prefix)
      : object_(object), name_(std::move(name)), prefix_(std::move(prefix)) {}

  void operator()(const char* key, double& value) const { value = number_at(at(key), prefix_ + key); }
  void operator()(const char* key, std::optional<double>& value) const {
    value = number_at(at(key), prefix_ + key);
  }
  void operator()(const char* key, int& value) const { value = integer_at(at(key), prefix_ + key); }
  void operator()(const char* key, bool& value) const { value = boolean_at(at(key), prefix_ + key); }

  template <class Enum>
  void operator()(const char* key, Enum& value, const Names<Enum>& names) const {
    const std::string text = text_at(at(key), prefix_ + key);
    std::string all;
    for (const auto& [known, name] : names) {
      if (text == name) {
        value = known;
        return;
      }
      all += (all.empty() ? "" : ", ") + std::string(name);
    }
    throw InvalidArgument(prefix_ + key + ": '" + text + "' is unknown, expected one of " + all + ".");
  }

  template <class Matrix>
  void operator()(const char* key, Eigen::PlainObjectBase<Matrix>& value) const {
    constexpr int kRows = Matrix::RowsAtCompileTime;
    if constexpr (Matrix::ColsAtCompileTime == 1) {
      const Eigen::VectorXd vector = vector_at(at(key), prefix_ + key);
      if (kRows != Eigen::Dynamic && vector.size() != kRows)
        throw InvalidArgument(prefix_ + key + ": expected " + std::to_string(kRows) + " numbers.");
      value = vector;
    } else {
      const RowMatrix table = table_at(at(key), prefix_ + key);
      const std::string size = std::to_string(kRows);
      if (kRows != Eigen::Dynamic && (table.rows() != kRows || table.cols() != kRows))
        throw InvalidArgument(prefix_ + key + ": expected a " + size + " x " + size + " matrix.");
      value = table;
    }
  }

  /// A point of a product: one member for each of its parts.
  template <class First, class Second>
  void operator()(const char* key, std::pair<First, Second>& value) const {
    const std::string where = prefix_ + key;
    const JsonReader parts(at(key), where, where + ".");
    parts("first", value.first);
    parts("second", value.second);
  }

 private:
  const Json& at(const char* key) const { return member(object_, key, name_); }

  const Json& object_;
  std::string name_;
  std::string prefix_;
};

/// The same fields as members of an object.
class JsonWriter {
 public:
  explicit JsonWriter(Json& object) : object_(object) {}

  template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
  void operator()(const char* key, Number value) const {
    object_[key] = value;
  }
  void operator()(const char* key, const std::optional<double>& value) const { object_[key] = *value; }

  template <class Enum>
  void operator()(const char* key, Enum value, const Names<Enum>& names) const {
    for (const auto& [known, name] : names) {
      if (known != value) continue;
      object_[key] = name;
      return;
    }
    throw InvalidArgument("options: an enumerator outside its enumeration.");
  }

  template <class Matrix>
  void operator()(const char* key, const Eigen::PlainObjectBase<Matrix>& value) const {
    if constexpr (Matrix::ColsAtCompileTime == 1) {
      object_[key] = to_list(value);
    } else {
      object_[key] = to_rows(value);
    }
  }

  template <class First, class Second>
  void operator()(const char* key, const std::pair<First, Second>& value) const {
    Json parts = Json::object();
    const JsonWriter write(parts);
    write("first", value.first);
    write("second", value.second);
    object_[key] = std::move(parts);
  }

 private:
  Json& object_;
};

}  // namespace dmp::detail
