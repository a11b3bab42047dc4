// One run of the structured network in a kernel: state in registers, one sample at a time (thesis eq. 4.6-4.29).
// Included once per instruction set.
#pragma once

#include "rwn/kernels/structured_step.hpp"

#include "rwn/numerics/pack.hpp"
#include "thesis_bounds.hpp"
#include "with_wavelet.hpp"

namespace rwn::RWN_ISA {

/// Where the network block lives during a run: in registers and on the stack (N vectors known) or where it is (N = 0).
template <int N>
struct Rows {
  Pack cell[kNetworkRows][N];
  RWN_INLINE explicit Rows(const StructuredBlock& b) {
    for (int r = 0; r < kNetworkRows; ++r) {
      for (int p = 0; p < N; ++p) cell[r][p] = load(b.network + (p * kNetworkRows + r) * width);
    }
  }
  RWN_INLINE void save(StructuredBlock& b) const {
    for (int r = 0; r < kNetworkRows; ++r) {
      for (int p = 0; p < N; ++p) store(b.network + (p * kNetworkRows + r) * width, cell[r][p]);
    }
  }
  RWN_INLINE static constexpr long size() { return N; }
  RWN_INLINE Pack get(int r, long p) const { return cell[r][p]; }
  RWN_INLINE void set(int r, long p, Pack a) { cell[r][p] = a; }
};

template <>
struct Rows<0> {
  double* network;
  long n;
  RWN_INLINE explicit Rows(const StructuredBlock& b) : network(b.network), n(b.vectors) {}
  RWN_INLINE void save(StructuredBlock&) const {}
  RWN_INLINE long size() const { return n; }
  RWN_INLINE Pack get(int r, long p) const { return load(network + (p * kNetworkRows + r) * width); }
  RWN_INLINE void set(int r, long p, Pack a) { store(network + (p * kNetworkRows + r) * width, a); }
};

struct NoBounds {
  RWN_INLINE void include(Pack, Pack, Pack, Pack) {}
};
struct WithBounds {
  const ThesisBounds& thesis;
  FrictionBounds bounds{};
  RWN_INLINE void include(Pack w, Pack m, Pack c, Pack inverse_d) { bounds.include(thesis, w, m, c, inverse_d); }
};

RWN_INLINE void load_linear(const double* p, double& a) { a = *p; }
RWN_INLINE void load_linear(const double* p, Pack& a) { a = load(p); }
RWN_INLINE void store_linear(double* p, double a) { *p = a; }
RWN_INLINE void store_linear(double* p, Pack a) { store(p, a); }
RWN_INLINE void total(Pack a, double& s) { s = sum(a); }
RWN_INLINE void total(Pack a, Pack& s) { s = a; }

/// State of a run in the loop. S is double (one run, wavelets across the lanes) or Pack (one run per lane).
template <class W, class S, int N>
struct Run {
  static constexpr long lanes = sizeof(S) / sizeof(double);
  W wavelet;
  StructuredBlock& block;
  Rows<N> net;
  S v[5], x1, x2, P[5], Q[5], tau;
  S a11, a12, a21, a22;
  const bool electrical = block.electrical;
  const bool friction = lanes > 1 || block.friction;  // side by side there always is; known, the loops carry no branch

  RWN_INLINE Run(StructuredBlock& b, W w) : wavelet(w), block(b), net(b) {
    for (int k = 0; k < 5; ++k) {
      row(kV + k, v[k]), row(kP + k, P[k]), row(kQ + k, Q[k]);
    }
    row(kX1, x1), row(kX2, x2), row(kTau, tau);
  }
  RWN_INLINE void save() {
    for (int k = 0; k < 5; ++k) {
      put(kV + k, v[k]), put(kP + k, P[k]), put(kQ + k, Q[k]);
    }
    put(kX1, x1), put(kX2, x2), put(kTau, tau);
    net.save(block);
  }

  RWN_INLINE void row(int r, S& a) const { load_linear(block.linear + r * lanes, a); }
  RWN_INLINE void put(int r, S a) { store_linear(block.linear + r * lanes, a); }

  RWN_INLINE void plant() {
    a11 = 1.0 - v[0] * v[1];
    a12 = v[1] * v[2];
    a21 = -(v[2] * v[3]);
    a22 = v[4];
  }

  /// P(n) = C R(n), R(n) = A R(n-1) + [drive; 0] for one parameter of the network (4.79, 4.91, 4.103, 4.115).
  RWN_INLINE void carry(int g, long p, Pack gain, Pack drive) {
    const Pack P0 = net.get(kPNet + g, p);
    const Pack Q0 = net.get(kQNet + g, p);
    net.set(kPNet + g, p, Pack(a11) * P0 + (Pack(a12) * Q0 + gain * drive));
    net.set(kQNet + g, p, Pack(a21) * P0 + Pack(a22) * Q0);
  }

  /// One vector of wavelets (3.2-3.4). Returns w phi.
  template <class B>
  RWN_INLINE Pack wavelets(long p, Pack input, B& bounds) {
    const Pack w = net.get(kTheta, p), m = net.get(kTheta + 1, p), c = net.get(kTheta + 3, p);
    const Pack inverse_d = 1.0 / net.get(kTheta + 2, p);
    const Pack before = net.get(kPhi, p);
    const Pack z = ((input - m) + c * before) * inverse_d;
    const Pack phi = wavelet.value(z);
    net.set(kPhi, p, phi);
    if (friction) {
      net.set(kBefore, p, before);
      net.set(kZ, p, z);
      net.set(kSlope, p, wavelet.derivative(z) * inverse_d);
    }
    bounds.include(w, m, c, inverse_d);
    return w * phi;
  }

  /// V1-V3 (3.16-3.18), P and Q of w, m, d, c (4.21-4.28) of one vector of wavelets.
  RWN_INLINE void wavelet_sensitivities(long p) {
    const Pack c = net.get(kTheta + 3, p), slope = net.get(kSlope, p);
    const Pack V1 = slope * (c * net.get(kVee, p) - 1.0);
    const Pack V2 = slope * (c * net.get(kVee + 1, p) - net.get(kZ, p));
    const Pack V3 = slope * (c * net.get(kVee + 2, p) + net.get(kBefore, p));
    net.set(kVee, p, V1), net.set(kVee + 1, p, V2), net.set(kVee + 2, p, V3);
    const Pack gain = -Pack(v[1]);
    const Pack weighted = gain * net.get(kTheta, p);
    carry(0, p, gain, net.get(kPhi, p));
    carry(1, p, weighted, V1), carry(2, p, weighted, V2), carry(3, p, weighted, V3);
  }

  template <class B>
  RWN_INLINE void torque(double speed, B& bounds) {
    Pack t{0.0};
    for (long p = 0; p < net.size(); ++p) t += wavelets(p, Pack(speed), bounds);
    total(t, tau);
    if (friction) {  // a second loop: short chains, so that the processor sees several wavelets at a time
      for (long p = 0; p < net.size(); ++p) wavelet_sensitivities(p);
    }
  }

  RWN_INLINE void linear_sensitivity(int k, S drive1, S drive2) {
    const S P0 = P[k];
    P[k] = (a11 * P0 + a12 * Q[k]) + drive1;
    Q[k] = (a21 * P0 + a22 * Q[k]) + drive2;
  }
  /// P and Q of v1..v5 (4.13-4.18, E.2, E.14); needs x(n-1) and tau(n-1).
  RWN_INLINE void linear_sensitivities(double u) {
    const S none(0.0);
    linear_sensitivity(0, -(v[1] * x1), none);
    linear_sensitivity(1, (v[2] * x2 - v[0] * x1) - tau, none);
    linear_sensitivity(2, v[1] * x2, -(v[3] * x1));
    if (electrical) {
      linear_sensitivity(3, none, u - v[2] * x1);
      linear_sensitivity(4, none, x2);
    }
  }

  /// x(n) from x(n-1), u(n-1) and the measured speed(n-1), with the parameters as they stand (4.6, 4.10).
  template <class B>
  RWN_INLINE void advance(double u, double speed, B& bounds) {
    plant();
    torque(speed, bounds);
    linear_sensitivities(u);
    move(u);
  }
  RWN_INLINE void move(double u) {
    const S next = (a11 * x1 + a12 * x2) - v[1] * tau;
    x2 = (a21 * x1 + a22 * x2) + v[3] * u;
    x1 = next;
  }

  /// theta += mu e P (4.19, 4.29); with `carry` the state follows its parameters, x += R dtheta.
  template <bool Carry>
  RWN_INLINE void correct(S error, const S* mu) {
    S follow1(0.0), follow2(0.0);
    correct_linear<0, 3>(error, mu, follow1, follow2);
    if (electrical) correct_linear<3, 5>(error, mu, follow1, follow2);
    if (friction) correct_network<Carry>(error, mu, follow1, follow2);
    if constexpr (Carry) {
      x1 += follow1;
      x2 += follow2;
    }
  }
  template <int first, int last>
  RWN_INLINE void correct_linear(S error, const S* mu, S& follow1, S& follow2) {
    for (int k = first; k < last; ++k) {
      const S step = mu[k] * error * P[k];
      v[k] += step;
      follow1 += P[k] * step;
      follow2 += Q[k] * step;
    }
  }
  template <bool Carry>
  RWN_INLINE void correct_network(S error, const S* mu, S& follow1, S& follow2) {
    Pack f1{0.0}, f2{0.0};
    const Pack step[4] = {mu[kWeight] * error, mu[kTranslation] * error, mu[kDilation] * error, mu[kFeedback] * error};
    for (long p = 0; p < net.size(); ++p) {
      for (int g = 0; g < 4; ++g) {
        const Pack P0 = net.get(kPNet + g, p);
        const Pack change = step[g] * P0;
        net.set(kTheta + g, p, net.get(kTheta + g, p) + change);
        if constexpr (Carry) {
          f1 += change * P0;
          f2 += change * net.get(kQNet + g, p);
        }
      }
    }
    if constexpr (Carry) {
      S s1, s2;
      total(f1, s1), total(f2, s2);
      follow1 += s1;
      follow2 += s2;
    }
  }
};

}  // namespace rwn::RWN_ISA
