// Any bytes as a model file: an InvalidArgument, or a model that is written and read again to the same text
// and runs.
#include <dmp/error.hpp>
#include <dmp/file.hpp>

#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

template <class Space>
void run(const dmp::Primitive<Space>& model) {
  dmp::Stepper<Space>(model).step(1e-3 * model.duration());
}

template <class Space>
void run(const dmp::Sequence<Space>& models) {
  dmp::SequenceRun<Space>(models).step(1e-3 * models.duration());
}

template <class Space>
void run(const dmp::Distribution<Space>& motions) {
  motions.rollout(2);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const dmp::Model model = dmp::from_json(std::string(reinterpret_cast<const char*>(data), size));
    const std::string text = dmp::to_json(model);
    if (dmp::to_json(dmp::from_json(text)) != text) std::abort();
    std::visit([](const auto& kind) { run(kind); }, model);
  } catch (const dmp::InvalidArgument&) {
  }
  return 0;
}
