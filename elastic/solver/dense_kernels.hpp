#pragma once

#include <Eigen/Core>

namespace springlod::elastic {

/// Dense kernels (BLAS), which take most of the time of factorising and solving. They use
/// vectors. Matrices are stored by columns. One thread; the same bits every time that the program
/// runs with the same kernels.
using DenseRef = Eigen::Ref<Eigen::MatrixXd>;
using ConstDenseRef = Eigen::Ref<const Eigen::MatrixXd>;

/// Which kernels BLAS uses, "Haswell". Others round differently.
const char* blas_kernels();

/// Factorises A = L L^T in the lower triangle of a; the upper triangle is unchanged. Returns false
/// if a pivot is not positive.
bool factorise_lower(DenseRef a);
/// b = b L^-T and b = b L^-1, with L the lower triangle of `l`.
void solve_right_transposed(const ConstDenseRef& l, DenseRef b);
void solve_right(const ConstDenseRef& l, DenseRef b);
/// c -= a a^T, in the lower triangle of c.
void subtract_square(const ConstDenseRef& a, DenseRef c);
/// a^T a.
Eigen::MatrixXd gram(const ConstDenseRef& a);
/// a^T b.
Eigen::MatrixXd transposed_product(const ConstDenseRef& a, const ConstDenseRef& b);
/// c = a b^T.
void multiply_transposed(const ConstDenseRef& a, const ConstDenseRef& b, DenseRef c);
/// c -= a b.
void subtract_product(const ConstDenseRef& a, const ConstDenseRef& b, DenseRef c);

}  // namespace springlod::elastic
