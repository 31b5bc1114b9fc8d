#pragma once

#include "model/transform.h"

namespace skinforge {

/// A matrix taken apart.
struct TrsForm {
  Transform transform;
  double error = 0;  ///< largest entry of (matrix - T R S), relative to the largest column; > 0 by shear
};

/// The TRS nearest to a matrix. Of the forms that give the same matrix it takes the one that is like `like`:
/// the same signs of scale where the determinant allows it (else x is mirrored), and q or -q whichever is
/// nearer. A vanishing axis keeps scale 0 and a direction square to the others. Finite input only.
TrsForm to_trs(const Affine3& matrix, const Transform& like = {});

}  // namespace skinforge
