// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "config/registry.h"

#include "brdf/lobe_model.h"
#include "core/error.h"

namespace ltc::config {
namespace {

constexpr double most_seed = 9007199254740992;  // 2^53: exact wherever JSON or a double carries it

// The four keys of an axis; angles carry their unit in the name.
template <typename Member>
std::vector<Key> axis_keys(std::string section, Member axis, std::string_view unit, Range range) {
  section = "table." + section + ".";
  return {
      key(
          section + "first" + std::string(unit), [=](Draft& d) { return &axis(d)->first; }, range,
          "value of the first node"),
      key(
          section + "last" + std::string(unit), [=](Draft& d) { return &axis(d)->last; }, range,
          "value of the last node"),
      key(
          section + "nodes", [=](Draft& d) { return &axis(d)->nodes; }, Range{1, 64},
          "number of nodes; one node stands at the first value"),
      key(
          section + "warp", [=](Draft& d) { return &axis(d)->warp; },
          "where the nodes are dense: linear nowhere, sqrt near first, complement-sqrt near last, "
          "half-sine as engines have theta"),
  };
}

// One of the models by its name, or a file of values.
Key brdf_key() {
  std::string allowed;
  for (const LobeModel* model : lobe_models())
    allowed += quoted(model->name()) + ", ";
  return {"table.brdf", allowed + "or the name of a file of values, ending in .h5",
          "the BRDF that is fitted (docs/materials.md)",
          [](Draft& d, const Value& value) {
            const auto* text = std::get_if<std::string>(&value);
            if (!text)
              return false;
            try {
              d.config.grid.model = &lobe_model(*text);
            } catch (const InputError&) {
              return false;
            }
            return true;
          },
          [](const Draft& d) -> Value { return std::string(d.config.grid.model->name()); }};
}

// clang-format off
std::vector<Key> table_keys() {
  std::vector<Key> all = {
      brdf_key(),
      key("table.storage", [](Draft& d) { return &d.config.storage; }, "what the table holds and a reader interpolates"),
      key("table.alpha_min", [](Draft& d) { return &d.config.grid.alpha_min; }, Range{1e-6, 1}, "least roughness: smaller alpha_x and alpha_y are raised to it"),
  };
  const auto add = [&](const std::vector<Key>& more) { all.insert(all.end(), more.begin(), more.end()); };
  add(axis_keys("alpha", [](Draft& d) { return &d.alpha; }, "", {0, 1}));
  add(axis_keys("lambda", [](Draft& d) { return &d.lambda; }, "", {0, 1}));
  add(axis_keys("theta", [](Draft& d) { return &d.theta_degrees; }, "_degrees", {0, 90}));
  add(axis_keys("phi", [](Draft& d) { return &d.phi_degrees; }, "_degrees", {0, 90}));
  return all;
}

std::vector<Key> fit_keys() {
  return {
      key("fit.solver", [](Draft& d) { return &d.config.fit.solver; }, "which optimiser fits the matrices"),
      key("fit.lobe", [](Draft& d) { return &d.config.fit.lobe; }, "a single LTC, or one that a fold bends first (docs/folded.md); folded ones by gauss-newton alone"),
      key("fit.crease", [](Draft& d) { return &d.config.fit.crease; }, {0, 10}, "where folded lobes have their creases, |x| = crease z of the cosine"),
      key("fit.second_crease", [](Draft& d) { return &d.config.fit.second_crease; }, {0, 10}, "a second pair of creases, above the first; 0: none"),
      key("fit.horizon", [](Draft& d) { return &d.config.fit.horizon; }, "what shaders do about light below the horizon: \"clipped\"; or \"scaled\", and lobes are fitted for what is above alone (docs/accuracy.md)"),
      key("fit.interpolation", [](Draft& d) { return &d.config.fit.interpolation; }, "big unrefined tables: \"automatic\" fits some of their nodes and interpolates between them, \"off\" fits each"),
      key("fit.target", [](Draft& d) { return &d.config.fit.target; }, "how the lobe is sampled: weighted lattice, or algorithm 1 with rejection as published"),
      key("fit.seed", [](Draft& d) { return &d.config.fit.seed; }, {0, most_seed}, "seed of what is random: sgd, rejection, random starts; without effect on the default settings"),

      key("fit.gauss_newton.loss", [](Draft& d) { return &d.config.fit.gauss_newton.loss; }, "how the distribution of an LTC is found"),
      key("fit.gauss_newton.coarse_samples", [](Draft& d) { return &d.config.fit.gauss_newton.coarse_samples; }, {64, 65536}, "cosine samples of the coarse phase"),
      key("fit.gauss_newton.coarse_directions", [](Draft& d) { return &d.config.fit.gauss_newton.coarse_directions; }, {4, 4096}, "projection directions of the coarse phase"),
      key("fit.gauss_newton.coarse_steps", [](Draft& d) { return &d.config.fit.gauss_newton.coarse_steps; }, {0, 1000}, "most steps of the coarse phase, for each start"),
      key("fit.gauss_newton.coarse_tolerance", [](Draft& d) { return &d.config.fit.gauss_newton.coarse_tolerance; }, {0, 1}, "the coarse phase ends when a step gains less than this share of the loss"),
      key("fit.gauss_newton.samples", [](Draft& d) { return &d.config.fit.gauss_newton.samples; }, {64, 65536}, "cosine samples of the fine phase"),
      key("fit.gauss_newton.directions", [](Draft& d) { return &d.config.fit.gauss_newton.directions; }, {4, 4096}, "projection directions of the fine phase"),
      key("fit.gauss_newton.steps", [](Draft& d) { return &d.config.fit.gauss_newton.steps; }, {1, 1000}, "most steps of the fine phase"),
      key("fit.gauss_newton.tolerance", [](Draft& d) { return &d.config.fit.gauss_newton.tolerance; }, {0, 1}, "the fine phase ends when a step gains less than this share of the loss"),
      key("fit.gauss_newton.target_samples", [](Draft& d) { return &d.config.fit.gauss_newton.target_samples; }, {64, 1048576}, "GGX samples that the target's quantiles come from"),
      key("fit.gauss_newton.adaptive", [](Draft& d) { return &d.config.fit.gauss_newton.adaptive; }, "fit lobes that no LTC comes near with down to a quarter of the samples"),
      key("fit.gauss_newton.starts", [](Draft& d) { return &d.config.fit.gauss_newton.starts; }, {1, 16}, "starting points tried in the coarse phase"),
      key("fit.gauss_newton.start_margin", [](Draft& d) { return &d.config.fit.gauss_newton.start_margin; }, {0, 1e9}, "descend from a start only if its loss exceeds the least by at most this share of it"),
      key("fit.gauss_newton.neighbour_sweeps", [](Draft& d) { return &d.config.fit.gauss_newton.neighbour_sweeps; }, {0, 16}, "how often an entry tries its neighbours' solutions"),

      key("fit.sgd.steps", [](Draft& d) { return &d.config.fit.sgd.steps; }, {1, 10'000'000}, "steps an entry"),
      key("fit.sgd.samples", [](Draft& d) { return &d.config.fit.sgd.samples; }, {16, 1048576}, "cosine samples and GGX samples of a step"),
      key("fit.sgd.directions", [](Draft& d) { return &d.config.fit.sgd.directions; }, {1, 4096}, "random projection directions of a step"),
      key("fit.sgd.learning_rate", [](Draft& d) { return &d.config.fit.sgd.learning_rate; }, above(0, 1000), "learning rate"),
      key("fit.sgd.step_scale", [](Draft& d) { return &d.config.fit.sgd.step_scale; }, above(0, 1000), "the step size is learning_rate * step_scale * step_decay^step"),
      key("fit.sgd.step_decay", [](Draft& d) { return &d.config.fit.sgd.step_decay; }, above(0, 1), "factor on the step size after each step"),
      key("fit.sgd.averaged_steps", [](Draft& d) { return &d.config.fit.sgd.averaged_steps; }, {1, 10'000'000}, "the last steps whose matrices are averaged, at most all"),
      key("fit.sgd.start", [](Draft& d) { return &d.config.fit.sgd.start; }, "where the descent starts"),
      key("fit.sgd.scaled_variables", [](Draft& d) { return &d.config.fit.sgd.scaled_variables; }, "descend in the mirror's frame divided by the roughness, not in M itself"),
      key("fit.sgd.lattice_samples", [](Draft& d) { return &d.config.fit.sgd.lattice_samples; }, "draw a step's samples from randomly shifted lattices, not independently; needs the weighted target"),

      key("fit.l3.samples", [](Draft& d) { return &d.config.fit.l3.samples; }, {16, 65536}, "directions from the LTC, and as many from the lobe, that the L3 error is integrated with"),
      key("fit.l3.evaluations", [](Draft& d) { return &d.config.fit.l3.evaluations; }, {1, 1'000'000}, "most evaluations of the L3 error an entry"),
      key("fit.l3.tolerance", [](Draft& d) { return &d.config.fit.l3.tolerance; }, {0, 1}, "ends when the errors of the simplex differ by less than this share"),
      key("fit.l3.start", [](Draft& d) { return &d.config.fit.l3.start; }, "where the simplex starts"),
  };
}

std::vector<Key> refine_keys() {
  return {
      key("refine.steps", [](Draft& d) { return &d.config.refine.steps; }, {0, 1000}, "most outer steps; 0 for no refinement"),
      key("refine.start", [](Draft& d) { return &d.config.refine.start; }, "what refinement begins with"),
      key("refine.queries_per_cell", [](Draft& d) { return &d.config.refine.queries_per_cell; }, {1, 1000}, "queries refined on, for each cell of the table"),
      key("refine.table_share", [](Draft& d) { return &d.config.refine.table_share; }, {0, 1}, "share of the queries that are uniform in the table's own axes"),
      key("refine.node_weight", [](Draft& d) { return &d.config.refine.node_weight; }, {0, 1}, "share of the objective that the nodes' own lobes have"),
      key("refine.held_out_queries", [](Draft& d) { return &d.config.refine.held_out_queries; }, {100, 1'000'000}, "queries not refined on, which decide what is kept"),
      key("refine.damping", [](Draft& d) { return &d.config.refine.damping; }, above(0, 1e6), "first damping, as a share of the curvature's diagonal"),
      key("refine.overshoot", [](Draft& d) { return &d.config.refine.overshoot; }, above(0, 1.9), "steps are taken this many times as long as the model says"),
      key("refine.tolerance", [](Draft& d) { return &d.config.refine.tolerance; }, {0, 1}, "ends when a step gains less than this share of the loss"),
      key("refine.keep_smoothest", [](Draft& d) { return &d.config.refine.keep_smoothest; }, "leave the nodes with alpha <= alpha_min as they are"),
      key("refine.loss", [](Draft& d) { return &d.config.refine.sampling.loss; }, "how the distribution of a query's LTC is found"),
      key("refine.thresholds", [](Draft& d) { return &d.config.refine.sampling.thresholds; }, {4, 256}, "where along a direction distributions are compared, by arcs"),
      key("refine.samples", [](Draft& d) { return &d.config.refine.sampling.samples; }, {64, 65536}, "cosine samples a query, where it is measured on samples"),
      key("refine.directions", [](Draft& d) { return &d.config.refine.sampling.directions; }, {4, 4096}, "projection directions a query"),
      key("refine.target_samples", [](Draft& d) { return &d.config.refine.sampling.target_samples; }, {64, 1048576}, "GGX samples a query"),
      key("refine.roughness_first", [](Draft& d) { return &d.config.refine.range.roughness_first; }, {0, 1}, "least perceptual roughness asked for, where no scene says"),
      key("refine.roughness_last", [](Draft& d) { return &d.config.refine.range.roughness_last; }, {0, 1}, "largest perceptual roughness asked for, where no scene says"),
  };
}

std::vector<Key> field_keys() {
  return {
      key("field.size", [](Draft& d) { return &d.config.field.size; }, {0, 8192}, "numbers of a field's matrix; 0 for a table of fits, no field"),
      key("field.albedo_size", [](Draft& d) { return &d.config.field.albedo_size; }, {10, 2000}, "numbers of its amplitude and Fresnel term together"),
      key("field.loss", [](Draft& d) { return &d.config.field.loss; }, {0, 1}, "the smallest field whose held-out loss is at most this, of at most field.size; 0: of that size"),
      key("field.half", [](Draft& d) { return &d.config.field.half; }, "coefficients that 16 bits hold, rounded while they are fitted"),
      key("field.queries", [](Draft& d) { return &d.config.field.queries; }, {1000, 1'000'000}, "look-ups that the field is fitted to"),
      key("field.edge_share", [](Draft& d) { return &d.config.field.edge_share; }, {0, 1}, "share of them spread over the whole domain, its edges too, not as asked for"),
      key("field.steps", [](Draft& d) { return &d.config.field.steps; }, {1, 1000}, "most steps once its terms are chosen"),
  };
}

std::vector<Key> output_keys() {
  return {
      file_name_key("output.name", [](Draft& d) { return &d.config.output.name; }, "the files are NAME.h5, NAME.0.exr and so on"),
      key("output.field", [](Draft& d) { return &d.config.output.field; }, "write NAME_field.json where there is a field"),
      key("output.hdf5", [](Draft& d) { return &d.config.output.hdf5; }, "write HDF5: everything, with what made it"),
      key("output.exr", [](Draft& d) { return &d.config.output.exr; }, "write OpenEXR textures: for engines"),
      key("output.npy", [](Draft& d) { return &d.config.output.npy; }, "write NPY: the matrices alone"),
      key("output.dds", [](Draft& d) { return &d.config.output.dds; }, "write DDS textures"),
      key("output.ktx2", [](Draft& d) { return &d.config.output.ktx2; }, "write KTX2 textures"),
      key("output.json", [](Draft& d) { return &d.config.output.json; }, "write the textures as JSON arrays"),
      key("output.javascript", [](Draft& d) { return &d.config.output.javascript; }, "write the textures as a JavaScript module"),
      key("output.c_header", [](Draft& d) { return &d.config.output.c_header; }, "write the textures as a C header"),
      key("output.c_sharp", [](Draft& d) { return &d.config.output.c_sharp; }, "write the texture as Unity's C#; needs layout = \"unity\""),
      key("output.header", [](Draft& d) { return &d.config.output.header; }, "write a C header that looks up, integrates polygons and samples; in place of c_header"),
      key("output.shaders", [](Draft& d) { return &d.config.output.shaders; }, "write what shaders want in GLSL, HLSL and WGSL: a table's constants, a field as functions (also in JavaScript)"),
      key("output.raw", [](Draft& d) { return &d.config.output.raw; }, "write the textures' bytes, with a JSON file beside that describes them"),
      key("output.exr_half", [](Draft& d) { return &d.config.output.exr_half; }, "16-bit OpenEXR instead of 32-bit"),
      key("output.half", [](Draft& d) { return &d.config.output.half; }, "16-bit values in DDS, KTX2 and raw files, else 32-bit"),
      key("output.layout", [](Draft& d) { return &d.config.output.layout; }, "how values lie in the textures of DDS, KTX2, JSON, JavaScript, C and raw files"),
      key("output.zstd", [](Draft& d) { return &d.config.output.zstd; }, "compress KTX2"),
      key("output.javascript_style", [](Draft& d) { return &d.config.output.javascript_style; }, "a module of arrays, or the one that three.js imports"),
  };
}
// clang-format on

}  // namespace

const std::vector<Key>& keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> keys;
    for (const std::vector<Key>& section :
         {table_keys(), fit_keys(), refine_keys(), field_keys(), output_keys()})
      keys.insert(keys.end(), section.begin(), section.end());
    return keys;
  }();
  return all;
}

}  // namespace ltc::config
