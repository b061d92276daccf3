#include "model_file/model_json.hpp"

#include <dmp/error.hpp>

#include <set>
#include <type_traits>
#include <utility>
#include <vector>

namespace dmp::detail {
namespace {

constexpr int kVersion = 2;  // 1: without a reference to turn along
constexpr std::size_t kMostNumbers = 1000000;
constexpr std::size_t kMostKeys = 100;     // of one object, whose keys are looked up one after the other
constexpr std::size_t kMostObjects = 100;  // after each the parser looks through all that its parent holds
constexpr int kDeepest = 8;

const Names<Kernels> kKernels{{Kernels::equal_in_time, "equal_in_time"}, {Kernels::source, "source"}};
const Names<Regression> kRegression{
    {Regression::lwr, "lwr"}, {Regression::ridge, "ridge"}, {Regression::automatic, "automatic"}};
const Names<Scaling> kScaling{{Scaling::none, "none"},
                              {Scaling::per_axis, "per_axis"},
                              {Scaling::per_axis_relative, "per_axis_relative"},
                              {Scaling::rotation_dilation, "rotation_dilation"}};
const Names<OrientationForm> kForm{{OrientationForm::automatic, "automatic"},
                                   {OrientationForm::ude, "ude"},
                                   {OrientationForm::log_linear, "log_linear"},
                                   {OrientationForm::turning, "turning"}};
const Names<LogBranch> kBranch{{LogBranch::lifted, "lifted"}, {LogBranch::principal, "principal"}};
const Names<Derivatives> kDerivatives{{Derivatives::interpolate, "interpolate"},
                                      {Derivatives::smooth, "smooth"},
                                      {Derivatives::gradient, "gradient"},
                                      {Derivatives::automatic, "automatic"}};
const Names<Start> kStart{{Start::demonstrated, "demonstrated"}, {Start::rest, "rest"}};
const Names<Integrator> kIntegrator{{Integrator::exact, "exact"},
                                    {Integrator::semi_implicit_euler, "semi_implicit_euler"}};

// What a model file holds, each field once: a reader fills it, a writer writes it.

template <class Visitor, class Options>
void visit_options(const Visitor& visit, Options& o) {
  visit("basis_count", o.basis_count);
  visit("alpha", o.alpha);
  visit("beta", o.beta);
  visit("orientation_alpha", o.orientation_alpha);
  visit("orientation_beta", o.orientation_beta);
  visit("alpha_x", o.alpha_x);
  visit("kernels", o.kernels, kKernels);
  visit("overlap", o.overlap);
  visit("regression", o.regression, kRegression);
  visit("passes", o.passes);
  visit("ridge", o.ridge);
  visit("scaling", o.scaling, kScaling);
  visit("orientation_form", o.orientation_form, kForm);
  visit("log_branch", o.log_branch, kBranch);
  visit("derivatives", o.derivatives, kDerivatives);
  visit("start", o.start, kStart);
  visit("integrator", o.integrator, kIntegrator);
  visit("force_after_end", o.force_after_end);
  visit("goal_filter", o.goal_filter);
  visit("tempo_filter", o.tempo_filter);
  visit("phase_stop", o.phase_stop);
}

/// What the velocity and the error at the start are called depends on the kind.
template <class Visitor, class Parameters>
void visit_start(const Visitor& visit, Parameters& p) {
  using Kind = std::remove_const_t<Parameters>;
  if constexpr (std::is_same_v<Kind, PoseDmpParameters>) {
    visit("start_twist", p.start_twist);
  } else {
    visit("start_velocity", p.start_velocity);
  }
  if constexpr (!std::is_same_v<Kind, DmpParameters>) visit("start_error", p.start_error);
}

template <class Visitor, class Parameters>
void visit_parameters(const Visitor& visit, Parameters& p) {
  visit("duration", p.duration);
  visit("start", p.start);
  visit("goal", p.goal);
  visit_start(visit, p);
  visit("amplitude", p.amplitude);
  visit("weights", p.weights);
}

template <class Parameters>
Json write(const char* kind, const Parameters& parameters) {
  Json options = Json::object();
  visit_options(JsonWriter(options), parameters.options);
  Json json{{"format", "dmpcpp"}, {"version", 1}, {"kind", kind}, {"options", std::move(options)}};
  visit_parameters(JsonWriter(json), parameters);
  if constexpr (!std::is_same_v<Parameters, DmpParameters>)
    if (parameters.reference.rows() > 0) {  // otherwise older versions can read it
      json["version"] = kVersion;
      json["reference"] = to_rows(parameters.reference);
    }
  return json;
}

Json to_json(const Dmp& dmp) { return write("dmp", dmp.parameters()); }
Json to_json(const OrientationDmp& dmp) { return write("orientation_dmp", dmp.parameters()); }
Json to_json(const PoseDmp& dmp) { return write("pose_dmp", dmp.parameters()); }

template <class Parameters>
Parameters read(const Json& json) {
  Parameters parameters;
  visit_options(JsonReader(member(json, "options", "model"), "options", "options."), parameters.options);
  if (parameters.options.basis_count == 0)
    throw InvalidArgument("options.basis_count: 0, expected the number of kernels.");
  visit_parameters(JsonReader(json, "model", ""), parameters);
  if constexpr (!std::is_same_v<Parameters, DmpParameters>)
    if (json.contains("reference")) parameters.reference = table_at(json["reference"], "reference");
  return parameters;
}

/// Refuses what a plain parse would take: repeated keys, deep nesting, too many values, lists or objects, and
/// objects of too many keys.
class Guard {
 public:
  bool operator()(int depth, Json::parse_event_t event, Json& parsed) {
    using Event = Json::parse_event_t;
    if (depth > kDeepest)
      throw InvalidArgument("model: nested deeper than " + std::to_string(kDeepest) + " levels.");
    if (event == Event::value) count(values_, kMostNumbers, "values");
    if (event == Event::array_start) count(lists_, kMostNumbers, "lists");
    if (event == Event::object_start) {
      count(objects_, kMostObjects, "objects");
      keys_.emplace_back();
    }
    if (event == Event::object_end) keys_.pop_back();
    if (event == Event::key) take_key(parsed.get<std::string>());
    return true;
  }

 private:
  static void count(std::size_t& so_far, std::size_t most, const char* what) {
    if (++so_far > most) throw InvalidArgument("model: more than " + std::to_string(most) + " " + what + ".");
  }

  void take_key(const std::string& key) {
    if (!keys_.back().insert(key).second) throw InvalidArgument("model: the key '" + key + "' stands twice.");
    if (keys_.back().size() > kMostKeys)
      throw InvalidArgument("model: an object of more than " + std::to_string(kMostKeys) + " keys.");
  }

  std::size_t values_ = 0;
  std::size_t lists_ = 0;
  std::size_t objects_ = 0;
  std::vector<std::set<std::string>> keys_;
};

}  // namespace

Json parse_json(const std::string& text) {
  try {
    Guard guard;
    return Json::parse(text, std::ref(guard));
  } catch (const nlohmann::json::parse_error& error) {  // whose text would quote what may be no text at all
    throw InvalidArgument("model: not readable as JSON from byte " + std::to_string(error.byte) +
                          " on, expected what dmp::save (dmpcpp.save, `dmpcpp fit`) writes.");
  } catch (const nlohmann::json::exception& error) {
    throw InvalidArgument(std::string("model: not readable as JSON: ") + error.what());
  }
}

Json model_to_json(const Model& model) {
  return std::visit([](const auto& kind) { return to_json(kind); }, model);
}

void require_readable(const Model& model) {
  const RowMatrix& weights =
      std::visit([](const auto& kind) -> const RowMatrix& { return kind.parameters().weights; }, model);
  const auto numbers = static_cast<std::size_t>(weights.size() + 4 * weights.cols() + 100);
  if (numbers > kMostNumbers)
    throw InvalidArgument("weights: " + std::to_string(weights.rows()) + " x " +
                          std::to_string(weights.cols()) +
                          ", more than a model file may hold (10^6 numbers in all). Use fewer kernels.");
}

Model model_from_json(const Json& json) {
  if (text_at(member(json, "format", "model"), "format") != "dmpcpp")
    throw InvalidArgument("format: expected \"dmpcpp\".");
  const int version = integer_at(member(json, "version", "model"), "version");
  if (version < 1 || version > kVersion)
    throw InvalidArgument("version: " + std::to_string(version) + ", expected 1 to " +
                          std::to_string(kVersion) +
                          (version > kVersion ? ". The file was written by a newer dmpcpp: update." : "."));
  const std::string kind = text_at(member(json, "kind", "model"), "kind");
  if (kind == "dmp") return Dmp(read<DmpParameters>(json));
  if (kind == "orientation_dmp") return OrientationDmp(read<OrientationDmpParameters>(json));
  if (kind == "pose_dmp") return PoseDmp(read<PoseDmpParameters>(json));
  throw InvalidArgument("kind: '" + kind + "' is unknown, expected dmp, orientation_dmp or pose_dmp.");
}

}  // namespace dmp::detail
