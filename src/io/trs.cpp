#include "io/trs.h"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace skinforge {
namespace {

/// Signs of the scale: those of `like` when they give the handedness that is wanted.
Vec3 scale_signs(const Vec3& like, bool mirrored) {
  const Vec3 signs = like.unaryExpr([](double s) { return s < 0 ? -1.0 : 1.0; });
  if ((signs.prod() < 0) == mirrored) return signs;
  return {mirrored ? -1.0 : 1.0, 1.0, 1.0};
}

/// The rotation nearest to a matrix (orthogonal Procrustes).
Mat3 nearest_rotation(const Mat3& m) {
  const Eigen::JacobiSVD<Mat3> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 turn = svd.matrixU() * svd.matrixV().transpose();
  if (turn.determinant() < 0) {
    Mat3 u = svd.matrixU();
    u.col(2) *= -1;
    turn = u * svd.matrixV().transpose();
  }
  return turn;
}

}  // namespace

TrsForm to_trs(const Affine3& matrix, const Transform& like) {
  const Mat3 linear = matrix.linear();
  const Vec3 lengths = linear.colwise().norm().transpose();
  const Vec3 signs = scale_signs(like.scale, linear.determinant() < 0);
  Mat3 directions = Mat3::Zero();
  for (int axis = 0; axis < 3; ++axis)
    if (lengths[axis] > 0) directions.col(axis) = linear.col(axis) * (signs[axis] / lengths[axis]);

  TrsForm form;
  form.transform.translation = matrix.translation();
  form.transform.rotation = Quat(nearest_rotation(directions)).normalized();
  if (form.transform.rotation.dot(like.rotation) < 0) form.transform.rotation.coeffs() *= -1;
  form.transform.scale = lengths.cwiseProduct(signs);
  const double size = lengths.maxCoeff();
  if (size > 0) form.error = (form.transform.matrix().linear() - linear).cwiseAbs().maxCoeff() / size;
  return form;
}

}  // namespace skinforge
