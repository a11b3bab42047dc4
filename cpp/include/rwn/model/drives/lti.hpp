// A linear transfer function from the input to the measured output; rwn/simulate/transfer_function.hpp has its steps.
#pragma once

#include <string_view>

namespace rwn {

struct LtiDrive {
  static constexpr std::string_view name = "lti";
  static constexpr bool coefficients = true;  // in place of equations of motion
  static constexpr int widths[] = {8};
};

}  // namespace rwn
