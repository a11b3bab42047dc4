// What src/normal_equations.cpp hands to the kernel of its instruction set.
#pragma once

namespace rwn {

/// One signal of one recording, and the sums that it is added to.
struct NormalSlice {
  static constexpr int block = 4;  // rows that are added at a time

  const double* errors;  // (rows); NaN does not count
  const double* slopes;  // (rows, columns) of what was simulated
  int rows;
  int columns;
  double weight;
  int stride;         // columns, padded
  double* room;       // (block, stride), aligned, 0 beyond the columns
  double* gradient;   // (columns)
  double* curvature;  // (columns, stride), aligned; of each row the part up to the diagonal is meant
  double chi2;
  long count;
};

}  // namespace rwn
