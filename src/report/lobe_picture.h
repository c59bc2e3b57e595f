// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The picture of a lobe: GGX, its LTC, one that is folded where there is one, and the difference to
// GGX side by side, and how the fit went.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "picture/canvas.h"
#include "picture/chart.h"
#include "picture/panel.h"
#include "report/lobe_density.h"

namespace ltc {

// The colour scale that the lobes share: from zero, or logarithmic where a linear one would show a
// dot on an empty ground (the peak above `sharp_peak` times the mean).
inline constexpr double sharp_peak = 12;
picture::Scale density_scale(const picture::Field& ggx, std::span<const picture::Field> beside);

// "alpha_x 0.4, alpha_y 0.1, θ 60°, φ 30°".
std::string lobe_caption(const Lobe& lobe);

// GGX, what is shown beside it, and how the last of these differs from GGX. `words` are written
// above and below, with a line on the projection.
struct NamedLobe {
  std::string name;
  LtcLobe lobe;
};
picture::PanelRow lobe_panels(const Lobe& lobe, const std::vector<NamedLobe>& beside,
                              picture::Words words, std::size_t side = 256);
// Of an LTC alone.
picture::PanelRow lobe_panels(const Lobe& lobe, const Eigen::Matrix3d& matrix, picture::Words words,
                              std::size_t side = 256);

// The panels, and a chart below them if it has a series.
picture::Canvas render_lobe(const picture::PanelRow& panels, const picture::Chart& chart,
                            int width = 1600);

}  // namespace ltc
