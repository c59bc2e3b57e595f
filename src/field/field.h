// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The field: the LTC of every anisotropic lobe as some hundreds of coefficients, without nodes.
//
// Of a lobe with alpha_x >= alpha_y and phi in [0, pi/2] (table/reduction.h), let
//     alpha = alpha_x,  lambda = alpha_y / alpha_x,  c = cos theta,  s = sin theta,
//     s_y = alpha sqrt(lambda^2 + (0.1 alpha)^2 (1 - lambda^2)),
//     b = sqrt(c^2 + (alpha v_x)^2 + (s_y v_y)^2),  r = sqrt b,  w = c / b.
// s_y is alpha_y as far as it matters: a lobe is no narrower than what curves it, whatever alpha_y.
// b is the length of the view stretched to unit roughness. Lobes change over c of the order of
// the roughness along the view; (b, w) are polar coordinates there: what jumps near grazing views
// of smooth surfaces as a function of c is smooth in w. The matrix is
//     M = Q L T diag(alpha, s_y, 1),
// Q the least rotation from z to the mirror direction (brdf/lobe.h), L the scaling by
//     u = sqrt(c^2 + sqrt((alpha v_x)^2 + (s_y v_y)^2))
// along (-sin phi, cos phi, 0), across the plane of incidence, where smooth lobes are
// foreshortened. T is the isotropic lobe turned by phi, and what anisotropy adds to it:
//     T = | A + B s^2 cos 2phi   B s^2 sin 2phi       k C s cos phi |   | m00   m01   k m02 |
//         | B s^2 sin 2phi       A - B s^2 cos 2phi   k C s sin phi | + | m10   m11   k m12 |
//         | h D s cos phi        h D s sin phi        g             |   | h m20 h m21 0     |
// with k = alpha^2 / q and h = 1 / sqrt q, q = sqrt(c^2 + alpha^2 s^2), the scales of these
// entries, and g = 1 - 0.8 alpha_y^2 (1 - c)^2, a choice: the lobe does not feel a factor, and this
// one leaves the least to the rest. Each of the twelve functions is a sum of terms
//     coefficient T_i(2 alpha - 1) L_j(lambda) T_k(2 r - 1) T_l(2 w - 1) F_m(phi)
// with Chebyshev polynomials T_i; L_0 = 1 and L_j = (1 - lambda) T_{j-1}(2 lambda - 1); F_m the
// parity that equation (16) of Aakash et al. 2022 asks for, times s where m is odd and s^2 where it
// is even and not 0:
//     cos 2n phi in m00 and m11;     sin 2n phi in m01 and m10;
//     cos (2n+1) phi in m02 and m20; sin (2n+1) phi in m12 and m21.
// A, B, C and D have j = 0 and m = 0, the mij j >= 1. So, exactly: lambda = 1 is the isotropic lobe
// turned, nothing jumps where the axes are exchanged (equation 14), the zeros of equation (16) are
// zero, and theta = 0 is the same for every phi.
//
// Where det T would be below 1/32, in corners that no lobe is well fitted in, A is raised until it
// is not: M is regular, and not mirrored, whatever the coefficients.
//
// A folded field has two functions more, kappa of the orders sin (2n+1) phi and gamma of cos 2n
// phi, both j >= 1: its lobe is M fold(omega_o) (ltc/folded.h) with the creases of the field and
//     k = alpha^2 kappa / s_y,   g = min(gamma, 0.95/sum of h),
// so that the fold is one to one whatever the coefficients, and lambda = 1 is not folded.
//
// Amplitude and Fresnel term (brdf/albedo.h) are functions e and x of the same terms (even m; j = 0
// with m = 0), r and w being made with alpha_y in place of s_y:
//     amplitude = e,   fresnel = e (1 - x)^5,
// x being the cosine at which Schlick's term has the lobe's mean, nearly that of the view.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "brdf/lobe.h"
#include "core/enum_names.h"
#include "ltc/folded.h"

namespace ltc {

// The functions that a field consists of, in the order in which files have them.
enum class FieldPart {
  a,
  b,
  c,
  d,
  m00,
  m01,
  m02,
  m10,
  m11,
  m12,
  m20,
  m21,  // of the matrix
  amplitude,
  view_cosine,  // e and x
  kappa,
  gamma,  // of the fold
};
inline constexpr std::size_t field_part_count = 16, field_matrix_part_count = 12,
                             field_fold_part_count = 2;
constexpr EnumNames<FieldPart, field_part_count> enum_names(FieldPart) {
  return {"part of a field",
          {{{FieldPart::a, "A"},
            {FieldPart::b, "B"},
            {FieldPart::c, "C"},
            {FieldPart::d, "D"},
            {FieldPart::m00, "m00"},
            {FieldPart::m01, "m01"},
            {FieldPart::m02, "m02"},
            {FieldPart::m10, "m10"},
            {FieldPart::m11, "m11"},
            {FieldPart::m12, "m12"},
            {FieldPart::m20, "m20"},
            {FieldPart::m21, "m21"},
            {FieldPart::amplitude, "amplitude"},
            {FieldPart::view_cosine, "view_cosine"},
            {FieldPart::kappa, "kappa"},
            {FieldPart::gamma, "gamma"}}}};
}

// Whether a part is one of amplitude and Fresnel term, or of the fold; and whether its orders in
// phi are sines.
constexpr bool is_of_albedo(FieldPart part) {
  return part == FieldPart::amplitude || part == FieldPart::view_cosine;
}
constexpr bool is_of_fold(FieldPart part) {
  return part >= FieldPart::kappa;
}
constexpr bool is_sine(FieldPart part) {
  return part == FieldPart::m01 || part == FieldPart::m10 || part == FieldPart::m12 ||
         part == FieldPart::m21 || part == FieldPart::kappa;
}

// A term without its coefficient: i, j, k, l and m above.
struct FieldTerm {
  FieldPart part = FieldPart::a;
  std::uint8_t alpha = 0, lambda = 0, radius = 0, angle = 0, order = 0;
  auto operator<=>(const FieldTerm&) const = default;
};

// The 0.1 of s_y and the 0.8 of g.
inline constexpr double field_least_width = 0.1, field_own_factor = 0.8;

// s_y of a folded lobe, alpha_x >= alpha_y.
double width_across(const Lobe& folded);

// Degrees and orders are at most this.
inline constexpr std::size_t field_most_degree = 20;

// Whether the part may have it: parity of the order, and what j and m are bound to.
bool is_allowed(const FieldTerm& term);

struct Field {
  double alpha_min = 1e-4;  // smaller roughnesses are raised to it, as in a table
  const LobeModel* model = &ggx();
  // The larger and the smaller roughness that it was contracted to (refine/field_fit.h): for others
  // it has no values. Nothing of a field of all lobes.
  std::optional<std::array<double, 2>> material = {};
  // Of its fold; none: it has no fold, and no terms of kappa and gamma.
  Creases creases = {};
  // In rising order, each once; those that are not there are zero.
  std::vector<FieldTerm> terms;
  std::vector<float> coefficients;

  bool operator==(const Field&) const = default;
};

// What of a folded lobe the terms are made from.
struct FieldVariables {
  // Roughnesses below alpha_min are raised.
  FieldVariables(const Lobe& folded, double alpha_min);

  Lobe lobe;  // as bounded
  double alpha, lambda, sin_theta, cos_theta;
  double radius, angle;                // r and w of the matrix
  double albedo_radius, albedo_angle;  // and of amplitude and Fresnel term
  double width_y;                      // s_y
};

// The values of all one-dimensional functions at a lobe, up to field_most_degree.
class FieldBasis {
 public:
  explicit FieldBasis(const FieldVariables& at, std::size_t most_degree = field_most_degree);

  double value(const FieldTerm& term) const {
    const View& view = is_of_albedo(term.part) ? albedo_ : matrix_;
    return alpha_[term.alpha] * lambda_[term.lambda] * view.radius[term.radius] *
           view.angle[term.angle] * (is_sine(term.part) ? sine_ : cosine_)[term.order];
  }

 private:
  using Values = std::array<double, field_most_degree + 1>;
  struct View {
    Values radius, angle;
  };
  Values alpha_, lambda_, cosine_, sine_;
  View matrix_, albedo_;
};

// How T changes with each part, T without any, and what stands on its left and right:
// M = Q L (constant + sum of value_i direction_i) R.
struct FieldDirections {
  explicit FieldDirections(const FieldVariables& at);
  std::array<Eigen::Matrix3d, field_matrix_part_count> direction;
  Eigen::Matrix3d constant, left;
};

// T has at least this determinant; of next to no lobe's own fit it is less.
inline constexpr double field_least_determinant = 1.0 / 32;

// T, or where its determinant is below the least, T with what that takes added to the first two
// entries of the diagonal: with S the 2x2 matrix of which det T = t22 det S, the mu >= 0 for which
// det(S + mu) = mu^2 + mu tr S + det S is the least. Continuous, and as symmetric as T.
Eigen::Matrix3d with_least_determinant(Eigen::Matrix3d t);

// The parts' values: what all of the above is a function of.
using FieldValues = std::array<double, field_part_count>;
FieldValues values_of(const Field& field, const FieldVariables& at);

// M of the folded lobe, e, and e (1 - x)^5; both of the latter clamped to [0, 1]. NaN for lobes of
// other roughnesses than the field's material.
struct FieldLobe {
  Eigen::Matrix3d matrix;
  double amplitude, fresnel;
  Fold fold = {};
  double kappa = 0, gamma = 0;  // what the fold is made from, gamma as bounded
};
FieldLobe lobe_of(const Field& field, const Lobe& folded);
// L T diag(1, s_y / alpha_y, 1), of M = Q P diag(alpha_x, alpha_y, 1) (fit/lobe_frame.h), of the
// first twelve values.
Eigen::Matrix3d field_frame_matrix(const double* values, const FieldVariables& at);

// The largest g of these creases.
double most_fold(const Creases& creases);

// The fold of kappa and gamma, as above; none of no creases.
Fold fold_of(double kappa, double gamma, const Lobe& folded, const Creases& creases);

}  // namespace ltc
