#include "primitive/rescaling.hpp"

#include "base/text.hpp"

namespace dmp::detail {

std::string guard_text(const DmpOptions& options, ForcingScale::Guard guard, Eigen::Index axis, double way,
                       double demonstrated, double range) {
  std::string name;
  for (const auto& [known, text] : names_of(options.scaling))
    if (known == options.scaling) name = text;
  const bool together = options.scaling == Scaling::rotation_dilation;
  const std::string axes =
      together ? "the axes from " + std::to_string(axis) + " on" : "axis " + std::to_string(axis);
  const std::string what = "scaling: " + axes;
  if (guard == ForcingScale::Guard::short_way)
    return what + (together ? " end " : " ends ") + number(demonstrated) + " from the start and " +
           (together ? "cover " : "covers ") + number(range) + ", too little for " + name +
           ", so the way to a new goal advances as the demonstration does.";
  return what + (together ? " go " : " goes ") + number(way) + ", more than 4 times the demonstrated " +
         number(demonstrated) + ", so what is beyond " + name + " advances as the demonstration does.";
}

}  // namespace dmp::detail
