// What takes the state over a step of given length: matrices, made once for each length that occurs again, or a series
// for a length that does not.
#pragma once

#include <algorithm>
#include <utility>

#include "rwn/simulate/equations.hpp"
#include "rwn/numerics/flow.hpp"
#include "rwn/numerics/room.hpp"
#include "rwn/simulate/step_counts.hpp"
#include "rwn/simulate/step_matrices.hpp"

namespace rwn {

/// What a length is used for: parts of the interval between samples, which occur again; the rest after an event, which
/// does not; or the search for an instant, which needs values without derivatives.
enum class Use { intervals, rests, search };

template <class S, class Drive, int masses>
class Operators {
 public:
  using Matrix = typename Equations<S, Drive, masses>::Matrix;
  using Vector = typename Equations<S, Drive, masses>::Vector;
  using Value = typename S::Value;
  static constexpr int n = Equations<S, Drive, masses>::n;

  /// The linear part, and its values.
  struct System {
    Regime regime{};
    Matrix a{};
    SmallMatrix<double, n> value{};
    double norm = 0.0;
    double fastest = 0.0;  // bound on the rates of its solutions
  };

  template <class T>
  using LinearStep = LinearMatrices<T, n>;

  /// In scalar T: S, or values alone.
  template <class T>
  struct Step : StepMatrices<T, n> {
    double h = -1.0;
    Regime regime{};

    /// x after half the step with f.
    RWN_INLINE Vector half(const Vector& x, const Vector& f) const {
      SmallVector<T, n> y{};
      add_product<T, n>(y, this->eh, in<T>(x));
      add_product<T, n>(y, this->p1h, in<T>(f));
      return in<S>(y);
    }

    /// x after the step with f at its start, `middle` twice the mean of f halfway, and `last` at its end.
    RWN_INLINE Vector whole(const Vector& x, const Vector& f, const Vector& middle, const Vector& last) const {
      SmallVector<T, n> y{};
      add_product<T, n>(y, this->e, in<T>(x));
      add_product<T, n>(y, this->f1, in<T>(f));
      add_product<T, n>(y, this->f2, in<T>(middle));
      add_product<T, n>(y, this->f3, in<T>(last));
      return in<S>(y);
    }
  };

  /// The same along the way, in scalar T: S, or values alone.
  template <class T>
  struct Passage {
    SmallMatrix<T, n> a;
    double norm, h;

    /// Parts in which the series of a nonlinear step are gone along.
    int parts() const { return 3 * parts_of_flow<S>(0.5 * norm * h) + parts_of_flow<S>(norm * h); }

    RWN_INLINE Vector half(const Vector& x, const Vector& f) const { return over(0.5 * h, x, {as<T>(f)}); }

    RWN_INLINE Vector whole(const Vector& x, const Vector& f, const Vector& middle, const Vector& last) const {
      Flow<T, n> force{as<T>(f)};  // the quadratic whose phi functions are the weights of Cox and Matthews
      for (std::size_t j = 0; j < n; ++j) {
        const T begin = force.constant[j], half = as_scalar<T>(middle[j]), end = as_scalar<T>(last[j]);
        force.linear[j] = 2.0 * half - 3.0 * begin - end;
        force.quadratic[j] = 4.0 * (begin - half + end);
      }
      return over(h, x, force);
    }

    Vector over(double length, const Vector& x, const Flow<T, n>& force) const {
      SmallVector<T, n> y = as<T>(x), way{};
      flow<T, n>(a, norm, length, force, y, way);
      return as<S>(y);
    }
  };

  StepCounts counts;  // kept by those who step

  explicit Operators(const Equations<S, Drive, masses>& equations) : equations_(equations) {}

  const System& system(const Regime& regime) {
    for (const System& s : systems_) {
      if (s.regime == regime) return s;
    }
    System& slot = next_of(systems_, next_system_);
    slot = {.regime = regime, .a = equations_.system_matrix(regime)};
    for (std::size_t k = 0; k < slot.a.size(); ++k) slot.value[k] = value_of(slot.a[k]);
    slot.norm = norm_of<S, n>(slot.a);
    slot.fastest = balanced_norm<n>(slot.value);
    return slot;
  }

  const Step<S>& over(double h, const Regime& regime) {
    if (const Step<S>* known = find(h, regime)) return *known;
    const std::size_t k = made_ < most_steps ? made_++ : std::exchange(next_step_, (next_step_ + 1) % most_steps);
    lengths_[k] = h;
    make(steps_[k], h, regime);
    return steps_[k];
  }

  /// Whether two lengths are equal but for the rounding of times.
  static bool same(double h, double other) { return std::abs(other - h) <= same_length * h; }

  /// The step of an interval between samples: its own for a length that occurs again, interpolated between those of a
  /// grid of lengths for one that does not, as where rows are off their clock.
  const Step<S>& of_interval(double h, const Regime& regime) {
    if (const Step<S>* known = find(h, regime)) return *known;
    const bool again = std::any_of(missed_.begin(), missed_.end(), [h](double m) { return same(h, m); });
    if (!again) next_of(missed_, next_missed_) = h;
    const System& s = system(regime);
    const bool at_rest =
        s.fastest == 0.0;  // as a shaft without electrics that friction holds: a grid of it has no spacing
    return again || made_ < most_returning || at_rest || s.fastest * h > longest_between ? over(h, regime)
                                                                                         : between(h, s);
  }

  /// The step of a length that occurs in one interval alone; it is valid until the next one is asked for.
  const Step<S>& of_rest(double h, const Regime& regime) {
    if (!same(h, rest_.h) || rest_.regime != regime) make(rest_, h, regime);
    return rest_;
  }

  /// The values, of a length that does not come back.
  const Step<Value>& values_over(double h, const Regime& regime) {
    make(passing_, h, regime);
    return passing_;
  }

  template <class T>
  Passage<T> along(double h, const Regime& regime) {
    const System& s = system(regime);
    return {as<T>(s.a), s.norm, h};
  }

  template <class T, class From, std::size_t size>
  static std::array<T, size> as(const std::array<From, size>& from) {
    std::array<T, size> a;
    for (std::size_t k = 0; k < size; ++k) a[k] = as_scalar<T>(from[k]);
    return a;
  }

  /// As `as`, without a copy where it is of that scalar.
  template <class T, class From>
  static decltype(auto) in(const SmallVector<From, n>& x) {
    if constexpr (std::is_same_v<T, From>) {
      return (x);
    } else {
      return as<T>(x);
    }
  }

 private:
  /// The oldest of the last few.
  template <class List>
  static auto& next_of(List& list, std::size_t& next) {
    return list[std::exchange(next, (next + 1) % list.size())];
  }

  template <class T>
  void make(Step<T>& o, double h, const Regime& regime) {
    (std::is_same_v<T, S> ? counts.matrices : counts.matrices_of_values) += equations_.varies() ? 2 : 1;
    o.h = h;
    o.regime = regime;
    make_matrices<T, n>(o, as<T>(system(regime).a), h, equations_.varies());
  }

  /// By Lagrange's polynomial through six lengths of a grid, whose spacing is exact to 1e-9.
  const Step<S>& between(double h, const System& s) {
    const double spacing = spacing_between / s.fastest, at = h / spacing, first = std::floor(at);
    const double t = at - first;
    const std::array<double, 6> weights{-(t + 1.0) * t * (t - 1.0) * (t - 2.0) * (t - 3.0) / 120.0,
                                        (t + 2.0) * t * (t - 1.0) * (t - 2.0) * (t - 3.0) / 24.0,
                                        -(t + 2.0) * (t + 1.0) * (t - 1.0) * (t - 2.0) * (t - 3.0) / 12.0,
                                        (t + 2.0) * (t + 1.0) * t * (t - 2.0) * (t - 3.0) / 12.0,
                                        -(t + 2.0) * (t + 1.0) * t * (t - 1.0) * (t - 3.0) / 24.0,
                                        (t + 2.0) * (t + 1.0) * t * (t - 1.0) * (t - 2.0) / 120.0};
    std::array<const Step<S>*, 6> nodes;
    for (std::size_t j = 0; j < nodes.size(); ++j)
      nodes[j] = &node(static_cast<int>(first) + static_cast<int>(j) - 2, spacing, s);
    blend(&Step<S>::e, weights, nodes);
    if (equations_.varies()) {
      for (const auto matrix : {&Step<S>::eh, &Step<S>::p1h, &Step<S>::f1, &Step<S>::f2, &Step<S>::f3})
        blend(matrix, weights, nodes);
    } else {
      for (const auto matrix : {&Step<S>::p1, &Step<S>::p2}) blend(matrix, weights, nodes);
    }
    between_.h = h;
    between_.regime = s.regime;
    ++counts.between;
    return between_;
  }

  void blend(Matrix Step<S>::* matrix, const std::array<double, 6>& weights,
             const std::array<const Step<S>*, 6>& nodes) {
    Matrix& sum = between_.*matrix;
    for (std::size_t k = 0; k < sum.size(); ++k) {
      S entry = weights[0] * ((*nodes[0]).*matrix)[k];
      for (std::size_t j = 1; j < nodes.size(); ++j) entry += weights[j] * ((*nodes[j]).*matrix)[k];
      sum[k] = entry;
    }
  }

  /// The step over `index` spacings.
  const Step<S>& node(int index, double spacing, const System& s) {
    const auto of_system = static_cast<std::size_t>(&s - systems_.data()) * (most_nodes / 2);
    const std::size_t place = (static_cast<std::size_t>(index + 2) + of_system) % most_nodes;
    if (!node_made_[place] || node_of_[place] != index || nodes_[place].regime != s.regime) {
      make(nodes_[place], index * spacing, s.regime);
      node_of_[place] = index;
      node_made_[place] = true;
    }
    return nodes_[place];
  }

  const Step<S>* find(double h, const Regime& regime) const {
    for (std::size_t k = 0; k < made_; ++k) {
      if (same(h, lengths_[k]) && steps_[k].regime == regime) return &steps_[k];
    }
    return nullptr;
  }

  static constexpr double same_length = 1e-9;  // relative
  // times the fastest rate: Lagrange's remainder, 0.07^6 times 3.5 / 6!, is below 1e-9; a grid to 4 has room in the
  // nodes
  static constexpr double spacing_between = 0.07, longest_between = 4.0;
  static constexpr std::size_t most_returning = 16, most_nodes = 64;

  const Equations<S, Drive, masses>& equations_;
  std::array<System, 6> systems_{};
  static constexpr std::size_t most_steps = 32;
  Room<Step<S>, most_steps> steps_;              // the first `made_`, the oldest replaced
  std::array<double, most_steps> lengths_{};     // theirs, side by side for the search
  std::array<double, 4> missed_{};               // the last lengths that had not come back
  Room<Step<S>, most_nodes> nodes_;              // of grids
  std::array<int, most_nodes> node_of_{};        // how many spacings each is
  std::array<bool, most_nodes> node_made_{};
  Step<S> between_{}, rest_{};
  Step<Value> passing_{};
  std::size_t next_system_ = 0, next_step_ = 0, next_missed_ = 0, made_ = 0;
};

}  // namespace rwn
