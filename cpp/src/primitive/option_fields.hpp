#pragma once

#include <dmp/options.hpp>

#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace dmp::detail {

template <class Visitor, class Field>
void visit_option(const Visitor& visit, const char* name, Field& field) {
  if constexpr (std::is_enum_v<std::remove_const_t<Field>>) {
    visit(name, field, names_of(field));
  } else {
    visit(name, field);
  }
}

/// Calls visit(name, field) for every option, or visit(name, field, names) for an enumeration.
template <class Visitor, class Options>
void visit_options(const Visitor& visit, Options& options) {
  std::apply([&](const auto&... field) { (visit_option(visit, field.first, options.*field.second), ...); },
             DmpOptions::fields());
}

}  // namespace dmp::detail
