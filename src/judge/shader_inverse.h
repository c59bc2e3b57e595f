// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a shader's inverse costs: matrices inverted in single or half precision, in several orders
// of operations, and how far that moves the lobe.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

#include "core/run_context.h"
#include "fit/lobe_frame.h"
#include "judge/lobe_quantiles.h"
#include "table/table.h"

namespace ltc {

// With M = F S A, F = Q or 1 and A = diag(alpha_x, alpha_y, 1) as the storage says (storage.h).
enum class InverseOrder {
  // M as a whole, then cofactors over the determinant.
  divided,
  // M as a whole, then its adjugate times the sign of the determinant: M^-1 but for a positive
  // factor, which no direction feels.
  adjugate,
  // The adjugate of M with its columns divided by the roughness and turned into the mirror's frame:
  // adj(F' M A^-1), F' = Q^T. The caller turns vertices by Q^T first and divides rows by A last.
  factored,
};
constexpr EnumNames<InverseOrder, 3> enum_names(InverseOrder) {
  return {"order of inversion",
          {{{InverseOrder::divided, "cofactors over determinant"},
            {InverseOrder::adjugate, "adjugate"},
            {InverseOrder::factored, "adjugate in the mirror's frame, roughness factored out"}}}};
}

// The matrix whose inverse in all digits is what a shader has: M but for what storing S, forming M
// and inverting it lose. `stored` is rounded to `memory` first; all that follows is in
// `arithmetic`; with storage "inverse" nothing does. NaN where the shader has no inverse: an entry
// that overflows, a determinant of zero, or a sign of the determinant that rounding turned, which
// puts the lobe's mirror image at the opposite side. With `factored` and storage "matrix", S is put
// into the mirror's frame in `arithmetic`.
Eigen::Matrix3d seen_by_shader(Storage storage, const Eigen::Matrix3d& stored,
                               const LobeFrame& frame, InverseOrder order, Precision memory,
                               Precision arithmetic);

// Distances of lobes to what a shader sees of them.
class InversionMeter {
 public:
  InversionMeter(std::size_t samples, std::size_t directions);

  // Sliced-Wasserstein distance of the LTCs of two matrices over the spread of the first; infinite
  // where the second is not finite. Finite `exact`.
  double error(const LobeFrame& frame, const LtcLobe& exact, const LtcLobe& seen);

 private:
  LobeQuantiles quantiles_;
  std::vector<float> exact_, seen_;
};

// That error at every entry of a table that is `judged`, NaN at the others; `seen` makes the lobe
// that is seen there. The same bits for any number of threads. Throws Interrupted.
std::vector<double> inversion_errors(
    const Table& table, const std::vector<bool>& judged, std::string_view stage,
    const RunContext& run, const std::function<LtcLobe(std::size_t, const LobeFrame&)>& seen);

}  // namespace ltc
