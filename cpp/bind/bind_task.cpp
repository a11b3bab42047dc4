#include <tuple>

#include "task.hpp"

namespace rwn::bind {
namespace {

/// What Python gives for a field of this type, where it has no value of its own, and how a task keeps it.
template <class T>
struct Kept {
  using Given = T;
  static Given standard(const T& field) { return field; }
  static void keep(Task&, T& field, const Given& given) { field = given; }
};

template <>
struct Kept<std::span<const double>> {
  using Given = Array;
  static Given standard(std::span<const double>) { return Array(0); }
  static void keep(Task& task, std::span<const double>& field, const Given& given) {
    task.arrays.push_back(given);
    field = view(given);
  }
};

template <>
struct Kept<std::span<const OwnEffect>> {
  using Given = std::vector<OwnEffect>;
  static Given standard(std::span<const OwnEffect>) { return {}; }
  static void keep(Task& task, std::span<const OwnEffect>&, const Given& given) { task.own = given; }  // Task::with
};

/// A field of a SimulationTask as a keyword argument: required, or with what the struct holds by itself.
template <auto member, bool required = false>
struct Field {
  using Type = std::remove_reference_t<decltype(std::declval<SimulationTask&>().*member)>;
  using Given = typename Kept<Type>::Given;
  const char* name;

  auto argument() const {
    if constexpr (required) {
      return py::arg(name).noconvert();
    } else {
      return py::arg(name) = Kept<Type>::standard(SimulationTask{}.*member);
    }
  }
  static void keep(Task& task, const Given& given) { Kept<Type>::keep(task, task.fixed.*member, given); }
};

/// In the order in which `rwn._core.Task` lists them.
constexpr std::tuple task_fields{
    Field<&SimulationTask::time, true>{"time"},
    Field<&SimulationTask::input, true>{"input"},
    Field<&SimulationTask::input_time>{"input_time"},
    Field<&SimulationTask::angle_per_position>{"angle_per_position"},
    Field<&SimulationTask::input_before>{"input_before"},
    Field<&SimulationTask::angle>{"angle"},
    Field<&SimulationTask::angle_from_speed>{"angle_from_speed"},
    Field<&SimulationTask::angle_from_start>{"angle_from_start"},
    Field<&SimulationTask::restart_every>{"restart_every"},
    Field<&SimulationTask::restart_speed>{"restart_speed"},
    Field<&SimulationTask::restart_position>{"restart_position"},
    Field<&SimulationTask::order>{"order"},
    Field<&SimulationTask::own>{"own"}};

template <class... Fields>
void define(py::class_<Task>& task, const std::tuple<Fields...>&) {
  const auto make = [](const std::string& drive, const typename Fields::Given&... given) {
    Task made;
    made.fixed.drive = drive_of(drive);
    (Fields::keep(made, given), ...);
    return made;
  };
  const auto with = [&](const auto&... f) { task.def(py::init(make), "drive"_a, py::kw_only(), f.argument()...); };
  std::apply(with, task_fields);
}

}  // namespace

void bind_task(py::module_& m) {
  py::class_<Task> task(m, "Task", "What is simulated: a drive, the input of one run, and what its effects follow.");
  define(task, task_fields);
}

}  // namespace rwn::bind
