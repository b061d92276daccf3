#pragma once

#include <dmp/file.hpp>

#include <string>

#include "model_file/json_fields.hpp"

namespace dmp::detail {

/// Text to JSON, refusing repeated keys, deep nesting, more than 100 objects or keys in one of them, and
/// more than 10^6 numbers or lists, while it is read.
Json parse_json(const std::string& text);
/// Throws InvalidArgument for a model that the reader would refuse for its size.
void require_readable(const Model& model);
Json model_to_json(const Model& model);
Model model_from_json(const Json& json);

}  // namespace dmp::detail
