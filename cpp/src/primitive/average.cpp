#include "primitive/average.hpp"

#include <dmp/error.hpp>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "primitive/option_fields.hpp"

namespace dmp::detail {
namespace {

/// Lists the options as text, for a message that compares two of them.
class OptionText {
 public:
  explicit OptionText(std::vector<std::pair<std::string, std::string>>& texts) : texts_(texts) {}
  void operator()(const char* name, double value) const { texts_.emplace_back(name, exact_number(value)); }
  void operator()(const char* name, int value) const { texts_.emplace_back(name, std::to_string(value)); }
  void operator()(const char* name, bool value) const { texts_.emplace_back(name, value ? "true" : "false"); }
  void operator()(const char* name, const std::optional<double>& value) const {
    (*this)(name, value.value());
  }
  template <class Enum>
  void operator()(const char* name, Enum value, const Names<Enum>& names) const {
    for (const auto& [known, text] : names)
      if (known == value) texts_.emplace_back(name, "\"" + std::string(text) + "\"");
  }

 private:
  std::vector<std::pair<std::string, std::string>>& texts_;
};

}  // namespace

bool same_basis(const DmpOptions& a, const DmpOptions& b) noexcept {
  return a.basis_count == b.basis_count && a.kernels == b.kernels && a.overlap == b.overlap;
}

RowMatrix in_basis(const RowMatrix& weights, const DmpOptions& from, const DmpOptions& to) {
  const Eigen::Index samples = 10 * static_cast<Eigen::Index>(std::max(from.basis_count, to.basis_count)) + 1;
  const ForcingTerm forcing(basis_of(from), weights);
  ForcingTarget target{
      Eigen::VectorXd::LinSpaced(samples, 0.0, 1.0), {}, Eigen::VectorXd::Ones(weights.cols())};
  target.value = forcing.evaluate(target.s);
  DmpOptions closely = to;
  closely.regression = Regression::ridge;
  return fit_forcing(basis_of(to), {target}, closely);
}

void require_same(const DmpOptions& first, const DmpOptions& other, std::size_t j) {
  if (first == other) return;
  const std::set<std::string> how_learned{"basis_count", "kernels", "overlap",    "regression",
                                          "passes",      "ridge",   "derivatives"};
  std::vector<std::pair<std::string, std::string>> expected;
  std::vector<std::pair<std::string, std::string>> came;
  visit_options(OptionText(expected), first);
  visit_options(OptionText(came), other);
  for (std::size_t k = 0; k < expected.size(); ++k)
    if (came[k].second != expected[k].second && how_learned.count(came[k].first) == 0)
      throw InvalidArgument("models[" + std::to_string(j) + "]: options." + came[k].first + " is " +
                            came[k].second + ", expected " + expected[k].second +
                            " as in the first. Fit the demonstrations together.");
}

}  // namespace dmp::detail
