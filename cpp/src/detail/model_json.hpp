#pragma once

#include <dmp/file.hpp>

#include <string>

#include "detail/json_fields.hpp"

namespace dmp::detail {

/// Text to JSON, refusing repeated keys, deep nesting and more than 10^6 numbers while it is read.
Json parse_json(const std::string& text);
Json model_to_json(const Model& model);
Model model_from_json(const Json& json);

}  // namespace dmp::detail
