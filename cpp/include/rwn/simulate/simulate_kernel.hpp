// The sample loop around the integrator, for one scalar type. Included by cpp/kernels/simulate.cpp only.
#pragma once

#include "rwn/model/drives.hpp"
#include "rwn/simulate/given_angle.hpp"
#include "rwn/simulate/late_sensor.hpp"
#include "rwn/simulate/plain_run.hpp"
#include "rwn/simulate/plant_of.hpp"
#include "rwn/simulate/simulation_slice.hpp"

namespace rwn {

template <class S, int N, class Drive, int masses = 1>
class Simulation {
  using Plant = typename PlantOf<S, Drive, masses>::type;
  using State = typename Plant::State;
  static constexpr std::size_t w = Plant::w;

 public:
  explicit Simulation(const SimulationSlice& slice) : slice_(slice) {
    for (int k = 0; k < motor_parameter_count; ++k) motor_[static_cast<std::size_t>(k)] = parameter(k);
    int slot = 0;
    for (int a = 0; a < slice_.active_count; ++a) {
      const int effect = slice_.active[a], own = effect - effect_count;
      auto& e = effects_[static_cast<std::size_t>(a)];
      if (own < 0) {
        e = {all_effect_functions<S>[static_cast<std::size_t>(effect)], parameters_.data() + slot, memories_};
        slot = take(slice_.first_parameter[effect], slice_.first_parameter[effect + 1], slot);
      } else {
        auto& formula = owns_[static_cast<std::size_t>(own)];
        formula = {slice_.own[own], stack_.data(), slice_.formula_failed};
        has_own_ = true;
        e = {functions_of(formula), parameters_.data() + slot, memories_, &formula};
        const int first = slice_.first_own + own * max_own_parameters;
        slot = take(first, first + max_own_parameters, slot);
      }
      memories_ += e.call.memories;
    }
    if constexpr (Drive::coefficients) {
      for (int k = 0; k < coefficient_count; ++k)
        coefficients_[static_cast<std::size_t>(k)] = parameter(slice_.first_coefficient + k);
    }
  }

  /// Number of samples that stayed finite.
  int run() {
    Plant integrator = plant();
    if (!integrator.sound()) return 0;
    const int finite = run(integrator);
    *slice_.work += cost_of<S, Plant::n>(integrator.counts(), finite, slice_.width);
    return finite;
  }

 private:
  int run(Plant& integrator) {
    State state = initial(integrator);
    integrator.settle(state);
    prepare(state);
    if (slice_.settings.angle_from_start) given_angle_.first = state.position;
    if constexpr (!Drive::coefficients) {
      if (integrator.plain() && is_plain()) {
        const auto show = [this](int k, const auto& s) { store(k, current_of(s), s.x[w], s.position); };
        return integrator.dry() ? plain_run<true, S>(integrator, state, slice_, show)
                                : plain_run<false, S>(integrator, state, slice_, show);
      }
    }
    for (int k = 0; k < slice_.samples; ++k) {
      if (!std::isfinite(value_of(state.x[w])) || !std::isfinite(value_of(state.position))) return k;
      write(k, state);
      if (has_own_ && *slice_.formula_failed) return k;
      if (slice_.settings.restart_every > 0 && k > 0 && k % slice_.settings.restart_every == 0) {
        state.x[w] = S(slice_.restart_speed[k]);
        given_angle_.jumped += slice_.restart_position[k] - state.position;
        state.position = S(slice_.restart_position[k]);
        integrator.settle(state);
      }
      if (slice_.angle != nullptr) integrator.follow(offset_ = given_angle_.offset(slice_, k, state.position));
      if (k + 1 < slice_.samples) advance(integrator, state, k);
    }
    return slice_.samples;
  }

  /// Whether each input is held from its row to the next, and neither actuators, sensors nor windows do more.
  bool is_plain() const {
    return !delayed_ && break_count_ == 0 && slice_.input_time == slice_.time && !actuates_ && !senses_ && !has_own_ &&
           slice_.settings.restart_every == 0;
  }

  Plant plant() const {
    if constexpr (Drive::coefficients) {
      return {coefficients_.data(), slice_.settings.order, effects_.data(), slice_.active_count};
    } else {
      return {motor_, effects_.data(), slice_.active_count, slice_.settings.angle_per_position};
    }
  }

  /// Puts parameters [begin, end) behind the first `slot` of the active effects; returns how many there are then.
  int take(int begin, int end, int slot) {
    for (int k = begin; k < end; ++k) parameters_[static_cast<std::size_t>(slot++)] = parameter(k);
    return slot;
  }

  S parameter(int index) const {
    const int column = slice_.column_of[index];
    return S::variable(slice_.parameters[index], column < 0 ? -1 : column - slice_.column);
  }

  State initial(const Plant& plant) const {
    if constexpr (Drive::coefficients) {
      return plant.initial();
    } else {
      State s;
      s.x[w] = motor_[initial_speed];
      s.position = motor_[initial_position];
      plant.begin(s);
      return s;
    }
  }

  /// What of the actuators and sensors has to be done at every sample.
  void prepare(State& s) {
    s.memory.use(memories_);
    for (int a = 0; a < slice_.active_count; ++a) {
      const auto& e = effects_[static_cast<std::size_t>(a)];
      if (e.call.delay != nullptr) delay_ += e.call.delay(e.p);
      delayed_ = delayed_ || e.call.delay != nullptr || e.call.late != nullptr;
      if (e.call.late != nullptr) late_.add(slice_, e.call.late(e.p), e.call.late_current);
      if (e.call.breaks != nullptr) {
        for (const S& instant : e.call.breaks(e.p)) breaks_[static_cast<std::size_t>(break_count_++)] = instant;
      }
      follows_ = follows_ || e.call.follow != nullptr;
      actuates_ = actuates_ || e.call.actuate != nullptr || e.call.follow != nullptr ||
                  (e.own != nullptr && e.own->term() == Term::input);
      senses_ = senses_ || e.call.sense != nullptr || (e.own != nullptr && is_sensor(e.own->term()));
      Reading<S> first = reading(s);
      first.input = S(slice_.settings.input_before);
      if (e.call.begin != nullptr) e.call.begin(e.p, first, s.memory.data() + e.memory);
    }
    late_.keep_until(slice_, slice_.time[0], [&] { return sensed(0, s); });
  }

  /// What acts in place of a command over the next h, after the instant of sample k.
  S acting(double command, State& s, const S& h, int k) const {
    return actuates_ ? actuated(command, s, h, k) : S(command);
  }

  [[gnu::noinline]] S actuated(double command, State& s, const S& h, int k) const {
    S input(command);
    for (int a = 0; a < slice_.active_count; ++a) {
      const auto& e = effects_[static_cast<std::size_t>(a)];
      if (e.call.actuate != nullptr) input = e.call.actuate(e.p, input);
      if (e.call.follow != nullptr) input = e.call.follow(e.p, h, input, s.memory.data() + e.memory);
      if (e.own != nullptr && e.own->term() == Term::input) input = e.own->value(e.p, motor_, motion(s, input, k));
    }
    return input;
  }

  /// Where the motor is at sample k, as formulas of actuators and sensors see it.
  Motion<S> motion(const State& s, const S& input, int k) const {
    Motion<S> x;
    x.time = slice_.time[k] - slice_.time[0];
    x.input = input;
    const Reading<S> y = reading(s);
    x.current = y.current;
    x.speed = y.speed;
    const bool recorded = slice_.angle != nullptr && !slice_.settings.angle_from_speed;
    const S angle = recorded ? slice_.angle[k] + given_angle_.first : y.position + offset_;
    x.angle = slice_.settings.angle_per_position * angle;
    x.angle_per_position = slice_.settings.angle_per_position;
    x.drive_torque = drive_torque(s, input);
    if constexpr (!Drive::coefficients) x.direction = s.direction;
    return x;
  }

  S drive_torque(const State& s, const S& input) const {
    if constexpr (Drive::coefficients) {
      return input;
    } else {
      return typename Drive::template Electrics<S>(motor_).torque(s.x, S(1.0), input);
    }
  }

  double command(int index) const { return index < 0 ? slice_.settings.input_before : slice_.input[index]; }

  void advance(Plant& integrator, State& s, int k) {
    const double begin = slice_.time[k];
    const double end = slice_.time[k + 1];
    if (!delayed_ && break_count_ == 0 && slice_.input_time == slice_.time) {
      advance_held(integrator, s, S(end - begin), slice_.input[k], k, begin - slice_.time[0]);
      return;
    }
    advance_pieces(integrator, s, k, begin, end);
  }

  /// Over h from `time` on, in which the command is held, after the instant of sample k.
  void advance_held(Plant& integrator, State& s, const S& h, double command, int k, double time) {
    const int parts = follows_ ? parts_followed : 1;
    const S part = h / static_cast<double>(parts);
    for (int j = 0; j < parts; ++j) {
      integrator.advance(s, part, acting(command, s, part, k), time + j * value_of(part));
    }
  }

  /// Splits the interval at instants that depend on parameters: of late commands, breaks of effects and late sensors.
  void advance_pieces(Plant& integrator, State& s, int k, double begin, double end) {
    S at(begin);
    while (row_ + 1 < slice_.inputs && slice_.input_time[row_ + 1] + value_of(delay_) <= begin) ++row_;
    int row = row_;
    while (value_of(at) < end) {
      S next(end);
      bool changes = false;
      if (row + 1 < slice_.inputs && slice_.input_time[row + 1] + value_of(delay_) < end) {
        next = slice_.input_time[row + 1] + delay_;
        changes = true;
      }
      for (int b = 0; b < break_count_; ++b) {
        const S instant = breaks_[static_cast<std::size_t>(b)] + slice_.time[0];
        if (value_of(instant) > value_of(at) && value_of(instant) < value_of(next)) {
          next = instant;
          changes = false;
        }
      }
      if (late_.show_sooner(slice_, next)) changes = false;
      advance_held(integrator, s, next - at, command(row), k, value_of(at) - slice_.time[0]);
      at = next;
      late_.keep_until(slice_, value_of(at), [&] { return sensed(k, s); });
      if (changes) ++row;
    }
  }

  static S current_of(const auto& s) {
    if constexpr (Drive::coefficients) return S(0.0);
    if constexpr (!Drive::coefficients) return Drive::template Electrics<S>::current(s.x);
  }

  Reading<S> reading(const State& s) const {
    return {.current = current_of(s), .speed = s.x[w], .position = s.position};
  }

  void write(int k, const State& s) {
    Reading<S> y = sensed(k, s);
    late_.show(k, y);
    if (slice_.settings.angle_from_speed) given_angle_.integrate(slice_, k, y.speed);
    store(k, y.current, y.speed, y.position);
  }

  /// What sensors show of a state, be it late or not.
  Reading<S> sensed(int k, const State& s) const {
    Reading<S> y = reading(s);
    if (senses_) sense(k, s, y);
    return y;
  }

  [[gnu::noinline]] void sense(int k, const State& s, Reading<S>& y) const {
    for (int a = 0; a < slice_.active_count; ++a) {
      const auto& e = effects_[static_cast<std::size_t>(a)];
      if (e.call.sense != nullptr) e.call.sense(e.p, y, s.memory.data() + e.memory);
      if (e.own != nullptr && is_sensor(e.own->term()))
        e.own->sense(e.p, motor_, motion(s, S(command(slice_.input_time == slice_.time ? k - 1 : row_)), k), y);
    }
  }

  void store(int k, const S& current, const S& speed, const S& position) const {
    store(k, current, slice_.current, slice_.d_current);
    store(k, speed, slice_.speed, slice_.d_speed);
    store(k, position, slice_.position, slice_.d_position);
  }

  void store(int k, const S& y, double* values, double* slopes) const {
    if (values != nullptr) values[k] = value_of(y);
    if constexpr (N > 0) {
      if (slopes == nullptr) return;
      const int count = std::min(N, slice_.columns - slice_.column);
      double* row = slopes + static_cast<std::ptrdiff_t>(k) * slice_.columns + slice_.column;
      for (int j = 0; j < count; ++j) row[j] = y.d[j];
    }
  }

  const SimulationSlice& slice_;
  Motor<S> motor_{};
  std::array<S, max_active_parameters> parameters_{};
  std::array<ActiveEffect<S>, max_active_effects> effects_{};
  std::array<ActiveOwnEffect<S>, max_own_effects> owns_{};
  std::array<S, formula_depth> stack_{};
  std::array<S, Drive::coefficients ? coefficient_count : 0> coefficients_{};
  S delay_{0.0};
  GivenAngle<S> given_angle_;
  S offset_{0.0};  // angle minus position, 0 where none is given
  LateSensors<S> late_;
  std::array<S, 8> breaks_{};
  int break_count_ = 0, memories_ = 0;
  int row_ = -1;  // the last input that had acted when the last interval began
  static constexpr int parts_followed = 10;  // of a held command, each with the mean of what follows it: exact to 1e-4
  bool delayed_ = false, actuates_ = false, follows_ = false, senses_ = false, has_own_ = false;
};

}  // namespace rwn
