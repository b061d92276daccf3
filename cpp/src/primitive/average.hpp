#pragma once

#include <dmp/average.hpp>

#include <string>

#include "primitive/fitting.hpp"

namespace dmp {

namespace detail {

/// Throws InvalidArgument, naming the first option in which model j differs from the first.
void require_same(const DmpOptions& first, const DmpOptions& other, std::size_t j);

template <class Space>
void require_alike(const std::vector<Primitive<Space>>& models) {
  if (models.empty()) throw InvalidArgument("models: none, expected at least one.");
  for (std::size_t j = 1; j < models.size(); ++j) {
    require_same(models[0].options(), models[j].options(), j);
    if (models[j].dimension() != models[0].dimension())
      throw InvalidArgument("models: of different dimensions, expected one for all.");
  }
}

/// Throws InvalidArgument unless all turn along with the same rotation, if with any.
template <class Space>
void require_one_reference(const std::vector<Ends<Space>>& ends) {
  const RowMatrix& first = ends.front().reference;
  for (std::size_t j = 1; j < ends.size(); ++j)
    if (ends[j].reference.rows() != first.rows() || ends[j].reference != first)
      throw InvalidArgument(indexed("models", static_cast<long>(j)) +
                            ": turns along with another rotation than the first. Fit the demonstrations "
                            "together.");
}

}  // namespace detail

template <class Space>
Primitive<Space> average(const std::vector<Primitive<Space>>& models) {
  detail::require_alike(models);
  const RowMatrix& first = models[0].parameters().weights;
  RowMatrix weights = RowMatrix::Zero(first.rows(), first.cols());
  RowMatrix advance =
      RowMatrix::Zero(models[0].parameters().advance.rows(), models[0].parameters().advance.cols());
  detail::Motions<Space> motions;
  for (const Primitive<Space>& model : models) {
    motions.durations.push_back(model.duration());
    motions.ends.push_back(detail::Geometry<Space>::ends_of(model.parameters()));
    weights += 1.0 / static_cast<double>(models.size()) * model.parameters().weights;
    advance += 1.0 / static_cast<double>(models.size()) * model.parameters().advance;
  }
  detail::require_one_reference(motions.ends);
  typename Space::Parameters mean = detail::mean_of<Space>(motions, models[0].options());
  // As where the demonstrations are learned together: what advances with the difference of their ways is no
  // part of what the mean goes by.
  const Eigen::VectorXd displacement = detail::Geometry<Space>::ends_of(mean).displacement;
  for (std::size_t j = 0; j < models.size(); ++j)
    detail::take_out_advance<Space>(weights, 1.0 / static_cast<double>(models.size()),
                                    models[j].parameters().advance, motions.ends[j], displacement);
  mean.weights = weights;
  mean.advance = advance;
  return Primitive<Space>(mean);
}

}  // namespace dmp
