#pragma once

#include <dmp/sequence.hpp>

#include <algorithm>
#include <string>

#include "base/text.hpp"
#include "primitive/rollout.hpp"

namespace dmp {

namespace detail {

constexpr std::size_t kMostParts = 32;
constexpr std::size_t kMostViasOfPart = 16;
constexpr double kMostCycles = 1e5;

template <class Space>
bool is_rhythmic(const SequencePart<Space>& part) {
  return part.model.options().motion == Motion::rhythmic;
}

template <class Space>
void require_part(const SequencePart<Space>& part, const SequencePart<Space>& first,
                  const std::string& name) {
  if (part.model.dimension() != first.model.dimension())
    throw InvalidArgument(name + ".model: of " + std::to_string(part.model.dimension()) +
                          " dimensions, expected " + std::to_string(first.model.dimension()) +
                          " as the first one.");
  const double most = is_rhythmic(part) ? kMostCycles : 1.0;
  if (!(part.leave >= kLeastReach && part.leave <= most))
    throw InvalidArgument(name + ".leave: " + number(part.leave) + ", expected a phase, 0.01 to " +
                          number(most) + ".");
  if (!(part.reach >= kLeastReach && part.reach <= 1.0))
    throw InvalidArgument(name + ".reach: " + number(part.reach) +
                          ", expected a part of the phase, 0.01 to 1.");
  if (part.vias.size() > kMostViasOfPart)
    throw InvalidArgument(name + ".vias: " + std::to_string(part.vias.size()) + ", expected at most 16.");
  try {
    for (std::size_t j = 0; j < part.vias.size(); ++j) require_via<Space>(part.vias, j, part.model);
  } catch (const InvalidArgument& error) {
    throw InvalidArgument(name + "." + error.what());
  }
}

template <class Space>
void set_up(Stepper<Space>& run, const SequencePart<Space>& part) {
  for (const Via<Space>& via : part.vias) {
    if (via.velocity) {
      run.via(via.phase, via.point, *via.velocity, via.reach);
    } else {
      run.via(via.phase, via.point, via.reach);
    }
  }
}

template <class Space>
typename Space::Trajectory roll_out(const Sequence<Space>& sequence, const Timetable& timetable,
                                    const std::optional<typename Space::Point>& goal,
                                    std::optional<double> duration) {
  using G = Geometry<Space>;
  SequenceRun<Space> run(sequence);
  if (duration) {
    require_duration(*duration);
    if (run.stretch(*duration / sequence.duration()) == Status::invalid_input)
      throw InvalidArgument("duration: " + number(*duration) + " s is out of proportion to " +
                            number(sequence.duration()) + " s as demonstrated.");
  }
  if (goal) {
    G::require(*goal, sequence.start(), "goal");
    run.set_goal(*goal);
  }
  typename Space::Trajectory result = G::room_for(timetable.times, sequence.start());
  step_through(run, timetable, [&](Eigen::Index k) { G::record(result, k, run.output()); });
  return result;
}

}  // namespace detail

template <class Space>
Sequence<Space>::Sequence(const std::vector<Part>& parts)
    : parts_(std::make_shared<std::vector<Part>>(parts)) {
  if (parts.empty() || parts.size() > detail::kMostParts)
    throw InvalidArgument("parts: " + std::to_string(parts.size()) + ", expected 1 to 32.");
  for (std::size_t k = 0; k < parts.size(); ++k)
    detail::require_part(parts[k], parts.front(), detail::indexed("parts", static_cast<long>(k)));
}

template <class Space>
double Sequence<Space>::duration() const noexcept {
  double sum = 0.0;
  for (std::size_t k = 0; k < parts_->size(); ++k) {
    const Part& part = (*parts_)[k];
    const bool is_left = k + 1 < parts_->size() || detail::is_rhythmic(part);
    sum += (is_left ? part.leave : 1.0) * part.model.duration();
  }
  return sum;
}

template <class Space>
typename Space::Trajectory Sequence<Space>::rollout(const std::optional<Point>& goal,
                                                    std::optional<double> duration, double dt) const {
  if (duration) detail::require_duration(*duration);
  return detail::roll_out(*this, detail::every(dt, duration.value_or(this->duration())), goal, duration);
}

template <class Space>
typename Space::Trajectory Sequence<Space>::rollout_at(const Eigen::VectorXd& times,
                                                       const std::optional<Point>& goal,
                                                       std::optional<double> duration) const {
  return detail::roll_out(*this, {times, 0.0}, goal, duration);
}

// SequenceRun

template <class Space>
SequenceRun<Space>::SequenceRun(const Sequence<Space>& sequence)
    : sequence_(sequence), current_(sequence.parts().front().model) {
  for (const SequencePart<Space>& part : sequence.parts()) {
    others_.emplace_back(part.model);
    detail::set_up(others_.back(), part);
  }
  current_ = others_.front();
}

template <class Space>
bool SequenceRun<Space>::is_last() const noexcept {
  return part_ + 1 == static_cast<Eigen::Index>(others_.size());
}

template <class Space>
Status SequenceRun<Space>::step(double dt) noexcept {
  constexpr int kMostPieces = 100;  // at a changing tempo the end of a part is approached in several
  constexpr double kThere = 1e-9;
  if (!(dt >= 0.0)) return Status::invalid_input;
  double left = dt;
  for (int piece = 0; !is_last() && piece < kMostPieces; ++piece) {
    const auto k = static_cast<std::size_t>(part_);
    const double way = sequence_.parts()[k].leave - current_.phase();
    if (way > kThere) {
      const double there = way * current_.duration();
      const Status status = current_.step(std::min(left, there));
      if (status == Status::not_finite || status == Status::invalid_input) return status;
      const double gone = std::min(left, there);
      left -= gone;
      time_ += gone;
      if (left <= 0.0) return Status::running;
      continue;
    }
    const Reach reach(sequence_.parts()[k + 1].reach);
    if (current_.join(others_[k + 1], reach) == Status::invalid_input) return Status::invalid_input;
    ++part_;
  }
  const Status status = current_.step(left);
  if (status != Status::invalid_input) time_ += left;
  return is_last() || status != Status::finished ? status : Status::running;
}

template <class Space>
Status SequenceRun<Space>::set_goal(typename Space::PointArgument goal) noexcept {
  return is_last() ? current_.set_goal(goal) : others_.back().set_goal(goal);
}

template <class Space>
Status SequenceRun<Space>::stretch(double factor) noexcept {
  if (!(factor > 0.0 && factor <= 1e24)) return Status::invalid_input;
  const Status status = current_.set_duration(factor * current_.duration());
  if (status == Status::invalid_input) return status;
  for (std::size_t k = static_cast<std::size_t>(part_) + 1; k < others_.size(); ++k)
    others_[k].set_duration(factor * others_[k].duration());
  return status;
}

}  // namespace dmp
