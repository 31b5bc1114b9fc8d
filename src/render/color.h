#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/math.h"
#include "model/skin_weights.h"

/// Colours of the renderer. A colour is linear RGB (sRGB primaries) in a Vec3, 1 = white, unless it says
/// "srgb".
namespace skinforge {

/// Linear value of an 8-bit sRGB code (IEC 61966-2-1), in [0, 1].
float linear_from_srgb(std::uint8_t code);

/// 8-bit sRGB code of a linear value; values outside [0, 1] are cut, NaN gives 0.
std::uint8_t srgb_from_linear(float value);

/// Linear colour from three 8-bit sRGB codes, as a designer writes them: rgb_color(0xF4, 0xF6, 0xF8).
Vec3 rgb_color(int red, int green, int blue);

/// Linear colour from OKLCh (Ottosson 2020): `lightness` in [0, 1], `chroma` about [0, 0.3], `hue` in turns.
/// Colours outside sRGB lose chroma until they fit.
Vec3 oklch_color(double lightness, double chroma, double hue);

/// A colour for each of `count` joints: hues a golden section apart, so that neighbours in the list (parent
/// and child) differ most, and two alternating lightnesses. Colour i does not depend on `count`.
std::vector<Vec3> joint_colors(std::size_t count);

/// One colour per vertex: that of its strongest joint, `joint_colors(joint_count)`; grey where a row is
/// empty.
std::vector<Vec3> dominant_weight_colors(const SkinWeights& weights, std::size_t joint_count);

/// Colour of a value in [0, 1] (cut): pale grey at 0, over yellow and orange to dark red at 1; lightness
/// falls all the way, so it reads in grey too.
Vec3 heat_color(double value);

/// One heat colour per vertex: the weight of `joint`.
std::vector<Vec3> joint_weight_colors(const SkinWeights& weights, JointId joint);

}  // namespace skinforge
