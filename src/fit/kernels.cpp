// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The hot loops, compiled once for every vector unit and chosen at run time.
#include "fit/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fit/kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ltc::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
// Never wider than a row, so that every loop below sees a whole number of vectors.
using Floats = hn::CappedTag<float, row_width>;
using Ints = hn::Rebind<std::int32_t, Floats>;
using V = hn::Vec<Floats>;

template <std::size_t columns>
void transform_columns(const FrameMatrix& matrix, const Points& cosine, const SampleRows& result) {
  constexpr std::size_t width = row_width_of(columns);
  const float* const p = matrix.p;
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  const V ax = hn::Set(d, matrix.alpha_x), ay = hn::Set(d, matrix.alpha_y), one = hn::Set(d, 1.0f);
  const V p00 = hn::Set(d, p[0]), p01 = hn::Set(d, p[1]), p02 = hn::Set(d, p[2]);
  const V p10 = hn::Set(d, p[3]), p11 = hn::Set(d, p[4]), p12 = hn::Set(d, p[5]);
  const V p20 = hn::Set(d, p[6]), p21 = hn::Set(d, p[7]), p22 = hn::Set(d, p[8]);
  HWY_ALIGN float transposed[width * row_width] = {};
  for (std::size_t i = 0; i < cosine.count; i += lanes) {
    const V x = hn::Mul(ax, hn::Load(d, cosine.x + i));
    const V y = hn::Mul(ay, hn::Load(d, cosine.y + i));
    const V z = hn::Load(d, cosine.z + i);
    V fx = hn::MulAdd(p00, x, hn::MulAdd(p01, y, hn::Mul(p02, z)));
    V fy = hn::MulAdd(p10, x, hn::MulAdd(p11, y, hn::Mul(p12, z)));
    V fz = hn::MulAdd(p20, x, hn::MulAdd(p21, y, hn::Mul(p22, z)));
    V u = hn::Zero(d);
    if constexpr (columns == 4) {
      u = hn::Load(d, matrix.u + i);
      fx = hn::MulAdd(hn::Set(d, matrix.q[0]), u, fx);
      fy = hn::MulAdd(hn::Set(d, matrix.q[1]), u, fy);
      fz = hn::MulAdd(hn::Set(d, matrix.q[2]), u, fz);
    }
    const V lateral = hn::MulAdd(fx, fx, hn::Mul(fy, fy));
    const V length = hn::Sqrt(hn::MulAdd(fz, fz, lateral));
    const V scale = hn::Div(one, length);
    const V ox = hn::Mul(fx, scale), oy = hn::Mul(fy, scale);
    // fz/|f| - 1 without cancellation where fz > 0; where fz <= 0 nothing cancels.
    const V ahead = hn::Neg(hn::Div(hn::Mul(lateral, scale), hn::Add(length, fz)));
    const V behind = hn::Sub(hn::Mul(fz, scale), one);
    const V oz = hn::IfThenElse(hn::Gt(fz, hn::Zero(d)), ahead, behind);
    hn::Store(ox, d, result.gx + i);
    hn::Store(oy, d, result.gy + i);
    hn::Store(oz, d, result.gz + i);
    V a[columns] = {hn::Mul(x, scale), hn::Mul(y, scale), hn::Mul(z, scale)};
    if constexpr (columns == 4)
      a[3] = hn::Mul(u, scale);
    for (std::size_t c = 0; c < columns; ++c) {
      hn::Store(hn::Mul(ox, a[c]), d, transposed + c * lanes);
      hn::Store(hn::Mul(oy, a[c]), d, transposed + (columns + c) * lanes);
      hn::Store(hn::Mul(oz, a[c]), d, transposed + (2 * columns + c) * lanes);
      hn::Store(a[c], d, transposed + (3 * columns + c) * lanes);
      hn::Store(a[c], d, transposed + (4 * columns + c) * lanes);
    }
    hn::Store(one, d, transposed + 5 * columns * lanes);
    float* row = result.rows + i * width;
    for (std::size_t sample = 0; sample < lanes; ++sample)
      for (std::size_t entry = 0; entry < width; ++entry)
        row[sample * width + entry] = transposed[entry * lanes + sample];
  }
}

void transform_samples(const FrameMatrix& matrix, const Points& cosine, const SampleRows& result) {
  if (matrix.q)
    transform_columns<4>(matrix, cosine, result);
  else
    transform_columns<3>(matrix, cosine, result);
}

void project_and_bin(const ProjectionMap& map, const Points& g, std::size_t bin_count, float* xi,
                     std::int32_t* bins) {
  const Floats d;
  const Ints di;
  const V dx = hn::Set(d, map.direction_x), dy = hn::Set(d, map.direction_y);
  const V dz = hn::Set(d, map.direction_z);
  const V centre = hn::Set(d, map.centre), inverse_scale = hn::Set(d, map.inverse_scale);
  const V one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f * static_cast<float>(bin_count));
  const auto last = hn::Set(di, static_cast<std::int32_t>(bin_count) - 1);
  const auto zero = hn::Zero(di);
  for (std::size_t i = 0; i < g.count; i += hn::Lanes(d)) {
    const V projection =
        hn::MulAdd(dx, hn::Load(d, g.x + i),
                   hn::MulAdd(dy, hn::Load(d, g.y + i), hn::Mul(dz, hn::Load(d, g.z + i))));
    const V z = hn::Mul(hn::Sub(projection, centre), inverse_scale);
    const V hypotenuse = hn::Sqrt(hn::MulAdd(z, z, one));
    V t = hn::Div(z, hypotenuse);
    if (map.spacing == BinSpacing::graded) {
      // 1 - |t| without cancellation.
      const V beyond = hn::Div(one, hn::Mul(hypotenuse, hn::Add(hypotenuse, hn::Abs(z))));
      t = hn::CopySign(hn::Sub(one, hn::Sqrt(beyond)), z);
    }
    const auto bin = hn::ConvertTo(di, hn::MulAdd(t, half, half));
    hn::Store(projection, d, xi + i);
    hn::Store(hn::Max(zero, hn::Min(bin, last)), di, bins + i);
  }
}

// accumulate_rows for a group of fixed size, so that its loops unroll.
template <std::size_t group, std::size_t columns>
void accumulate_group(const BinnedSamples& samples, const float* rows, const float* direction_z,
                      const BinSums& result) {
  constexpr std::size_t width = row_width_of(columns);
  // Values of their own: the compiler cannot know that what is written is not them.
  const auto [xi, bins, count, bin_count] = samples;
  const auto [sums, populations] = result;
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  // Factor of lane l along direction g is constant[g][l] + xi slope[l].
  HWY_ALIGN float constant[group][width], slope[width];
  for (std::size_t lane = 0; lane < width; ++lane) {
    slope[lane] = lane < 4 * columns || lane == 5 * columns ? 1.0f : 0.0f;
    for (std::size_t g = 0; g < group; ++g)
      constant[g][lane] = lane < 3 * columns                          ? direction_z[g]
                          : lane >= 4 * columns && lane < 5 * columns ? 1.0f
                                                                      : 0.0f;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const float* row = rows + i * width;
    for (std::size_t g = 0; g < group; ++g) {
      const V projection = hn::Set(d, xi[g * count + i]);
      const std::size_t bin = g * bin_count + static_cast<std::size_t>(bins[g * count + i]);
      float* sum = sums + bin * width;
      for (std::size_t part = 0; part < width; part += lanes) {
        const V factor =
            hn::MulAdd(projection, hn::Load(d, slope + part), hn::Load(d, constant[g] + part));
        hn::Store(hn::MulAdd(factor, hn::Load(d, row + part), hn::Load(d, sum + part)), d,
                  sum + part);
      }
      ++populations[bin];
    }
  }
}

template <std::size_t columns>
void accumulate_columns(const BinnedSamples& samples, const float* rows, const float* direction_z,
                        std::size_t group, const BinSums& result) {
  if (group == directions_at_once) {
    accumulate_group<directions_at_once, columns>(samples, rows, direction_z, result);
    return;
  }
  const auto [xi, bins, count, bin_count] = samples;
  for (std::size_t g = 0; g < group; ++g)
    accumulate_group<1, columns>(
        {xi + g * count, bins + g * count, count, bin_count}, rows, direction_z + g,
        {result.sums + g * bin_count * row_width_of(columns), result.populations + g * bin_count});
}

void accumulate_rows(const BinnedSamples& samples, const float* rows, const float* direction_z,
                     std::size_t group, const BinSums& result, std::size_t columns) {
  if (columns == 4)
    accumulate_columns<4>(samples, rows, direction_z, group, result);
  else
    accumulate_columns<3>(samples, rows, direction_z, group, result);
}

void accumulate_weights(const float* xi, const std::int32_t* bins, const float* weights,
                        std::size_t count, float* scratch, float* sums) {
  const Floats d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const V weight = hn::Load(d, weights + i);
    hn::StoreInterleaved2(weight, hn::Mul(weight, hn::Load(d, xi + i)), d, scratch + 2 * i);
  }
  // One pair at a time; two single values where the target has no vectors.
  const hn::CappedTag<float, 2> pair;
  for (std::size_t i = 0; i < count; ++i) {
    float* sum = sums + 2 * static_cast<std::size_t>(bins[i]);
    for (std::size_t part = 0; part < 2; part += hn::Lanes(pair))
      hn::StoreU(hn::Add(hn::LoadU(pair, sum + part), hn::LoadU(pair, scratch + 2 * i + part)),
                 pair, sum + part);
  }
}

// Integral of the target's quantile function from 0 to u in [0, 1].
V integrated_quantile(const TargetCells& target, std::size_t bin_count, V u) {
  const Floats d;
  const Ints di;
  const auto one = hn::Set(di, 1);
  const auto last_cell = hn::Set(di, static_cast<std::int32_t>(bin_count) - 1);
  const V scaled = hn::Mul(u, hn::Set(d, static_cast<float>(bin_count)));
  auto cell = hn::GatherIndex(di, target.first_cell, hn::Min(hn::ConvertTo(di, scaled), last_cell));
  for (;;) {
    const V upper = hn::GatherIndex(d, target.mass, hn::Add(cell, one));
    const auto up = hn::And(hn::RebindMask(di, hn::Lt(upper, u)), hn::Lt(cell, last_cell));
    if (hn::AllFalse(di, up))
      break;
    cell = hn::Add(cell, hn::IfThenElseZero(up, one));
  }
  const V unit = hn::Set(d, 1.0f);
  const auto within = [&](V share) { return hn::Min(unit, hn::Max(hn::Zero(d), share)); };
  const V inverse_width = hn::GatherIndex(d, target.inverse_width, cell);
  const V s = within(hn::Mul(hn::Sub(u, hn::GatherIndex(d, target.mass, cell)), inverse_width));
  const V cubic =
      hn::MulAdd(s, hn::GatherIndex(d, target.c3, cell), hn::GatherIndex(d, target.c2, cell));
  const V quadratic = hn::MulAdd(s, cubic, hn::GatherIndex(d, target.c1, cell));
  const V inside = hn::MulAdd(s, quadratic, hn::GatherIndex(d, target.moment, cell));
  const V first = hn::Mul(hn::Set(d, target.first_tail), hn::Sqrt(s));
  // 1 - s from 1 - u: the root would make a thousandth of a rounding of s near 1.
  const V left = within(hn::Mul(hn::Sub(unit, u), inverse_width));
  const V last = hn::Mul(hn::Set(d, target.last_tail), hn::Sub(unit, hn::Sqrt(left)));
  const auto is_first = hn::RebindMask(d, hn::Eq(cell, hn::Zero(di)));
  const auto is_last = hn::RebindMask(d, hn::Eq(cell, last_cell));
  return hn::Add(inside, hn::IfThenElse(is_first, first, hn::IfThenElseZero(is_last, last)));
}

// jacobian_of_sums for every bin, padded with zeros to rows.
template <std::size_t columns>
void store_jacobians(const ProjectionMap& map, const float* sums, std::size_t bin_count,
                     float* jacobians) {
  constexpr std::size_t width = row_width_of(columns);
#if HWY_TARGET <= HWY_AVX3
  if constexpr (columns == 3) {
    // A row is a register: lane l is factor[l] sum[source[l]] - sum[l].
    const Floats d;
    HWY_ALIGN const std::int32_t source[row_width] = {12, 13, 14, 12, 13, 14, 9, 10,
                                                      11, 0,  0,  0,  0,  0,  0, 0};
    const float x = map.direction_x, y = map.direction_y;
    HWY_ALIGN const float factor[row_width] = {x, x, x, y, y, y, -1, -1, -1};
    const auto indices = hn::SetTableIndices(d, source);
    const V factors = hn::Load(d, factor);
    const auto used = hn::FirstN(d, 9);
    for (std::size_t b = 0; b < bin_count; ++b) {
      const V sum = hn::Load(d, sums + b * row_width);
      // Not fused, like jacobian_of_sums: the same bits.
      const V jacobian = hn::Sub(hn::Mul(factors, hn::TableLookupLanes(sum, indices)), sum);
      hn::Store(hn::IfThenElseZero(used, jacobian), d, jacobians + b * row_width);
    }
    return;
  }
#endif
  for (std::size_t b = 0; b < bin_count; ++b) {
    float* jacobian = jacobians + b * width;
    jacobian_of_sums<static_cast<int>(columns)>(map, sums + b * width, jacobian);
    for (std::size_t lane = 3 * columns; lane < width; ++lane)
      jacobian[lane] = 0;
  }
}

template <std::size_t columns>
void reduce_columns(const DirectionBins& of, const TargetCells& target, float smoothing,
                    float* scratch, DirectionSums& result) {
  constexpr std::size_t width = row_width_of(columns), numbers = 3 * columns;
  const auto& [map, sums, populations, bin_count, count, unused] = of;
  const Floats d;
  const Ints di;
  const std::size_t lanes = hn::Lanes(d);
  float* const integral = scratch;  // one place later: integral[b + 1] is that below bin b's top
  float* const xi_sums = scratch + bin_count;
  float* const pulls = scratch + 2 * bin_count;
  float* const factors = scratch + 3 * bin_count;
  const float share = 1.0f / static_cast<float>(count);
  std::int32_t below = 0;
  for (std::size_t b = 0; b < bin_count; ++b) {
    below += populations[b];
    pulls[b] = static_cast<float>(below) * share;
    xi_sums[b] = sums[b * width + 5 * columns];
  }
  for (std::size_t b = 0; b < bin_count; b += lanes)
    hn::Store(integrated_quantile(target, bin_count, hn::Load(d, pulls + b)), d, integral + b);
  // Sixteen sums, whatever the vector's length: the same bits.
  HWY_ALIGN float losses[row_width] = {};
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), epsilon = hn::Set(d, smoothing);
  const V total = hn::Set(d, static_cast<float>(count));
  float previous = 0;
  for (std::size_t b = 0; b < bin_count; b += lanes) {
    const V population = hn::ConvertTo(d, hn::Load(di, populations + b));
    const auto empty = hn::Eq(population, zero);
    const V inverse = hn::Div(one, hn::IfThenElse(empty, one, population));
    const V upper = hn::Load(d, integral + b);
    HWY_ALIGN float shifted[row_width];
    shifted[0] = previous;
    for (std::size_t lane = 1; lane < lanes; ++lane)
      shifted[lane] = integral[b + lane - 1];
    previous = integral[b + lanes - 1];
    const V target_sum = hn::Mul(hn::Sub(upper, hn::Load(d, shifted)), total);
    const V difference = hn::IfThenZeroElse(empty, hn::Sub(hn::Load(d, xi_sums + b), target_sum));
    const V residual = hn::Mul(difference, inverse);
    const V weight = hn::Div(one, hn::Add(hn::Abs(residual), epsilon));
    float* const loss = losses + b % row_width;
    hn::Store(hn::Add(hn::Load(d, loss), hn::Abs(difference)), d, loss);
    hn::Store(hn::Mul(residual, weight), d, pulls + b);
    hn::Store(hn::IfThenZeroElse(empty, hn::Mul(weight, inverse)), d, factors + b);
  }
  // In two passes: a vector load of what scalar stores have just written would have to wait for
  // them.
  float* const jacobians = scratch + 4 * bin_count;
  store_jacobians<columns>(map, sums, bin_count, jacobians);
  V gradient[width], hessian[numbers * width];
  // The last lanes carry nothing; registers that hold only those are left out.
  const std::size_t parts = (numbers + lanes - 1) / lanes;
  for (std::size_t part = 0; part < parts; ++part) {
    gradient[part] = hn::Load(d, result.gradient + part * lanes);
    for (std::size_t row = 0; row < numbers; ++row)
      hessian[row * parts + part] = hn::Load(d, result.hessian + row * width + part * lanes);
  }
  for (std::size_t b = 0; b < bin_count; ++b) {
    const float* jacobian = jacobians + b * width;
    for (std::size_t part = 0; part < parts; ++part) {
      const V j = hn::Load(d, jacobian + part * lanes);
      gradient[part] = hn::MulAdd(hn::Set(d, pulls[b]), j, gradient[part]);
      const V scaled = hn::Mul(hn::Set(d, factors[b]), j);
      for (std::size_t row = 0; row < numbers; ++row)
        hessian[row * parts + part] =
            hn::MulAdd(hn::Set(d, jacobian[row]), scaled, hessian[row * parts + part]);
    }
  }
  for (std::size_t part = 0; part < parts; ++part) {
    hn::Store(gradient[part], d, result.gradient + part * lanes);
    for (std::size_t row = 0; row < numbers; ++row)
      hn::Store(hessian[row * parts + part], d, result.hessian + row * width + part * lanes);
  }
  for (const float loss : losses)
    result.loss += static_cast<double>(loss);
}

void reduce_direction(const DirectionBins& of, const TargetCells& target, float smoothing,
                      float* scratch, DirectionSums& result) {
  if (of.columns == 4)
    reduce_columns<4>(of, target, smoothing, scratch, result);
  else
    reduce_columns<3>(of, target, smoothing, scratch, result);
}

}  // namespace ltc::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ltc::kernels {

HWY_EXPORT(transform_samples);
HWY_EXPORT(project_and_bin);
HWY_EXPORT(accumulate_rows);
HWY_EXPORT(accumulate_weights);
HWY_EXPORT(reduce_direction);

void transform_samples(const FrameMatrix& matrix, const Points& cosine, const SampleRows& result) {
  HWY_DYNAMIC_DISPATCH(transform_samples)(matrix, cosine, result);
}

void project_and_bin(const ProjectionMap& map, const Points& g, std::size_t bin_count, float* xi,
                     std::int32_t* bins) {
  HWY_DYNAMIC_DISPATCH(project_and_bin)(map, g, bin_count, xi, bins);
}

void accumulate_rows(const BinnedSamples& samples, const float* rows, const float* direction_z,
                     std::size_t group, const BinSums& result, std::size_t columns) {
  HWY_DYNAMIC_DISPATCH(accumulate_rows)(samples, rows, direction_z, group, result, columns);
}

void accumulate_weights(const float* xi, const std::int32_t* bins, const float* weights,
                        std::size_t count, float* scratch, float* sums) {
  HWY_DYNAMIC_DISPATCH(accumulate_weights)(xi, bins, weights, count, scratch, sums);
}

void reduce_direction(const DirectionBins& of, const TargetCells& target, float smoothing,
                      float* scratch, DirectionSums& result) {
  HWY_DYNAMIC_DISPATCH(reduce_direction)(of, target, smoothing, scratch, result);
}

}  // namespace ltc::kernels
#endif
