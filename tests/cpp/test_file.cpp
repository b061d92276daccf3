#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/file.hpp>

#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "motions.hpp"

using namespace dmp;
using namespace motions;

namespace {
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("dmp-test-" + std::to_string(::getpid()));
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
};
}  // namespace

TEST_CASE("every kind of model comes back bit for bit") {
  DmpOptions options;
  options.regression = Regression::ridge;
  options.scaling = Scaling::rotation_dilation;
  options.orientation_form = OrientationForm::log_linear;
  const Dmp dmp = Dmp::fit(reach(100, 1.0 / 3), options);
  const OrientationDmp orientation = OrientationDmp::fit(rotation(100, 1.0, 3.0), options);
  const PoseDmp both = PoseDmp::fit(pose(100, 1.0), options);
  CHECK(std::get<Dmp>(from_json(to_json(dmp))).parameters().weights == dmp.parameters().weights);
  CHECK(std::get<Dmp>(from_json(to_json(dmp))).duration() == dmp.duration());
  CHECK(std::get<Dmp>(from_json(to_json(dmp))).options().scaling == Scaling::rotation_dilation);
  CHECK(to_json(from_json(to_json(orientation))) == to_json(orientation));
  CHECK(to_json(from_json(to_json(both))) == to_json(both));
  const PoseDmp back = std::get<PoseDmp>(from_json(to_json(both)));
  CHECK(back.rollout({}, {}, .01).pose == both.rollout({}, {}, .01).pose);
}

TEST_CASE("a file is written whole or not at all") {
  const Folder folder;
  const std::string path = folder.path / "reach.json";
  const Dmp dmp = Dmp::fit(reach(100, 1.0));
  save(dmp, path);
  CHECK(load_dmp(path).parameters().weights == dmp.parameters().weights);
  CHECK_THROWS_WITH_AS(load_pose_dmp(path), doctest::Contains("expected a PoseDmp"), InvalidArgument);
  CHECK_THROWS_AS(save(dmp, folder.path / "no" / "such.json"), FileError);
  CHECK_THROWS_AS(load(folder.path / "missing.json"), FileError);
  CHECK_THROWS_AS(load(folder.path), FileError);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path)) files += entry.exists() ? 1 : 0;
  CHECK(files == 1);
}

TEST_CASE("a file of one kind is not taken for another, nor a large one for a model") {
  const Folder folder;
  const std::string turn = folder.path / "turn.json";
  const std::string both = folder.path / "pose.json";
  const OrientationDmp orientation = OrientationDmp::fit(rotation(100, 1.0, 3.0));
  save(orientation, turn);
  save(PoseDmp::fit(pose(100, 1.0)), both);
  CHECK(to_json(load_orientation_dmp(turn)) == to_json(orientation));
  CHECK(load_pose_dmp(both).duration() == 1.0);
  CHECK_THROWS_WITH_AS(load_dmp(turn), doctest::Contains("expected a Dmp"), InvalidArgument);
  CHECK_THROWS_WITH_AS(load_orientation_dmp(both), doctest::Contains("expected an OrientationDmp"),
                       InvalidArgument);
  std::filesystem::resize_file(both, (64u << 20) + 1);
  CHECK_THROWS_WITH_AS(load(both), doctest::Contains("larger than 64 MiB"), InvalidArgument);
  CHECK_THROWS_WITH_AS(from_json(std::string((64u << 20) + 1, ' ')), doctest::Contains("64 MiB"),
                       InvalidArgument);
}

TEST_CASE("what cannot be moved into place leaves nothing behind") {
  const Folder folder;
  const std::filesystem::path occupied = folder.path / "occupied";
  std::filesystem::create_directory(occupied);
  CHECK_THROWS_WITH_AS(save(Dmp::fit(reach(100, 1.0)), occupied), doctest::Contains("cannot be written"),
                       FileError);
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path), {}) == 1);
}

TEST_CASE("a model that turns along is a file of version 2 and comes back bit for bit") {
  const OrientationDmp dmp = OrientationDmp::fit(rotation(300, 4.0, 12.0));
  REQUIRE(dmp.options().orientation_form == OrientationForm::turning);
  const std::string text = to_json(dmp);
  CHECK(text.find("\"version\": 2") != std::string::npos);
  const OrientationDmp again = std::get<OrientationDmp>(from_json(text));
  CHECK(again.parameters().reference == dmp.parameters().reference);
  CHECK(again.rollout({}, {}, .01).rotation == dmp.rollout({}, {}, .01).rotation);
  CHECK(to_json(again) == text);
}

TEST_CASE("what is no model of this version is refused with the place") {
  DmpOptions options = stated();
  options.scaling = Scaling::none;  // version 1
  const std::string text = to_json(Dmp::fit(reach(100, 1.0), options));
  const auto refused = [](const std::string& bad, const char* reason) {
    CHECK_THROWS_WITH_AS(from_json(bad), doctest::Contains(reason), InvalidArgument);
  };
  refused("", "not readable as JSON");
  refused("[]", "expected an object");
  refused("{}", "'format' is missing");
  refused(replaced(text, "\"dmpcpp\"", "\"other\""), "format");
  refused(replaced(text, "\"version\": 1", "\"version\": 5"), "newer dmpcpp");
  refused(replaced(text, "\"kind\": \"dmp\"", "\"kind\": \"mp\""), "'mp' is unknown");
  refused(replaced(text, "\"kind\": \"dmp\"", "\"kind\": \"dmp\", \"kind\": \"dmp\""), "stands twice");
  refused(replaced(text, "\"lwr\"", "\"gpr\""),
          "options.regression: 'gpr' is unknown, expected one of lwr, ridge");
  refused(replaced(text, "\"alpha\": 25.0", "\"alpha\": \"25\""), "options.alpha: expected a number");
  refused(replaced(text, "\"alpha\": 25.0", "\"alpha\": -1"), "options.alpha");
  refused(replaced(text, "\"basis_count\": 100", "\"basis_count\": 99"), "weights: 100 x 3, expected 99 x 3");
  refused(replaced(text, "\"basis_count\": 100", "\"basis_count\": 1e300"), "basis_count");
  refused(replaced(text, "\"duration\": 1.0", "\"duration\": 0"), "duration");
  refused(replaced(text, "\"duration\": 1.0", "\"duration\": 1e999"), "JSON");
  refused(std::string(100000, '['), "nested deeper");
  refused(replaced(text, "\"force_after_end\": false", "\"force_after_end\": 0"), "expected true or false");
  refused(replaced(text, "\"kind\": \"dmp\"", "\"kind\": 7"), "kind: expected text");
  refused(replaced(text, "\"weights\": [", "\"weights\": [7, "), "weights: expected rows of numbers");
}

TEST_CASE("keys that this version does not know are passed over") {
  const std::string text = to_json(Dmp::fit(reach(100, 1.0)));
  const Model model = from_json(replaced(text, "\"kind\"", "\"comment\": {\"by\": \"hand\"}, \"kind\""));
  CHECK(to_json(model) == text);
}

TEST_CASE("golden files of version 1 are read for ever and written again to the last byte") {
  int read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(DMP_GOLDEN_MODELS "/v1")) {
    if (entry.path().filename() == "motions.json") continue;
    CAPTURE(entry.path().string());
    std::ifstream file(entry.path());
    std::stringstream text;
    text << file.rdbuf();
    CHECK(to_json(load(entry.path())) == text.str());
    ++read;
  }
  CHECK(read == 27);
}

namespace {

/// A key and where it stands; the first of a text, or the last.
struct Place {
  std::string key;
  std::size_t at;
};
Place first_of(const std::string& text, const std::string& key) {
  return {key, text.find("\"" + key + "\":")};
}
Place last_of(const std::string& text, const std::string& key) {
  return {key, text.rfind("\"" + key + "\":")};
}

std::string with_value(const std::string& text, const Place& place, const std::string& value) {
  REQUIRE(place.at != std::string::npos);
  const std::size_t from = place.at + place.key.size() + 4;
  int depth = 0;
  std::size_t to = from;
  for (; depth > 0 || (text[to] != ',' && text[to] != '\n' && text[to] != '}'); ++to)
    depth += text[to] == '[' || text[to] == '{' ? 1 : text[to] == ']' || text[to] == '}' ? -1 : 0;
  return text.substr(0, from) + value + text.substr(to);
}

/// Every key that stands in a file, those of the options too.
std::vector<Place> keys_of(const std::string& text) {
  std::vector<Place> keys;
  for (std::size_t at = 0; (at = text.find("\":", at)) != std::string::npos; ++at) {
    const std::size_t open = text.rfind('"', at - 1);
    keys.push_back({text.substr(open + 1, at - open - 1), open});
  }
  return keys;
}

}  // namespace

TEST_CASE("a value of the wrong kind is refused by its name, in every field of every kind of model") {
  const Model models[] = {Dmp::fit(reach(30, 1.0)), OrientationDmp::fit(rotation(30, 1.0, 1.0)),
                          PoseDmp::fit(pose(60, 1.0))};
  for (const Model& model : models) {
    const std::string text = to_json(model);
    const std::vector<Place> keys = keys_of(text);
    CHECK(keys.size() > 25);
    for (const Place& place : keys)
      for (const char* value :
           {"{}", "null", "[]", "[[]]", "[1, \"a\"]", "\"nonsense\"", "1e400", "[[1, 2], [3]]"}) {
        CAPTURE(place.key);
        CAPTURE(value);
        try {
          from_json(with_value(text, place, value));
          FAIL_CHECK("was taken");
        } catch (const InvalidArgument& refused) {
          const std::string reason = refused.what();
          CHECK((reason.find(place.key) != std::string::npos || reason.find("JSON") != std::string::npos));
        }
      }
    for (const Place& place : keys) {
      std::string without = text;
      without.insert(place.at + 1, "_");
      CHECK_THROWS_WITH_AS(from_json(without), doctest::Contains(place.key.c_str()), InvalidArgument);
    }
  }
}

TEST_CASE("numbers out of range or of another count are refused by their name") {
  const std::string turn = to_json(OrientationDmp::fit(rotation(30, 1.0, 1.0)));
  const std::string both = to_json(PoseDmp::fit(pose(60, 1.0), stated()));
  const auto refused = [](const std::string& bad, const char* reason) {
    CHECK_THROWS_WITH_AS(from_json(bad), doctest::Contains(reason), InvalidArgument);
  };
  refused(with_value(turn, last_of(turn, "start_velocity"), "[1, 2]"), "start_velocity: expected 3 numbers");
  refused(with_value(both, last_of(both, "start_twist"), "[1, 2, 3]"), "start_twist: expected 6 numbers");
  refused(with_value(turn, last_of(turn, "start"), "[[1, 0], [0, 1]]"), "start: expected a 3 x 3 matrix");
  refused(with_value(both, last_of(both, "goal"), "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]"),
          "goal: expected a 4 x 4 matrix");
  refused(with_value(turn, last_of(turn, "goal"), "[[2, 0, 0], [0, 1, 0], [0, 0, 1]]"), "goal");
  refused(with_value(turn, last_of(turn, "weights"), "[[1, 2, 3], [1, 2]]"),
          "weights[1]: expected 3 numbers");
  refused(with_value(both, last_of(both, "weights"), "[[1, 2, 3]]"), "weights: 1 x 3, expected 100 x 6");
  const std::string position = to_json(Dmp::fit(reach(30, 1.0)));
  refused(with_value(position, last_of(position, "goal"), "[1, 2]"), "goal: 2 numbers, expected 3");
  for (const auto& [option, least] : {std::pair("basis_count", "0"),
                                      {"passes", "0"},
                                      {"alpha", "0"},
                                      {"beta", "-1"},
                                      {"alpha_x", "0"},
                                      {"overlap", "0"},
                                      {"ridge", "-1"},
                                      {"goal_filter", "-1"},
                                      {"tempo_filter", "-1"},
                                      {"phase_stop", "-1"},
                                      {"basis_count", "2.5"}})
    refused(with_value(position, first_of(position, option), least),
            (std::string("options.") + option).c_str());
}

TEST_CASE("what would take long or much to read is refused at once") {
  const std::string text = to_json(Dmp::fit(reach(30, 1.0)));
  const auto with = [&](const std::string& more) { return "{" + more + "," + text.substr(1); };
  std::string keys = "\"k0\": 1", lists = "\"x\": [[]", objects = "\"x\": [{}";
  for (int i = 1; i < 100000; ++i) keys += ", \"k" + std::to_string(i) + "\": 1";
  for (int i = 1; i <= 1000000; ++i) lists += ",[]", objects += ",{}";
  CHECK_THROWS_WITH_AS(from_json(with(keys)), doctest::Contains("more than 100 keys"), InvalidArgument);
  CHECK_THROWS_WITH_AS(from_json(with("\"x\": {" + keys + "}")), doctest::Contains("more than 100 keys"),
                       InvalidArgument);
  CHECK_THROWS_WITH_AS(from_json(with(lists + "]")), doctest::Contains("1000000 lists"), InvalidArgument);
  CHECK_THROWS_WITH_AS(from_json(with(objects + "]")), doctest::Contains("100 objects"), InvalidArgument);
}

TEST_CASE("a model that could not be read again is not written") {
  const Folder folder;
  DmpParameters p = spring(0, 1, 1).parameters();
  p.options.basis_count = 50000;
  const auto of = [&](int dimension) {
    p.start = p.goal = p.start_velocity = p.amplitude = Eigen::VectorXd::Ones(dimension);
    p.weights = RowMatrix::Zero(50000, dimension);
    return Dmp(p);
  };
  save(of(19), folder.path / "large.json");
  CHECK(load_dmp(folder.path / "large.json").dimension() == 19);
  CHECK_THROWS_WITH_AS(save(of(20), folder.path / "larger.json"), doctest::Contains("weights: 50000 x 20"),
                       InvalidArgument);
  CHECK_FALSE(std::filesystem::exists(folder.path / "larger.json"));
}

TEST_CASE("a file keeps its permissions and stays behind its link; a new one has those of the process") {
  const Folder folder;
  const Dmp dmp = Dmp::fit(reach(30, 1.0));
  const std::filesystem::path file = folder.path / "model.json", link = folder.path / "link.json";
  const auto mode_of = [](const std::filesystem::path& path) {
    return static_cast<unsigned>(std::filesystem::status(path).permissions());
  };
  const mode_t before = ::umask(027);
  save(dmp, file);
  ::umask(before);
  CHECK(mode_of(file) == 0640);
  std::filesystem::permissions(file, std::filesystem::perms(0600));
  std::filesystem::create_symlink("model.json", link);
  save(dmp, link);
  CHECK(std::filesystem::is_symlink(link));
  CHECK(mode_of(file) == 0600);
  CHECK(load_dmp(file).parameters().weights == dmp.parameters().weights);
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path), {}) == 2);
}

TEST_CASE("devices, and names with a zero byte in them, are no files") {
  CHECK_THROWS_WITH_AS(load("/dev/zero"), doctest::Contains("not a file"), FileError);
  CHECK_THROWS_WITH_AS(load(std::string("model.json\0x", 12)), doctest::Contains("zero"), FileError);
  CHECK_THROWS_AS(save(Dmp::fit(reach(30, 1.0)), std::string("model.json\0x", 12)), FileError);
}
