#pragma once

#include "render/draw.h"
#include "render/lighting.h"

namespace skinforge {

/// Weights of a triangle's corners at one point; sum 1.
struct CornerWeights {
  float a = 1, b = 0, c = 0;

  template <class Value, class Values>
  Value mix(const Values& values, const TriangleIndices& at) const {
    return Value(a * values[at[0]] + b * values[at[1]] + c * values[at[2]]);
  }
};

/// A point on a triangle of the subject.
struct SubjectPoint {
  std::size_t triangle = 0;
  CornerWeights weights;
  float spread = 0;  ///< uv per pixel
};

/// Base colour of the material there: factor x texture x vertex colour; linear RGBA.
Eigen::Vector4f base_color_at(const Subject& subject, const SubjectPoint& point);

/// The finish there, after the options' vertex colours and highlighted faces (`is_highlighted`). `alpha` is
/// not part of it.
Finish finish_at(const Subject& subject, const DrawOptions& options, const SubjectPoint& point,
                 bool is_highlighted);

/// Whether the surface of a cut-out or blended material exists at this point for this sample: blending
/// becomes coverage, so that it needs no order.
bool exists_at(const Subject& subject, const SubjectPoint& point, int sample);

}  // namespace skinforge
