#include "detail/model_json.hpp"

#include <dmp/error.hpp>

#include <array>
#include <set>
#include <utility>
#include <vector>

#include "detail/text.hpp"

namespace dmp::detail {
namespace {

using Eigen::Index;

constexpr int kVersion = 1;
constexpr std::size_t kMostNumbers = 1000000;
constexpr int kDeepest = 8;

// ---- the names that options have in a file
// ----------------------------------------------------------------------

template <class Enum>
using Names = std::vector<std::pair<Enum, const char*>>;

const Names<Kernels> kKernels{{Kernels::equal_in_time, "equal_in_time"}, {Kernels::source, "source"}};
const Names<Regression> kRegression{{Regression::lwr, "lwr"}, {Regression::ridge, "ridge"}};
const Names<Scaling> kScaling{{Scaling::none, "none"},
                              {Scaling::per_axis, "per_axis"},
                              {Scaling::per_axis_relative, "per_axis_relative"},
                              {Scaling::rotation_dilation, "rotation_dilation"}};
const Names<OrientationForm> kForm{{OrientationForm::automatic, "automatic"},
                                   {OrientationForm::ude, "ude"},
                                   {OrientationForm::log_linear, "log_linear"}};
const Names<LogBranch> kBranch{{LogBranch::lifted, "lifted"}, {LogBranch::principal, "principal"}};
const Names<Derivatives> kDerivatives{{Derivatives::interpolate, "interpolate"},
                                      {Derivatives::smooth, "smooth"},
                                      {Derivatives::gradient, "gradient"}};
const Names<Start> kStart{{Start::demonstrated, "demonstrated"}, {Start::rest, "rest"}};
const Names<Integrator> kIntegrator{{Integrator::exact, "exact"},
                                    {Integrator::semi_implicit_euler, "semi_implicit_euler"}};

template <class Enum>
std::string name_of(Enum value, const Names<Enum>& names) {
  for (const auto& [known, name] : names)
    if (known == value) return name;
  throw InvalidArgument("options: an enumerator outside its enumeration.");
}

// ---- reading
// ----------------------------------------------------------------------------------------------------

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

template <class Enum>
Enum enum_at(const Json& json, const std::string& where, const Names<Enum>& names) {
  const std::string text = text_at(json, where);
  std::string known;
  for (const auto& [value, name] : names) {
    if (text == name) return value;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  throw InvalidArgument(where + ": '" + text + "' is unknown, expected one of " + known + ".");
}

/// Rows of numbers, all of one length.
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

template <int Size>
Eigen::Matrix<double, Size, 1> fixed_vector_at(const Json& json, const std::string& where) {
  const Eigen::VectorXd vector = vector_at(json, where);
  if (vector.size() != Size)
    throw InvalidArgument(where + ": expected " + std::to_string(Size) + " numbers.");
  return vector;
}

template <int Size>
Eigen::Matrix<double, Size, Size> square_at(const Json& json, const std::string& where) {
  const RowMatrix table = table_at(json, where);
  const std::string size = std::to_string(Size);
  if (table.rows() != Size || table.cols() != Size)
    throw InvalidArgument(where + ": expected a " + size + " x " + size + " matrix.");
  return table;
}

// ---- writing
// ----------------------------------------------------------------------------------------------------

Json to_list(const Eigen::VectorXd& vector) {
  return std::vector<double>(vector.data(), vector.data() + vector.size());
}

Json to_rows(const RowMatrix& table) {
  Json rows = Json::array();
  for (Index r = 0; r < table.rows(); ++r) rows.push_back(to_list(table.row(r)));
  return rows;
}

// ---- options
// ----------------------------------------------------------------------------------------------------

Json to_json(const DmpOptions& o) {
  return {{"basis_count", o.basis_count},
          {"alpha", o.alpha},
          {"beta", *o.beta},
          {"orientation_alpha", *o.orientation_alpha},
          {"orientation_beta", *o.orientation_beta},
          {"alpha_x", o.alpha_x},
          {"kernels", name_of(o.kernels, kKernels)},
          {"overlap", *o.overlap},
          {"regression", name_of(o.regression, kRegression)},
          {"passes", o.passes},
          {"ridge", o.ridge},
          {"scaling", name_of(o.scaling, kScaling)},
          {"orientation_form", name_of(o.orientation_form, kForm)},
          {"log_branch", name_of(o.log_branch, kBranch)},
          {"derivatives", name_of(o.derivatives, kDerivatives)},
          {"start", name_of(o.start, kStart)},
          {"integrator", name_of(o.integrator, kIntegrator)},
          {"force_after_end", o.force_after_end},
          {"goal_filter", o.goal_filter},
          {"tempo_filter", o.tempo_filter},
          {"phase_stop", o.phase_stop}};
}

DmpOptions options_at(const Json& model) {
  const Json& json = member(model, "options", "model");
  const std::string where = "options";
  const auto at = [&](const char* key) -> const Json& { return member(json, key, where); };
  const auto place = [&](const char* key) { return where + "." + key; };
  const auto value = [&](const char* key) { return number_at(at(key), place(key)); };
  DmpOptions o;
  o.basis_count = integer_at(at("basis_count"), place("basis_count"));
  o.alpha = value("alpha");
  o.beta = value("beta");
  o.orientation_alpha = value("orientation_alpha");
  o.orientation_beta = value("orientation_beta");
  o.alpha_x = value("alpha_x");
  o.kernels = enum_at(at("kernels"), place("kernels"), kKernels);
  o.overlap = value("overlap");
  o.regression = enum_at(at("regression"), place("regression"), kRegression);
  o.passes = integer_at(at("passes"), place("passes"));
  o.ridge = value("ridge");
  o.scaling = enum_at(at("scaling"), place("scaling"), kScaling);
  o.orientation_form = enum_at(at("orientation_form"), place("orientation_form"), kForm);
  o.log_branch = enum_at(at("log_branch"), place("log_branch"), kBranch);
  o.derivatives = enum_at(at("derivatives"), place("derivatives"), kDerivatives);
  o.start = enum_at(at("start"), place("start"), kStart);
  o.integrator = enum_at(at("integrator"), place("integrator"), kIntegrator);
  o.force_after_end = boolean_at(at("force_after_end"), place("force_after_end"));
  o.goal_filter = value("goal_filter");
  o.tempo_filter = value("tempo_filter");
  o.phase_stop = value("phase_stop");
  return o;
}

// ---- the three kinds
// --------------------------------------------------------------------------------------------

Json header(const char* kind, const DmpOptions& options, double duration) {
  return {{"format", "dmpcpp"},
          {"version", kVersion},
          {"kind", kind},
          {"options", to_json(options)},
          {"duration", duration}};
}

Json to_json(const Dmp& dmp) {
  const DmpParameters& p = dmp.parameters();
  Json json = header("dmp", p.options, p.duration);
  json["start"] = to_list(p.start);
  json["goal"] = to_list(p.goal);
  json["start_velocity"] = to_list(p.start_velocity);
  json["amplitude"] = to_list(p.amplitude);
  json["weights"] = to_rows(p.weights);
  return json;
}

Json to_json(const OrientationDmp& dmp) {
  const OrientationDmpParameters& p = dmp.parameters();
  Json json = header("orientation_dmp", p.options, p.duration);
  json["start"] = to_rows(p.start);
  json["goal"] = to_rows(p.goal);
  json["start_velocity"] = to_list(p.start_velocity);
  json["start_error"] = to_list(p.start_error);
  json["amplitude"] = to_list(p.amplitude);
  json["weights"] = to_rows(p.weights);
  return json;
}

Json to_json(const PoseDmp& dmp) {
  const PoseDmpParameters& p = dmp.parameters();
  Json json = header("pose_dmp", p.options, p.duration);
  json["start"] = to_rows(p.start);
  json["goal"] = to_rows(p.goal);
  json["start_twist"] = to_list(p.start_twist);
  json["start_error"] = to_list(p.start_error);
  json["amplitude"] = to_list(p.amplitude);
  json["weights"] = to_rows(p.weights);
  return json;
}

Dmp dmp_at(const Json& json) {
  const auto at = [&](const char* key) -> const Json& { return member(json, key, "model"); };
  DmpParameters p;
  p.options = options_at(json);
  p.duration = number_at(at("duration"), "duration");
  p.start = vector_at(at("start"), "start");
  p.goal = vector_at(at("goal"), "goal");
  p.start_velocity = vector_at(at("start_velocity"), "start_velocity");
  p.amplitude = vector_at(at("amplitude"), "amplitude");
  p.weights = table_at(at("weights"), "weights");
  return Dmp(p);
}

OrientationDmp orientation_dmp_at(const Json& json) {
  const auto at = [&](const char* key) -> const Json& { return member(json, key, "model"); };
  OrientationDmpParameters p;
  p.options = options_at(json);
  p.duration = number_at(at("duration"), "duration");
  p.start = square_at<3>(at("start"), "start");
  p.goal = square_at<3>(at("goal"), "goal");
  p.start_velocity = fixed_vector_at<3>(at("start_velocity"), "start_velocity");
  p.start_error = fixed_vector_at<3>(at("start_error"), "start_error");
  p.amplitude = fixed_vector_at<3>(at("amplitude"), "amplitude");
  p.weights = table_at(at("weights"), "weights");
  return OrientationDmp(p);
}

PoseDmp pose_dmp_at(const Json& json) {
  const auto at = [&](const char* key) -> const Json& { return member(json, key, "model"); };
  PoseDmpParameters p;
  p.options = options_at(json);
  p.duration = number_at(at("duration"), "duration");
  p.start = square_at<4>(at("start"), "start");
  p.goal = square_at<4>(at("goal"), "goal");
  p.start_twist = fixed_vector_at<6>(at("start_twist"), "start_twist");
  p.start_error = fixed_vector_at<3>(at("start_error"), "start_error");
  p.amplitude = fixed_vector_at<6>(at("amplitude"), "amplitude");
  p.weights = table_at(at("weights"), "weights");
  return PoseDmp(p);
}

/// Refuses what a plain parse would take: repeated keys, deep nesting, too many values.
class Guard {
 public:
  bool operator()(int depth, Json::parse_event_t event, Json& parsed) {
    using Event = Json::parse_event_t;
    if (depth > kDeepest)
      throw InvalidArgument("model: nested deeper than " + std::to_string(kDeepest) + " levels.");
    if (event == Event::value && ++values_ > kMostNumbers)
      throw InvalidArgument("model: more than 10^6 values.");
    if (event == Event::object_start) keys_.emplace_back();
    if (event == Event::object_end) keys_.pop_back();
    if (event == Event::key && !keys_.back().insert(parsed.get<std::string>()).second)
      throw InvalidArgument("model: the key '" + parsed.get<std::string>() + "' stands twice.");
    return true;
  }

 private:
  std::size_t values_ = 0;
  std::vector<std::set<std::string>> keys_;
};

}  // namespace

Json parse_json(const std::string& text) {
  try {
    Guard guard;
    return Json::parse(text, std::ref(guard));
  } catch (const nlohmann::json::exception& error) {
    throw InvalidArgument(std::string("model: not readable as JSON: ") + error.what());
  }
}

Json model_to_json(const Model& model) {
  return std::visit([](const auto& kind) { return to_json(kind); }, model);
}

Model model_from_json(const Json& json) {
  if (text_at(member(json, "format", "model"), "format") != "dmpcpp")
    throw InvalidArgument("format: expected \"dmpcpp\".");
  const int version = integer_at(member(json, "version", "model"), "version");
  if (version != kVersion)
    throw InvalidArgument("version: " + std::to_string(version) + ", expected " + std::to_string(kVersion) +
                          (version > kVersion ? ". The file was written by a newer dmpcpp: update." : "."));
  const std::string kind = text_at(member(json, "kind", "model"), "kind");
  if (kind == "dmp") return dmp_at(json);
  if (kind == "orientation_dmp") return orientation_dmp_at(json);
  if (kind == "pose_dmp") return pose_dmp_at(json);
  throw InvalidArgument("kind: '" + kind + "' is unknown, expected dmp, orientation_dmp or pose_dmp.");
}

}  // namespace dmp::detail
