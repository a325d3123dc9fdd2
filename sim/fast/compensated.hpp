#pragma once

namespace springlod {

/// What a number loses when it is rounded to Real.
template <class Real>
Real remainder_of(double number) {
  return static_cast<Real>(number - static_cast<double>(static_cast<Real>(number)));
}

/// Kahan's compensated sum: x += more, where `low` keeps what x is too coarse to hold; without it,
/// a plain sum.
template <class Real>
void add_compensated(Real more, Real& x, Real* low) {
  if (low == nullptr) {
    x += more;
    return;
  }
  const Real way = more + *low;
  const Real sum = x + way;
  *low = way - (sum - x);
  x = sum;
}

}  // namespace springlod
