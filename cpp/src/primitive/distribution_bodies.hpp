#pragma once

#include <dmp/distribution.hpp>
#include <dmp/error.hpp>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "base/text.hpp"
#include "primitive/deviations.hpp"
#include "primitive/distribution_fit.hpp"
#include "primitive/given_rows.hpp"
#include "primitive/reference_motion.hpp"

namespace dmp {

template <class Space>
struct Distribution<Space>::Data {
  Parameters parameters;
  detail::ControlPoints points;
  Demonstration reference;
  std::vector<Eigen::Index> parts;
  Eigen::Index axes;

  explicit Data(const Parameters& given)
      : parameters(given),
        points((detail::require_options(given.options), given.options.control_points)),
        reference(detail::reference_from<Space>(given.reference)),
        parts(detail::parts_in<Space>(detail::point_from<Space>(given.reference.row(0)))),
        axes(detail::dimension_of<Space>(reference)) {
    detail::require_fields(given.options, given.demonstrations, given.duration, given.mean, given.factor,
                           given.noise, axes, static_cast<Eigen::Index>(parts.size()));
  }

  detail::WeightGaussian weights() const { return {parameters.mean, parameters.factor}; }
  Distribution with(detail::WeightGaussian weights) const {
    Parameters changed = parameters;
    changed.mean = std::move(weights.mean);
    changed.factor = std::move(weights.factor);
    return Distribution(changed);
  }
  Eigen::VectorXd variance() const { return detail::by_axis(parameters.noise.cwiseAbs2(), parts); }
  std::vector<detail::Moment<Space>> moments(const Eigen::VectorXd& phases) const {
    return detail::moments_of(reference, phases, static_cast<Space*>(nullptr));
  }
  detail::Moment<Space> moment(double phase) const {
    return std::move(moments(Eigen::VectorXd::Constant(1, phase)).front());
  }
  /// The motion with these weights at even phases, as it runs over the phase.
  std::vector<detail::Moment<Space>> motion(const Eigen::VectorXd& weights, Eigen::Index count) const {
    const Eigen::VectorXd phases = Eigen::VectorXd::LinSpaced(count, 0.0, 1.0);
    auto found = moments(phases);
    for (Eigen::Index k = 0; k < count; ++k) {
      const auto at = [&](int derivative) {
        return detail::value_of(points.at(phases[k], derivative), weights, axes);
      };
      const Eigen::VectorXd value = at(0), rate = at(1), second = at(2);
      found[static_cast<std::size_t>(k)].displace({value.data(), rate.data(), second.data()});
    }
    return found;
  }
  std::vector<Point> points_with(const Eigen::VectorXd& weights, Eigen::Index count) const {
    std::vector<Point> path;
    for (const auto& moment : motion(weights, count))
      detail::OffsetIn<Space>::point(moment.view(), path.emplace_back());
    return path;
  }
  Trajectory rollout(const Eigen::VectorXd& weights, Eigen::Index samples) const {
    using G = detail::Geometry<Space>;
    if (samples < 2 || samples > 10000000)
      throw InvalidArgument("samples: " + std::to_string(samples) + ", expected 2 to 10^7.");
    auto found = motion(weights, samples);
    const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(samples, 0.0, parameters.duration);
    Point first;
    detail::OffsetIn<Space>::point(found.front().view(), first);
    Trajectory trajectory = G::room_for(times, first);
    for (Eigen::Index k = 0; k < samples; ++k) {
      found[static_cast<std::size_t>(k)].quicken(1.0 / parameters.duration);
      G::record(trajectory, k, found[static_cast<std::size_t>(k)].view());
    }
    return trajectory;
  }
  /// Covariance of the point at a phase, without noise, in the axes of the world.
  Eigen::MatrixXd covariance(double phase, const detail::Moment<Space>& at) const {
    const detail::SplineRow row = points.at(phase);
    const Eigen::MatrixXd turned =
        detail::tangents_of<Space>(at, detail::value_of(row, parameters.mean, axes)) *
        detail::rows_of(row, parameters.factor, axes);
    return turned * turned.transpose();
  }
  Eigen::MatrixXd covariance(double phase) const { return covariance(phase, moment(phase)); }
};

template <class Space>
Distribution<Space>::Distribution(const Parameters& parameters)
    : data_(std::make_shared<const Data>(parameters)) {}

template <class Space>
const DistributionParameters<Space>& Distribution<Space>::parameters() const noexcept {
  return data_->parameters;
}

template <class Space>
Eigen::Index Distribution<Space>::dimension() const noexcept {
  return data_->axes;
}

template <class Space>
Distribution<Space> Distribution<Space>::fit(const std::vector<Demonstration>& demonstrations,
                                             const DistributionOptions& options) {
  detail::require_options(options);
  detail::require_alike<Space>(detail::pointers_to(demonstrations));
  if (demonstrations.size() < 2)
    throw InvalidArgument(
        "demonstrations: 1, expected at least 2: one alone does not show how the motion varies.");
  const auto means = detail::mean_points<Space>(demonstrations, options.control_points);
  detail::require_one_motion<Space>(demonstrations, means.front());
  Parameters parameters;
  parameters.options = options;
  parameters.demonstrations = static_cast<Eigen::Index>(demonstrations.size());
  parameters.duration = 0.0;
  for (const auto& demonstration : demonstrations)
    parameters.duration += demonstration.duration() / static_cast<double>(demonstrations.size());
  parameters.reference = detail::table_of<Space>(means);
  const Demonstration reference = detail::reference_from<Space>(parameters.reference);
  std::vector<detail::Deviation> deviations;
  for (std::size_t j = 0; j < demonstrations.size(); ++j) {
    const Eigen::VectorXd& time = demonstrations[j].time();
    deviations.push_back(
        detail::deviation_of<Space>(demonstrations[j], time / time[time.size() - 1], reference));
    detail::require_near<Space>(deviations.back(), means.front(),
                                detail::indexed("demonstrations", static_cast<long>(j)));
  }
  detail::WeightFit fit = detail::fit_weights(detail::ControlPoints(options.control_points), deviations,
                                              detail::parts_in<Space>(means.front()),
                                              detail::extents_of<Space>(means, deviations), options);
  parameters.mean = fit.weights.mean;
  parameters.factor = detail::widening(demonstrations.size()) * fit.weights.factor;
  parameters.noise = fit.noise;
  return Distribution(parameters);
}

template <class Space>
Distribution<Space> Distribution<Space>::condition(const std::vector<Given<Space>>& given) const {
  detail::WeightGaussian weights = data_->weights();
  for (std::size_t k = 0; k < given.size(); ++k) {
    const std::string name = detail::indexed("given", static_cast<long>(k));
    const auto seen = detail::observation_of(given[k], name, *data_);
    if (!detail::condition(weights, seen))
      throw InvalidArgument(name + ": nothing is left open at phase " + detail::number(given[k].phase) +
                            ": what was given before fixes it. Leave one out, or give a covariance.");
  }
  return data_->with(std::move(weights));
}

template <class Space>
Distribution<Space> Distribution<Space>::condition(const Demonstration& part, std::optional<double> duration,
                                                   double phase,
                                                   const std::optional<Eigen::VectorXd>& noise) const {
  const double whole = duration.value_or(this->duration());
  const Eigen::VectorXd phases = detail::phases_of(part.time(), whole, phase);
  if (detail::dimension_of<Space>(part) != data_->axes)
    throw InvalidArgument("part: " + std::to_string(detail::dimension_of<Space>(part)) +
                          " dimensions, expected " + std::to_string(data_->axes) + ".");
  const detail::Deviation deviation = detail::deviation_of<Space>(part, phases, data_->reference);
  detail::require_near<Space>(deviation, detail::point_from<Space>(data_->parameters.reference.row(0)),
                              "part");
  Eigen::VectorXd own = data_->variance();
  if (noise) own = detail::by_axis(detail::require_noise(*noise, data_->parts).cwiseAbs2(), data_->parts);
  const double share = noise ? 0.0 : detail::share_of_samples(phases, data_->points);
  detail::WeightGaussian weights = data_->weights();
  detail::Information seen = detail::no_information(weights.mean.size());
  for (Eigen::Index k = 0; k < phases.size(); ++k) {
    const detail::SplineRow row = data_->points.at(phases[k]);
    const Eigen::VectorXd open = detail::rows_of(row, weights.factor, data_->axes).rowwise().squaredNorm();
    detail::add(seen, row, deviation.value.row(k), own + share * open);
  }
  detail::condition(weights, seen);
  return data_->with(std::move(weights));
}

template <class Space>
Eigen::MatrixXd Distribution<Space>::observation_covariance(double phase) const {
  detail::require_phase(phase, "phase");
  Eigen::MatrixXd covariance = detail::kMisfit * data_->covariance(phase);
  covariance.diagonal() += data_->variance();
  return covariance;
}

template <class Space>
double Distribution<Space>::distance(const Given<Space>& given) const {
  const auto seen = detail::observation_of(given, "given", *data_);
  const Eigen::MatrixXd spread = seen.rows * data_->parameters.factor;
  Eigen::MatrixXd covariance = spread * spread.transpose() + seen.deviation * seen.deviation.transpose();
  const Eigen::VectorXd variance = data_->variance();
  const auto axes = detail::axes_of(given, data_->axes);
  for (std::size_t i = 0; given.point && i < axes.size(); ++i)
    covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) += variance[axes[i]];
  const Eigen::VectorXd away = seen.value - seen.rows * data_->parameters.mean;
  return std::sqrt(std::max(0.0, away.dot(covariance.ldlt().solve(away))));
}

template <class Space>
Primitive<Space> Distribution<Space>::mean(const DmpOptions& options) const {
  constexpr Eigen::Index kSamples = 401;
  const auto path = data_->points_with(data_->parameters.mean, kSamples);
  return Primitive<Space>::fit(Demonstration(Eigen::VectorXd::LinSpaced(kSamples, 0.0, duration()),
                                             detail::Geometry<Space>::path_of(path)),
                               options);
}

template <class Space>
typename Space::Trajectory Distribution<Space>::rollout(Eigen::Index samples) const {
  return data_->rollout(data_->parameters.mean, samples);
}

template <class Space>
typename Space::Trajectory Distribution<Space>::sample(std::uint64_t seed, Eigen::Index samples) const {
  detail::SplitMix random(seed);
  Eigen::VectorXd drawn(data_->parameters.mean.size());
  for (double& value : drawn) value = random.normal();
  return data_->rollout(data_->parameters.mean + data_->parameters.factor * drawn, samples);
}

template <class Space>
SpreadOf<Space> Distribution<Space>::spread(Eigen::Index count) const {
  if (count < 2) throw InvalidArgument("count: " + std::to_string(count) + ", expected at least 2 phases.");
  SpreadOf<Space> result{Eigen::VectorXd::LinSpaced(count, 0.0, 1.0), {}, {}};
  result.mean = detail::Geometry<Space>::path_of(data_->points_with(data_->parameters.mean, count));
  const auto moments = data_->moments(result.phase);
  for (Eigen::Index k = 0; k < count; ++k)
    result.covariance.push_back(data_->covariance(result.phase[k], moments[static_cast<std::size_t>(k)]));
  return result;
}

template <class Space>
double Distribution<Space>::log_likelihood(const Demonstration& demonstration) const {
  if (detail::dimension_of<Space>(demonstration) != data_->axes)
    throw InvalidArgument("demonstration: " + std::to_string(detail::dimension_of<Space>(demonstration)) +
                          " dimensions, expected " + std::to_string(data_->axes) + ".");
  const Eigen::VectorXd& time = demonstration.time();
  detail::Deviation deviation =
      detail::deviation_of<Space>(demonstration, time / time[time.size() - 1], data_->reference);
  for (Eigen::Index k = 0; k < time.size(); ++k)
    deviation.value.row(k) -=
        detail::value_of(data_->points.at(deviation.phase[k]), data_->parameters.mean, data_->axes);
  const Eigen::VectorXd variance = data_->variance();
  const double squares = deviation.value.colwise().squaredNorm().transpose().cwiseQuotient(variance).sum();
  const double widths = static_cast<double>(time.size()) * (6.283185307179586 * variance.array()).log().sum();
  return -0.5 * (squares + widths +
                 detail::deviance_change(
                     data_->parameters.factor,
                     detail::information_of(detail::sums_of(data_->points, deviation), variance)));
}

template <class Space>
Eigen::MatrixXd Distribution<Space>::stiffness(double phase, const Eigen::VectorXd& most,
                                               const Eigen::VectorXd& spread) const {
  detail::require_phase(phase, "phase");
  detail::require_positive(most, data_->axes, "most");
  detail::require_positive(spread, data_->axes, "spread");
  const Eigen::VectorXd inverse = spread.cwiseInverse();
  Eigen::MatrixXd inner = inverse.asDiagonal() * data_->covariance(phase) * inverse.asDiagonal();
  inner.diagonal().array() += 1.0;
  const Eigen::VectorXd root = most.cwiseSqrt();
  const Eigen::MatrixXd half = inner.llt().matrixL().solve(Eigen::MatrixXd(root.asDiagonal()));
  return half.transpose() * half;
}

template <class Space>
Distribution<Space> blend(const std::vector<Distribution<Space>>& distributions,
                          const Eigen::VectorXd& weights) {
  detail::require_blendable(distributions, weights);
  auto parameters = distributions.front().parameters();
  const auto reference = detail::reference_from<Space>(parameters.reference);
  const Eigen::Index n = parameters.mean.size();
  Eigen::MatrixXd precision = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd vector = Eigen::VectorXd::Zero(n);
  double duration = 0.0;
  for (std::size_t j = 0; j < distributions.size(); ++j) {
    const double share = weights[static_cast<Eigen::Index>(j)];
    const Eigen::MatrixXd own = share * detail::precision_of(distributions[j].parameters().factor, j);
    precision += own;
    vector += own * detail::mean_about(distributions[j], reference);
    duration += share * distributions[j].duration() / weights.sum();
  }
  const Eigen::LLT<Eigen::MatrixXd> llt(precision);
  parameters.mean = llt.solve(vector);
  parameters.factor = llt.matrixU().solve(Eigen::MatrixXd::Identity(n, n));
  parameters.duration = duration;
  return Distribution<Space>(parameters);
}

}  // namespace dmp
