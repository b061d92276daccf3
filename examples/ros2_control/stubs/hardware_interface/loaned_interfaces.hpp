#pragma once
// The values that hardware lends to a controller. Real ones are handed over under a lock that is tried, not
// waited for, so that either direction can fail: `locked` is another thread that holds it.

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace hardware_interface {

struct Handle {
  explicit Handle(std::string its_name, double start = std::numeric_limits<double>::quiet_NaN())
      : name(std::move(its_name)), value(start) {}

  std::string name;  // joint/kind
  double value;
  bool locked = false;
};
struct StateInterface : Handle {
  using ConstSharedPtr = std::shared_ptr<const StateInterface>;
  using Handle::Handle;
};
struct CommandInterface : Handle {
  using SharedPtr = std::shared_ptr<CommandInterface>;
  using Handle::Handle;
};

class LoanedStateInterface {
 public:
  explicit LoanedStateInterface(StateInterface::ConstSharedPtr state) : state_(std::move(state)) {}
  LoanedStateInterface(const LoanedStateInterface&) = delete;
  LoanedStateInterface(LoanedStateInterface&&) = default;

  const std::string& get_name() const { return state_->name; }
  template <typename T = double>
  [[nodiscard]] std::optional<T> get_optional(unsigned int /*max_tries*/ = 10) const {
    return state_->locked ? std::nullopt : std::optional<T>(state_->value);
  }

 private:
  StateInterface::ConstSharedPtr state_;
};

class LoanedCommandInterface {
 public:
  explicit LoanedCommandInterface(CommandInterface::SharedPtr command) : command_(std::move(command)) {}
  LoanedCommandInterface(const LoanedCommandInterface&) = delete;
  LoanedCommandInterface(LoanedCommandInterface&&) = default;

  const std::string& get_name() const { return command_->name; }
  template <typename T>
  [[nodiscard]] bool set_value(const T& value, unsigned int /*max_tries*/ = 10) {
    if (!command_->locked) command_->value = value;
    return !command_->locked;
  }
  template <typename T = double>
  [[nodiscard]] std::optional<T> get_optional(unsigned int /*max_tries*/ = 10) const {
    return command_->locked ? std::nullopt : std::optional<T>(command_->value);
  }

 private:
  CommandInterface::SharedPtr command_;
};

}  // namespace hardware_interface
