// A method marked DMP_REALTIME that takes memory: RealtimeSanitizer must stop it, or its silence elsewhere
// means nothing.
#include <dmp/realtime.hpp>

#include <vector>

namespace {

struct Loop {
  std::vector<double> memory;
  void step() noexcept DMP_REALTIME { memory.resize(memory.size() + 1000); }
};

}  // namespace

int main() { Loop().step(); }
