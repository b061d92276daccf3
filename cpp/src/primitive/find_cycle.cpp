#include <dmp/cycle.hpp>
#include <dmp/error.hpp>
#include <dmp/so3.hpp>

#include <algorithm>

#include "primitive/cycle_phase.hpp"
#include "primitive/turning_reference.hpp"

namespace dmp {
namespace {

using detail::PhaseTrack;
using detail::Signal;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr Index kSamples = 200;  // of a cycle
constexpr Index kMost = 2000;    // of a recording that is looked at
constexpr double kLever = 0.2;   // m a rad: what a rotation counts beside a position

VectorXd even_times(Index size, double duration) {
  return VectorXd::LinSpaced(std::clamp<Index>(size, 200, kMost), 0.0, duration);
}

RowMatrix entries_of(const Rotations& rotations) {
  RowMatrix table(static_cast<Index>(rotations.size()), 9);
  for (std::size_t k = 0; k < rotations.size(); ++k)
    table.row(static_cast<Index>(k)) = Eigen::Map<const Eigen::Matrix<double, 1, 9>>(rotations[k].data());
  return table;
}

/// Phases of a cycle, its end included.
VectorXd round_phases() { return VectorXd::LinSpaced(kSamples + 1, 0.0, 1.0); }

RowMatrix cycle_of(const PhaseTrack& track, const RowMatrix& value, int harmonics) {
  const MatrixXd c = detail::least_squares(detail::harmonics_of(track.phase, harmonics), value);
  RowMatrix cycle = detail::harmonics_of(round_phases(), harmonics) * c;
  cycle.row(kSamples) = cycle.row(0);
  return cycle;
}

/// One cycle of rotations: p of R = Exp(p) Q(phase), Q what turns on evenly, in harmonics.
Rotations cycle_of(const PhaseTrack& track, const OrientationDemonstration& recording, int harmonics) {
  VectorXd moments(kSamples);  // of the first cycle
  for (Index k = 0; k < kSamples; ++k)
    moments[k] = detail::time_at(track.signal.time, track.phase, static_cast<double>(k) / kSamples);
  const auto reference = detail::TurningReference::round(recording.at(moments).rotation);
  const Rotations rotations = recording.at(track.signal.time).rotation;
  RowMatrix away(track.phase.size(), 3);
  Vector3d p = Vector3d::Zero();
  for (Index k = 0; k < away.rows(); ++k) {
    const Eigen::Quaterniond turn = Eigen::Quaterniond(rotations[static_cast<std::size_t>(k)]) *
                                    reference.at(track.phase[k]).turn.conjugate();
    p = so3::lifted_log(turn, p);
    away.row(k) = p;
  }
  const RowMatrix cycle = cycle_of(track, away, harmonics);
  Rotations round;
  for (Index k = 0; k < kSamples; ++k)
    round.push_back(
        (so3::exp_quaternion(Vector3d(cycle.row(k))) * reference.at(static_cast<double>(k) / kSamples).turn)
            .toRotationMatrix());
  round.push_back(round.front());
  return round;
}

VectorXd cycle_times(const CycleReport& report) { return report.period * round_phases(); }

}  // namespace

Cycle<Demonstration> find_cycle(const Demonstration& recording, const CycleOptions& options) {
  const VectorXd times = even_times(recording.size(), recording.duration());
  const PhaseTrack track = detail::track_phase({times, recording.at(times).position}, options);
  return {Demonstration(cycle_times(track.report), cycle_of(track, track.signal.value, options.harmonics)),
          track.report};
}

Cycle<OrientationDemonstration> find_cycle(const OrientationDemonstration& recording,
                                           const CycleOptions& options) {
  const VectorXd times = even_times(recording.size(), recording.duration());
  const PhaseTrack track = detail::track_phase({times, entries_of(recording.at(times).rotation)}, options);
  return {OrientationDemonstration(cycle_times(track.report), cycle_of(track, recording, options.harmonics)),
          track.report};
}

Cycle<PoseDemonstration> find_cycle(const PoseDemonstration& recording, const CycleOptions& options) {
  const VectorXd times = even_times(recording.size(), recording.duration());
  const RowMatrix position = recording.position().at(times).position;
  RowMatrix both(times.size(), 12);
  both << position, kLever * entries_of(recording.orientation().at(times).rotation);
  const PhaseTrack track = detail::track_phase({times, both}, options);
  const RowMatrix round = cycle_of(track, track.signal.value.leftCols(3), options.harmonics);
  const Rotations turn = cycle_of(track, recording.orientation(), options.harmonics);
  Poses poses;
  for (std::size_t k = 0; k < turn.size(); ++k)
    poses.push_back(pose_of(turn[k], round.row(static_cast<Index>(k)).transpose()));
  return {PoseDemonstration(cycle_times(track.report), poses), track.report};
}

}  // namespace dmp
