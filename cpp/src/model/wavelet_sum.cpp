#include "rwn/model/wavelet_sum.hpp"

#include <algorithm>
#include <cmath>

#include "rwn/model/formula.hpp"

namespace rwn {
namespace {

/// What is known of a value on the stack, and where the steps that give it begin.
struct Value {
  enum class Form {
    other,
    number,     // c
    parameter,  // c times an own one
    wave,       // a x + c, or a sin(f x) + b cos(f x) + c
    sum         // the last of the sums
  };
  Form form = Form::other;
  std::size_t begin = 0;
  double a = 0.0, b = 0.0, c = 0.0, frequency = 0.0;
  int place = 0;  // of the parameter or variable
};
using Form = Value::Form;

class Reader {
 public:
  explicit Reader(std::vector<WaveletSum>& sums) : sums_(sums) {}

  std::vector<Instruction> read(std::span<const Instruction> program) {
    for (const Instruction& step : program) {
      if (pushes(step.operation)) {
        stack_.push_back(pushed(step));
      } else if (takes_two(step.operation)) {
        const Value right = take(), left = take();
        put(joined(step.operation, left, right), left.begin);
      } else {
        const Value value = take();
        put(changed(step.operation, value), value.begin);
      }
      steps_.push_back(step);
      Value& top = stack_.back();
      if (top.form != Form::sum) continue;
      steps_.resize(top.begin);
      steps_.push_back({Operation::wavelet_sum, 0.0, static_cast<int>(sums_.size()) - 1});
    }
    return std::move(steps_);
  }

 private:
  Value take() {
    const Value value = stack_.back();
    stack_.pop_back();
    return value;
  }

  void put(Value value, std::size_t begin) {
    value.begin = begin;
    stack_.push_back(value);
  }

  Value pushed(const Instruction& step) const {
    Value value;
    value.begin = steps_.size();
    value.place = step.place;
    if (step.operation == Operation::number) {
      value.form = Form::number;
      value.c = step.number;
    } else if (step.operation == Operation::parameter) {
      value.form = Form::parameter;
      value.c = 1.0;
    } else if (step.operation == Operation::variable) {
      value.form = Form::wave;
      value.a = 1.0;
    }
    return value;
  }

  Value changed(Operation operation, Value value) {
    if (operation == Operation::negate) return scaled(value, -1.0);
    const bool straight = value.form == Form::wave && value.frequency == 0.0;
    if (operation == Operation::sin && straight && value.a != 0.0) {
      return {Form::wave, 0, std::cos(value.c), std::sin(value.c), 0.0, value.a, value.place};
    }
    if (operation != Operation::mexican_hat || value.form != Form::wave) return {};
    WaveletSum sum;
    sum.over = value.place;
    sum.count = 1;
    sum.frequency = value.frequency;
    sum.a[0] = value.a;
    sum.b[0] = value.b;
    sum.c[0] = value.c;
    sum.factor[0] = 1.0;
    sum.parameter[0] = -1;
    sums_.push_back(sum);
    return {.form = Form::sum};
  }

  Value joined(Operation operation, const Value& left, const Value& right) {
    switch (operation) {
      case Operation::add:
      case Operation::subtract: {
        const double sign = operation == Operation::add ? 1.0 : -1.0;
        if (left.form == Form::sum && right.form == Form::sum) return added(sign);
        if (right.form == Form::number) return raised(left, sign * right.c);
        const bool flat = left.form == Form::number && right.form == Form::wave;
        return flat ? raised(scaled(right, sign), left.c) : Value{};
      }
      case Operation::multiply:
        if (right.form == Form::number) return scaled(left, right.c);
        if (left.form == Form::number) return scaled(right, left.c);
        if (right.form == Form::parameter) return weighted(left, right);
        if (left.form == Form::parameter) return weighted(right, left);
        return {};
      case Operation::divide:
        return right.form == Form::number ? scaled(left, 1.0 / right.c) : Value{};
      default:
        return {};
    }
  }

  Value raised(Value value, double by) const {
    if (value.form != Form::wave && value.form != Form::number) return {};
    value.c += by;
    return value;
  }

  Value scaled(Value value, double by) {
    if (!std::isfinite(by)) return {};
    value.a *= by;
    value.b *= by;
    value.c *= by;
    if (value.form == Form::sum) {
      for (double& factor : sums_.back().factor) factor *= by;
    }
    return value;
  }

  /// A sum times an own parameter; a product of two is none.
  Value weighted(const Value& value, const Value& parameter) {
    if (value.form != Form::sum || !sums_.back().numeric()) return {};
    WaveletSum& sum = sums_.back();
    std::fill(sum.parameter, sum.parameter + sum.count, parameter.place);
    return scaled(value, parameter.c);
  }

  /// The last two sums in one, where they are over the same.
  Value added(double sign) {
    WaveletSum& left = sums_[sums_.size() - 2];
    const WaveletSum& right = sums_.back();
    const bool alike = left.over == right.over && left.frequency == right.frequency;
    if (!alike || left.count + right.count > max_wavelets) return {};
    for (int k = 0; k < right.count; ++k, ++left.count) {
      left.a[left.count] = right.a[k];
      left.b[left.count] = right.b[k];
      left.c[left.count] = right.c[k];
      left.factor[left.count] = sign * right.factor[k];
      left.parameter[left.count] = right.parameter[k];
    }
    sums_.pop_back();
    return {.form = Form::sum};
  }

  std::vector<WaveletSum>& sums_;
  std::vector<Instruction> steps_;
  std::vector<Value> stack_;
};

}  // namespace

std::vector<Instruction> with_sums(std::span<const Instruction> program, std::vector<WaveletSum>& sums) {
  return Reader(sums).read(program);
}

}  // namespace rwn
