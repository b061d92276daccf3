#pragma once

#include <dmp/distribution.hpp>
#include <dmp/dmp.hpp>
#include <dmp/export.hpp>
#include <dmp/orientation_dmp.hpp>
#include <dmp/pose_dmp.hpp>
#include <dmp/pose_gripper_dmp.hpp>
#include <dmp/sequence.hpp>

#include <string>
#include <variant>

/// Model files: JSON, versioned, every number as it was to the last bit. Schema: docs/model-file.md.
namespace dmp {

using Model = std::variant<Dmp, OrientationDmp, PoseDmp, PoseGripperDmp, DmpSequence, OrientationDmpSequence,
                           PoseDmpSequence, PoseGripperDmpSequence, DmpDistribution, OrientationDistribution,
                           PoseDistribution, PoseGripperDistribution>;

/// Throws InvalidArgument for a model that from_json would refuse for its size.
DMP_EXPORT std::string to_json(const Model& model);
/// Throws InvalidArgument, naming the place, for text that is no JSON, another format, another version, an
/// unknown kind or enumerator, a missing or repeated key, wrong sizes or numbers; for more than 64 MiB,
/// 10^6 numbers or lists, 100 objects, or 100 keys in one.
DMP_EXPORT Model from_json(const std::string& text);

/// Writes a temporary file beside `path`, flushes it to disk and renames it: the file is there whole or not
/// at all, with the permissions of the file that it replaces, or else of any new file. Throws FileError;
/// InvalidArgument as to_json.
DMP_EXPORT void save(const Model& model, const std::string& path);
/// Throws FileError if the file cannot be read, InvalidArgument if it is no model.
DMP_EXPORT Model load(const std::string& path);
/// The same for a caller who knows the kind. Throws InvalidArgument if the file holds another.
DMP_EXPORT Dmp load_dmp(const std::string& path);
DMP_EXPORT OrientationDmp load_orientation_dmp(const std::string& path);
DMP_EXPORT PoseDmp load_pose_dmp(const std::string& path);
DMP_EXPORT PoseGripperDmp load_pose_gripper_dmp(const std::string& path);

}  // namespace dmp
