#include "rwn/simulate/simulate.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "rwn/model/sites.hpp"
#include "rwn/numerics/isa.hpp"
#include "rwn/simulate/active_effects.hpp"
#include "rwn/simulate/simulation_slice.hpp"
#include "rwn/simulate/transfer_function.hpp"

namespace rwn {

namespace baseline {
int simulate_slice(int drive, const SimulationSlice& slice);
}
#ifdef RWN_AVX2
namespace avx2 {
int simulate_slice(int drive, const SimulationSlice& slice);
}
#endif
#ifdef RWN_AVX512
namespace avx512 {
int simulate_slice(int drive, const SimulationSlice& slice);
}
#endif

namespace {

template <std::size_t... I>
std::array<int, effect_count + 1> make_offsets(std::index_sequence<I...>) {
  std::array<int, effect_count + 1> first{};
  first[0] = motor_parameter_count;
  ((first[I + 1] = first[I] + static_cast<int>(std::tuple_element_t<I, Effects>::parameters.size())), ...);
  return first;
}

const std::array<int, effect_count + 1>& offsets() {
  static const auto first = make_offsets(std::make_index_sequence<effect_count>{});
  return first;
}

int simulate_slice(int drive, const SimulationSlice& slice) {
#if defined(RWN_AVX512) && defined(RWN_AVX2)
  if (isa() == Isa::avx512 && slice.width % 8 == 0) return avx512::simulate_slice(drive, slice);
  if (isa() != Isa::baseline) return avx2::simulate_slice(drive, slice);  // vectors that would stay half empty
#elif defined(RWN_AVX512)
  if (isa() == Isa::avx512) return avx512::simulate_slice(drive, slice);
#elif defined(RWN_AVX2)
  if (isa() == Isa::avx2) return avx2::simulate_slice(drive, slice);
#endif
  return baseline::simulate_slice(drive, slice);
}

void require(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(message);
}

bool has_coefficients(int drive) {
  return with_drive(drive, [](auto d) { return decltype(d)::coefficients; });
}

void check_own(const SimulationTask& task) {
  require(task.own.size() <= max_own_effects, "simulate: too many own effects");
  require(!has_coefficients(task.drive) || task.own.empty(),
          "simulate: a transfer function has no equations for own effects");
  const int effects = effect_count + static_cast<int>(task.own.size());
  for (int effect : task.active) {
    require(effect >= 0 && effect < effects, "simulate: no such effect");
    const Site site = effect < effect_count ? site_of(effect)
                                            : site_of(task.own[static_cast<std::size_t>(effect - effect_count)].term);
    require(has_site(task.drive, site), "simulate: the drive's equations have no term for an effect");
  }
}

std::array<OwnProgram, max_own_effects> programs_of(std::span<const OwnEffect> own) {
  std::array<OwnProgram, max_own_effects> found{};
  for (std::size_t k = 0; k < own.size(); ++k) found[k] = own[k].plain();
  return found;
}

void check(const SimulationTask& task, const SimulationOutput& output) {
  const std::size_t n = task.time.size();
  require(task.drive >= 0 && task.drive < drive_count, "simulate: no such kind of drive");
  require(n >= 2, "simulate: at least two samples are needed");
  const std::size_t instants = task.input_time.empty() ? n : task.input_time.size();
  require(task.input.size() == instants, "simulate: the input and its instants differ in length");
  require(task.angle.empty() || task.angle.size() == n, "simulate: time and angle differ in length");
  require(task.restart_every == 0 ||
              (task.restart_every > 0 && task.restart_speed.size() == n && task.restart_position.size() == n),
          "simulate: windows need the recorded motion at every sample");
  require(task.parameters.size() == static_cast<std::size_t>(parameter_count()),
          "simulate: wrong number of parameters");
  require(!has_coefficients(task.drive) || (task.order >= 1 && task.order <= max_order),
          "simulate: order out of range");
  require(task.active.size() <= max_active_effects, "simulate: too many effects at once");
  check_own(task);
  require(joint_count(task.active) <= 1, "simulate: two effects bring a second mass");
  for (int index : task.by) require(index >= 0 && index < parameter_count(), "simulate: no such parameter");
  for (const auto& signal : {output.current, output.speed, output.position}) {
    require(signal.empty() || signal.size() == n, "simulate: an output differs in length from time");
  }
  for (const auto& slope : {output.d_current, output.d_speed, output.d_position}) {
    require(slope.empty() || slope.size() == n * task.by.size(), "simulate: derivatives must be (samples, parameters)");
  }
}

/// Derivatives at once of what is left: the least width of the kernels that holds them.
int width_of(const SimulationTask& task, int columns, int masses) {
  if (columns > 0 && masses == 2) return width_of_two_masses;
  return with_drive(task.drive, [&](auto d) { return width_for<decltype(d)>(columns); });
}

double* pointer(std::span<double> s) { return s.empty() ? nullptr : s.data(); }

constexpr std::string_view status_names[] = {"ok", "diverged", "formula-failed"};

void hold_last(std::span<double> signal, int finite) {
  if (signal.empty()) return;
  const auto kept = signal.begin() + finite;
  std::fill(kept, signal.end(), finite > 0 ? *(kept - 1) : 0.0);
}

}  // namespace

std::string_view to_string(SimulationStatus status) { return status_names[static_cast<std::size_t>(status)]; }

std::string_view advice(SimulationStatus status) {
  constexpr std::string_view texts[] = {
      "The simulation ran to the end.",
      "The simulation left the finite numbers: look for a negative inertia or inductance, or an unstable model.",
      "The formula of an own effect has no finite value somewhere on the way: look for a division by zero, a root or "
      "logarithm of what may be negative, or an overflow; abs, max and tighter bounds of its parameters keep it in "
      "range."};
  return texts[static_cast<std::size_t>(status)];
}

SimulationStatus status_of(std::string_view name) {
  const auto* found = std::find(std::begin(status_names), std::end(status_names), name);
  require(found != std::end(status_names), "simulate: no such status");
  return static_cast<SimulationStatus>(found - std::begin(status_names));
}

int joint_count(std::span<const int> active) {
  return static_cast<int>(std::count_if(active.begin(), active.end(), [](int effect) {
    return effect < effect_count && all_effect_functions<double>[static_cast<std::size_t>(effect)].joint != nullptr;
  }));
}

int parameter_count() { return first_own_parameter() + max_own_effects * max_own_parameters; }

int first_coefficient() { return offsets()[effect_count]; }

int first_own_parameter() { return first_coefficient() + coefficient_count; }

int drive_of(std::string_view name) {
  const auto* found = std::find(drive_names.begin(), drive_names.end(), name);
  require(found != drive_names.end(), "simulate: no such kind of drive");
  return static_cast<int>(found - drive_names.begin());
}

int first_parameter(int effect) { return offsets()[static_cast<std::size_t>(effect)]; }

SimulationStatus simulate(const SimulationTask& task, const SimulationOutput& output) {
  check(task, output);
  const int columns = static_cast<int>(task.by.size());
  std::vector<int> column_of(static_cast<std::size_t>(parameter_count()), -1);
  for (int j = 0; j < columns; ++j) column_of[static_cast<std::size_t>(task.by[static_cast<std::size_t>(j)])] = j;

  const auto programs = programs_of(task.own);
  bool formula_failed = false;
  long work = 0;
  SimulationSlice slice{.settings = static_cast<const RunSettings&>(task),
                        .time = task.time.data(),
                        .input = task.input.data(),
                        .input_time = task.input_time.empty() ? task.time.data() : task.input_time.data(),
                        .inputs = static_cast<int>(task.input.size()),
                        .samples = static_cast<int>(task.time.size()),
                        .parameters = task.parameters.data(),
                        .active = task.active.data(),
                        .active_count = static_cast<int>(task.active.size()),
                        .first_parameter = offsets().data(),
                        .column_of = column_of.data(),
                        .column = 0,
                        .angle = task.angle.empty() ? nullptr : task.angle.data(),
                        .restart_speed = task.restart_speed.data(),
                        .restart_position = task.restart_position.data(),
                        .current = pointer(output.current),
                        .speed = pointer(output.speed),
                        .position = pointer(output.position),
                        .d_current = pointer(output.d_current),
                        .d_speed = pointer(output.d_speed),
                        .d_position = pointer(output.d_position),
                        .columns = columns,
                        .masses = 1 + joint_count(task.active),
                        .first_coefficient = first_coefficient(),
                        .own = programs.data(),
                        .first_own = first_own_parameter(),
                        .formula_failed = &formula_failed,
                        .work = &work,
                        .width = 0};
  int finite = slice.samples;
  do {
    slice.width = width_of(task, columns - slice.column, slice.masses);
    finite = std::min(finite, simulate_slice(task.drive, slice));
    slice.column += std::max(slice.width, 1);
  } while (slice.column < columns && finite == slice.samples);

  if (task.work != nullptr) task.work->add(work);
  if (finite == slice.samples) return SimulationStatus::ok;
  for (const auto& signal : {output.current, output.speed, output.position}) hold_last(signal, finite);
  for (const auto& slope : {output.d_current, output.d_speed, output.d_position}) {
    if (!slope.empty()) std::fill(slope.begin() + finite * columns, slope.end(), 0.0);
  }
  return formula_failed ? SimulationStatus::formula_failed : SimulationStatus::diverged;
}

}  // namespace rwn
