#pragma once

#include <dmp/average.hpp>

#include <string>

#include "primitive/fitting.hpp"

namespace dmp {

namespace detail {

/// Throws InvalidArgument, naming the first option of a run in which model j differs from the first. How the
/// weights were found, and in which kernels, may differ.
void require_same(const DmpOptions& first, const DmpOptions& other, std::size_t j);
bool same_basis(const DmpOptions& a, const DmpOptions& b) noexcept;

/// Weights (N x columns) of one basis in another one, by ridge regression.
RowMatrix in_basis(const RowMatrix& weights, const DmpOptions& from, const DmpOptions& to);

/// The model with the most kernels, the first of several.
template <class Space>
const Primitive<Space>& finest(const std::vector<Primitive<Space>>& models) {
  std::size_t best = 0;
  for (std::size_t j = 1; j < models.size(); ++j)
    if (models[j].options().basis_count > models[best].options().basis_count) best = j;
  return models[best];
}

/// The same model in the kernels that other options name.
template <class Space>
Primitive<Space> with_kernels_of(const Primitive<Space>& model, const DmpOptions& options) {
  if (same_basis(model.options(), options)) return model;
  auto parameters = model.parameters();
  parameters.weights = in_basis(parameters.weights, model.options(), options);
  if (parameters.advance.size() > 0)
    parameters.advance = in_basis(parameters.advance, model.options(), options);
  parameters.options.basis_count = options.basis_count;
  parameters.options.kernels = options.kernels;
  parameters.options.overlap = options.overlap;
  return Primitive<Space>(parameters);
}

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
Primitive<Space> average(const std::vector<Primitive<Space>>& given) {
  detail::require_alike(given);
  const DmpOptions options = detail::finest(given).options();
  std::vector<Primitive<Space>> models;
  for (const Primitive<Space>& model : given) models.push_back(detail::with_kernels_of(model, options));
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
  typename Space::Parameters mean = detail::mean_of<Space>(motions, options);
  // As where the demonstrations are learned together: what advances with the difference of their ways is no
  // part of what the mean goes by.
  const detail::Ends<Space> ends = detail::Geometry<Space>::ends_of(mean);
  for (std::size_t j = 0; j < models.size(); ++j)
    detail::take_out_advance<Space>(weights, 1.0 / static_cast<double>(models.size()),
                                    models[j].parameters().advance, detail::way_of<Space>(motions.ends[j]),
                                    ends, mean.options);
  mean.weights = weights;
  mean.advance = advance;
  return Primitive<Space>(mean);
}

}  // namespace dmp
