#include "model_file/model_json.hpp"

#include <dmp/error.hpp>

#include <optional>
#include <set>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "primitive/option_fields.hpp"
#include "primitive/parameters.hpp"

namespace dmp::detail {
namespace {

// What a file calls each kind of model.
template <class Primitive>
constexpr const char* kind_of = nullptr;
template <>
constexpr const char* kind_of<Dmp> = "dmp";
template <>
constexpr const char* kind_of<OrientationDmp> = "orientation_dmp";
template <>
constexpr const char* kind_of<PoseDmp> = "pose_dmp";
template <>
constexpr const char* kind_of<PoseGripperDmp> = "pose_gripper_dmp";

constexpr int kVersion = 2;  // 1: without fields that may be empty
constexpr std::size_t kMostNumbers = 1000000;
constexpr std::size_t kMostKeys = 100;     // of one object, whose keys are looked up one after the other
constexpr std::size_t kMostObjects = 100;  // after each the parser looks through all that its parent holds
constexpr int kDeepest = 8;

template <class Primitive>
Json to_json(const Primitive& model) {
  const auto& parameters = model.parameters();
  Json options = Json::object();
  visit_options(JsonWriter(options), parameters.options);
  Json json{
      {"format", "dmpcpp"}, {"version", 1}, {"kind", kind_of<Primitive>}, {"options", std::move(options)}};
  visit_fields(parameters, JsonWriter(json));
  visit_optional_fields(parameters, [&](const char* name, const RowMatrix& table) {
    if (table.rows() == 0) return;  // so that older versions can read it
    json["version"] = kVersion;
    json[name] = to_rows(table);
  });
  return json;
}

template <class Primitive>
Primitive read(const Json& json) {
  typename Primitive::Parameters parameters;
  visit_options(JsonReader(member(json, "options", "model"), "options", "options."), parameters.options);
  if (parameters.options.basis_count == 0)
    throw InvalidArgument("options.basis_count: 0, expected the number of kernels.");
  const JsonReader reader(json, "model", "");
  visit_fields(parameters, reader);
  visit_optional_fields(parameters, [&](const char* name, RowMatrix& table) {
    if (json.contains(name)) reader(name, table);
  });
  return Primitive(parameters);
}

/// The model of the alternative whose kind that is.
template <class... Kinds>
Model read_kind(const std::string& kind, const Json& json, std::variant<Kinds...>*) {
  std::optional<Model> model;
  std::string known;
  const auto attempt = [&](auto* alternative) {
    using Kind = std::remove_pointer_t<decltype(alternative)>;
    known += (known.empty() ? "" : ", ") + std::string(kind_of<Kind>);
    if (kind == kind_of<Kind>) model = read<Kind>(json);
  };
  (attempt(static_cast<Kinds*>(nullptr)), ...);
  if (!model) throw InvalidArgument("kind: '" + kind + "' is unknown, expected one of " + known + ".");
  return *model;
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
  const Eigen::Index advance =
      std::visit([](const auto& kind) { return kind.parameters().advance.size(); }, model);
  const auto numbers = static_cast<std::size_t>(weights.size() + advance + 4 * weights.cols() + 100);
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
  return read_kind(kind, json, static_cast<Model*>(nullptr));
}

}  // namespace dmp::detail
