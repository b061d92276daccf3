#include <doctest/doctest.h>
#include <dmp/arm.hpp>
#include <dmp/error.hpp>

#include <Eigen/Geometry>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <thread>

#include "arms.hpp"

using arms::JointText;
using dmp::Arm;
using doctest::Approx;

namespace {

std::string refusal(const std::string& text, const std::string& base = "", const std::string& tip = "") {
  try {
    Arm::from_urdf(text, base, tip);
  } catch (const dmp::InvalidArgument& error) {
    return error.what();
  }
  return "";
}

bool refuses_with(const std::string& text, const std::string& words) {
  const std::string message = refusal(text);
  INFO(message);
  CHECK(message.find(words) != std::string::npos);
  return message.find(words) != std::string::npos;
}

std::string one_joint(const JointText& joint) { return arms::urdf({joint}); }

// Composes the transforms of the joints as the URDF specification states them, without KDL.
Eigen::Matrix4d by_definition(const Eigen::VectorXd& q) {
  struct J {
    Eigen::Vector3d xyz, rpy, axis;
  };
  const std::vector<J> joints = {
      {{0, 0, .33}, {0, 0, 0}, {0, 0, 1}},         {{0, 0, 0}, {.1, 0, 0}, {0, 1, 0}},
      {{0, 0, .31}, {0, 0, .3}, {.6, 0, .8}},      {{.08, 0, 0}, {0, 0, 0}, {0, 1, 0}},
      {{-.08, 0, .38}, {0, .2, 0}, {0, 0, 1}},     {{0, 0, 0}, {0, 0, 0}, {0, 1, 0}},
      {{.09, 0, .1}, {3.14159, 0, 0}, {0, 0, -1}}, {{0, 0, -.1}, {0, 0, -.785}, {0, 0, 1}}};
  Eigen::Isometry3d tip = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const J& joint = joints[i];
    tip = tip * Eigen::Translation3d(joint.xyz) * Eigen::AngleAxisd(joint.rpy.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(joint.rpy.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(joint.rpy.x(), Eigen::Vector3d::UnitX());
    if (i < 7) tip = tip * Eigen::AngleAxisd(q[static_cast<Eigen::Index>(i)], joint.axis);
  }
  return tip.matrix();
}

}  // namespace

TEST_CASE("The two-link arm stands where the closed form says") {
  const Arm arm = Arm::from_urdf(arms::two_link());
  CHECK(arm.joint_count() == 2);
  CHECK(arm.base() == "link0");
  CHECK(arm.tip() == "link3");
  CHECK(arm.joint_names() == std::vector<std::string>{"joint1", "joint2"});
  const Eigen::Vector2d q(0.4, -1.1);
  const Eigen::Matrix4d pose = arm.forward_kinematics(Eigen::VectorXd(q));
  CHECK(pose(0, 3) == Approx(std::cos(0.4) + std::cos(-0.7)).epsilon(1e-15));
  CHECK(pose(1, 3) == Approx(std::sin(0.4) + std::sin(-0.7)).epsilon(1e-15));
  CHECK(pose(1, 0) == Approx(std::sin(-0.7)).epsilon(1e-15));
  CHECK(arm.manipulability(q) > 0.0);
  // Yoshikawa's measure over the two joints: det(J^T J) of the planar arm with the angular row.
  CHECK(arm.manipulability(Eigen::Vector2d(0.4, 0.0)) < arm.manipulability(q));
}

TEST_CASE("Forward kinematics agree with the definition of a URDF joint, oblique axes and all") {
  const Arm arm = Arm::from_urdf(arms::seven_joints());
  std::mt19937 random(1);
  for (int k = 0; k < 1000; ++k) {
    const Eigen::VectorXd q = arms::random_joints(arm, random);
    REQUIRE((arm.forward_kinematics(q) - by_definition(q)).cwiseAbs().maxCoeff() < 1e-12);
  }
}

TEST_CASE("The Jacobian is the derivative of the forward kinematics") {
  const Arm arm = Arm::from_urdf(arms::seven_joints());
  std::mt19937 random(2);
  const double h = 1e-6;
  for (int k = 0; k < 50; ++k) {
    const Eigen::VectorXd q = arms::random_joints(arm, random);
    const Eigen::MatrixXd jacobian = arm.jacobian(q);
    const Eigen::Matrix3d rotation = arm.forward_kinematics(q).topLeftCorner<3, 3>();
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      const Eigen::VectorXd dq = h * Eigen::VectorXd::Unit(q.size(), i);
      const Eigen::Matrix4d rate = (arm.forward_kinematics(Eigen::VectorXd(q + dq)) -
                                    arm.forward_kinematics(Eigen::VectorXd(q - dq))) /
                                   (2 * h);
      const Eigen::Matrix3d spin = rate.topLeftCorner<3, 3>() * rotation.transpose();
      REQUIRE((rate.topRightCorner<3, 1>() - jacobian.col(i).head<3>()).norm() < 1e-8);
      REQUIRE((Eigen::Vector3d(spin(2, 1), spin(0, 2), spin(1, 0)) - jacobian.col(i).tail<3>()).norm() <
              1e-8);
    }
  }
}

TEST_CASE("A table of joints gives the pose of each row") {
  const Arm arm = Arm::from_urdf(arms::two_link());
  dmp::RowMatrix q(2, 2);
  q << 0.1, 0.2, -0.3, 0.4;
  const dmp::Poses poses = arm.forward_kinematics(q);
  REQUIRE(poses.size() == 2);
  CHECK(poses[1] == arm.forward_kinematics(Eigen::VectorXd(q.row(1).transpose())));
}

TEST_CASE("Prismatic and continuous joints move as they should") {
  const Arm arm =
      Arm::from_urdf(arms::urdf({{"", R"(<axis xyz="1 0 0"/>)", "prismatic",
                                  R"(<limit lower="-0.5" upper="0.7" velocity="0.1" effort="9"/>)"},
                                 {"", R"(<axis xyz="0 0 -1"/>)", "continuous", ""}}));
  const Eigen::Matrix4d pose = arm.forward_kinematics(Eigen::VectorXd(Eigen::Vector2d(0.3, 0.5)));
  CHECK(pose(0, 3) == Approx(0.3));
  CHECK(pose(1, 0) == Approx(std::sin(-0.5)));
  CHECK(arm.lower()[0] == -0.5);
  CHECK(arm.upper()[1] == std::numeric_limits<double>::infinity());
  CHECK(arm.velocity_limit()[1] == std::numeric_limits<double>::infinity());
  CHECK(arm.effort_limit()[0] == 9.0);
}

TEST_CASE("A mimic joint moves with its master, in the Jacobian too") {
  const std::string text = arms::urdf(
      {{},
       {R"(<origin xyz="1 0 0"/>)", R"(<axis xyz="0 0 1"/>)", "revolute",
        R"(<limit lower="-1" upper="1" velocity="3" effort="50"/><mimic joint="joint1" multiplier="-2" offset="0.1"/>)"},
       {R"(<origin xyz="1 0 0"/>)", "", "fixed", ""}});
  const Arm arm = Arm::from_urdf(text);
  REQUIRE(arm.joint_count() == 1);
  const double q1 = 0.3, q2 = -2 * q1 + 0.1;
  const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, q1);
  CHECK(arm.forward_kinematics(q)(0, 3) == Approx(std::cos(q1) + std::cos(q1 + q2)));
  CHECK(arm.jacobian(q)(0, 0) == Approx(-std::sin(q1) + std::sin(q1 + q2)));
  CHECK(arm.jacobian(q)(5, 0) == Approx(-1.0));
  // The follower's range of -1 to 1 leaves the master -0.45 to 0.55, its 3 rad/s leave 1.5.
  CHECK(arm.lower()[0] == Approx(-0.45));
  CHECK(arm.upper()[0] == Approx(0.55));
  CHECK(arm.velocity_limit()[0] == Approx(1.5));
}

TEST_CASE("Soft limits narrow the range, zero soft limits are ignored with a warning") {
  const std::string limit = R"(<limit lower="-2" upper="2" velocity="3" effort="50"/>)";
  const Arm narrow = Arm::from_urdf(one_joint(
      {"", R"(<axis xyz="0 0 1"/>)", "revolute",
       limit + R"(<safety_controller k_velocity="1" soft_lower_limit="-1.5" soft_upper_limit="1"/>)"}));
  CHECK(narrow.lower()[0] == -1.5);
  CHECK(narrow.upper()[0] == 1.0);
  CHECK(narrow.warnings().empty());
  const Arm zero = Arm::from_urdf(one_joint(
      {"", R"(<axis xyz="0 0 1"/>)", "revolute", limit + R"(<safety_controller k_velocity="1"/>)"}));
  CHECK(zero.upper()[0] == 2.0);
  REQUIRE(zero.warnings().size() == 1);
  CHECK(zero.warnings()[0].find("joint1") != std::string::npos);
}

TEST_CASE("An axis that is not of length one is a direction all the same, with a warning") {
  const std::string limit = R"(<limit lower="-2" upper="2" velocity="3" effort="50"/>)";
  const Eigen::Vector3d direction = Eigen::Vector3d(1, 2, 2) / 3.0;
  const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, 0.7);
  const Arm turning = Arm::from_urdf(one_joint({"", R"(<axis xyz="1 2 2"/>)", "revolute", limit}));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, direction).toRotationMatrix();
  CHECK((turning.forward_kinematics(q).topLeftCorner<3, 3>() - turn).norm() < 1e-14);
  REQUIRE(turning.warnings().size() == 1);
  CHECK(
      turning.warnings()[0] ==
      "joint 'joint1': axis (1 2 2) has length 3, expected 1; kinematics normalise it, a simulator may not.");
  const Arm sliding = Arm::from_urdf(one_joint({"", R"(<axis xyz="1 2 2"/>)", "prismatic", limit}));
  CHECK((sliding.forward_kinematics(q).topRightCorner<3, 1>() - 0.7 * direction).norm() < 1e-14);
  // What four decimals leave of a unit vector is not worth a word.
  CHECK(Arm::from_urdf(one_joint({"", R"(<axis xyz="0.3333 0.6667 0.6667"/>)", "revolute", limit}))
            .warnings()
            .empty());
}

TEST_CASE("Limits of zero velocity or effort count as not stated, with a warning") {
  const Arm arm = Arm::from_urdf(one_joint({"", R"(<axis xyz="0 0 1"/>)", "revolute",
                                            R"(<limit lower="-2" upper="2" velocity="0" effort="0"/>)"}));
  CHECK(arm.velocity_limit()[0] == std::numeric_limits<double>::infinity());
  CHECK(arm.warnings().size() == 2);
}

TEST_CASE("A limit of which one half is stated is a warning that names the joint and the half") {
  const Arm arm = Arm::from_urdf(one_joint(
      {"", R"(<axis xyz="0 0 1"/>)", "revolute", R"(<limit upper="2" velocity="3" effort="50"/>)"}));
  CHECK(arm.lower()[0] == 0.0);
  REQUIRE(arm.warnings().size() == 1);
  CHECK(arm.warnings()[0] == "joint 'joint1': its <limit> states no lower, which counts as 0.");
}

TEST_CASE("What urdfdom could not read and left out is a warning in its words") {
  std::string text = arms::two_link();
  text.replace(text.find(R"(<link name="link1"/>)"), 20,
               R"(<link name="link1"><inertial><mass value="1"/><inertia ixx="much" ixy="0" ixz="0" iyy="1"
                  iyz="0" izz="1"/></inertial></link>)");
  const Arm arm = Arm::from_urdf(text);
  REQUIRE(arm.warnings().size() == 1);
  CHECK(arm.warnings()[0].find("urdfdom: ") == 0);
  CHECK(arm.warnings()[0].find("link1") != std::string::npos);
}

TEST_CASE("An impossible inertia is a warning that names the link") {
  std::string text = arms::two_link();
  text.replace(
      text.find(R"(<link name="link1"/>)"), 20,
      R"(<link name="link1"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0"
                  izz="9"/></inertial></link>)");
  const Arm arm = Arm::from_urdf(text);
  REQUIRE(arm.warnings().size() == 1);
  CHECK(arm.warnings()[0].find("link1") != std::string::npos);
}

TEST_CASE("Joints with which no motion can be planned are refused by name") {
  const std::string z = R"(<axis xyz="0 0 1"/>)";
  const std::string limit = R"(<limit lower="-2" upper="2" velocity="3" effort="50"/>)";
  CHECK(refuses_with(one_joint({"", z, "revolute", ""}), "joint1"));
  CHECK(
      refuses_with(one_joint({"", z, "revolute", R"(<limit velocity="3" effort="50"/>)"}), "lower < upper"));
  CHECK(refuses_with(
      one_joint({"", z, "revolute", R"(<limit lower="1" upper="-1" velocity="3" effort="50"/>)"}),
      "lower < upper"));
  CHECK(
      refuses_with(one_joint({"", z, "revolute", R"(<limit lower="-1" upper="1" effort="50"/>)"}), "joint1"));
  CHECK(refuses_with(one_joint({"", R"(<axis xyz="0 0 0"/>)", "revolute", limit}), "axis (0 0 0) is zero"));
  CHECK(refuses_with(one_joint({"", R"(<axis xyz="0 1e-9 0"/>)", "revolute", limit}), "is zero"));
  CHECK(refuses_with(one_joint({"", R"(<axis xyz="0 nan 0"/>)", "revolute", limit}), "joint1"));
  CHECK(refuses_with(one_joint({"", z, "floating", ""}), "floating"));
  CHECK(refuses_with(one_joint({"", z, "planar", ""}), "planar"));
  CHECK(refuses_with(one_joint({"", z, "hinge", limit}), "hinge"));
  CHECK(refuses_with(one_joint({"", z, "revolute", limit + R"(<mimic joint="elsewhere"/>)"}), "elsewhere"));
  CHECK(refuses_with(one_joint({R"(<origin xyz="nan 0 0"/>)", z, "revolute", limit}), "joint1"));
}

TEST_CASE("Numbers that are none are refused") {
  const std::string z = R"(<axis xyz="0 0 1"/>)";
  for (const char* number : {"nan", "1e400", "-1,5", "${pi}", ""}) {
    CAPTURE(number);
    const std::string limit =
        "<limit lower=\"" + std::string(number) + "\" upper=\"2\" velocity=\"3\" effort=\"50\"/>";
    CHECK(refusal(one_joint({"", z, "revolute", limit})) != "");
  }
}

TEST_CASE("Graphs that are no trees are refused and never hang") {
  const auto joint = [](const char* name, const char* parent, const char* child) {
    return std::string("<joint name=\"") + name + "\" type=\"fixed\"><parent link=\"" + parent +
           "\"/><child link=\"" + child + "\"/></joint>";
  };
  const std::string links = R"(<link name="a"/><link name="b"/><link name="c"/><link name="d"/>)";
  const auto robot = [&](const std::string& joints) {
    return "<robot name=\"r\">" + links + joints + "</robot>";
  };
  CHECK(refuses_with(robot(joint("j", "a", "a")), "cycle"));
  CHECK(refuses_with(robot(joint("j", "a", "b") + joint("k", "b", "a")), "cycle"));
  CHECK(refuses_with(robot(joint("j", "a", "b") + joint("k", "c", "d") + joint("l", "d", "c")), "cycle"));
  CHECK(refuses_with(robot(joint("j", "a", "c") + joint("k", "b", "c")), "two joints"));
  CHECK(refuses_with(robot(joint("j", "a", "b")), "urdfdom"));  // c and d are roots too
  CHECK(refuses_with(robot(joint("j", "a", "nowhere")), "nowhere"));
}

TEST_CASE("A cycle is found however its XML is written, whether or not the walk from base to tip meets it") {
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
    return text;
  };
  const auto joint = [](const char* name, const char* parent, const char* child) {
    return std::string("<joint type=\"fixed\" name=\"") + name + "\"><parent link=\"" + parent +
           "\"/><child link=\"" + child + "\"/></joint>";
  };
  const std::string links = R"(<link name="root"/><link name="a"/><link name="b"/><link name="c"/>)";
  const std::string apart = "<robot name=\"r\">" + links + joint("i", "root", "c") + joint("j", "a", "b") +
                            joint("k", "b", "a") + "</robot>";
  const std::string hanging = replaced(apart, "link=\"c\"", "link=\"a\"");
  for (const std::string& text : {apart, hanging})
    for (const char* written : {" link=", "\tlink=", "\nlink=", " link =", " link\n= ", " of=\">\" link="}) {
      CAPTURE(written);
      for (const char* tip : {"", "a"})
        CHECK(refusal(replaced(text, " link=", written), "root", tip).find("expected a tree") !=
              std::string::npos);
    }
  CHECK(refusal(replaced(apart, "\"a\"/>", "\"&#97;\"/>"), "root", "a").find("cycle") != std::string::npos);
  // What begins with no name is no element to urdfdom's parser, and its quotes hide nothing.
  for (const char* no_element : {"<6 0.8\"/>", "<'>", "<= \">", "<\">"}) {
    CAPTURE(no_element);
    CHECK(refusal(replaced(apart, "<link name=\"a\"/>", "<link name=\"a\"/>" + std::string(no_element)),
                  "root", "c")
              .find("expected a tree") != std::string::npos);
  }
}

TEST_CASE("Deep nesting is refused behind quotes too that are no attribute's") {
  std::string deep;
  for (int i = 0; i < 200000; ++i) deep += "<a>";
  for (const char* before :
       {"<![CDATA[']]>", "<!DOCTYPE r '>", "<?note it's?>", "<!-- ' -->", "<b of='>'/>"}) {
    CAPTURE(before);
    CHECK(refuses_with("<robot name='r'>" + std::string(before) + deep, "nested"));
  }
}

TEST_CASE("A text larger than 64 MiB is refused before it is read") {
  CHECK(refuses_with(std::string((64u << 20) + 1, ' '), "64 MiB"));
}

TEST_CASE("Text that is no URDF is refused, with the words of urdfdom and without printing") {
  std::ostringstream printed;
  std::streambuf* const console = std::cerr.rdbuf(printed.rdbuf());
  CHECK(refuses_with("", "urdf"));
  CHECK(refuses_with("hello", "urdf"));
  CHECK(refuses_with("<robot name='r'>", "urdf"));
  CHECK(refuses_with("<model/>", "robot"));
  CHECK(refuses_with("<robot name='r'></robot>", "urdf"));
  std::string deep = "<robot name='r'>";
  for (int i = 0; i < 200000; ++i) deep += "<a>";
  CHECK(refuses_with(deep, "nested"));
  std::cerr.rdbuf(console);
  CHECK(printed.str().empty());
}

TEST_CASE("Links that do not exist are answered with a list") {
  const std::string text = arms::two_link();
  CHECK(refusal(text, "link0", "hand").find("link0, link1, link2, link3") != std::string::npos);
  CHECK(refusal(text, "world").find("base: no link 'world'") == 0);
  CHECK(refusal(text, "link2", "link1").find("does not hang below") != std::string::npos);
  CHECK(refusal(text, "link2", "link3").find("no moving joint") != std::string::npos);
  std::string forked = text;
  forked.replace(
      forked.find("</robot>"), 8,
      R"(<link name="other"/><joint name="fork" type="fixed"><parent link="link1"/><child link="other"/></joint></robot>)");
  CHECK(Arm::from_urdf(forked).tip() == "link3");
  CHECK(Arm::from_urdf(forked, "", "other").joint_count() == 1);
}

TEST_CASE("with_limits replaces what is given and keeps the rest") {
  const Arm arm = Arm::from_urdf(arms::two_link());
  const Arm slow = arm.with_limits({std::nullopt, std::nullopt, Eigen::Vector2d(0.5, 0.6), std::nullopt});
  CHECK(slow.velocity_limit() == Eigen::Vector2d(0.5, 0.6));
  CHECK(slow.lower() == arm.lower());
  CHECK(arm.velocity_limit() == Eigen::Vector2d(3.0, 3.0));
  dmp::LimitOverrides bad;
  bad.lower = Eigen::Vector2d(0.0, 3.0);
  CHECK_THROWS_WITH_AS(arm.with_limits(bad), doctest::Contains("lower[1]"), dmp::InvalidArgument);
  bad.lower = Eigen::VectorXd::Zero(3);
  CHECK_THROWS_AS(arm.with_limits(bad), dmp::InvalidArgument);
}

TEST_CASE("Every limit says where it comes from") {
  using dmp::LimitKind;
  using dmp::LimitSource;
  const Arm arm = Arm::from_urdf(arms::two_link());
  const std::vector<LimitSource> urdf(2, LimitSource::urdf), assumed(2, LimitSource::assumed),
      unstated(2, LimitSource::unstated);
  CHECK(arm.limit_sources(LimitKind::position) == urdf);
  CHECK(arm.limit_sources(LimitKind::velocity) == urdf);
  CHECK(arm.limit_sources(LimitKind::acceleration) == assumed);
  CHECK(arm.acceleration_limit() == Eigen::Vector2d::Constant(dmp::assumed_acceleration));
  CHECK(arm.limit_sources(LimitKind::jerk) == unstated);
  CHECK(arm.jerk_limit() == Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()));

  dmp::LimitOverrides limits;
  limits.acceleration = Eigen::Vector2d(4.0, 5.0);
  limits.jerk = Eigen::Vector2d(6.0, std::numeric_limits<double>::infinity());
  limits.source = LimitSource::maker;
  const Arm stated = arm.with_limits(limits);
  CHECK(stated.acceleration_limit() == Eigen::Vector2d(4.0, 5.0));
  CHECK(stated.limit_sources(LimitKind::acceleration) == std::vector<LimitSource>(2, LimitSource::maker));
  CHECK(stated.limit_sources(LimitKind::jerk) ==
        std::vector<LimitSource>{LimitSource::maker, LimitSource::unstated});
  CHECK(stated.limit_sources(LimitKind::velocity) == urdf);
  limits.jerk = Eigen::Vector2d(6.0, 0.0);
  CHECK_THROWS_WITH_AS(arm.with_limits(limits), doctest::Contains("jerk[1]"), dmp::InvalidArgument);
}

TEST_CASE("Joints of the wrong number or not finite are refused") {
  const Arm arm = Arm::from_urdf(arms::two_link());
  CHECK_THROWS_AS(arm.forward_kinematics(Eigen::VectorXd(Eigen::VectorXd::Zero(3))), dmp::InvalidArgument);
  CHECK_THROWS_WITH_AS(arm.jacobian(Eigen::Vector2d(0.0, std::nan(""))), doctest::Contains("q[1]"),
                       dmp::InvalidArgument);
}

TEST_CASE("An arm from a file knows its folder; a missing file is a FileError") {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "dmp_test_arm.urdf";
  std::ofstream(file) << arms::two_link();
  const Arm arm = Arm::from_urdf_file(file.string());
  CHECK(arm.folder() == file.parent_path().string());
  CHECK(arm.urdf() == arms::two_link());
  std::filesystem::remove(file);
  CHECK_THROWS_WITH_AS(Arm::from_urdf_file(file.string()), doctest::Contains("dmp_test_arm.urdf"),
                       dmp::FileError);
  CHECK_THROWS_AS(Arm::from_urdf_file("/"), dmp::FileError);
  CHECK_THROWS_WITH_AS(Arm::from_urdf_file("/dev/zero"), doctest::Contains("not a file"), dmp::FileError);
}

TEST_CASE("Threads that share an arm get the serial answers, bit for bit") {
  const Arm arm = Arm::from_urdf(arms::seven_joints());
  std::mt19937 random(3);
  std::vector<Eigen::VectorXd> joints;
  std::vector<Eigen::Matrix4d> serial;
  for (int k = 0; k < 5000; ++k) {
    joints.push_back(arms::random_joints(arm, random));
    serial.push_back(arm.forward_kinematics(joints.back()));
  }
  std::array<int, 4> wrong{};
  std::vector<std::thread> threads;
  for (int& count : wrong)
    threads.emplace_back([&] {
      for (std::size_t k = 0; k < joints.size(); ++k)
        count += arm.forward_kinematics(joints[k]) != serial[k] ? 1 : 0;
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(wrong == std::array<int, 4>{});
}

TEST_CASE("A file that is no arm is named with the reason") {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "dmp_test_no_arm.urdf";
  std::ofstream(file) << "<robot name=\"r\"><link name=\"a\"/></robot>";
  CHECK_THROWS_WITH_AS(Arm::from_urdf_file(file.string()), doctest::Contains("dmp_test_no_arm.urdf"),
                       dmp::InvalidArgument);
  std::filesystem::remove(file);
  CHECK(Arm::from_urdf(arms::two_link()).name() == "arm");
}

TEST_CASE("Mimic joints that leave no motion are refused by name") {
  const std::string z = R"(<axis xyz="0 0 1"/>)", at = R"(<origin xyz="1 0 0"/>)";
  const auto mimicking = [&](const std::string& mimic) {
    return arms::urdf(
        {{}, {at, z, "revolute", R"(<limit lower="-1" upper="1" velocity="3" effort="50"/>)" + mimic}});
  };
  CHECK(refuses_with(mimicking(R"(<mimic joint="joint1" multiplier="0"/>)"), "multiplier"));
  CHECK(refuses_with(mimicking(R"(<mimic joint="joint1" multiplier="1" offset="9"/>)"), "no range"));
}

TEST_CASE("Without a tip the arm's tool is taken and its gripper is held") {
  const auto hung = [](const char* parent, const char* child, const char* joint) {
    return std::string("<link name=\"") + child + "\"/>" + joint + "<parent link=\"" + parent +
           "\"/><child link=\"" + child + "\"/><origin xyz=\"0.1 0 0\"/></joint>";
  };
  std::string text = arms::seven_joints();
  text.erase(text.rfind("</robot>"));
  const char* jaw =
      R"(<joint name="jaw" type="revolute"><limit lower="0" upper="1" velocity="1" effort="1"/>)";
  text +=
      hung("link8", "tool0", R"(<joint name="t" type="fixed">)") + hung("link8", "part", jaw) + "</robot>";
  const Arm arm = Arm::from_urdf(text);
  CHECK(arm.tip() == "tool0");
  CHECK(arm.base() == "link0");
  CHECK(arm.joint_count() == 7);
  CHECK(arm.choice() == "7 joints, joint1 to joint7; held still: jaw");
  CHECK(Arm::from_urdf(text, "link0", "part").joint_count() == 8);
  CHECK(Arm::from_urdf(text, "link0", "part").choice().empty());
}

TEST_CASE("Two arms are asked about, with a line for each") {
  const std::string one = arms::seven_joints();
  std::string text = one;
  text.erase(text.rfind("</robot>"));
  std::string other = one.substr(one.find("<link name=\"link1\""));
  for (std::size_t at = 0; (at = other.find("link", at)) != std::string::npos; at += 5)
    if (std::isdigit(static_cast<unsigned char>(other[at + 4])) && other[at + 4] != '0')
      other.insert(at, "r");
  for (std::size_t at = 0; (at = other.find("name=\"joint", at)) != std::string::npos; at += 8)
    other.insert(at + 6, "r");
  const std::string message = refusal(text + other);
  CHECK(message.find("2 arms or legs could be meant") != std::string::npos);
  CHECK(message.find("base='link0' tip='link8' (7 joints, joint1 to joint7)") != std::string::npos);
  CHECK(message.find("base='link0' tip='rlink8' (7 joints, rjoint1 to rjoint7)") != std::string::npos);
}

TEST_CASE("A tool is a frame fixed to the tip, in the chain and in the text") {
  const Arm arm = Arm::from_urdf(arms::seven_joints());
  Eigen::Isometry3d tool = Eigen::Isometry3d::Identity();
  tool.translate(Eigen::Vector3d(0.02, -0.01, 0.15))
      .rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.6, 0, 0.8)));
  const Arm longer = arm.with_tool(tool.matrix());
  const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(7, -0.5, 0.1);
  const Eigen::Matrix4d wanted = arm.forward_kinematics(q) * tool.matrix();
  CHECK(longer.tip() == arm.tip() + "_tool");
  CHECK((longer.forward_kinematics(q) - wanted).norm() < 1e-14);
  CHECK((Arm::from_urdf(longer.urdf(), "", longer.tip()).forward_kinematics(q) - wanted).norm() < 1e-14);
  CHECK_THROWS_AS(arm.with_tool(Eigen::Matrix4d::Zero()), dmp::InvalidArgument);
}
