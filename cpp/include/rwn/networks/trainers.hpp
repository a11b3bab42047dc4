// Trainers of the conventional network; a new one is a file in trainers/ and one entry in the tuple.
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "rwn/networks/trainers/gradient_descent.hpp"
#include "rwn/networks/trainers/levenberg_marquardt.hpp"
#include "rwn/networks/trainers/pattern_descent.hpp"
#include "rwn/networks/trainers/pattern_gauss_newton.hpp"
#include "rwn/networks/trainers/variable_projection.hpp"

namespace rwn {

using ConventionalTrainers =
    std::tuple<GradientDescent, PatternDescent, PatternGaussNewton, LevenbergMarquardt, VariableProjection>;

inline std::vector<std::string> trainer_names() {
  return std::apply([](auto... t) { return std::vector<std::string>{std::string(decltype(t)::name)...}; },
                    ConventionalTrainers{});
}

}  // namespace rwn
