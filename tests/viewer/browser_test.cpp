// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The page of `ltcfit view` in a browser: its numbers are those of `ltcfit render`, its controls
// and its address say the same, and what cannot work says why.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/run_context.h"
#include "field/synthetic_field.h"
#include "render/sphere_images.h"
#include "report/viewer_page.h"
#include "support/program.h"
#include "table/field_table.h"
#include "table/synthetic.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

using nlohmann::json;

bool found(const std::string& program) {
  return run_program({"sh", "-c", "command -v " + program}).exit_code == 0;
}

class Viewer : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* needed : {"node", "chromium"})
      if (!found(needed))
        GTEST_SKIP() << "no " << needed;
  }

  void write_page(const std::vector<ViewedTable>& tables) {
    folder_.write("page.html", viewer_page(tables));
  }

  // What the steps of tests/viewer/drive.mjs found.
  json drive(const json& steps, const std::vector<std::string>& options = {}) {
    folder_.write("steps.json", steps.dump());
    std::vector<std::string> command{"node", LTCFIT_SOURCE_DIR "/tests/viewer/drive.mjs",
                                     "page.html", "steps.json"};
    command.insert(command.end(), options.begin(), options.end());
    const ProgramResult result = run_program(command, folder_.path());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.exit_code == 0 ? json::parse(result.out) : json();
  }

  TemporaryDirectory folder_;
  const Table nodes_ = testing::synthetic_table(Grid::paper(3), Storage::mirror_frame);
  const Table field_ =
      table_of_field(testing::synthetic_field(), Grid::paper(2), Storage::matrix, {1, nullptr});
};

const json is_there = {{"until", "window.ltcViewer"}};
const json window_size = {{"size", {900, 700}}};
json opened(const std::string& fragment) {
  return {{"open", fragment}};
}
json evaluated(const std::string& name, const std::string& expression) {
  return {{"value", {name, expression}}};
}
json done(const std::string& script) {
  return {{"do", script}};
}
json key(const std::string& name) {
  return {{"key", json::array({name})}};
}
const std::string status_text = "document.getElementById('status').textContent";
const std::string message_text = "document.getElementById('message').textContent";

// ---- Numbers ----

constexpr std::size_t side = 40;

SphereImages rendered(const std::vector<const Table*>& tables, const SphereMaterial& material,
                      LightShape light = LightShape::rectangle) {
  SphereSettings settings;
  settings.scene.light = standard_light(light, usual_light_position(settings.scene.shape), 1);
  settings.size = side;
  settings.samples = 8192;
  return render_sphere(tables, material, settings, "render", {2, nullptr});
}

// Rows from below, RGBA, against rows from above. The page computes in single precision; 1e-3 of
// the light's radiance is a fifth of a step of 8 bits where light is full. A ray that touches the
// outline may meet the sphere here and miss it there: such pixels are told by their cover.
void expect_alike(const json& pixels, const picture::Field& expected,
                  const picture::Field& coverage, double tolerance = 1e-3) {
  ASSERT_EQ(pixels.size(), 4 * side * side);
  std::size_t touched = 0;
  for (std::size_t y = 0; y < side; ++y)
    for (std::size_t x = 0; x < side; ++x) {
      const std::size_t at = y * side + x, below = 4 * ((side - 1 - y) * side + x);
      if (std::abs(pixels[below + 3].get<double>() - coverage.values[at]) > 0.01) {
        ++touched;
        continue;
      }
      for (std::size_t channel = 0; channel < 3; ++channel)
        ASSERT_NEAR(pixels[below + channel].get<double>(), expected.values[at], tolerance)
            << x << ", " << y;
    }
  EXPECT_LE(touched, 4u);
}

json measuring_steps(const std::string& fragment) {
  const std::string size = fmt::format("[{0}, {0}]", side);
  return {opened(fragment),
          is_there,
          done("ltcViewer.fix(" + size + ")"),
          {{"until", "ltcViewer.state().finished || " + message_text}},
          evaluated("a " + fragment, "ltcViewer.pixels(0)"),
          evaluated("b " + fragment, "ltcViewer.pixels(1)"),
          evaluated("errors " + fragment, "ltcViewer.state().errors")};
}

TEST_F(Viewer, ItsPicturesAndErrorsAreThoseOfRender) {
  write_page({{"nodes", &nodes_}, {"field", &field_}});
  const std::vector<std::pair<std::string, SphereMaterial>> cases{
      {"#alpha_x=0.1&alpha_y=0.4", {0.1, 0.4, 1}},
      {"#alpha_x=0.6&alpha_y=0.25&f0=0.04&view=difference", {0.6, 0.25, 0.04}}};
  json steps{window_size};
  for (const auto& [fragment, material] : cases)
    for (const json& step : measuring_steps(fragment))
      steps.push_back(step);
  const json results = drive(steps);
  EXPECT_EQ(results["errors"], json::array());
  for (const auto& [fragment, material] : cases) {
    const SphereImages images = rendered({&nodes_, &field_}, material);
    expect_alike(results["a " + fragment], images.ltc[0], images.coverage);
    expect_alike(results["b " + fragment], images.ltc[1], images.coverage);
    for (std::size_t table = 0; table < 2; ++table) {
      const SphereError expected = sphere_error(images, table);
      const json& error = results["errors " + fragment][table];
      // Both have noise in them, which adds to the square of what is measured.
      const double noise = error["noise"].get<double>() + expected.relative_noise;
      EXPECT_LE(error["noise"].get<double>(), 0.01);
      EXPECT_NEAR(error["rmse"].get<double>(), expected.relative_rmse, noise) << fragment;
      EXPECT_NEAR(error["mean"].get<double>() / expected.reference_mean, 1, noise) << fragment;
    }
  }
}

// Isotropic tables are turned, those over alpha_x and alpha_y not swapped, halfs are halfs; the
// texture unit of some 8 bits is off by what these are worth.
TEST_F(Viewer, LooksUpInTablesOfEveryKind) {
  const SphereMaterial material{0.3, 0.3, 1};
  Grid isotropic = Grid::paper({4, 1, 5, 1});
  isotropic.lambda = Axis::make(1, 1, 1, Warp::linear);
  isotropic.phi = Axis::make(0, 0, 1, Warp::linear);
  const Table turned = testing::synthetic_table(isotropic, Storage::roughness_scaled);
  Table both = testing::synthetic_table(Grid::paper(3), Storage::matrix);
  both.grid.layout = Layout::alphax_alphay;
  Table halved = nodes_;
  for (std::vector<float>* values : {&halved.stored, &halved.amplitude, &halved.fresnel})
    for (float& value : *values)
      value = rounded(value, Precision::half);
  halved.precision = Precision::half;
  const std::string fragment = "#alpha_x=0.3&alpha_y=0.3";
  using Pair = std::pair<const Table*, const Table*>;
  for (const auto& [a, b] : {Pair(&turned, &both), Pair(&halved, &nodes_)}) {
    write_page({{"a", a}, {"b", b}});
    json steps{window_size};
    for (const json& step : measuring_steps(fragment))
      steps.push_back(step);
    steps.push_back(done("ltcViewer.set('lookup', 'filter')"));
    steps.push_back({{"until", "ltcViewer.state().ready"}});
    steps.push_back(evaluated("filtered", "ltcViewer.pixels(0)"));
    const json results = drive(steps);
    EXPECT_EQ(results["errors"], json::array());
    const SphereImages images = rendered({a, b}, material);
    expect_alike(results["a " + fragment], images.ltc[0], images.coverage);
    expect_alike(results["b " + fragment], images.ltc[1], images.coverage);
    const json &exact = results["a " + fragment], &filtered = results["filtered"];
    double most = 0;
    for (std::size_t i = 0; i < exact.size(); ++i)
      most = std::max(most, std::abs(exact[i].get<double>() - filtered[i].get<double>()));
    EXPECT_LT(most, 0.02);
  }
}

// In every light; but disks and spheres are polygons of other corners there, and lines strips of
// their width, not of none: 0.0045 for 0.065 here.
TEST_F(Viewer, FoldedLobesAreThoseOfRender) {
  const Table folded = table_of_field(testing::synthetic_folded_field(), Grid::paper(2),
                                      Storage::matrix, {1, nullptr});
  Table nodes = table_of_field(testing::synthetic_folded_field(), Grid::paper(3), Storage::folded,
                               {1, nullptr});
  nodes.field.reset();
  write_page({{"folded", &folded}, {"nodes", &nodes}});
  json steps{window_size};
  const std::vector<std::pair<std::string, LightShape>> lights{{"rectangle", LightShape::rectangle},
                                                               {"star", LightShape::star},
                                                               {"disk", LightShape::disk},
                                                               {"sphere", LightShape::sphere},
                                                               {"line", LightShape::line}};
  for (const auto& [name, light] : lights)
    for (const json& step :
         {opened("#alpha_x=0.1&alpha_y=0.4&light=" + name), is_there,
          done("ltcViewer.fix([40, 40])"),
          json{{"until", "ltcViewer.state().ready || " + message_text}},
          evaluated(name, "ltcViewer.pixels(0)"), evaluated("b" + name, "ltcViewer.pixels(1)")})
      steps.push_back(step);
  const json results = drive(steps);
  EXPECT_EQ(results["errors"], json::array());
  for (const auto& [name, light] : lights) {
    SCOPED_TRACE(name);
    const SphereImages images = rendered({&folded, &nodes}, {0.1, 0.4, 1}, light);
    const bool exact = light == LightShape::rectangle || light == LightShape::star;
    const double tolerance = exact ? 1e-3 : light == LightShape::line ? 0.01 : 3e-3;
    expect_alike(results[name], images.ltc[0], images.coverage, tolerance);
    expect_alike(results["b" + name], images.ltc[1], images.coverage, tolerance);
  }
}

// A quarter turn of the tangent frame is the other order of the roughnesses, and glTF's two numbers
// say the same material.
TEST_F(Viewer, TurningTheFrameSwapsTheRoughnesses) {
  write_page({{"nodes", &nodes_}});
  json steps{window_size};
  const std::vector<std::string> fragments{"#alpha_x=0.1&alpha_y=0.4",
                                           "#alpha_x=0.4&alpha_y=0.1&rotation=90"};
  for (const std::string& fragment : fragments)
    for (const json& step :
         {opened(fragment), is_there, done("ltcViewer.fix([40, 40])"),
          json{{"until", "ltcViewer.state().ready || " + message_text}},
          evaluated(fragment, "ltcViewer.pixels(0)"), done("ltcViewer.set('gltf', true)"),
          json{{"until", "ltcViewer.state().ready"}},
          evaluated("gltf " + fragment, "ltcViewer.pixels(0)"),
          evaluated("state " + fragment, "ltcViewer.state()")})
      steps.push_back(step);
  const json results = drive(steps);
  EXPECT_EQ(results["errors"], json::array());
  const json& expected = results[fragments[0]];
  for (const std::string& name : {fragments[1], "gltf " + fragments[0], "gltf " + fragments[1]}) {
    ASSERT_EQ(results[name].size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
      ASSERT_NEAR(results[name][i].get<double>(), expected[i].get<double>(), 2e-4) << name;
  }
  EXPECT_EQ(results["state " + fragments[1]]["rotation"], 90);
  EXPECT_EQ(results["state " + fragments[0]]["rotation"], 90);
  EXPECT_NEAR(results["state " + fragments[0]]["alphas"][0].get<double>(), 0.4, 1e-6);
}

// Every light on every object: the field is near enough to its lobes that gross mistakes, of a
// side, an area or an orientation, would show. The mean of the pictures alone is compared: to a
// fifth.
TEST_F(Viewer, EveryLightShinesAsBrightAsSampled) {
  const Table table = testing::synthetic_table(Grid::paper(8), Storage::mirror_frame);
  write_page({{"nodes", &table}});
  json steps{window_size};
  std::vector<std::string> names;
  for (const char* shape : {"sphere", "plane", "sheet"})
    for (const char* light : {"rectangle", "star", "disk", "sphere", "line", "picture"}) {
      const std::string fragment =
          fmt::format("#shape={}&light={}&alpha_x=0.15&alpha_y=0.1", shape, light);
      names.push_back(fragment);
      for (const json& step :
           {opened(fragment), is_there, done("ltcViewer.fix([32, 32])"),
            json{{"until", "ltcViewer.state().samples >= 256 || " + message_text}},
            evaluated("e" + fragment, "ltcViewer.state().errors"),
            evaluated("p" + fragment, "ltcViewer.pixels(0)"),
            evaluated("s" + fragment, status_text)})
        steps.push_back(step);
    }
  const json results = drive(steps);
  EXPECT_EQ(results["errors"], json::array());
  for (const std::string& name : names) {
    const json& pixels = results["p" + name];
    double sum = 0, pixel_count = 0;
    for (std::size_t i = 0; i < pixels.size(); i += 4)
      if (pixels[i + 3].get<double>() > 0) {
        sum +=
            (pixels[i].get<double>() + pixels[i + 1].get<double>() + pixels[i + 2].get<double>()) /
            3;
        ++pixel_count;
      }
    const double reference = results["e" + name][0]["mean"].get<double>();
    EXPECT_GT(reference, 1e-4) << name;
    EXPECT_NEAR(sum / pixel_count / reference, 1, 0.2) << name;
    EXPECT_EQ(results["s" + name].get<std::string>().find("touches"), std::string::npos) << name;
  }
}

// ---- Controls and address ----

const std::string fragment_now = "decodeURIComponent(location.hash)";

std::string slide(const std::string& id, const std::string& value) {
  return fmt::format(
      "{{ const e = document.getElementById('{}'); e.value = '{}'; for (const t of ['input', "
      "'change']) e.dispatchEvent(new Event(t, {{ bubbles: true }})); }}",
      id, value);
}
std::string click(const std::string& id) {
  return fmt::format("document.getElementById('{}').click()", id);
}

TEST_F(Viewer, EveryControlLandsInTheAddress) {
  write_page({{"nodes", &nodes_}, {"field", &field_}});
  // Roughnesses stand by their square roots, exposure by its logarithm.
  const std::vector<std::pair<std::string, std::string>> cases{
      {slide("alpha_x", "0.5"), "alpha_x=0.25"},
      {slide("alpha_y-number", "0.07"), "alpha_y=0.07"},
      {slide("rotation", "30"), "rotation=30"},
      {slide("f0", "0.5"), "f0=0.5"},
      {slide("metal", "copper"), "metal=copper"},
      {click("shape-plane"), "shape=plane"},
      {click("shape-sheet"), "shape=sheet"},
      {click("light-star"), "light=star"},
      {click("light-picture"), "light=picture"},
      {slide("light_size-number", "0.5"), "light_size=0.5"},
      {slide("light_x", "0.5"), "light_x=0.5"},
      {slide("light_y", "2"), "light_y=2"},
      {slide("light_z", "-1"), "light_z=-1"},
      {slide("exposure", "1"), "exposure=2"},
      {slide("lookup", "filter"), "lookup=filter"},
      {click("view-table_b"), "view=table_b"},
      {click("view-ggx"), "view=ggx"},
      {click("view-difference"), "view=difference"},
      {click("view-difference_b"), "view=difference_b"},
      {click("view-split"), "view=split"},
      {click("gltf"), "roughness="},
      {slide("roughness", "0.3"), "roughness=0.3"},
      {slide("anisotropy", "0.8"), "anisotropy=0.8"},
  };
  json steps{window_size,
             opened(""),
             is_there,
             done("ltcViewer.fix([16, 16])"),
             {{"until", "ltcViewer.state().ready || " + message_text}}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    steps.push_back(done(cases[i].first));
    steps.push_back(evaluated(std::to_string(i), fragment_now));
    steps.push_back({{"until", "ltcViewer.state().ready || " + message_text}});
  }
  for (const json& step :
       {done("document.getElementById('divider').focus()"), key("ArrowRight"),
        evaluated("divider", fragment_now), done("document.getElementById('picture').focus()"),
        key("ArrowRight"), key("ArrowUp"),
        // The address follows when nothing moves any more.
        json{{"until", "location.hash.includes('pitch')"}}, evaluated("keys", fragment_now),
        json{{"mouse", {"mousePressed", 250, 300}}}, json{{"drag", {300, 300}}},
        json{{"mouse", {"mouseReleased", 300, 300}}}, evaluated("drag", fragment_now),
        done(click("auto")), evaluated("auto", fragment_now), done(click("copy")),
        json{{"until", status_text + ".includes('link is')"}},
        evaluated("theme before", "getComputedStyle(document.body).backgroundColor"),
        done(click("theme")),
        evaluated("theme after", "getComputedStyle(document.body).backgroundColor"),
        done(click("reset")), evaluated("reset", fragment_now),
        evaluated("alphas", "ltcViewer.state().alphas"), evaluated("message", message_text)})
    steps.push_back(step);
  const json results = drive(steps);
  EXPECT_EQ(results["errors"], json::array());
  const auto expect_part = [&](const std::string& name, const std::string& part) {
    EXPECT_NE(results[name].get<std::string>().find(part), std::string::npos)
        << part << " in " << results[name];
  };
  for (std::size_t i = 0; i < cases.size(); ++i)
    expect_part(std::to_string(i), cases[i].second);
  expect_part("divider", "split=0.52");
  expect_part("keys", "yaw=5&pitch=5");
  EXPECT_NE(results["drag"], results["keys"]);
  expect_part("drag", "yaw=");
  EXPECT_EQ(results["auto"].get<std::string>().find("exposure"), std::string::npos);
  EXPECT_NE(results["theme before"], results["theme after"]);
  EXPECT_EQ(results["reset"], "");
  EXPECT_EQ(results["alphas"], (json{0.1, 0.4}));
  EXPECT_EQ(results["message"], "");
}

TEST_F(Viewer, TheAddressSaysWhatIsShown) {
  write_page({{"nodes", &nodes_}});
  const json results =
      drive({window_size,
             opened("#roughness=0.5&anisotropy=0.5&light_x=-1&exposure=3"),
             is_there,
             evaluated("alphas", "ltcViewer.state().alphas"),
             evaluated("text", "document.getElementById('light_x-number').value"),
             done("location.hash = '#alpha_x=2&alpha_y=0.3&lihgt=star&view=table_b&shape=cube'"),
             {{"until", "ltcViewer.state().alpha_y === 0.3"}},
             evaluated("status", status_text),
             evaluated("state", "ltcViewer.state()"),
             done("location.hash = '#alpha_x=0x1&rotation=1e999&f0='"),
             {{"until", "ltcViewer.state().alpha_y === 0.4"}},
             evaluated("odd", status_text)});
  EXPECT_EQ(results["errors"], json::array());
  // alpha = 0.25, mixed towards 1 by 0.25 along the tangent.
  EXPECT_EQ(results["alphas"], (json{0.4375, 0.25}));
  EXPECT_EQ(results["text"], "-1");
  const std::string status = results["status"];
  for (const char* part :
       {"alpha_x=2 is not allowed; expected a number in [0.0001, 1]; taken: 0.1.",
        "lihgt is unknown; known: view, ",
        "shape=cube is not allowed; expected sphere, plane, sheet",
        "view=table_b is not allowed; expected a second table"})
    EXPECT_NE(status.find(part), std::string::npos) << part << " in " << status;
  EXPECT_EQ(results["state"]["alphas"], (json{0.1, 0.3}));
  EXPECT_EQ(results["state"]["shape"], "sphere");
  for (const char* part : {"alpha_x=0x1 is not", "rotation=1e999 is not", "f0= is not"})
    EXPECT_NE(results["odd"].get<std::string>().find(part), std::string::npos) << results["odd"];
}

// The middle of the sphere is seen along the normal.
TEST_F(Viewer, TellsWhatLiesUnderThePointer) {
  write_page({{"nodes", &nodes_}});
  const json results = drive(
      {window_size,
       opened("#alpha_x=0.1&alpha_y=0.4"),
       is_there,
       done("ltcViewer.fix([32, 32])"),
       {{"until", "ltcViewer.state().finished"}},
       done("document.getElementById('picture').focus()"),
       // Fifty steps from the left: the middle.
       {{"mouse", {"mouseMoved", 285, 352}}},
       {{"until", "document.getElementById('entry').textContent.includes('--entry')"}},
       evaluated("entry", "document.getElementById('entry').textContent"),
       evaluated("drawn",
                 "[...document.querySelectorAll('#lobes canvas')].map((c) => new "
                 "Set(c.getContext('2d').getImageData(0, 0, c.width, c.height).data).size)"),
       evaluated(
           "picture",
           "{ const c = document.createElement('canvas'); c.width = c.height = 64; const p = "
           "document.getElementById('picture'); const x = c.getContext('2d'); x.drawImage(p, 0, "
           "0, 64, 64); new Set(x.getImageData(0, 0, 64, 64).data).size }"),
       {{"mouse", {"mouseMoved", 5, 600}}},
       {{"until", "document.getElementById('entry').textContent.includes('Point at')"}}});
  EXPECT_EQ(results["errors"], json::array());
  const std::string entry = results["entry"];
  // lambda 0.25 is between the nodes 0 and 0.5 of three, theta next to 0.
  EXPECT_NE(entry.find("0.4, 0.250"), std::string::npos) << entry;
  EXPECT_NE(entry.find("--entry 1,1,0,"), std::string::npos) << entry;
  for (const json& colors : results["drawn"])
    EXPECT_GT(colors.get<int>(), 20);
  EXPECT_GT(results["picture"].get<int>(), 20);
}

// ---- What cannot work ----

TEST_F(Viewer, WhatLiesBeyondTheAxesIsSaid) {
  Grid isotropic = Grid::paper({4, 1, 5, 1});
  isotropic.lambda = Axis::make(1, 1, 1, Warp::linear);
  isotropic.phi = Axis::make(0, 0, 1, Warp::linear);
  const Table turned = testing::synthetic_table(isotropic, Storage::roughness_scaled);
  write_page({{"t.h5", &turned}});
  const json results =
      drive({opened("#alpha_x=0.1&alpha_y=0.4"), is_there, evaluated("beyond", status_text),
             opened("#alpha_x=0.4&alpha_y=0.4"), is_there, evaluated("within", status_text)});
  EXPECT_NE(results["beyond"].get<std::string>().find(
                "Beyond the axes of t.h5, clamped: lambda 0.25 to 1."),
            std::string::npos)
      << results["beyond"];
  EXPECT_EQ(results["within"].get<std::string>().find("Beyond"), std::string::npos);
}

TEST_F(Viewer, ACutPageSaysSo) {
  write_page({{"nodes.h5", &nodes_}});
  const std::string page = read_file(folder_ / "page.html");
  folder_.write("page.html", page.substr(0, page.size() - 1000));
  const json results = drive({opened(""),
                              {{"until", status_text + ".includes('cut')"}},
                              evaluated("status", status_text)});
  EXPECT_NE(results["status"].get<std::string>().find("its script is not whole"),
            std::string::npos);
}

TEST_F(Viewer, DamagedValuesAreNamed) {
  write_page({{"nodes.h5", &nodes_}});
  std::string page = read_file(folder_ / "page.html");
  const std::size_t at = page.find("id=\"values-0\">") + 400;
  page[at] = page[at] == 'A' ? 'B' : 'A';
  folder_.write("page.html", page);
  const json results = drive({opened(""),
                              {{"until", message_text}},
                              evaluated("text", message_text),
                              evaluated("status", status_text)});
  const std::string text = results["text"];
  EXPECT_NE(text.find("The values of nodes.h5 are damaged"), std::string::npos) << text;
  EXPECT_EQ(results["status"], text);
  EXPECT_EQ(results["errors"], json::array());
}

TEST_F(Viewer, ABrowserWithoutWebGlIsTold) {
  write_page({{"nodes", &nodes_}});
  const json results =
      drive({opened(""), {{"until", message_text}}, evaluated("text", message_text)},
            {"--disable-3d-apis"});
  EXPECT_NE(results["text"].get<std::string>().find("no WebGL 2"), std::string::npos);
  EXPECT_EQ(results["errors"], json::array());
}

// Extensions that a browser lacks.
json without(const std::string& names) {
  return {{"before",
           "const have = WebGL2RenderingContext.prototype.getExtension; "
           "WebGL2RenderingContext.prototype.getExtension = function (name) { return " +
               names + ".includes(name) ? null : have.call(this, name); };"}};
}

TEST_F(Viewer, WhatABrowserLacksIsToldAndGoneAround) {
  write_page({{"nodes", &nodes_}});
  const json none = drive({without("['EXT_color_buffer_float', 'EXT_color_buffer_half_float']"),
                           opened(""),
                           {{"until", message_text}},
                           evaluated("text", message_text)});
  EXPECT_NE(none["text"].get<std::string>().find("EXT_color_buffer_float"), std::string::npos);
  const json unfiltered = drive({window_size,
                                 without("['OES_texture_float_linear']"),
                                 opened("#lookup=filter"),
                                 is_there,
                                 done("ltcViewer.fix([24, 24])"),
                                 {{"until", "ltcViewer.state().ready || " + message_text}},
                                 {{"until", status_text + ".includes('OES_texture_float_linear')"}},
                                 evaluated("middle", "ltcViewer.pixels(0)[4 * (24 * 16 + 14)]"),
                                 evaluated("text", message_text)});
  EXPECT_EQ(unfiltered["text"], "");
  EXPECT_GT(unfiltered["middle"].get<double>(), 0.01);
}

TEST_F(Viewer, SumsAreOfSixteenBitsWhereThirtyTwoAreRefused) {
  write_page({{"nodes", &nodes_}});
  const json results = drive({window_size,
                              without("['EXT_color_buffer_float']"),
                              opened(""),
                              {{"until", "window.ltcViewer || " + message_text}},
                              evaluated("text", message_text),
                              evaluated("status", status_text)});
  // Where the browser has no halfs either, that is what it says.
  const std::string said =
      results["text"].get<std::string>() + results["status"].get<std::string>();
  EXPECT_NE(said.find("EXT_color_buffer_float"), std::string::npos) << said;
  EXPECT_EQ(results["errors"], json::array());
}

TEST_F(Viewer, ATableThatIsTooLargeForTheBrowserIsTold) {
  write_page({{"nodes", &nodes_}});
  const json results =
      drive({{{"before",
               "const ask = WebGL2RenderingContext.prototype.getParameter; "
               "WebGL2RenderingContext.prototype.getParameter = function (name) { return name === "
               "WebGL2RenderingContext.MAX_3D_TEXTURE_SIZE ? 16 : ask.call(this, name); };"}},
             opened(""),
             {{"until", message_text}},
             evaluated("text", message_text)});
  EXPECT_NE(results["text"].get<std::string>().find(
                "nodes is 3 x 3 x 27 texels; this browser's 3-D textures have at most 16 a side"),
            std::string::npos)
      << results["text"];
  EXPECT_EQ(results["errors"], json::array());
}

TEST_F(Viewer, AFieldOfOneMaterialShowsThatAlone) {
  Field field = testing::synthetic_field();
  field.material = {0.3, 0.1};
  const Table table = table_of_field(field, Grid::paper(2), Storage::matrix, {1, nullptr});
  write_page({{"metal", &table}});
  const json results = drive({window_size,
                              opened(""),
                              is_there,
                              done("ltcViewer.fix([24, 24])"),
                              {{"until", "ltcViewer.state().ready || " + message_text}},
                              evaluated("alphas", "ltcViewer.state().alphas"),
                              evaluated("status", status_text),
                              evaluated("locked", "document.getElementById('alpha_x').disabled"),
                              evaluated("middle", "ltcViewer.pixels(0)[4 * (24 * 16 + 14)]")});
  EXPECT_EQ(results["alphas"], (json{0.3, 0.1}));
  EXPECT_EQ(results["locked"], true);
  EXPECT_NE(results["status"].get<std::string>().find("A field of one material"),
            std::string::npos);
  EXPECT_GT(results["middle"].get<double>(), 0.001);
  EXPECT_EQ(results["errors"], json::array());
}

TEST_F(Viewer, ALostContextIsToldAndComesBack) {
  write_page({{"nodes", &nodes_}});
  const json results =
      drive({window_size,
             opened(""),
             is_there,
             done("ltcViewer.fix([24, 24])"),
             {{"until", "ltcViewer.state().ready"}},
             done("window.lost = ltcViewer.loseContext()"),
             {{"until", message_text}},
             evaluated("text", message_text),
             done("window.lost.back()"),
             {{"until", "ltcViewer.state().ready && document.getElementById('message').hidden"}},
             evaluated("status", status_text),
             evaluated("middle", "ltcViewer.pixels(0)[4 * (24 * 16 + 14)]")});
  EXPECT_NE(results["text"].get<std::string>().find("took the graphics context away"),
            std::string::npos);
  EXPECT_NE(results["status"].get<std::string>().find("was lost, and is back"), std::string::npos);
  EXPECT_GT(results["middle"].get<double>(), 0.01);
  EXPECT_EQ(results["errors"], json::array());
}

}  // namespace
}  // namespace ltc::test
