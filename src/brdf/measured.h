// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A BRDF given by its values on a grid of view and light directions: measured, or computed by an
// engine's own shading code. Its model's name is the file it comes from (docs/materials.md).
//
// Between the nodes values are interpolated linearly in every angle and roughness. So lobes should
// be wider than the steps between light directions, and views so dense that lobes move by less than
// their width from one to the next; at a table's nodes that are also the file's, views are not
// interpolated at all.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "brdf/lobe_model.h"

namespace ltc {

// Axes rise strictly; angles in radians. Values are the BRDF, 1/sr and not negative, or what it is
// times the cosine of the light's elevation; in C order of (alpha, lambda, theta, phi, theta_light,
// phi_light). Beyond the first and the last light elevation the BRDF stays what it is there.
struct MeasuredBrdf {
  std::vector<double> alpha, lambda, theta, phi;  // of lobes, as a table's axes have them
  std::vector<double> theta_light;                // in [0, pi/2]
  // With one node of phi, counted from the view's azimuth: on [0, pi] both ends included, light of
  // the other half turn mirrored. With more, azimuths on [0, 2 pi), the turn closed.
  std::vector<double> phi_light;
  std::vector<float> values;

  std::vector<std::size_t> shape() const {
    return {alpha.size(), lambda.size(),      theta.size(),
            phi.size(),   theta_light.size(), phi_light.size()};
  }
  bool turns() const { return phi.size() == 1; }
};

// Throws InputError, naming `source`, the value and what is allowed, unless all of the above holds
// and every lobe reflects something.
void require_sound(const MeasuredBrdf& brdf, const std::string& source);

// Whether a model's name is that of such a file: it ends in .h5 or .hdf5.
bool names_brdf_file(std::string_view name);

// The model of that file, the same one for the same name as long as the program runs. The file is
// read when the model is first asked for a lobe, or by require(): tables are read without it.
const LobeModel& measured(std::string_view name);

}  // namespace ltc
