#include "rwn/simulate/unknown_inputs.hpp"

#include <array>
#include <limits>
#include <stdexcept>
#include <vector>

#include "rwn/simulate/equations.hpp"

namespace rwn {
namespace {

struct Plain {};
using Real = Dual<0, Plain>;

void require(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(message);
}

/// The switched-on effects of a task, of numbers without derivatives.
class TaskEffects {
 public:
  explicit TaskEffects(const SimulationTask& task) : values_(task.parameters.begin(), task.parameters.end()) {
    std::copy_n(values_.begin(), motor_parameter_count, motor.begin());
    for (const OwnEffect& effect : task.own) own_.emplace_back(effect.plain(), stack_.data(), &failed);
    for (int effect : task.active) {
      if (effect >= effect_count) {
        const int slot = effect - effect_count;
        const auto& formula = own_.at(static_cast<std::size_t>(slot));
        active.push_back(
            {functions_of(formula), at(first_own_parameter() + slot * max_own_parameters), memories, &formula});
        continue;
      }
      const auto& call = all_effect_functions<Real>[static_cast<std::size_t>(effect)];
      active.push_back({call, at(first_parameter(effect)), memories});
      memories += call.memories;
      masses = call.joint != nullptr ? 2 : masses;
    }
  }
  TaskEffects(const TaskEffects&) = delete;  // its parts refer to each other
  TaskEffects& operator=(const TaskEffects&) = delete;

  Motor<Real> motor{};
  std::vector<ActiveEffect<Real>> active;
  int memories = 0, masses = 1;
  bool failed = false;

 private:
  const Real* at(int parameter) const { return values_.data() + parameter; }

  std::vector<Real> values_;
  std::array<Real, formula_depth> stack_{};
  std::vector<ActiveOwnEffect<Real>> own_;
};

template <class Drive, int masses>
void along(const SimulationTask& task, const GivenMotion& motion, std::span<double> torque, std::span<double> voltage) {
  TaskEffects effects(task);
  Equations<Real, Drive, masses> equations(effects.motor, effects.active.data(),
                                           static_cast<int>(effects.active.size()), task.angle_per_position);
  using State = DriveState<Real, Drive, masses>;
  const auto move = [&](State& s, std::size_t k) {
    s.x[State::w] = motion.speed[k];
    s.position = motion.position[k];
    s.direction = motion.speed[k] > 0.0 ? 1.0 : motion.speed[k] < 0.0 ? -1.0 : 0.0;
    if constexpr (Drive::states > 0) {
      const Real rest = equations.electrics().resting_current(s.x[State::w], Real(task.input[k]));
      s.x[0] = motion.current.empty() ? rest : Real(motion.current[k]);
    }
  };
  State s;
  move(s, 0);
  s.memory.use(effects.memories);
  const auto carried = [&](State& of, std::size_t k) {
    const Real driving = equations.electrics().torque(of.x, Real(1.0), Real(task.input[k]));
    if constexpr (masses == 2) equations.second().carry(of, motion.acceleration[k], driving);
  };
  if constexpr (masses == 2) equations.second().begin(s);
  if (equations.second().drives()) carried(s, 0);
  for (std::size_t k = 0; k < task.time.size(); ++k) {
    equations.begin(Real(task.input[k]), task.time[k] - task.time[0]);
    if constexpr (masses == 2) {
      if (!equations.second().drives()) equations.second().touch(s);
    }
    effects.failed = false;
    const UnknownInputs<Real> left =
        equations.unknown(s, motion.acceleration[k], motion.current_slope.empty() ? 0.0 : motion.current_slope[k]);
    torque[k] = effects.failed ? std::numeric_limits<double>::quiet_NaN() : left.torque.v;
    if (!voltage.empty()) voltage[k] = effects.failed ? std::numeric_limits<double>::quiet_NaN() : left.voltage.v;
    if (k + 1 == task.time.size()) break;
    State next = s;
    const double h = task.time[k + 1] - task.time[k];
    move(next, k + 1);
    if (equations.second().drives()) {
      carried(next, k + 1);
    } else if constexpr (masses == 2) {
      equations.second().follow(next, s.x[State::w], next.x[State::w], h);
    }
    equations.finish(s, next, Real(h));
    s = next;
  }
}

}  // namespace

void unknown_inputs(const SimulationTask& task, const GivenMotion& motion, std::span<double> torque,
                    std::span<double> voltage) {
  const std::size_t n = task.time.size();
  require(n > 0 && task.input.size() == n && task.input_time.empty() && motion.speed.size() == n &&
              motion.position.size() == n && motion.acceleration.size() == n && torque.size() == n,
          "unknown_inputs: the signals differ in length");
  require(
      motion.current.size() == motion.current_slope.size() && (motion.current.empty() || motion.current.size() == n),
      "unknown_inputs: the current and its slope differ in length from time");
  require(voltage.empty() || voltage.size() == n, "unknown_inputs: voltage differs in length from time");
  require(task.parameters.size() == static_cast<std::size_t>(parameter_count()),
          "unknown_inputs: wrong number of parameters");
  const bool two = joint_count(task.active) > 0;
  with_drive(task.drive, [&](auto d) {
    using Drive = decltype(d);
    if constexpr (Drive::coefficients) {
      require(false, "unknown_inputs: a transfer function has no equations of motion");
    } else {
      two ? along<Drive, 2>(task, motion, torque, voltage) : along<Drive, 1>(task, motion, torque, voltage);
    }
  });
}

}  // namespace rwn
