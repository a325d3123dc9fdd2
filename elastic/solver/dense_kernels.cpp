#include "elastic/solver/dense_kernels.hpp"

#include <algorithm>
#include <cassert>
#include <mutex>

#include <Eigen/Cholesky>
#include <cblas.h>

namespace springlod::elastic {
namespace {

/// Up to this many rows Eigen's kernels are as fast as BLAS.
constexpr Eigen::Index kSmall = 48;

/// Held during a BLAS call. The threads are the program's own, and BLAS uses one for each call. A
/// BLAS built without threads is not safe for concurrent calls (1 in 100 products is wrong), so its
/// calls are serialized.
class BlasTurn {
 public:
  BlasTurn() {
    static const bool threads = [] {
      openblas_set_num_threads(1);
      return openblas_get_parallel() != OPENBLAS_SEQUENTIAL;
    }();
    static std::mutex one_at_a_time;
    if (!threads) turn_ = std::unique_lock(one_at_a_time);
  }

 private:
  std::unique_lock<std::mutex> turn_;
};

int size(Eigen::Index n) {
  return static_cast<int>(n);
}

/// The distance between columns; BLAS needs it above 0 even for empty matrices.
int stride(const ConstDenseRef& m) {
  return size(std::max<Eigen::Index>(1, m.outerStride()));
}

}  // namespace

const char* blas_kernels() {
  return openblas_get_corename();
}

bool factorise_lower(DenseRef a) {
  assert(a.rows() == a.cols());
  if (a.cols() <= kSmall) return Eigen::LLT<DenseRef>(a).info() == Eigen::Success;
  const Eigen::Index half = a.cols() / 2;
  const Eigen::Index rest = a.cols() - half;
  if (!factorise_lower(a.topLeftCorner(half, half))) return false;
  solve_right_transposed(a.topLeftCorner(half, half), a.bottomLeftCorner(rest, half));
  subtract_square(a.bottomLeftCorner(rest, half), a.bottomRightCorner(rest, rest));
  return factorise_lower(a.bottomRightCorner(rest, rest));
}

void solve_right_transposed(const ConstDenseRef& l, DenseRef b) {
  if (b.size() == 0) return;
  assert(l.rows() == l.cols() && b.cols() == l.rows());
  const BlasTurn turn;
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, size(b.rows()),
              size(b.cols()), 1, l.data(), stride(l), b.data(), stride(b));
}

void solve_right(const ConstDenseRef& l, DenseRef b) {
  if (b.size() == 0) return;
  assert(l.rows() == l.cols() && b.cols() == l.rows());
  const BlasTurn turn;
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasNoTrans, CblasNonUnit, size(b.rows()),
              size(b.cols()), 1, l.data(), stride(l), b.data(), stride(b));
}

void subtract_square(const ConstDenseRef& a, DenseRef c) {
  if (c.size() == 0) return;
  assert(c.rows() == c.cols() && a.rows() == c.rows());
  const BlasTurn turn;
  cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, size(c.rows()), size(a.cols()), -1, a.data(),
              stride(a), 1, c.data(), stride(c));
}

Eigen::MatrixXd gram(const ConstDenseRef& a) {
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(a.cols(), a.cols());
  if (a.size() == 0) return square;
  const BlasTurn turn;
  cblas_dsyrk(CblasColMajor, CblasLower, CblasTrans, size(a.cols()), size(a.rows()), 1, a.data(),
              stride(a), 0, square.data(), stride(square));
  square.triangularView<Eigen::StrictlyUpper>() = square.transpose();
  return square;
}

Eigen::MatrixXd transposed_product(const ConstDenseRef& a, const ConstDenseRef& b) {
  assert(a.rows() == b.rows());
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(a.cols(), b.cols());
  if (product.size() == 0 || a.size() == 0) return product;
  const BlasTurn turn;
  cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, size(a.cols()), size(b.cols()),
              size(a.rows()), 1, a.data(), stride(a), b.data(), stride(b), 0, product.data(),
              stride(product));
  return product;
}

void multiply_transposed(const ConstDenseRef& a, const ConstDenseRef& b, DenseRef c) {
  if (c.size() == 0) return;
  assert(a.cols() == b.cols() && c.rows() == a.rows() && c.cols() == b.rows());
  const BlasTurn turn;
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, size(c.rows()), size(c.cols()),
              size(a.cols()), 1, a.data(), stride(a), b.data(), stride(b), 0, c.data(), stride(c));
}

void subtract_product(const ConstDenseRef& a, const ConstDenseRef& b, DenseRef c) {
  if (c.size() == 0) return;
  assert(a.cols() == b.rows() && c.rows() == a.rows() && c.cols() == b.cols());
  const BlasTurn turn;
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, size(c.rows()), size(c.cols()),
              size(a.cols()), -1, a.data(), stride(a), b.data(), stride(b), 1, c.data(), stride(c));
}

}  // namespace springlod::elastic
