#include "model_file/model_json.hpp"

#include <dmp/error.hpp>

#include <optional>
#include <set>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "base/text.hpp"
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

template <>
constexpr const char* kind_of<DmpSequence> = "dmp_sequence";
template <>
constexpr const char* kind_of<OrientationDmpSequence> = "orientation_dmp_sequence";
template <>
constexpr const char* kind_of<PoseDmpSequence> = "pose_dmp_sequence";
template <>
constexpr const char* kind_of<PoseGripperDmpSequence> = "pose_gripper_dmp_sequence";

template <>
constexpr const char* kind_of<DmpDistribution> = "dmp_distribution";
template <>
constexpr const char* kind_of<OrientationDistribution> = "orientation_distribution";
template <>
constexpr const char* kind_of<PoseDistribution> = "pose_distribution";
template <>
constexpr const char* kind_of<PoseGripperDistribution> = "pose_gripper_distribution";

// A model has the oldest version that can hold it, so that older libraries read it.
constexpr int kFieldsThatMayBeEmpty = 2;
constexpr int kSequences = 3;  // and rhythmic motions
constexpr int kDistributions = 4;
constexpr int kNewest = kDistributions;
constexpr const char* kGuard = "scaling_guard";
constexpr std::size_t kMostNumbers = 1000000;
constexpr std::size_t kMostKeys = 100;     // of one object, whose keys are looked up one after the other
constexpr std::size_t kMostObjects = 100;  // after each the parser looks through all that its parent holds
constexpr int kDeepest = 8;

template <class Space>
Json to_json(const Primitive<Space>& model) {
  const auto& parameters = model.parameters();
  Json options = Json::object();
  const JsonWriter write(options);
  visit_options(write, parameters.options);
  if (!parameters.options.scaling_guard) options.erase(kGuard);  // so that older versions can read it
  const Motion motion = parameters.options.motion;
  if (motion == Motion::rhythmic) write("motion", motion, names_of(motion));
  Json json{{"format", "dmpcpp"},
            {"version", 1},
            {"kind", kind_of<Primitive<Space>>},
            {"options", std::move(options)}};
  visit_fields(parameters, JsonWriter(json));
  visit_optional_fields(parameters, [&](const char* name, const RowMatrix& table) {
    if (table.rows() == 0) return;
    json["version"] = kFieldsThatMayBeEmpty;
    json[name] = to_rows(table);
  });
  if (motion == Motion::rhythmic) json["version"] = kSequences;
  return json;
}

/// Every field of a distribution but the number of its demonstrations, by its name in a file.
template <class Parameters, class Visit>
void visit_distribution(Parameters& parameters, const Visit& visit) {
  visit("control_points", parameters.options.control_points);
  visit("prior", parameters.options.prior);
  visit("iterations", parameters.options.iterations);
  visit("duration", parameters.duration);
  visit("reference", parameters.reference);
  visit("mean", parameters.mean);
  visit("factor", parameters.factor);
  visit("noise", parameters.noise);
}

template <class Space>
Json to_json(const Via<Space>& via) {
  Json json = Json::object();
  const JsonWriter write(json);
  write("phase", via.phase);
  write("point", via.point);
  if (via.velocity) write("velocity", *via.velocity);
  write("reach", Eigen::VectorXd(Eigen::Vector2d(via.reach.rise, via.reach.fall)));
  return json;
}

template <class Space>
Json to_json(const Sequence<Space>& sequence) {
  Json parts = Json::array();
  for (const SequencePart<Space>& part : sequence.parts()) {
    Json one{{"model", to_json(part.model)}, {"leave", part.leave}, {"reach", part.reach}};
    if (!part.vias.empty()) one["vias"] = Json::array();
    for (const Via<Space>& via : part.vias) one["vias"].push_back(to_json(via));
    parts.push_back(std::move(one));
  }
  return {{"format", "dmpcpp"},
          {"version", kSequences},
          {"kind", kind_of<Sequence<Space>>},
          {"parts", std::move(parts)}};
}

template <class Space>
Json to_json(const Distribution<Space>& distribution) {
  const auto& parameters = distribution.parameters();
  Json json{{"format", "dmpcpp"}, {"version", kDistributions}, {"kind", kind_of<Distribution<Space>>}};
  visit_distribution(parameters, JsonWriter(json));
  json["demonstrations"] = parameters.demonstrations;
  return json;
}

/// Format, version and kind of a model.
std::string kind_in(const Json& json) {
  if (text_at(member(json, "format", "model"), "format") != "dmpcpp")
    throw InvalidArgument("format: expected \"dmpcpp\".");
  const int version = integer_at(member(json, "version", "model"), "version");
  if (version < 1 || version > kNewest)
    throw InvalidArgument("version: " + std::to_string(version) + ", expected 1 to " +
                          std::to_string(kNewest) +
                          (version > kNewest ? ". The file was written by a newer dmpcpp: update." : "."));
  return text_at(member(json, "kind", "model"), "kind");
}

/// `read()`, what it refuses named as a part of `where`.
template <class Read>
auto within(const std::string& where, const Read& read) {
  try {
    return read();
  } catch (const InvalidArgument& error) {
    throw InvalidArgument(where + "." + error.what());
  }
}

template <class Space>
Primitive<Space> read(const Json& json, Primitive<Space>*) {
  typename Space::Parameters parameters;
  Json known = member(json, "options", "model");
  if (known.is_object() && !known.contains(kGuard)) known[kGuard] = false;
  visit_options(JsonReader(known, "options", "options."), parameters.options);
  Motion& motion = parameters.options.motion;
  if (const Json& options = json["options"]; options.contains("motion"))
    JsonReader(options, "options", "options.")("motion", motion, names_of(motion));
  if (parameters.options.basis_count == 0)
    throw InvalidArgument("options.basis_count: 0, expected the number of kernels.");
  const JsonReader reader(json, "model", "");
  visit_fields(parameters, reader);
  visit_optional_fields(parameters, [&](const char* name, RowMatrix& table) {
    if (json.contains(name)) reader(name, table);
  });
  return Primitive<Space>(parameters);
}

const Json& list_in(const Json& json, const char* key, const char* where) {
  const Json& list = member(json, key, where);
  if (!list.is_array()) throw InvalidArgument(std::string(key) + ": expected a list.");
  return list;
}

template <class Space>
Via<Space> read_via(const Json& json) {
  typename Space::Point point;
  double phase = 0.0;
  Eigen::VectorXd reach;
  const JsonReader reader(json, "via", "");
  reader("phase", phase);
  reader("point", point);
  reader("reach", reach);
  if (reach.size() != 2) throw InvalidArgument("reach: expected 2 numbers.");
  Via<Space> via(phase, point, {}, Reach(reach[0], reach[1]));
  if (json.contains("velocity")) reader("velocity", via.velocity.emplace());
  return via;
}

template <class Space>
SequencePart<Space> read_part(const Json& json) {
  const Json& model = member(json, "model", "part");
  if (const std::string kind = kind_in(model); kind != kind_of<Primitive<Space>>)
    throw InvalidArgument("model.kind: '" + kind + "', expected " + kind_of<Primitive<Space>> + ".");
  SequencePart<Space> part(
      within("model", [&] { return read(model, static_cast<Primitive<Space>*>(nullptr)); }));
  const JsonReader reader(json, "part", "");
  reader("leave", part.leave);
  reader("reach", part.reach);
  if (!json.contains("vias")) return part;
  for (const Json& via : list_in(json, "vias", "part"))
    part.vias.push_back(
        within(indexed("vias", static_cast<long>(part.vias.size())), [&] { return read_via<Space>(via); }));
  return part;
}

template <class Space>
Sequence<Space> read(const Json& json, Sequence<Space>*) {
  std::vector<SequencePart<Space>> parts;
  for (const Json& part : list_in(json, "parts", "model"))
    parts.push_back(
        within(indexed("parts", static_cast<long>(parts.size())), [&] { return read_part<Space>(part); }));
  return Sequence<Space>(parts);
}

template <class Space>
Distribution<Space> read(const Json& json, Distribution<Space>*) {
  DistributionParameters<Space> parameters;
  visit_distribution(parameters, JsonReader(json, "model", ""));
  parameters.demonstrations = integer_at(member(json, "demonstrations", "model"), "demonstrations");
  return Distribution<Space>(parameters);
}

/// The model of the alternative whose kind that is.
template <class... Kinds>
Model read_kind(const std::string& kind, const Json& json, std::variant<Kinds...>*) {
  std::optional<Model> model;
  std::string known;
  const auto attempt = [&](auto* alternative) {
    using Kind = std::remove_pointer_t<decltype(alternative)>;
    known += (known.empty() ? "" : ", ") + std::string(kind_of<Kind>);
    if (kind == kind_of<Kind>) model = read(json, alternative);
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

namespace {

template <class Space>
std::size_t numbers_in(const Primitive<Space>& model) {
  const RowMatrix& weights = model.parameters().weights;
  const auto numbers =
      static_cast<std::size_t>(weights.size() + model.parameters().advance.size() + 4 * weights.cols() + 100);
  if (numbers > kMostNumbers)
    throw InvalidArgument("weights: " + std::to_string(weights.rows()) + " x " +
                          std::to_string(weights.cols()) +
                          ", more than a model file may hold (10^6 numbers in all). Use fewer kernels.");
  return numbers;
}

// The objects that a point is in a file: one of a product, which has a member for each part.
template <class Point>
constexpr std::size_t objects_of = 0;
template <class First, class Second>
constexpr std::size_t objects_of<std::pair<First, Second>> = 1 + objects_of<First> + objects_of<Second>;

template <class Space>
std::size_t numbers_in(const Sequence<Space>& sequence) {
  std::size_t numbers = 0;
  std::size_t objects = 1;
  for (const SequencePart<Space>& part : sequence.parts()) {
    numbers += numbers_in(part.model) + 100 * part.vias.size();
    constexpr std::size_t kPoint = objects_of<typename Space::Point>;
    objects += 3 + 2 * kPoint + (1 + kPoint) * part.vias.size();
  }
  if (numbers > kMostNumbers || objects > kMostObjects)
    throw InvalidArgument(
        "parts: more than a model file may hold (10^6 numbers; 100 objects, of which a "
        "motion takes 3 and a via-point 1). Take fewer motions, kernels or via-points.");
  return numbers;
}

template <class Space>
std::size_t numbers_in(const Distribution<Space>& distribution) {
  const auto& parameters = distribution.parameters();
  const auto numbers = static_cast<std::size_t>(parameters.factor.size() + parameters.mean.size() +
                                                parameters.reference.size() + 100);
  if (numbers > kMostNumbers)
    throw InvalidArgument("control_points: " + std::to_string(parameters.options.control_points) +
                          ", more weights than a model file may hold (10^6 numbers in all). Use fewer.");
  return numbers;
}

}  // namespace

void require_readable(const Model& model) {
  std::visit([](const auto& kind) { numbers_in(kind); }, model);
}

Model model_from_json(const Json& json) {
  return read_kind(kind_in(json), json, static_cast<Model*>(nullptr));
}

}  // namespace dmp::detail
