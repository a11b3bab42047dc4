#include "bind.hpp"
#include "rwn/wavelets.hpp"

namespace rwn::bind {

void bind_wavelets(py::module_& m) {
  m.def("wavelet_names", [] {
    return std::apply([](auto... w) { return std::vector<std::string>{std::string(decltype(w)::name)...}; },
                      Wavelets{});
  });
}

}  // namespace rwn::bind
