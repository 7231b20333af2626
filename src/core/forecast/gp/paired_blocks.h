#pragma once
/// Products of symmetric matrices with one that has only 2×2 blocks on its diagonal, like the transition of states
/// in conjugate pairs. Blocks above the diagonal mirror those below.

#include <Eigen/Core>

namespace slipnav {

/// M ← Φ M Φᵀ.
template <int D>
void transformPairs(const Eigen::Matrix<double, D, D>& phi, Eigen::Matrix<double, D, D>& m) {
  for (Eigen::Index j = 0; j < D; j += 2) {
    const Eigen::Matrix2d phi_j = phi.template block<2, 2>(j, j).transpose();
    for (Eigen::Index i = j; i < D; i += 2) {
      const Eigen::Matrix2d half = m.template block<2, 2>(i, j).lazyProduct(phi_j);
      const Eigen::Matrix2d block = phi.template block<2, 2>(i, i).lazyProduct(half);
      m.template block<2, 2>(j, i) = block.transpose();
      m.template block<2, 2>(i, j) = block;
    }
  }
}

/// M ← M + F N + N Fᵀ; F is zero except for the states from `first` to `last`, the latter excluded.
template <int D>
void addRateOfPairs(const Eigen::Matrix<double, D, D>& f, const Eigen::Matrix<double, D, D>& n, Eigen::Index first,
                    Eigen::Index last, Eigen::Matrix<double, D, D>& m) {
  for (Eigen::Index i = first - first % 2; i < last; i += 2) {
    const Eigen::Matrix2d f_i = f.template block<2, 2>(i, i);
    for (Eigen::Index j = 0; j < D; j += 2) {
      const Eigen::Matrix2d change = f_i.lazyProduct(n.template block<2, 2>(i, j));
      m.template block<2, 2>(i, j) += change;
      m.template block<2, 2>(j, i) += change.transpose();
    }
  }
}

}  // namespace slipnav
