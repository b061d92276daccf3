#include "model_file/json_fields.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace dmp::detail {

using Eigen::Index;

const Json& member(const Json& object, const std::string& key, const std::string& where) {
  if (!object.is_object()) throw InvalidArgument(where + ": expected an object.");
  const auto found = object.find(key);
  if (found == object.end()) throw InvalidArgument(where + ": the key '" + key + "' is missing.");
  return *found;
}

double number_at(const Json& json, const std::string& where) {
  if (!json.is_number()) throw InvalidArgument(where + ": expected a number.");
  return json.get<double>();
}

int integer_at(const Json& json, const std::string& where) {
  const double value = number_at(json, where);
  if (value != static_cast<double>(static_cast<int>(std::max(-1e9, std::min(1e9, value)))))
    throw InvalidArgument(where + ": " + number(value) + ", expected a whole number.");
  return static_cast<int>(value);
}

bool boolean_at(const Json& json, const std::string& where) {
  if (!json.is_boolean()) throw InvalidArgument(where + ": expected true or false.");
  return json.get<bool>();
}

std::string text_at(const Json& json, const std::string& where) {
  if (!json.is_string()) throw InvalidArgument(where + ": expected text.");
  return json.get<std::string>();
}

RowMatrix table_at(const Json& json, const std::string& where) {
  if (!json.is_array() || json.empty() || !json[0].is_array() || json[0].empty())
    throw InvalidArgument(where + ": expected rows of numbers.");
  RowMatrix table(static_cast<Index>(json.size()), static_cast<Index>(json[0].size()));
  for (Index r = 0; r < table.rows(); ++r) {
    const Json& row = json[static_cast<std::size_t>(r)];
    if (!row.is_array() || static_cast<Index>(row.size()) != table.cols())
      throw InvalidArgument(indexed(where, r) + ": expected " + std::to_string(table.cols()) + " numbers.");
    for (Index c = 0; c < table.cols(); ++c)
      table(r, c) = number_at(row[static_cast<std::size_t>(c)], indexed(where, r));
  }
  return table;
}

Eigen::VectorXd vector_at(const Json& json, const std::string& where) {
  if (!json.is_array()) throw InvalidArgument(where + ": expected a list of numbers.");
  Eigen::VectorXd vector(static_cast<Index>(json.size()));
  for (Index d = 0; d < vector.size(); ++d)
    vector[d] = number_at(json[static_cast<std::size_t>(d)], indexed(where, d));
  return vector;
}

Json to_list(const Eigen::VectorXd& vector) {
  return std::vector<double>(vector.data(), vector.data() + vector.size());
}

Json to_rows(const RowMatrix& table) {
  Json rows = Json::array();
  for (Index r = 0; r < table.rows(); ++r) rows.push_back(to_list(table.row(r)));
  return rows;
}

}  // namespace dmp::detail
